#include "command_line/mesh_files.h"

#include "command_line/text_files.h"
#include "core/vcg_conversion.h"

#include <vcg/complex/algorithms/clean.h>
#include <wrap/io_trimesh/export.h>
#include <wrap/io_trimesh/import.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace massprops {
namespace {

namespace io = vcg::tri::io;

struct Vertex;
struct Face;
struct Used : vcg::UsedTypes<vcg::Use<Vertex>::AsVertexType, vcg::Use<Face>::AsFaceType> {};
struct Vertex : vcg::Vertex<Used, vcg::vertex::Coord3d, vcg::vertex::Normal3d,
                            vcg::vertex::Qualityd, vcg::vertex::Color4b, vcg::vertex::BitFlags> {};
struct Face : vcg::Face<Used, vcg::face::VertexRef, vcg::face::Normal3d, vcg::face::BitFlags> {};
struct Mesh : vcg::tri::TriMesh<std::vector<Vertex>, std::vector<Face>> {};

std::string suffixOf(const std::string& path) {
  std::string suffix = std::filesystem::path(path).extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return suffix;
}

void requireKnownFormat(const std::string& path) {
  const std::array<const char*, 4> known = {".stl", ".ply", ".obj", ".off"};
  if (std::find(known.begin(), known.end(), suffixOf(path)) != known.end()) return;
  throw InvalidInput("'" + path +
                     "' is of no known format: give a name that ends in .stl, .ply, .obj or .off.");
}

/// VCG's reader looks for the end of an ASCII file's first line without end.
bool endsALine(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return std::find(std::istreambuf_iterator<char>(file), {}, '\n') !=
         std::istreambuf_iterator<char>();
}

/// 80 bytes, the count of faces, and 50 bytes a face.
bool isBinaryStl(const std::string& path) {
  std::uint32_t count = 0;
  std::ifstream file(path, std::ios::binary);
  file.seekg(80);
  file.read(reinterpret_cast<char*>(&count), sizeof count);
  return file && std::filesystem::file_size(path) == 84 + 50 * std::uintmax_t{count};
}

void write(const std::string& path, const TriangleMesh& mesh, Mesh& file, int mask) {
  const int all = io::Mask::IOM_VERTCOORD | io::Mask::IOM_FACEINDEX | mask;
  const std::string suffix = suffixOf(path);
  bool isWritten = false;
  if (suffix == ".obj") {
    isWritten = writeObj(path, mesh);
  } else if (suffix == ".off") {
    isWritten = writeOff(path, mesh);
  } else if (suffix == ".stl") {
    isWritten = io::ExporterSTL<Mesh>::Save(file, path.c_str()) == 0;
  } else {
    isWritten = io::ExporterPLY<Mesh>::Save(file, path.c_str(), all) == 0;
  }
  if (!isWritten) throw std::runtime_error("'" + path + "' cannot be written.");
}

} // namespace

MeshFile readMesh(const std::string& path) {
  requireKnownFormat(path);
  if (!std::ifstream(path)) throw InvalidInput("'" + path + "' cannot be opened.");
  const auto requireReadable = [&](bool isReadable) {
    if (!isReadable) throw InvalidInput("'" + path + "' cannot be read: it may be damaged.");
  };
  if (suffixOf(path) == ".obj") {
    MeshFile file;
    requireReadable(readObj(path, file.mesh));
    return file;
  }
  requireReadable(suffixOf(path) != ".stl" || isBinaryStl(path) || endsALine(path));
  Mesh mesh;
  const int failure = io::Importer<Mesh>::Open(mesh, path.c_str());
  requireReadable(!io::Importer<Mesh>::ErrorCritical(failure));
  if (suffixOf(path) == ".stl") vcg::tri::Clean<Mesh>::RemoveDuplicateVertex(mesh);
  return {fromVcg(mesh, Placement::Identity()), selectedFaces(mesh)};
}

TriangleMesh withoutEqualVertices(const TriangleMesh& mesh) {
  Mesh merged;
  toVcg(mesh, Placement::Identity(), merged);
  vcg::tri::Clean<Mesh>::RemoveDuplicateVertex(merged);
  return fromVcg(merged, Placement::Identity());
}

void requireMeshFormat(const std::string& path) {
  requireKnownFormat(path);
}

bool keepsDoubles(const std::string& path) {
  return suffixOf(path) != ".stl";
}

void writeMesh(const std::string& path, const TriangleMesh& mesh, const Vector& quality) {
  Mesh file;
  toVcg(mesh, Placement::Identity(), file);
  if (quality.size() > 0) {
    Eigen::Index v = 0;
    for (Vertex& vertex : file.vert) vertex.Q() = quality[v++];
  }
  write(path, mesh, file, quality.size() > 0 ? io::Mask::IOM_VERTQUALITY : 0);
}

void writeMesh(const std::string& path, const ColouredMesh& mesh) {
  Mesh file;
  toVcg(mesh.mesh, Placement::Identity(), file);
  auto colour = mesh.colours.begin();
  for (Vertex& vertex : file.vert) {
    vertex.C() = vcg::Color4b(colour->red, colour->green, colour->blue, 255);
    ++colour;
  }
  write(path, mesh.mesh, file, io::Mask::IOM_VERTCOLOR);
}

} // namespace massprops
