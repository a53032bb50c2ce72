#include "core/query/enclosed_volume.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

namespace massprops {
namespace {

/// Across each side of the box.
constexpr int kLines = 128;

/// Where a line meets a triangle.
struct Crossing {
  int line;
  double height;
  int enters; ///< 1, or −1 where the line leaves
};

/// What lines along one axis say.
struct Measured {
  double volume = 0.0;
  double trust = 0.0; ///< area of the lines that pass through no gap, times their share
};

class LinesAlong {
public:
  LinesAlong(const TriangleMesh& mesh, int axis)
      : mesh_(mesh), axis_(axis), u_((axis + 1) % 3), v_((axis + 2) % 3),
        low_(mesh.vertices.colwise().minCoeff().transpose()),
        step_((mesh.vertices.colwise().maxCoeff().transpose() - low_) / kLines) {}

  Measured measure() {
    if (!(step_[u_] > 0.0 && step_[v_] > 0.0)) return {};
    for (Eigen::Index f = 0; f < mesh_.faces.rows(); ++f) cross(f);
    std::sort(crossings_.begin(), crossings_.end(), [](const Crossing& a, const Crossing& b) {
      return std::tie(a.line, a.height, a.enters) < std::tie(b.line, b.height, b.enters);
    });
    double length = 0.0;
    double lines = 0.0;
    double withoutGaps = 0.0;
    for (std::size_t i = 0; i < crossings_.size();) {
      const int line = crossings_[i].line;
      double inside = 0.0;
      int turns = 0;
      for (double before = 0.0; i < crossings_.size() && crossings_[i].line == line; ++i) {
        if (turns != 0) inside += crossings_[i].height - before;
        before = crossings_[i].height;
        turns += crossings_[i].enters;
      }
      lines += 1.0;
      if (turns != 0) continue;
      withoutGaps += 1.0;
      length += inside;
    }
    if (withoutGaps == 0.0) return {};
    const double share = withoutGaps / lines;
    const double area = step_[u_] * step_[v_];
    return {area * length / share, area * withoutGaps * share};
  }

private:
  /// The first line not before a place: the same for all triangles that end there.
  int first(double place, int across) const {
    return std::clamp(static_cast<int>(std::ceil((place - low_[across]) / step_[across] - 0.5)), 0,
                      kLines);
  }

  void cross(Eigen::Index f) {
    Vec3 p[3];
    for (int k = 0; k < 3; ++k) p[k] = mesh_.vertices.row(mesh_.faces(f, k)).transpose();
    const auto [lowest, highest] = std::minmax({p[0][v_], p[1][v_], p[2][v_]});
    for (int row = first(lowest, v_); row < first(highest, v_); ++row) {
      const double y = low_[v_] + (row + 0.5) * step_[v_];
      // From the edge that falls to the one that rises, as seen against the axis.
      Vec3 ends[2];
      int met = 0;
      for (int k = 0; k < 3; ++k) {
        const Vec3& a = p[k];
        const Vec3& b = p[(k + 1) % 3];
        const bool rises = a[v_] <= y;
        if (rises == (b[v_] <= y)) continue;
        const Vec3& below = rises ? a : b;
        const Vec3& above = rises ? b : a;
        ends[rises ? 1 : 0] = below + (y - below[v_]) / (above[v_] - below[v_]) * (above - below);
        ++met;
      }
      if (met != 2) continue;
      const bool facesAxis = ends[0][u_] < ends[1][u_];
      const Vec3& left = ends[facesAxis ? 0 : 1];
      const Vec3& right = ends[facesAxis ? 1 : 0];
      for (int column = first(left[u_], u_); column < first(right[u_], u_); ++column) {
        const double x = low_[u_] + (column + 0.5) * step_[u_];
        const double share = (x - left[u_]) / (right[u_] - left[u_]);
        crossings_.push_back({row * kLines + column,
                              left[axis_] + share * (right[axis_] - left[axis_]),
                              facesAxis ? -1 : 1});
      }
    }
  }

  const TriangleMesh& mesh_;
  int axis_, u_, v_;
  Vec3 low_, step_;
  std::vector<Crossing> crossings_;
};

} // namespace

double enclosedVolume(const TriangleMesh& mesh) {
  if (mesh.faces.rows() == 0) return 0.0;
  Measured best;
  for (int axis = 0; axis < 3; ++axis) {
    const Measured measured = LinesAlong(mesh, axis).measure();
    if (measured.trust > best.trust) best = measured;
  }
  return best.volume;
}

} // namespace massprops
