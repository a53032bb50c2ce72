// What the user gets to know about a body: whether it does what the goal asks for, in numbers,
// words and a drawing.
#pragma once

#include "core/base/report.h"
#include "core/mesh/annotations.h"
#include "core/physics/mass_properties.h"

#include <optional>
#include <string>
#include <vector>

namespace massprops {

/// Sees a body as its goal does (goal.h): mass moments in the working frame, density 1.
class Verdict {
public:
  virtual ~Verdict() = default;

  /// Whether the body does what the goal asks for, constraint margins aside.
  virtual bool isReached(const Moments& massMoments) const = 0;
  /// The constraint that is violated most, as a clause and in the model's units; of use only when
  /// `largestViolation` of the goal is not 0.
  virtual std::string worstViolation(const Moments& massMoments) const = 0;
  /// How much that constraint is violated, 0 where the goal has none: compares bodies, in a unit of
  /// its own. Two across an axis are violated by one length.
  virtual double violation(const Moments& massMoments) const;
  /// What of the verdict is missed, as a clause, by a body that keeps all constraints; of use only
  /// when that is not `isReached`. Where the constraints are all that the verdict asks for, it is
  /// `worstViolation`.
  virtual std::string whatIsMissed(const Moments& massMoments) const;
  /// What a person should know about a body that does what is asked for, in sentences; "" where
  /// nothing is left to say.
  virtual std::string remark(const Moments& massMoments) const;
  /// Adds the goal's own keys with `suffix` ("before", "after") to the report.
  virtual void describe(const Moments& massMoments, const std::string& suffix,
                        Report& report) const = 0;
  /// Adds the goal's measure (goal.h) of a body in the worst of its states, where there are
  /// several.
  virtual void describeWorst(double measure, const std::string& suffix, Report& report) const;
  /// The goal's measure in the worst of all states of this body, where it has states that its mass
  /// moments do not tell.
  virtual std::optional<double> worstMeasure(const Moments& massMoments) const;
  /// What the best of all bodies reaches, in words, when no body holds all constraints. `states`:
  /// its mass moments in each.
  virtual std::string bestInWords(const std::vector<Moments>& states) const;
  /// Draws, in the working frame, what the verdict goes by on the solid body `before` and on the
  /// answer `after`, and names it in plain words; nothing but "" where the numbers say it all.
  virtual std::string draw(const Moments& before, const Moments& after,
                           Annotations& annotations) const;
};

} // namespace massprops
