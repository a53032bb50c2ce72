#include "core/mesh/interpolation.h"

#include "core/base/parallel.h"
#include "core/base/triangle.h"
#include "core/mesh/connectivity.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace massprops {
namespace {

constexpr Eigen::Index kChunk = 4096;

template <int Columns>
void addTransposed(const Faces& corners, const Points& weights,
                   const Eigen::Ref<const RowMatrix>& values, const Chunk& chunk, RowMatrix& sum) {
  using Row = Eigen::Matrix<double, 1, Columns>;
  for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
    const Eigen::Map<const Row> value(values.row(v).data(), values.cols());
    for (int k = 0; k < 3; ++k) {
      Eigen::Map<Row>(sum.row(corners(v, k)).data(), sum.cols()) += weights(v, k) * value;
    }
  }
}

/// The nearest point of a surface, looked for from a vertex near it: always to the nearest face
/// around the corners of the last one.
class WalkToNearest {
public:
  explicit WalkToNearest(const TriangleMesh& mesh)
      : mesh_(mesh), corners_(vertexCorners(mesh.vertices.rows(), mesh.faces)) {}

  struct Place {
    int face = -1;
    Vec3 weights = Vec3::Zero(); ///< of the face's corners
    double squaredDistance = std::numeric_limits<double>::infinity();
  };

  /// `visited`: room for the vertices that it goes round.
  Place from(int vertex, const Vec3& p, std::vector<int>& visited) const {
    visited.clear();
    Place best;
    goRound(vertex, p, visited, best);
    for (int last = -1; best.face != last;) {
      last = best.face;
      for (const int v : mesh_.faces.row(last)) goRound(v, p, visited, best);
    }
    return best;
  }

private:
  void goRound(int vertex, const Vec3& p, std::vector<int>& visited, Place& best) const {
    if (std::find(visited.begin(), visited.end(), vertex) != visited.end()) return;
    visited.push_back(vertex);
    for (const int corner : corners_.at(vertex)) {
      const int f = corner / 3;
      const Vec3 a = mesh_.vertices.row(mesh_.faces(f, 0)).transpose();
      const Vec3 b = mesh_.vertices.row(mesh_.faces(f, 1)).transpose();
      const Vec3 c = mesh_.vertices.row(mesh_.faces(f, 2)).transpose();
      const Vec3 w = nearestWeights(p, a, b, c);
      const double distance = (w[0] * a + w[1] * b + w[2] * c - p).squaredNorm();
      if (distance < best.squaredDistance) best = {f, w, distance};
    }
  }

  const TriangleMesh& mesh_;
  VertexCorners corners_;
};

} // namespace

Interpolation::Interpolation(Faces corners, Points weights, Eigen::Index coarseSize)
    : rows_(corners.rows()), cols_(coarseSize), corners_(std::move(corners)),
      weights_(std::move(weights)) {}

Interpolation Interpolation::identity(Eigen::Index size) {
  Interpolation result;
  result.rows_ = size;
  result.cols_ = size;
  return result;
}

Vector Interpolation::operator*(const Vector& values) const {
  if (isIdentity()) return values;
  Vector result(rows_);
  forChunks(rows_, kChunk, [&](const Chunk& chunk) {
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      result[v] = weights_(v, 0) * values[corners_(v, 0)] +
                  weights_(v, 1) * values[corners_(v, 1)] + weights_(v, 2) * values[corners_(v, 2)];
    }
  });
  return result;
}

Points Interpolation::operator*(const Points& values) const {
  if (isIdentity()) return values;
  Points result(rows_, 3);
  forChunks(rows_, kChunk, [&](const Chunk& chunk) {
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      result.row(v) = weights_(v, 0) * values.row(corners_(v, 0)) +
                      weights_(v, 1) * values.row(corners_(v, 1)) +
                      weights_(v, 2) * values.row(corners_(v, 2));
    }
  });
  return result;
}

RowMatrix Interpolation::transposeTimes(const Eigen::Ref<const RowMatrix>& values) const {
  if (isIdentity()) return values;
  // One sum a chunk, for the sums of two threads must not depend on who comes first.
  const Eigen::Index length = std::max<Eigen::Index>(kChunk / 2, chunkCount(rows_, 4));
  std::vector<RowMatrix> parts(static_cast<std::size_t>(chunkCount(rows_, length)));
  forChunks(rows_, length, [&](const Chunk& chunk) {
    RowMatrix& part = parts[static_cast<std::size_t>(chunk.number)];
    part.setZero(cols_, values.cols());
    // Rows of known length take half the time.
    switch (values.cols()) {
    case 4:
      addTransposed<4>(corners_, weights_, values, chunk, part);
      break;
    case 10:
      addTransposed<10>(corners_, weights_, values, chunk, part);
      break;
    default:
      addTransposed<Eigen::Dynamic>(corners_, weights_, values, chunk, part);
    }
  });
  for (std::size_t i = 1; i < parts.size(); ++i) parts[0] += parts[i];
  return std::move(parts[0]);
}

Interpolation interpolationFrom(const DecimatedMesh& coarse, const Points& vertices) {
  if (coarse.isWhole()) return Interpolation::identity(vertices.rows());
  // A vertex lies near the one that it was collapsed onto.
  const WalkToNearest walk(coarse.mesh);
  Faces corners(vertices.rows(), 3);
  Points weights(vertices.rows(), 3);
  forChunks(vertices.rows(), kChunk, [&](const Chunk& chunk) {
    std::vector<int> visited;
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      const WalkToNearest::Place place = walk.from(coarse.vertexFor[static_cast<std::size_t>(v)],
                                                   vertices.row(v).transpose(), visited);
      corners.row(v) = coarse.mesh.faces.row(place.face);
      weights.row(v) = place.weights.transpose();
    }
  });
  return {std::move(corners), std::move(weights), coarse.mesh.vertices.rows()};
}

} // namespace massprops
