// A body that stands while its cavity is filled.
#pragma once

#include "core/goals/tipping.h"

#include <vector>

namespace massprops {

/// The cavity of a standing body, cut at heights from its bottom to its top.
class FillingLevels {
public:
  /// `vertices`, `faces`: of the cavity, closed and outward, working frame.
  FillingLevels(const Points& vertices, const Faces& faces);

  /// Cavities without a way between them.
  int cavities() const { return static_cast<int>(parts_.size()); }

  /// At most the tangent of the tipping angle of the body with its cavities filled in any way: each
  /// from empty to full by itself, the contents' surface level while the body stands, and frozen as
  /// it tips over. Also between the heights at which the cavities are cut: what lies between two of
  /// them counts as if it were all in the worst place. `empty`: moments of the body without
  /// contents, density 1; `density`: of the contents. [docs/math.md "Stand empty and filled"]
  double leastTangent(const std::vector<TippingDirection>& directions, const Moments& empty,
                      double density) const;

  /// Whether the body stands with its cavities filled in any way when it is tilted by this tangent:
  /// what `leastTangent` is the greatest of.
  bool stands(const std::vector<TippingDirection>& directions, const Moments& empty, double density,
              double tangent) const;

private:
  bool stands(const TippingDirection& direction, const Moments& empty, double density,
              double tangent) const;
  /// What lies below a height.
  struct Cut {
    double height, volume;
    Vec3 first; ///< ∫x dV
  };
  struct Part {
    std::vector<Cut> cuts;     ///< from empty to full
    std::vector<Vec2> outline; ///< seen from above, its convex hull
  };

  /// The most that contents of density 1 raise u·S + tangent S_z − extent m by.
  double worst(const Part& part, const TippingDirection& direction, double tangent) const;

  std::vector<Part> parts_;
};

} // namespace massprops
