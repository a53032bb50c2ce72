#include "core/mesh/degenerate_faces.h"

#include "core/base/triangle.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace massprops {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

} // namespace

std::vector<int> facesWithoutArea(const Points& vertices, const Faces& faces) {
  std::vector<int> flat;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Vec3 a = vertices.row(faces(f, 0)).transpose();
    const Vec3 ab = vertices.row(faces(f, 1)).transpose() - a;
    const Vec3 ac = vertices.row(faces(f, 2)).transpose() - a;
    if (areaNormal(vertices, faces, f).squaredNorm() >
        kSafe * kSafe * ab.squaredNorm() * ac.squaredNorm())
      continue;
    const auto exact = [&](int v) {
      return Kernel::Point_3(vertices(v, 0), vertices(v, 1), vertices(v, 2));
    };
    if (CGAL::collinear(exact(faces(f, 0)), exact(faces(f, 1)), exact(faces(f, 2)))) {
      flat.push_back(static_cast<int>(f));
    }
  }
  return flat;
}

} // namespace massprops
