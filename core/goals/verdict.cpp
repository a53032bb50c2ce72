#include "core/goals/verdict.h"

namespace massprops {

double Verdict::violation(const Moments& /*massMoments*/) const {
  return 0.0;
}

std::string Verdict::whatIsMissed(const Moments& massMoments) const {
  return worstViolation(massMoments);
}

std::string Verdict::remark(const Moments& /*massMoments*/) const {
  return "";
}

void Verdict::describeWorst(double /*measure*/, const std::string& /*suffix*/,
                            Report& /*report*/) const {}

std::optional<double> Verdict::worstMeasure(const Moments& /*massMoments*/) const {
  return std::nullopt;
}

std::string Verdict::bestInWords(const std::vector<Moments>& states) const {
  // Where several constraints are missed, none of them need be at its least there.
  return "with the nearest one found " + worstViolation(states.front());
}

std::string Verdict::draw(const Moments& /*before*/, const Moments& /*after*/,
                          Annotations& /*annotations*/) const {
  return "";
}

} // namespace massprops
