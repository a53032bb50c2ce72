// Surfaces as MeshLab wrote them.
#pragma once

#include <Eigen/Dense>

#include <string>

namespace simulation {

struct Mesh {
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> vertices;
  Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor> faces;
};

/// A binary little-endian PLY file whose vertices begin with float x, y, z and whose faces begin
/// with a list of three vertices. \throw std::runtime_error for any other file
Mesh readPly(const std::string& path);

} // namespace simulation
