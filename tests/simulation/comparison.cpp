#include "simulation/comparison.h"

#include <cmath>
#include <cstdio>

namespace simulation {
namespace {

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string word(bool value) {
  return value ? "yes" : "no";
}

} // namespace

void Comparison::title(const std::string& text) {
  std::printf("\n%-52s %16s %12s\n", text.c_str(), "expected", "simulated");
}

void Comparison::note(const std::string& text) const {
  std::printf("  (%s)\n", text.c_str());
}

void Comparison::number(const std::string& what, double expected, double simulated,
                        double tolerance) {
  line(what, digits(expected) + " +- " + digits(tolerance), digits(simulated),
       std::abs(expected - simulated) <= tolerance);
}

void Comparison::truth(const std::string& what, bool expected, bool simulated) {
  line(what, word(expected), word(simulated), expected == simulated);
}

void Comparison::below(const std::string& what, double bound, double simulated) {
  line(what, "< " + digits(bound), digits(simulated), simulated < bound);
}

void Comparison::line(const std::string& what, const std::string& expected,
                      const std::string& simulated, bool agrees) {
  std::printf("  %-50s %16s %12s  %s\n", what.c_str(), expected.c_str(), simulated.c_str(),
              agrees ? "agrees" : "DISAGREES");
  if (!agrees) ++disagreements_;
}

} // namespace simulation
