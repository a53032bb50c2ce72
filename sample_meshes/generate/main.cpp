// Writes all sample meshes into a folder: generate_samples <folder> [name ...]
#include "shapes.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace {

static_assert(sizeof(float) == 4 && sizeof(int) == 4);

/// Binary little-endian PLY.
void writePly(const samples::Mesh& mesh, const std::filesystem::path& path) {
  std::ofstream file(path, std::ios::binary);
  file << "ply\nformat binary_little_endian 1.0\n"
       << "element vertex " << mesh.vertices.size() << "\n"
       << "property float x\nproperty float y\nproperty float z\n"
       << "element face " << mesh.faces.size() << "\n"
       << "property list uchar int vertex_indices\nend_header\n";
  for (const auto& vertex : mesh.vertices)
    file.write(reinterpret_cast<const char*>(vertex.data()), sizeof vertex);
  for (const auto& face : mesh.faces) {
    file.put(3);
    file.write(reinterpret_cast<const char*>(face.data()), sizeof face);
  }
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

} // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: generate_samples <folder> [name ...]\n");
    return 2;
  }
  try {
    const std::filesystem::path folder = argv[1];
    std::filesystem::create_directories(folder);
    for (const samples::Sample& sample : samples::allSamples()) {
      if (argc > 2 && std::find(argv + 2, argv + argc, sample.name) == argv + argc) continue;
      const samples::Mesh mesh = samples::meshAboveGround(sample.problem);
      writePly(mesh, folder / (sample.name + ".ply"));
      std::printf("%s: %zu vertices, %zu faces\n", sample.name.c_str(), mesh.vertices.size(),
                  mesh.faces.size());
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "generate_samples: %s\n", error.what());
    return 1;
  }
  return 0;
}
