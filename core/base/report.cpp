#include "core/base/report.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>

namespace massprops {
namespace {

std::string number(double value) {
  // Not printf: a host may have set a locale with a decimal comma.
  std::array<char, 32> text{};
  char* const end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::general, 9)
          .ptr;
  return {text.data(), end};
}

std::string tuple(const Vec3& v) {
  return "(" + number(v.x()) + ", " + number(v.y()) + ", " + number(v.z()) + ")";
}

struct Printer {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(int value) const { return std::to_string(value); }
  std::string operator()(double value) const { return number(value); }
  std::string operator()(const Vec3& value) const { return tuple(value); }
  std::string operator()(const Mat3& value) const {
    return "(" + tuple(value.row(0)) + ", " + tuple(value.row(1)) + ", " + tuple(value.row(2)) +
           ")";
  }
  std::string operator()(const std::string& value) const { return value; }
};

} // namespace

void Report::add(std::string key, ReportValue value) {
  entries.emplace_back(std::move(key), std::move(value));
}

const ReportValue& Report::at(const std::string& key) const {
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [&](const auto& entry) { return entry.first == key; });
  if (found == entries.end()) throw std::out_of_range("the report has no key '" + key + "'");
  return found->second;
}

std::string toString(const ReportValue& value) {
  return std::visit(Printer{}, value);
}

} // namespace massprops
