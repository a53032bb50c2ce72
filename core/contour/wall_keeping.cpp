#include "core/contour/wall_keeping.h"

#include "core/base/parallel.h"
#include "core/base/triangle.h"
#include "core/contour/shape_guard.h"

#include <algorithm>
#include <cmath>

namespace massprops {
namespace {

/// By how much the walls of a cavity's faces are too thin; measured anew where vertices have moved.
class Shortfall {
public:
  Shortfall(const TriangleTree& surface, double wall, const Faces& faces, const Points* kept)
      : surface_(surface), wall_(wall), faces_(faces), ofFace_(Vector::Zero(faces.rows())) {
    if (kept != nullptr) last_ = *kept;
  }

  /// For every vertex the largest of the faces around it.
  Vector measure(const Points& vertices) {
    constexpr Eigen::Index kRun = 256;
    const bool isFirst = last_.rows() == 0;
    forChunks(faces_.rows(), kRun, [&](const Chunk& chunk) {
      for (Eigen::Index f = chunk.begin; f < chunk.end; ++f) {
        if (isFirst || hasMoved(f, vertices)) ofFace_[f] = shortfall(f, vertices);
      }
    });
    last_ = vertices;
    Vector ofVertex = Vector::Zero(vertices.rows());
    for (Eigen::Index f = 0; f < faces_.rows(); ++f) {
      for (const int v : faces_.row(f)) ofVertex[v] = std::max(ofVertex[v], ofFace_[f]);
    }
    return ofVertex;
  }

private:
  bool hasMoved(Eigen::Index f, const Points& vertices) const {
    const auto corners = faces_.row(f);
    return std::any_of(corners.begin(), corners.end(),
                       [&](int v) { return vertices.row(v) != last_.row(v); });
  }

  double shortfall(Eigen::Index f, const Points& vertices) const {
    const auto corner = [&](int k) { return Vec3(vertices.row(faces_(f, k)).transpose()); };
    const double squared =
        surface_.squaredClearance(corner(0), corner(1), corner(2), wall_ * wall_);
    return std::max(wall_ - std::sqrt(squared), 0.0);
  }

  const TriangleTree& surface_;
  double wall_;
  const Faces& faces_;
  Vector ofFace_;
  Points last_; ///< where the vertices were
};

} // namespace

std::vector<int> keepWall(const TriangleTree& surface, double wall, TriangleMesh& cavity,
                          const Points* kept) {
  constexpr int kRounds = 12;
  constexpr double kMore = 1.05; // than what is missing, for the direction turns on the way
  constexpr double kGrowth = 0.5;
  constexpr double kLeast = 1e-4; // of the wall
  Shortfall shortfall(surface, wall, cavity.faces, kept);
  std::vector<int> thin;
  for (int round = 0; round <= kRounds; ++round) {
    const Vector missing = shortfall.measure(cavity.vertices);
    thin.clear();
    for (Eigen::Index v = 0; v < missing.size(); ++v) {
      if (missing[v] > 0.0) thin.push_back(static_cast<int>(v));
    }
    if (thin.empty() || round == kRounds) break;
    Points targets = cavity.vertices;
    const Points normals = vertexNormals(cavity.vertices, cavity.faces);
    for (const int v : thin) {
      const Vec3 x = cavity.vertices.row(v).transpose();
      const Vec3 away = (x - surface.clearance(x).point).normalized();
      const Vec3 inwards = -normals.row(v).transpose();
      // Where a face bulges, away from its corner's nearest point is not away from the face's.
      targets.row(v) += ((kMore + kGrowth * round) * missing[v] + kLeast * wall) *
                        (away + inwards).normalized().transpose();
    }
    moveSoundly(targets, cavity.faces, cavity.vertices);
  }
  return thin;
}

} // namespace massprops
