// The proof that goes with a cavity, every number measured on the delivered triangles.
#pragma once

#include "core/base/types.h"

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace massprops {

using ReportValue = std::variant<bool, int, double, Vec3, Mat3, std::string>;

/// Keys and values in the order in which they are to be read. Lengths in model units, volumes in
/// cubic model units, masses in grams, inertia in g·(model unit)² about the centre of mass along
/// the model's own axes, angles in degrees, times in seconds. docs/report.md lists all keys.
struct Report {
  std::vector<std::pair<std::string, ReportValue>> entries;

  void add(std::string key, ReportValue value);
  /// \throw std::out_of_range when there is no such key
  const ReportValue& at(const std::string& key) const;
};

/// One line without its end: `0.125`, `true`, `(1, 2, 3)`, `((1, 2, 3), (4, 5, 6), (7, 8, 9))`.
/// Doubles with 9 significant digits.
std::string toString(const ReportValue& value);

} // namespace massprops
