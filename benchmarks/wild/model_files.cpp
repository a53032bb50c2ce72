#include "wild/model_files.h"

#include "core/vcg_conversion.h"
#include "shapes.h"

#include <vcg/complex/algorithms/clean.h>
#include <wrap/io_trimesh/import.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

namespace massprops::wild {
namespace {

struct Vertex;
struct Face;
struct Used : vcg::UsedTypes<vcg::Use<Vertex>::AsVertexType, vcg::Use<Face>::AsFaceType> {};
struct Vertex : vcg::Vertex<Used, vcg::vertex::Coord3f, vcg::vertex::BitFlags> {};
struct Face : vcg::Face<Used, vcg::face::VertexRef, vcg::face::BitFlags> {};
struct Mesh : vcg::tri::TriMesh<std::vector<Vertex>, std::vector<Face>> {};

std::string extension(const std::filesystem::path& path) {
  std::string result = path.extension().string();
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

bool isModel(const std::filesystem::path& path) {
  const std::array<const char*, 4> kinds = {".stl", ".obj", ".off", ".ply"};
  return std::find(kinds.begin(), kinds.end(), extension(path)) != kinds.end();
}

} // namespace

std::vector<std::string> modelFiles(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    if (!std::filesystem::is_directory(path)) {
      files.push_back(path);
      continue;
    }
    const auto options = std::filesystem::directory_options::follow_directory_symlink;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path, options)) {
      if (entry.is_regular_file() && isModel(entry.path())) files.push_back(entry.path().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

TriangleMesh readModel(const std::string& file) {
  const std::size_t colon = file.find_last_of(':');
  const std::string path = file.substr(0, colon);
  const int cuts = colon == std::string::npos ? 0 : std::stoi(file.substr(colon + 1));
  Mesh mesh;
  namespace io = vcg::tri::io;
  if (extension(path) == ".obj") {
    io::ImporterOBJ<Mesh>::Info info;
    if (!io::ImporterOBJ<Mesh>::LoadMask(path.c_str(), info)) return {};
    // Faces whose textures or normals it has no place for would be left out.
    info.mask = io::Mask::IOM_VERTCOORD | io::Mask::IOM_FACEINDEX;
    io::ImporterOBJ<Mesh>::Open(mesh, path.c_str(), info);
  } else {
    int mask = 0;
    io::Importer<Mesh>::Open(mesh, path.c_str(), mask);
  }
  vcg::tri::Clean<Mesh>::RemoveDuplicateVertex(mesh);
  vcg::tri::Clean<Mesh>::RemoveUnreferencedVertex(mesh);
  if (mesh.VN() == 0) return {};
  TriangleMesh result = fromVcg(mesh, Placement::Identity());
  for (int i = 0; i < cuts; ++i) result = testing::subdivided(result);
  const double side =
      (result.vertices.colwise().maxCoeff() - result.vertices.colwise().minCoeff()).maxCoeff();
  result.vertices = (result.vertices * (100.0 / side)).cast<float>().cast<double>().eval();
  return result;
}

} // namespace massprops::wild
