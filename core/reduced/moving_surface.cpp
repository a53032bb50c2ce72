#include "core/reduced/moving_surface.h"

#include "core/base/parallel.h"
#include "core/base/stopwatch.h"
#include "core/base/triangle.h"
#include "core/mesh/refinement.h"
#include "core/reduced/offset_field.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace massprops {
namespace {

/// Of the diagonal: smooths the noise of the skeleton's correspondence and keeps its shape.
constexpr double kDiffusionLength = 0.02;

/// What moves inwards is as fine as a cavity has to be: on finer ones, the objective does not
/// improve by more than the one or two per cent that it scatters by. In working lengths.
constexpr DecimationTarget kMoving{12000, 3000, 1.5e-4};

/// Skeleton and basis are smooth: their carrier leads to cavities as good as the whole surface does
/// (benchmarks/results.md).
constexpr DecimationTarget kCarrier{4800, 1200, 1.5e-4};

/// Even surfaces of so many vertices move as they are.
constexpr Eigen::Index kEnough = 600;

/// A function of the basis needs a few vertices to have a shape.
DecimationTarget carrying(int basisSize, const DecimationTarget& wanted) {
  constexpr Eigen::Index kVerticesAFunction = 4;
  const Eigen::Index needed = kVerticesAFunction * basisSize;
  return {std::max(wanted.most, needed), std::max(wanted.least, needed), wanted.distance};
}

/// The edges of so many triangles of one size and shape, with half as many vertices.
double evenEdge(double area, Eigen::Index vertices) {
  return std::sqrt(2.0 / std::sqrt(3.0) * area / static_cast<double>(vertices));
}

/// The greatest length of its edges, where the surface has too few triangles or uneven ones; empty
/// where they do as they are.
std::optional<double> edgeToRefineTo(const PosedModel& posed, int basisSize) {
  // In edges of even triangles: what splitting leaves, and what well-shaped surfaces have.
  constexpr double kLong = 1.5;
  constexpr double kUneven = 2.5;
  const Eigen::Index n = posed.vertices.rows();
  const Eigen::Index needed = std::min(carrying(basisSize, kMoving).least, kMoving.most);
  const double area = surfaceArea(posed.vertices, posed.faces);
  const double longest = longestEdge(posed.vertices, posed.faces);
  const double edge = kLong * evenEdge(area, needed);
  const bool isEven = longest <= kUneven * evenEdge(area, n);
  const bool isMany = n >= carrying(basisSize, {kEnough, kEnough, 0.0}).least;
  if (longest <= edge || (isEven && isMany)) return std::nullopt;
  return edge;
}

/// What moves inwards in place of the surface.
DecimatedMesh copyOf(const PosedModel& posed, std::optional<double> edge, int basisSize) {
  DecimationTarget target = carrying(basisSize, kMoving);
  if (!edge) return decimated(posed.vertices, posed.faces, target);
  const TriangleMesh fine = refined(posed.vertices, posed.faces, *edge);
  target.longestEdge = *edge;
  return decimated(fine.vertices, fine.faces, target);
}

void requireEnoughVertices(const TriangleMesh& carrier, int basisSize) {
  if (basisSize < carrier.vertices.rows()) return;
  throw InvalidInput("basis_k is " + std::to_string(basisSize) +
                     ", but what moves inwards has only " +
                     std::to_string(carrier.vertices.rows()) +
                     " vertices: lower basis_k below that, or refine the model with Remeshing > "
                     "Subdivision Surfaces: Midpoint.");
}

} // namespace

Coarsening coarsen(const PosedModel& posed, const CoarseningOptions& options,
                   const std::function<void()>& whenCopied, const std::function<void()>& beside) {
  const Stopwatch copying;
  const DecimationTarget whole{posed.vertices.rows(), posed.vertices.rows(), 0.0};
  const std::optional<double> edge =
      options.mayCopy ? edgeToRefineTo(posed, options.basisSize) : std::nullopt;
  DecimatedMesh copy = options.mayCopy ? copyOf(posed, edge, options.basisSize)
                                       : decimated(posed.vertices, posed.faces, whole);
  auto moving = std::make_shared<MovingSurface>();
  moving->isCopy = edge || !copy.isWhole();
  moving->vertices = std::move(copy.mesh.vertices);
  moving->faces = std::move(copy.mesh.faces);
  moving->carrier =
      decimated(moving->vertices, moving->faces,
                options.isCarrierCoarse ? carrying(options.basisSize, kCarrier) : whole);
  requireEnoughVertices(moving->carrier.mesh, options.basisSize);
  Coarsening result;
  if (!edge) result.vertexOf = std::move(copy.vertexOf);
  result.secondsCopy = copying.seconds();
  whenCopied();

  const TriangleMesh& carrier = moving->carrier.mesh;
  const Vector area = vertexLumpedMass(moving->vertices, moving->faces);
  moving->mass = area / area.sum();
  SparseMatrix laplacian;
  Vector carrierArea; // that the carrier's vertices stand for on what moves
  inParallel(
      [&] {
        const Stopwatch time;
        moving->interpolation = interpolationFrom(moving->carrier, moving->vertices);
        carrierArea = moving->interpolation.transposeTimes(area);
        laplacian = cotanLaplacian(carrier.vertices, carrier.faces);
        moving->basis = harmonicBasis(carrier.vertices, carrier.faces, laplacian,
                                      carrierArea / carrierArea.sum(), options.basisSize);
        result.secondsBasis = time.seconds();
        beside();
      },
      [&] {
        const Stopwatch time;
        result.skeleton = meanCurvatureSkeleton(carrier.vertices, carrier.faces);
        result.secondsSkeleton = time.seconds();
      });
  if (options.isSmooth) moving->laplacian = cotanLaplacian(moving->vertices, moving->faces);
  result.axis = moving->interpolation * smoothedOverSurface(result.skeleton.points, laplacian,
                                                            carrierArea, kDiffusionLength);
  result.moving = std::move(moving);
  return result;
}

} // namespace massprops
