#include "filter_massprops/parameters.h"

#include "core/parameters.h"

#include <array>
#include <charconv>
#include <cmath>

namespace massprops {
namespace {

/// The decimal number that was typed: hosts keep parameters in single precision, where 1.24 becomes
/// 1.2400000095, even if they hand it over in double precision.
double asTyped(double value) {
  const auto single = static_cast<float>(value);
  if (!std::isfinite(single) || static_cast<double>(single) != value) return value;
  std::array<char, 64> text{};
  char* const end = std::to_chars(text.data(), text.data() + text.size(), single).ptr;
  double result = 0.0;
  std::from_chars(text.data(), end, result);
  return result;
}

QStringList textsOf(const std::vector<std::string>& entries) {
  QStringList texts;
  for (const std::string& entry : entries) texts.append(QString::fromStdString(entry));
  return texts;
}

/// `arguments`: what stands between name and label in this type's constructor.
template <class Rich, class... Arguments>
void add(RichParameterList& list, const Parameter& parameter, const Arguments&... arguments) {
  const QString name = QString::fromStdString(parameter.name);
  const QString label = QString::fromStdString(fullLabel(parameter));
  const QString help = QString::fromStdString(parameter.help);
#if MASSPROPS_MESHLAB_API >= 2022
  const QString category = QString::fromStdString(parameter.category);
  list.addParam(Rich(name, arguments..., label, help, parameter.advanced, category));
#else
  list.addParam(Rich(name, arguments..., label, help));
#endif
}

void addTo(RichParameterList& list, const Parameter& parameter, float diagonal) {
  const auto standard = [&] { return static_cast<float>(std::get<double>(parameter.standard)); };
  switch (parameter.kind) {
  case ParameterKind::Switch:
    return add<RichBool>(list, parameter, std::get<bool>(parameter.standard));
  case ParameterKind::Whole:
    return add<RichInt>(list, parameter, std::get<int>(parameter.standard));
  case ParameterKind::Number:
  case ParameterKind::Share:
    return add<RichFloat>(list, parameter, standard());
  case ParameterKind::Length:
    return add<RichLength>(list, parameter, standard() * diagonal, 0.0F, diagonal);
  case ParameterKind::Choice:
    return add<RichEnum>(list, parameter, std::get<int>(parameter.standard),
                         textsOf(parameter.entries));
  case ParameterKind::File:
    return add<RichFile>(list, parameter,
                         QString::fromStdString(std::get<std::string>(parameter.standard)),
                         textsOf(parameter.entries).join(' '));
  }
}

ParameterValue valueIn(const RichParameterList& list, const Parameter& parameter) {
  const QString name = QString::fromStdString(parameter.name);
  switch (parameter.kind) {
  case ParameterKind::Switch:
    return list.getBool(name);
  case ParameterKind::Whole:
    return list.getInt(name);
  case ParameterKind::Number:
  case ParameterKind::Share:
    return asTyped(static_cast<double>(list.getFloat(name)));
  case ParameterKind::Length:
    return asTyped(static_cast<double>(list.getAbsPerc(name)));
  case ParameterKind::Choice:
    return list.getEnum(name);
  case ParameterKind::File:
    return list.getSaveFileName(name).toStdString();
  }
  return {};
}

} // namespace

RichParameterList dialogParameters(double diagonal) {
  RichParameterList list;
  for (const Parameter& parameter : parameterTable()) {
    addTo(list, parameter, static_cast<float>(diagonal));
  }
  return list;
}

Options optionsFrom(const RichParameterList& parameters) {
  return optionsFrom([&](const Parameter& parameter) { return valueIn(parameters, parameter); });
}

} // namespace massprops
