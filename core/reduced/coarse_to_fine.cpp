#include "core/reduced/coarse_to_fine.h"

#include <memory>
#include <utility>
#include <vector>

namespace massprops {
namespace {

template <class Rows>
Rows rowsOf(const Rows& values, const std::vector<int>& rows) {
  Rows result(static_cast<Eigen::Index>(rows.size()), values.cols());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    result.row(static_cast<Eigen::Index>(i)) = values.row(rows[i]);
  }
  return result;
}

/// The faces whose corners do not fall together: what is closed stays closed.
Faces clustered(const Faces& faces, const std::vector<int>& vertexFor) {
  Faces result(faces.rows(), 3);
  Eigen::Index kept = 0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const int a = vertexFor[static_cast<std::size_t>(faces(f, 0))];
    const int b = vertexFor[static_cast<std::size_t>(faces(f, 1))];
    const int c = vertexFor[static_cast<std::size_t>(faces(f, 2))];
    if (a != b && b != c && c != a) result.row(kept++) << a, b, c;
  }
  result.conservativeResize(kept, 3);
  return result;
}

} // namespace

MinimizeResult minimizeCoarseToFine(const OffsetModel& model, const Goal& goal,
                                    const Weights& weights, const Vector& start,
                                    const MinimizeOptions& options) {
  const DecimatedMesh& carrier = model.surface->carrier;
  auto surface = std::make_shared<MovingSurface>();
  surface->vertices = rowsOf(model.surface->vertices, carrier.vertexOf);
  surface->basis = model.surface->basis;
  OffsetModel coarse;
  coarse.surface = std::move(surface);
  coarse.field.directions = rowsOf(model.field.directions, carrier.vertexOf);
  coarse.inner = {rowsOf(model.inner.lower, carrier.vertexOf),
                  rowsOf(model.inner.upper, carrier.vertexOf)};
  coarse.innerFaces = clustered(model.innerFaces, carrier.vertexFor);
  coarse.fillings = model.fillings;
  coarse.solidMoments = model.solidMoments;
  const auto standIn = [&](const Vector& x) { return evaluate(coarse, goal, weights, x); };
  const MinimizeResult rough = minimize(standIn, start, options);
  MinimizeOptions remaining = options;
  remaining.objectiveScale = rough.objectiveScale;
  const auto exact = [&](const Vector& x) { return evaluate(model, goal, weights, x); };
  MinimizeResult result = minimize(exact, rough.x, remaining);
  result.evaluations += rough.evaluations;
  return result;
}

} // namespace massprops
