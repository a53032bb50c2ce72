// Any bytes as a mesh and options: either a sentence that says what is wrong with it, or a cavity
// that keeps every promise about its geometry. Anything else aborts.
//
// The first byte chooses how the rest is read: as coordinates and indices just as they come, or as
// changes to a small solid, which get deeper into the filter.
#include "core/goals/registry.h"
#include "core/model/solid.h"
#include "core/pipeline.h"
#include "judge/checks.h"
#include "judge/guarantee.h"
#include "shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace massprops::testing {
namespace {

/// Reads values off the front; zeros when the bytes are used up.
class Bytes {
public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), left_(size) {}

  bool empty() const { return left_ == 0; }
  template <class T>
  T take() {
    T value{};
    const std::size_t n = std::min(left_, sizeof value);
    if (n > 0) std::memcpy(&value, data_, n);
    data_ += n;
    left_ -= n;
    return value;
  }
  /// 0 ≤ result < n
  int below(int n) { return take<std::uint8_t>() % n; }
  double share() { return take<std::uint8_t>() / 255.0; }

private:
  const std::uint8_t* data_;
  std::size_t left_;
};

TriangleMesh joinedAt(const TriangleMesh& a, const TriangleMesh& b, const Vec3& shift) {
  return joined(a, transformed(b, Mat3::Identity(), shift));
}

TriangleMesh smallSolid(int which) {
  switch (which) {
  case 0:
    return tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  case 1:
    return box({1, 2, 3}, 1);
  case 2:
    return box({1, 1, 2}, 3);
  case 3:
    return sphere(3);
  case 4:
    return torus(1.0, 0.4, 10, 6);
  case 5:
    return capsule(0.3, 1.0, 8);
  case 6:
    return roundedBox({1, 1, 1}, 0.2, 2, 1);
  case 7:
    return joinedAt(sphere(2), sphere(2), {2.5, 0, 0});
  case 8:
    return joined(sphere(3), reversed(scaled(sphere(2), 0.4)));
  default:
    return polycube({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}}, 2);
  }
}

double coordinate(Bytes& bytes) {
  switch (bytes.below(4)) {
  case 0:
    return bytes.take<double>();
  case 1:
    return static_cast<double>(bytes.take<float>());
  case 2:
    return bytes.take<std::int8_t>();
  default:
    return bytes.take<std::int16_t>() / 1024.0;
  }
}

TriangleMesh rawMesh(Bytes& bytes) {
  TriangleMesh mesh;
  mesh.vertices.resize(bytes.below(48), 3);
  mesh.faces.resize(bytes.below(96), 3);
  const bool anyIndex = bytes.below(8) == 0;
  for (Eigen::Index i = 0; i < mesh.vertices.size(); ++i)
    mesh.vertices.data()[i] = coordinate(bytes);
  const int n = std::max(1, static_cast<int>(mesh.vertices.rows()));
  for (Eigen::Index i = 0; i < mesh.faces.size(); ++i)
    mesh.faces.data()[i] = anyIndex ? bytes.take<std::int32_t>() : bytes.below(n);
  return mesh;
}

void addFace(TriangleMesh& mesh, const Eigen::RowVector3i& face) {
  mesh.faces.conservativeResize(mesh.faces.rows() + 1, 3);
  mesh.faces.bottomRows(1) = face;
}

int addVertex(TriangleMesh& mesh, const Vec3& point) {
  mesh.vertices.conservativeResize(mesh.vertices.rows() + 1, 3);
  mesh.vertices.bottomRows(1) = point.transpose();
  return static_cast<int>(mesh.vertices.rows()) - 1;
}

/// One change as a modelling program, a file or an unlucky user could make it.
void change(TriangleMesh& mesh, Bytes& bytes) {
  const auto vertex = [&] {
    return bytes.take<std::uint16_t>() % static_cast<int>(mesh.vertices.rows());
  };
  const auto face = [&] {
    return bytes.take<std::uint16_t>() % static_cast<int>(mesh.faces.rows());
  };
  switch (bytes.below(14)) {
  case 0: { // moved a little
    const double size = std::pow(10.0, -bytes.below(12));
    for (double& x : mesh.vertices.row(vertex())) x += size * (bytes.share() - 0.5);
    return;
  }
  case 1: { // onto another vertex
    const int to = vertex();
    mesh.vertices.row(vertex()) = mesh.vertices.row(to);
    return;
  }
  case 2:
    mesh.vertices(vertex(), bytes.below(3)) = coordinate(bytes);
    return;
  case 3: { // stretched along one axis
    mesh.vertices.col(bytes.below(3)) *= std::pow(10.0, bytes.below(13) - 9);
    return;
  }
  case 4: // another size
    mesh.vertices *= std::pow(10.0, bytes.below(25) - 12);
    return;
  case 5: // another place
    mesh.vertices.rowwise() += std::pow(10.0, bytes.below(16)) * Eigen::RowVector3d(1.0, 0.3, -0.7);
    return;
  case 6:
    addFace(mesh, mesh.faces.row(face()).reverse());
    return;
  case 7:
    addFace(mesh, mesh.faces.row(face()));
    return;
  case 8: { // a face turned round
    const int f = face();
    std::swap(mesh.faces(f, 0), mesh.faces(f, 1));
    return;
  }
  case 9: { // a vertex in the middle of a face, perhaps far off it
    const int f = face();
    const Vec3 middle = (mesh.vertices.row(mesh.faces(f, 0)) + mesh.vertices.row(mesh.faces(f, 1)) +
                         mesh.vertices.row(mesh.faces(f, 2)))
                            .transpose() /
                        3;
    const int v = addVertex(mesh, middle * (1.0 + 0.5 * bytes.share() * bytes.below(2)));
    const Eigen::RowVector3i old = mesh.faces.row(f);
    mesh.faces.row(f) << old[0], old[1], v;
    addFace(mesh, {old[1], old[2], v});
    addFace(mesh, {old[2], old[0], v});
    return;
  }
  case 10: { // a flat face between the halves of an edge
    const int f = face();
    const Eigen::RowVector3i old = mesh.faces.row(f);
    const double t = bytes.share();
    const int v = addVertex(
        mesh, ((1 - t) * mesh.vertices.row(old[0]) + t * mesh.vertices.row(old[1])).transpose());
    mesh.faces.row(f) << old[0], v, old[2];
    addFace(mesh, {v, old[1], old[2]});
    addFace(mesh, {old[0], old[1], v});
    return;
  }
  case 11: { // a face's corner replaced
    const int f = face();
    mesh.faces(f, bytes.below(3)) = vertex();
    return;
  }
  case 12: { // every triangle with corners of its own
    TriangleMesh split{Points(mesh.faces.size(), 3), mesh.faces};
    for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) {
      const int v = mesh.faces.data()[i];
      if (v < 0 || v >= mesh.vertices.rows()) return;
      split.vertices.row(i) = mesh.vertices.row(v);
      split.faces.data()[i] = static_cast<int>(i);
    }
    if (split.vertices.rows() < 2000) mesh = split;
    return;
  }
  default: // a second body or a cavity
    if (mesh.faces.rows() < 300) {
      const double size = 0.1 + 2.0 * bytes.share();
      const Vec3 shift(4 * bytes.share() - 2, 4 * bytes.share() - 2, 0.0);
      mesh = joinedAt(mesh, scaled(smallSolid(bytes.below(10)), size), shift);
    }
  }
}

