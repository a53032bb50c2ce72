#include "core/goals/verdict.h"

namespace massprops {

std::string Verdict::whatIsMissed(const Moments& massMoments) const {
  return worstViolation(massMoments);
}

std::string Verdict::remark(const Moments& /*massMoments*/) const {
  return "";
}

std::string Verdict::bestInWords(const Moments& massMoments) const {
  return "at best " + worstViolation(massMoments);
}

std::string Verdict::draw(const Moments& /*before*/, const Moments& /*after*/,
                          Annotations& /*annotations*/) const {
  return "";
}

} // namespace massprops
