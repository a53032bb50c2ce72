#include "core/parameter_text.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

namespace massprops {
namespace {

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

[[noreturn]] void refuse(const Parameter& parameter, const std::string& text,
                         const std::string& expected) {
  throw InvalidInput("The parameter '" + parameter.name + "' cannot be '" + text + "': give " +
                     expected + ".");
}

/// All of the text, whatever the locale.
template <class Number>
std::optional<Number> numberIn(const std::string& text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [rest, failure] = std::from_chars(text.data(), end, value);
  return failure == std::errc{} && rest == end ? std::optional(value) : std::nullopt;
}

int entryIn(const Parameter& parameter, const std::string& text) {
  const auto named =
      std::find_if(parameter.entries.begin(), parameter.entries.end(),
                   [&](const std::string& entry) { return lowered(entry) == lowered(text); });
  if (named != parameter.entries.end()) {
    return static_cast<int>(named - parameter.entries.begin());
  }
  std::string list = "one of ";
  for (const std::string& entry : parameter.entries) {
    list += (&entry == &parameter.entries.front() ? "" : ", ") + entry;
  }
  refuse(parameter, text, list);
}

double lengthIn(const Parameter& parameter, const std::string& text, double diagonal) {
  const bool isShare = !text.empty() && text.back() == '%';
  const auto value = numberIn<double>(isShare ? text.substr(0, text.size() - 1) : text);
  if (!value) {
    refuse(parameter, text, "a length in the model's units, or in % of its diagonal like 1.5%");
  }
  return isShare ? *value / 100.0 * diagonal : *value;
}

} // namespace

ParameterValue valueFrom(const Parameter& parameter, const std::string& text, double diagonal) {
  switch (parameter.kind) {
  case ParameterKind::Switch:
    if (text == "true" || text == "false") return text == "true";
    refuse(parameter, text, "true or false");
  case ParameterKind::Whole:
    if (const auto value = numberIn<int>(text)) return *value;
    refuse(parameter, text, "a whole number");
  case ParameterKind::Number:
  case ParameterKind::Share:
    if (const auto value = numberIn<double>(text)) return *value;
    refuse(parameter, text, "a number");
  case ParameterKind::Length:
    return lengthIn(parameter, text, diagonal);
  case ParameterKind::Choice:
    return entryIn(parameter, text);
  case ParameterKind::File:
    return text;
  }
  return text;
}

} // namespace massprops
