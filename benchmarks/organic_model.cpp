#include "organic_model.h"

#include "core/base/parallel.h"
#include "core/mesh/connectivity.h"
#include "property/mesher.h"

#include <algorithm>
#include <cmath>

namespace massprops::benchmarks {
namespace {

using testing::capsuleDistance;
using testing::smoothMinimum;

double animal(const Vec3& p) {
  struct Limb {
    Vec3 from, to;
    double fromRadius, toRadius;
  };
  static const Limb limbs[] = {
      {{0.9, 0.2, 1.1}, {-0.9, -0.2, 1.3}, 0.5, 0.62},    // body
      {{-1.2, -0.2, 1.6}, {-2.0, -0.3, 2.5}, 0.35, 0.3},  // neck
      {{-2.0, -0.3, 2.5}, {-2.6, -0.35, 2.4}, 0.36, 0.2}, // head
      {{-1.9, -0.1, 2.7}, {-1.8, 0.15, 3.1}, 0.14, 0.08}, // ears
      {{-1.95, -0.5, 2.7}, {-1.9, -0.8, 3.1}, 0.14, 0.08},
      {{1.2, 0.2, 1.2}, {2.3, 0.4, 1.9}, 0.26, 0.1},   // tail
      {{0.8, 0.55, 0.8}, {0.9, 0.7, -0.3}, 0.26, 0.2}, // legs
      {{0.8, -0.25, 0.8}, {0.95, -0.4, -0.3}, 0.26, 0.2},
      {{-0.8, 0.25, 0.9}, {-0.7, 0.4, -0.3}, 0.28, 0.2},
      {{-0.8, -0.55, 0.9}, {-0.75, -0.75, -0.3}, 0.28, 0.2},
  };
  double value = 10.0;
  for (const Limb& limb : limbs) {
    value = smoothMinimum(
        value, capsuleDistance(p, limb.from, limb.to, limb.fromRadius, limb.toRadius), 0.25);
  }
  // A little skin, so that no patch is exactly smooth.
  value += 0.006 * std::sin(14.0 * p.x()) * std::sin(15.0 * p.y()) * std::sin(13.0 * p.z());
  return std::max(value, -p.z()); // flat feet
}

void drawOntoSurface(Points& vertices, double step) {
  forChunks(vertices.rows(), 4096, [&](const Chunk& chunk) {
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      Vec3 p = vertices.row(v).transpose();
      for (int i = 0; i < 2; ++i) {
        const double h = 1e-3 * step;
        Vec3 g;
        for (int k = 0; k < 3; ++k) {
          g[k] = (animal(p + h * Vec3::Unit(k)) - animal(p - h * Vec3::Unit(k))) / (2.0 * h);
        }
        const Vec3 back = -animal(p) * g / std::max(g.squaredNorm(), 0.1);
        p += back.normalized() * std::min(back.norm(), 0.3 * step);
      }
      vertices.row(v) = p.transpose();
    }
  });
}

/// Every triangle in four.
TriangleMesh refined(const TriangleMesh& mesh) {
  const std::vector<int> opposite = oppositeHalfEdges(mesh.vertices.rows(), mesh.faces);
  std::vector<int> middle(opposite.size());
  int count = static_cast<int>(mesh.vertices.rows());
  for (std::size_t h = 0; h < opposite.size(); ++h) {
    const auto other = static_cast<std::size_t>(opposite[h]);
    middle[h] = other < h ? middle[other] : count++;
  }
  TriangleMesh result{Points(count, 3), Faces(4 * mesh.faces.rows(), 3)};
  result.vertices.topRows(mesh.vertices.rows()) = mesh.vertices;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    int m[3];
    for (int k = 0; k < 3; ++k) {
      m[k] = middle[static_cast<std::size_t>(3 * f + k)];
      result.vertices.row(m[k]) = 0.5 * (mesh.vertices.row(mesh.faces(f, k)) +
                                         mesh.vertices.row(mesh.faces(f, (k + 1) % 3)));
      result.faces.row(4 * f + k) << mesh.faces(f, k), m[k], 0;
    }
    for (int k = 0; k < 3; ++k) result.faces(4 * f + k, 2) = m[(k + 2) % 3];
    result.faces.row(4 * f + 3) << m[0], m[1], m[2];
  }
  return result;
}

} // namespace

TriangleMesh organicModel(Eigen::Index vertexCount) {
  // Each refinement has four times as many vertices; so many that the lattice stays small.
  int refinements = 0;
  double coarse = static_cast<double>(vertexCount);
  while (coarse > 30000.0) {
    coarse /= 4.0;
    ++refinements;
  }
  // About 3.5 vertices for every cell that the surface, of area 25, passes.
  double step = std::sqrt(88.0 / coarse);
  TriangleMesh mesh = testing::implicitMesh(animal, {-3.2, -1.4, -0.2}, {2.8, 1.4, 3.5}, step, 12);
  for (int i = 0; i < refinements; ++i) {
    mesh = refined(mesh);
    step /= 2.0;
    drawOntoSurface(mesh.vertices, step);
  }
  return mesh;
}

} // namespace massprops::benchmarks
