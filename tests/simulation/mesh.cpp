#include "simulation/mesh.h"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace simulation {
namespace {

struct Property {
  std::string name;
  std::size_t bytes;
};

struct Element {
  std::string name;
  Eigen::Index count = 0;
  bool isList = false;
  std::size_t countBytes = 0;       ///< of the list's length
  std::vector<Property> properties; ///< of a list element the first is the list's item
};

std::size_t bytesOf(const std::string& type) {
  if (type == "char" || type == "uchar" || type == "int8" || type == "uint8") return 1;
  if (type == "short" || type == "ushort" || type == "int16" || type == "uint16") return 2;
  if (type == "double" || type == "float64") return 8;
  return 4;
}

std::vector<Element> readHeader(std::istream& file) {
  std::vector<Element> elements;
  bool isBinary = false;
  for (std::string line; std::getline(file, line) && line != "end_header";) {
    std::istringstream words(line);
    std::string word;
    words >> word;
    if (word == "format") {
      words >> word;
      isBinary = word == "binary_little_endian";
    } else if (word == "element") {
      Element element;
      words >> element.name >> element.count;
      elements.push_back(element);
    } else if (word == "property") {
      std::string type;
      words >> type;
      if (type == "list") {
        elements.back().isList = true;
        words >> word >> type;
        elements.back().countBytes = bytesOf(word);
      }
      words >> word;
      elements.back().properties.push_back({word, bytesOf(type)});
    }
  }
  if (!isBinary) throw std::runtime_error("not a binary little-endian PLY file");
  return elements;
}

template <typename T>
T take(std::istream& file) {
  T value{};
  file.read(reinterpret_cast<char*>(&value), sizeof value);
  return value;
}

void skip(std::istream& file, const std::vector<Property>& properties, std::size_t first) {
  for (std::size_t i = first; i < properties.size(); ++i) {
    file.ignore(static_cast<std::streamsize>(properties[i].bytes));
  }
}

void readVertices(std::istream& file, const Element& element, Mesh& mesh) {
  const auto& p = element.properties;
  if (p.size() < 3 || p[0].name != "x" || p[0].bytes != 4 || p[2].name != "z") {
    throw std::runtime_error("vertices do not begin with float x, y, z");
  }
  mesh.vertices.resize(element.count, 3);
  for (Eigen::Index v = 0; v < element.count; ++v) {
    for (int k = 0; k < 3; ++k) mesh.vertices(v, k) = take<float>(file);
    skip(file, p, 3);
  }
}

void readFaces(std::istream& file, const Element& element, Mesh& mesh) {
  if (!element.isList || element.countBytes != 1 || element.properties[0].bytes != 4) {
    throw std::runtime_error("faces do not begin with a list of int");
  }
  mesh.faces.resize(element.count, 3);
  for (Eigen::Index f = 0; f < element.count; ++f) {
    if (take<std::uint8_t>(file) != 3) throw std::runtime_error("a face is no triangle");
    for (int k = 0; k < 3; ++k) mesh.faces(f, k) = take<std::int32_t>(file);
    skip(file, element.properties, 1);
  }
}

} // namespace

Mesh readPly(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot open " + path);
  try {
    Mesh mesh;
    for (const Element& element : readHeader(file)) {
      if (element.name == "vertex") readVertices(file, element, mesh);
      if (element.name == "face") readFaces(file, element, mesh);
    }
    if (!file || mesh.faces.minCoeff() < 0 || mesh.faces.maxCoeff() >= mesh.vertices.rows()) {
      throw std::runtime_error("it ends early");
    }
    return mesh;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

} // namespace simulation
