#include "core/overhang/supporting_fill.h"

#include "core/base/parallel.h"
#include "core/overhang/layer_distance.h"
#include "core/query/grid_sampling.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

namespace massprops {
namespace {

constexpr double kMostNodes = 3e6; // what is coarser has wider spans

constexpr float kBand = kSampledBand;

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

/// A layer's values, linear between nodes.
class LayerValues {
public:
  LayerValues(const std::vector<float>& values, int columns, int rows)
      : values_(values), columns_(columns), rows_(rows) {}

  float at(const Eigen::Vector2f& p) const {
    const float x = std::clamp(p.x(), 0.0F, static_cast<float>(columns_) - 1.001F);
    const float y = std::clamp(p.y(), 0.0F, static_cast<float>(rows_) - 1.001F);
    const int i = static_cast<int>(x);
    const int j = static_cast<int>(y);
    const float u = x - static_cast<float>(i);
    const float v = y - static_cast<float>(j);
    const auto value = [&](int a, int b) {
      return values_[static_cast<std::size_t>(a + columns_ * b)];
    };
    return (1 - v) * ((1 - u) * value(i, j) + u * value(i + 1, j)) +
           v * ((1 - u) * value(i, j + 1) + u * value(i + 1, j + 1));
  }

private:
  const std::vector<float>& values_;
  int columns_, rows_;
};

/// The sweep downwards through the layers.
class Sweep {
public:
  Sweep(const Grid& grid, float run, float halfThickness,
        const std::vector<Eigen::Vector2f>& pillars, float pillarRadius)
      : columns_(grid.counts.x()), rows_(grid.counts.y()), run_(run), halfThickness_(halfThickness),
        pillars_(pillars), pillarRadius_(pillarRadius), distance_(columns_, rows_),
        towards_(size()), away_(size()), above_(size(), -LayerDistance::kFar), unsupported_(size()),
        cavity_(size()) {
    nearestPillar();
  }

  /// `hollow`: positive in the layer's cavity. `fill`: becomes negative where something must be
  /// filled for the layer above to be carried; beyond the cavity what it is at the nearest point.
  /// Whether anything is.
  bool visit(const std::vector<float>& hollow, std::vector<float>& fill) {
    std::fill(fill.begin(), fill.end(), kBand);
    distance_.measure(hollow);
    if (!distance_.hasBorder()) {
      above_ = distance_.distances();
      return false;
    }
    const bool isCarried = !findUnsupported();
    if (isCarried) {
      above_ = distance_.distances();
      return false;
    }
    const std::vector<float> before = distance_.distances();
    push(before, fill);
    closeSlits(before, fill);
    for (std::size_t n = 0; n < size(); ++n) cavity_[n] = std::min(before[n], fill[n]);
    openCavity(fill);
    thicken(before, fill);
    constexpr int kRounds = 3;
    for (int round = 0; round < kRounds; ++round) {
      distance_.measure(cavity_);
      // What was pushed to where nothing stands near enough is filled where it is.
      bool isLeft = false;
      constexpr float kSlack = 0.6F;
      for (std::size_t n = 0; n < size(); ++n) {
        if (above_[n] > -kSlack || distance_.distances()[n] <= run_ + kSlack) continue;
        cavity_[n] = fill[n] = -0.5F;
        isLeft = true;
      }
      if (!isLeft) break;
    }
    standIslands(fill);
    above_ = distance_.distances();
    // As distances, unless the wall is what is nearer.
    constexpr float kNearer = 0.25F;
    for (std::size_t n = 0; n < size(); ++n) {
      if (before[n] > 0.0F && above_[n] < before[n] - kNearer)
        fill[n] = std::clamp(above_[n], -kBand, kBand);
    }
    extend(before, hollow, fill);
    return true;
  }

private:
  std::size_t size() const {
    return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  }

