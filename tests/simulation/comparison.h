// What was expected beside what was simulated.
#pragma once

#include <string>

namespace simulation {

/// Prints a line for each comparison and counts those that do not agree.
class Comparison {
public:
  void title(const std::string& text);
  void note(const std::string& text) const;
  /// Agrees where both differ by no more than `tolerance`.
  void number(const std::string& what, double expected, double simulated, double tolerance);
  void truth(const std::string& what, bool expected, bool simulated);
  /// Of something that shall stay below a bound.
  void below(const std::string& what, double bound, double simulated);

  int disagreements() const { return disagreements_; }

private:
  void line(const std::string& what, const std::string& expected, const std::string& simulated,
            bool agrees);

  int disagreements_ = 0;
};

} // namespace simulation
