// What several stages must agree on when they compare numbers. Lengths are shares of the model's
// diagonal.
#pragma once

namespace massprops {

/// Constraints hold where |h| ≤ kFeasibility for equalities h = 0 and g ≤ kFeasibility for
/// inequalities g ≤ 0.
constexpr double kFeasibility = 1e-6;

/// A wall that common printers print and that carries a hand-sized model.
constexpr double kDefaultWall = 0.01;

/// A vertex touches the ground where its height above the lowest one is ≤ kContactHeight; so does
/// what hangs, at the highest one.
constexpr double kContactHeight = 1e-4;

/// What a model stands on holds a circle of this radius where it is cut flat for that, and whoever
/// stands on that much needs no cut.
constexpr double kFootInradius = 0.01;

/// Of the diagonal's cube: a component that encloses less is no body, but rounding.
constexpr double kLeastVolume = 1e-12;

} // namespace massprops