  /// The way from each node to the nearest pillar's axis.
  void nearestPillar() {
    if (pillars_.empty()) return;
    wayToPillar_.resize(size());
    pillarOf_.resize(size());
    for (int j = 0; j < rows_; ++j) {
      for (int i = 0; i < columns_; ++i) {
        const Eigen::Vector2f p(static_cast<float>(i), static_cast<float>(j));
        Eigen::Vector2f best = Eigen::Vector2f::Constant(LayerDistance::kFar);
        std::size_t nearest = 0;
        for (std::size_t k = 0; k < pillars_.size(); ++k) {
          const Eigen::Vector2f way = pillars_[k] - p;
          if (way.squaredNorm() >= best.squaredNorm()) continue;
          best = way;
          nearest = k;
        }
        wayToPillar_[static_cast<std::size_t>(i + columns_ * j)] = best;
        pillarOf_[static_cast<std::size_t>(i + columns_ * j)] = nearest;
      }
    }
  }

  /// Positive where the layer above is material that nothing carries.
  bool findUnsupported() {
    constexpr float kSlack = 0.1F;
    bool isAny = false;
    const std::vector<float>& distances = distance_.distances();
    for (std::size_t n = 0; n < size(); ++n) {
      unsupported_[n] = std::min(-above_[n], distances[n] - run_ - kSlack);
      isAny = isAny || unsupported_[n] > 0.0F;
    }
    return isAny;
  }

  /// What hangs moves a layer down and towards what may carry it. Of a node it is asked whether
  /// something comes there: from where the same wall or pillar is the nearest, a run farther away.
  void push(const std::vector<float>& before, std::vector<float>& fill) {
    constexpr float kSharpness = 8.0F; // beyond the middle between walls nothing comes from
    constexpr float kNearly = 0.9F;
    findCarriers(before);
    const LayerValues unsupported(unsupported_, columns_, rows_);
    const LayerValues away(away_, columns_, rows_);
    for (int j = 0; j < rows_; ++j) {
      for (int i = 0; i < columns_; ++i) {
        const auto n = static_cast<std::size_t>(i + columns_ * j);
        if (before[n] <= -kBand) continue;
        const Eigen::Vector2f p(static_cast<float>(i), static_cast<float>(j));
        const Eigen::Vector2f from = p - run_ * towards_[n];
        const float isFrom =
            std::clamp(kSharpness * (away.at(from) - away_[n] - kNearly * run_), -1.0F, 1.0F);
        float hanging = std::min(unsupported.at(from), isFrom);
        if (away_[n] < 0.0F && before[n] > 0.0F) // within a pillar
          hanging = std::max(hanging, unsupported.at(p));
        fill[n] = std::clamp(-hanging, -kBand, kBand);
      }
    }
  }

  /// Slits between what is filled are filled, too.
  void openCavity(std::vector<float>& fill) {
    constexpr float kRadius = 0.45F;
    constexpr float kNearFill = 2.0F;
    distance_.measure(cavity_);
    if (!distance_.hasBorder()) return;
    moved_ = distance_.distances();
    for (float& value : moved_) value -= kRadius;
    distance_.measure(moved_);
    for (std::size_t n = 0; n < size(); ++n) {
      const float opened = distance_.distances()[n] + kRadius;
      if (fill[n] >= kNearFill || opened >= cavity_[n]) continue;
      fill[n] = std::min(fill[n], std::max(opened, -kBand));
      cavity_[n] = std::min(cavity_[n], fill[n]);
    }
  }

  /// What is filled is nowhere too thin for the surface's cubes, which would tear it.
  void thicken(const std::vector<float>& before, std::vector<float>& fill) {
    constexpr float kSlack = 0.2F;
    distance_.measure(cavity_);
    if (!distance_.hasBorder()) return;
    moved_ = distance_.distances();
    for (float& value : moved_) value += halfThickness_;
    distance_.measure(moved_);
    if (!distance_.hasBorder()) return;
    for (std::size_t n = 0; n < size(); ++n) {
      if (before[n] <= 0.0F || cavity_[n] > 0.0F ||
          distance_.distances()[n] - halfThickness_ <= kSlack)
        continue;
      addDisc(n, halfThickness_, fill);
    }
    for (std::size_t n = 0; n < size(); ++n) cavity_[n] = std::min(cavity_[n], fill[n]);
  }