TriangleMesh changedSolid(Bytes& bytes) {
  TriangleMesh mesh = smallSolid(bytes.below(10));
  for (int i = bytes.below(8); i > 0 && !bytes.empty(); --i) change(mesh, bytes);
  return mesh;
}

Options someOptions(Bytes& bytes, double diagonal) {
  Options options;
  options.goal = static_cast<GoalKind>(bytes.below(static_cast<int>(goalRegistry().size())));
  options.basisSize = 1 + bytes.below(8);
  // Thinner walls are left to the random models: sanitized, one takes minutes.
  options.innerLowerBound = diagonal * std::pow(10.0, -2.0 * bytes.share());
  options.innerUpperBound = 0.05 + 0.95 * bytes.share();
  options.upAxis = static_cast<UpAxis>(bytes.below(6));
  const int flags = bytes.below(64);
  if ((flags & 1) != 0) options.radiusX = options.radiusY = 0.2 * diagonal;
  if ((flags & 6) == 6) options.outerUpperBound = 0.1 * bytes.share() * diagonal;
  if ((flags & 8) != 0) options.fillDensity = 3.0 * bytes.share();
  if ((flags & 24) == 24) options.tippingAngle = 40.0 * bytes.share();
  if ((flags & 16) != 0) options.weights.volume = bytes.share();
  options.cavityShape = static_cast<CavityShape>(bytes.below(3));
  if ((flags & 32) != 0) {
    options.representable = [](const Points& points) {
      return Points(points.cast<float>().cast<double>());
    };
  }
  return options;
}

void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken promise: %s\n", promise);
  std::abort();
}

void requireSentence(const InvalidInput& e) {
  const std::string text = e.what();
  require(text.size() > 20 && text.back() == '.', "a refusal is a sentence");
}

void check(const TriangleMesh& input, const Options& options, const Solid& solid) {
  Result result;
  try {
    result = optimizeMassProperties(input, options);
  } catch (const InvalidInput& e) { // an option that does not fit
    requireSentence(e);
    return;
  }
  for (const auto& [key, value] : result.report.entries) {
    if (const double* number = std::get_if<double>(&value)) {
      require(std::isfinite(*number), key.c_str());
    }
  }
  if (result.inner.faces.rows() == 0) return;
  const TriangleMesh outer =
      result.outer ? *result.outer : TriangleMesh{solid.vertices(), solid.faces()};
  require(isClosedAndOriented(result.inner), "the cavity is closed");
  require(facesWithoutArea(result.inner) == 0, "the cavity has no flat faces");
  require(intersectingPairs(result.inner) == 0, "the cavity does not cross itself");
  require(intersectingPairs(outer) == 0, "the outer surface does not cross itself");
  require(intersectingPairs(result.inner, outer) == 0, "the cavity stays off the outer surface");
  const double wall = *options.innerLowerBound;
  require(separation(result.inner, outer).least >= wall, "the wall is kept");
  require(std::abs(windingNumber(outer, result.inner.vertices.row(0).transpose()) - 1.0) < 1e-6,
          "the cavity lies inside");
}

} // namespace
} // namespace massprops::testing

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace massprops;
  using namespace massprops::testing;
  Bytes bytes(data, size);
  const int mode = bytes.below(4);
  const Options unscaled = someOptions(bytes, 1.0);
  const TriangleMesh mesh = mode == 0 ? rawMesh(bytes) : changedSolid(bytes);
  try {
    const Solid solid = makeSolid(mesh);
    Options options = unscaled;
    const double diagonal = solid.diagonal();
    options.innerLowerBound = *unscaled.innerLowerBound * diagonal;
    options.outerUpperBound *= diagonal;
    if (options.radiusX) options.radiusX = options.radiusY = *unscaled.radiusX * diagonal;
    check(mesh, options, solid);
  } catch (const InvalidInput& e) {
    requireSentence(e);
  }
  return 0;
}
