// The parts of the filter that are called most, each by itself, on one core: the moments with all
// gradients, the harmonic basis, the offset directions and the inspection of the result.
//
// usage: micro [Google Benchmark's options]
#include "core/base/parallel.h"
#include "core/check/inspection.h"
#include "core/mesh/decimation.h"
#include "core/model/posed_model.h"
#include "core/physics/moments.h"
#include "core/reduced/harmonics.h"
#include "core/reduced/laplacian.h"
#include "core/reduced/offset_field.h"
#include "organic_model.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <map>

namespace {

using namespace massprops;

/// An animal in the working frame, with a cavity that keeps a wall of 1 % of the diagonal.
struct Animal {
  PosedModel posed;
  Points directions;
  Points inner;
};

const Animal& animal(Eigen::Index size) {
  static std::map<Eigen::Index, Animal> made;
  const auto at = made.find(size);
  if (at != made.end()) return at->second;
  setThreadCount(1);
  Animal a{makePosedModel(makeSolid(benchmarks::organicModel(size)), {}), {}, {}};
  const Points& x = a.posed.vertices;
  const Points middle = Points::Zero(x.rows(), 3).rowwise() + x.colwise().mean();
  const OffsetField field = offsetField(x, a.posed.faces, middle);
  a.directions = field.directions;
  const Vector offsets = (2.0 * a.posed.wall * field.clearance.cwiseMax(0.2).cwiseInverse())
                             .cwiseMin(0.5 * field.reach);
  a.inner = x - offsets.asDiagonal() * field.directions;
  return made.emplace(size, std::move(a)).first->second;
}

void countTriangles(benchmark::State& state, const Animal& a) {
  state.counters["a_triangle"] = benchmark::Counter(static_cast<double>(a.posed.faces.rows()),
                                                    benchmark::Counter::kIsIterationInvariantRate |
                                                        benchmark::Counter::kInvert);
}

void momentsWithGradients(benchmark::State& state) {
  const Animal& a = animal(state.range(0));
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(momentsWithRates(a.inner, a.posed.faces, a.directions));
  }
  countTriangles(state, a);
}

void basis(benchmark::State& state) {
  const Animal& a = animal(100000);
  const DecimatedMesh carrier =
      decimated(a.posed.vertices, a.posed.faces, {state.range(0), state.range(0), 0.0});
  const SparseMatrix L = cotanLaplacian(carrier.mesh.vertices, carrier.mesh.faces);
  const Vector area = vertexLumpedMass(carrier.mesh.vertices, carrier.mesh.faces);
  constexpr int kBasisSize = 36;
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(
        harmonicBasis(carrier.mesh.vertices, carrier.mesh.faces, L, area / area.sum(), kBasisSize));
  }
}

void directionField(benchmark::State& state) {
  const Animal& a = animal(state.range(0));
  const Points middle =
      Points::Zero(a.posed.vertices.rows(), 3).rowwise() + a.posed.vertices.colwise().mean();
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(offsetField(a.posed.vertices, a.posed.faces, middle));
  }
  countTriangles(state, a);
}

void checker(benchmark::State& state) {
  const Animal& a = animal(state.range(0));
  for ([[maybe_unused]] auto _ : state) {
    const TriangleTree surface(a.posed.vertices, a.posed.faces, TriangleTree::Order::Spatial);
    benchmark::DoNotOptimize(inspect(a.inner, a.posed.faces, surface, a.posed.wall));
  }
  countTriangles(state, a);
}

} // namespace

BENCHMARK(momentsWithGradients)->Arg(6000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(basis)->Arg(2500)->Arg(5000)->Unit(benchmark::kMillisecond);
BENCHMARK(directionField)->Arg(6000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(checker)->Arg(6000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK_MAIN();