  void addDisc(std::size_t middle, float radius, std::vector<float>& fill) const {
    const int reach = static_cast<int>(radius + kBand) + 1;
    const int x0 = static_cast<int>(middle) % columns_;
    const int y0 = static_cast<int>(middle) / columns_;
    for (int y = std::max(0, y0 - reach); y <= std::min(rows_ - 1, y0 + reach); ++y) {
      for (int x = std::max(0, x0 - reach); x <= std::min(columns_ - 1, x0 + reach); ++x) {
        const float away =
            std::hypot(static_cast<float>(x - x0), static_cast<float>(y - y0)) - radius;
        float& value = fill[static_cast<std::size_t>(x + columns_ * y)];
        value = std::min(value, std::clamp(away, -kBand, kBand));
      }
    }
  }

  /// Material above with nothing near enough to any of it stands on a column.
  void standIslands(std::vector<float>& fill) {
    constexpr float kSlack = 0.1F;
    const std::vector<float>& distances = distance_.distances();
    isSeen_.assign(size(), 0);
    bool isAny = false;
    std::vector<std::size_t> component;
    for (std::size_t first = 0; first < size(); ++first) {
      if (isSeen_[first] != 0 || above_[first] >= 0.0F) continue;
      component.assign(1, first);
      isSeen_[first] = 1;
      bool stands = false;
      std::size_t deepest = first;
      for (std::size_t i = 0; i < component.size(); ++i) {
        const std::size_t n = component[i];
        stands = stands || distances[n] <= run_ + kSlack;
        if (above_[n] < above_[deepest]) deepest = n;
        const int x = static_cast<int>(n) % columns_;
        const int y = static_cast<int>(n) / columns_;
        for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
          if (x + dx < 0 || y + dy < 0 || x + dx >= columns_ || y + dy >= rows_) continue;
          const auto m = static_cast<std::size_t>(x + dx + columns_ * (y + dy));
          if (isSeen_[m] != 0 || above_[m] >= 0.0F) continue;
          isSeen_[m] = 1;
          component.push_back(m);
        }
      }
      if (stands) continue;
      isAny = true;
      addDisc(deepest, halfThickness_, fill);
    }
    for (std::size_t n = 0; n < size(); ++n) cavity_[n] = std::min(cavity_[n], fill[n]);
    if (isAny) distance_.measure(cavity_);
  }

  /// Between a wall and what is filled next to it.
  void closeSlits(const std::vector<float>& before, std::vector<float>& fill) const {
    constexpr float kNarrow = 1.5F;
    const std::vector<float> known = fill;
    const LayerValues filled(known, columns_, rows_);
    for (int j = 0; j < rows_; ++j) {
      for (int i = 0; i < columns_; ++i) {
        const auto n = static_cast<std::size_t>(i + columns_ * j);
        if (before[n] <= 0.0F || before[n] >= kNarrow) continue;
        fill[n] = std::min(fill[n], nearBorder(filled, i, j, -kNarrow).value_or(kBand));
      }
    }
  }

  /// The value so far beyond the nearest point of the border, on the way from a node to it; empty
  /// on the border.
  std::optional<float> nearBorder(const LayerValues& values, int i, int j, float beyond) const {
    const Eigen::Vector2f way = distance_.wayToBorder(i, j);
    const float length = way.norm();
    if (length < 1e-4F) return {};
    const Eigen::Vector2f p(static_cast<float>(i), static_cast<float>(j));
    return values.at(p + (1.0F + beyond / length) * way);
  }

  /// How far every node is from what may carry, and the unit way towards it.
  void findCarriers(const std::vector<float>& before) {
    // One too near to a wall leans on it.
    const LayerValues depth(before, columns_, rows_);
    std::vector<char> stands;
    for (const Eigen::Vector2f& pillar : pillars_)
      stands.push_back(depth.at(pillar) > pillarRadius_ + run_ ? 1 : 0);
    for (int j = 0; j < rows_; ++j) {
      for (int i = 0; i < columns_; ++i) {
        const auto n = static_cast<std::size_t>(i + columns_ * j);
        away_[n] = before[n];
        Eigen::Vector2f way = distance_.wayToBorder(i, j); // out of the cavity
        if (before[n] < 0.0F) way = -way;
        if (!pillars_.empty() && stands[pillarOf_[n]] != 0 &&
            wayToPillar_[n].norm() - pillarRadius_ < before[n]) {
          way = wayToPillar_[n];
          away_[n] = way.norm() - pillarRadius_;
        }
        const float length = way.norm();
        towards_[n] = length > 1e-4F ? Eigen::Vector2f(way / length) : Eigen::Vector2f(0.0F, 0.0F);
      }
    }
  }

  /// Beyond the cavity as it is inside of it, so that nothing opens between fill and wall.
  void extend(const std::vector<float>& before, const std::vector<float>& hollow,
              std::vector<float>& fill) {
    distance_.measure(hollow);
    constexpr float kFar = 2.5F;
    constexpr float kInside = 0.7F;
    const std::vector<float> known = fill;
    const LayerValues inside(known, columns_, rows_);
    for (int j = 0; j < rows_; ++j) {
      for (int i = 0; i < columns_; ++i) {
        const auto n = static_cast<std::size_t>(i + columns_ * j);
        if (before[n] > 0.0F) continue;
        fill[n] = kBand;
        if (std::abs(distance_.distances()[n]) > kFar) continue;
        fill[n] = nearBorder(inside, i, j, kInside).value_or(kBand);
      }
    }
  }

  int columns_, rows_;
  float run_, halfThickness_;
  const std::vector<Eigen::Vector2f>& pillars_;
  float pillarRadius_;
  LayerDistance distance_;
  std::vector<Eigen::Vector2f> wayToPillar_, towards_;
  std::vector<std::size_t> pillarOf_; ///< the nearest one
  std::vector<char> isSeen_;
  std::vector<float> moved_, away_, above_, unsupported_, cavity_;
};

} // namespace

SupportingFill::SupportingFill(const FeasibleSet& set, double edge, const OverhangWishes& wishes)
    : edge_(edge), grid_(gridAround(set.surface.vertices(), wishes.toPrint,
                                    wishes.edge * wishes.bridge, kMostNodes)),
      run_(static_cast<float>(1.0 / std::tan(wishes.angle))) {
  halfThickness_ = static_cast<float>(wishes.halfThickness * std::max(edge / grid_.edge, 1.0));
  fill_.assign(at(grid_.nodes()), kBand);
  inset_ = sampled(grid_, [&] {
    return [probe = RegionProbe(set)](const Vec3& x, double horizon) mutable {
      return probe.insetAt(x, horizon);
    };
  });
}

void SupportingFill::allowPillars(double spacing) {
  constexpr double kRadius = 1.5; // edges of the set's cubes
  pillarRadius_ = static_cast<float>(kRadius * edge_ / grid_.edge);
  const auto inRow = static_cast<float>(spacing / grid_.edge);
  const float betweenRows = inRow * std::sqrt(3.0F) / 2.0F;
  const int rows = static_cast<int>(static_cast<float>(grid_.counts.y()) / betweenRows) + 1;
  const int columns = static_cast<int>(static_cast<float>(grid_.counts.x()) / inRow) + 1;
  for (int row = 0; row < rows; ++row) {
    const float first = row % 2 == 0 ? 0.0F : 0.5F * inRow;
    for (int column = 0; column < columns; ++column)
      pillars_.emplace_back(first + static_cast<float>(column) * inRow,
                            static_cast<float>(row) * betweenRows);
  }
}

double SupportingFill::add(const LayeredQuadric& quadric) {
  const QuadricCut cut{quadric, edge_};
  const Eigen::Index layer = Eigen::Index(grid_.counts.x()) * grid_.counts.y();
  std::vector<char> isHollow(at(grid_.nodes()));
  std::vector<float> fresh(at(grid_.nodes()), kBand);
  std::vector<float> hollow(at(layer)), filled(at(layer));
  Sweep sweep(grid_, run_, halfThickness_, pillars_, pillarRadius_);
  bool isAny = false;
  for (int k = grid_.counts.z() - 1; k >= 0; --k) {
    const Eigen::Index first = layer * k;
    forChunks(grid_.counts.y(), 8, [&](const Chunk& rows) {
      for (auto j = static_cast<int>(rows.begin); j < rows.end; ++j) {
        for (int i = 0; i < grid_.counts.x(); ++i) {
          const Eigen::Index n = grid_.nodeAt(i, j, k);
          float value = std::min(inset_[at(n)], fill_[at(n)]);
          if (value > -kBand) {
            const double side = cutAt(cut, grid_.positionOf(i, j, k)).value / grid_.edge;
            value = std::clamp(static_cast<float>(side), -kBand, value);
          }
          hollow[at(n - first)] = value;
          isHollow[at(n)] = value > 0.0F ? 1 : 0;
        }
      }
    });
    if (!sweep.visit(hollow, filled)) continue;
    isAny = true;
    std::copy(filled.begin(), filled.end(), fresh.begin() + first);
  }
  if (!isAny) return 0.0;
  Eigen::Index all = 0;
  Eigen::Index some = 0;
  for (std::size_t n = 0; n < fresh.size(); ++n) {
    if (isHollow[n] == 0) continue;
    ++all;
    if (fresh[n] <= 0.0F) ++some;
  }
  join(isHollow, fresh);
  for (std::size_t n = 0; n < fill_.size(); ++n) fill_[n] = std::min(fill_[n], fresh[n]);
  return static_cast<double>(some) / static_cast<double>(all);
}

void SupportingFill::addColumns(const std::vector<Vec3>& places) {
  constexpr double kAbove = 1.5; // edges, into what hangs down
  const int reach = static_cast<int>(halfThickness_ + kBand) + 1;
  for (const Vec3& place : places) {
    const Vec3 x = (grid_.rotation * place - grid_.origin) / grid_.edge;
    const int i0 = static_cast<int>(std::lround(x.x()));
    const int j0 = static_cast<int>(std::lround(x.y()));
    const int top = static_cast<int>(std::ceil(x.z() + kAbove));
    for (int k = std::clamp(top, 0, grid_.counts.z() - 1); k >= 0; --k) {
      for (int j = std::max(0, j0 - reach); j <= std::min(grid_.counts.y() - 1, j0 + reach); ++j) {
        for (int i = std::max(0, i0 - reach); i <= std::min(grid_.counts.x() - 1, i0 + reach);
             ++i) {
          const double away = std::hypot(i - x.x(), j - x.y()) - halfThickness_;
          float& value = fill_[at(grid_.nodeAt(i, j, k))];
          value = std::min(value, std::clamp(static_cast<float>(away), -kBand, kBand));
        }
      }
      if (k < x.z() - kAbove && inset_[at(grid_.nodeAt(i0, j0, k))] < -1.0F) break;
    }
  }
}

void SupportingFill::join(const std::vector<char>& isHollow, std::vector<float>& fresh) const {
  constexpr int kThrough = 3; // edges into a wall
  const Eigen::Index layer = Eigen::Index(grid_.counts.x()) * grid_.counts.y();
  const auto column = [&](Eigen::Index first, int step) {
    float value = kBand;
    int through = kThrough;
    for (int i = 0; i < grid_.counts.z(); ++i) {
      const Eigen::Index k = step > 0 ? i : grid_.counts.z() - 1 - i;
      const std::size_t n = at(first + layer * k);
      if (isHollow[n] != 0) {
        value = fresh[n];
        through = 0;
      } else if (through < kThrough) {
        fresh[n] = std::min(fresh[n], value);
        // On the other side of the quadric nothing is to open above what carries it.
        if (step < 0 || inset_[n] <= 0.0F || value > 0.0F) ++through;
      }
    }
  };
  for (Eigen::Index first = 0; first < layer; ++first) {
    column(first, 1);
    column(first, -1);
  }
}

} // namespace massprops
