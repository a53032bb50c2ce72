// What the filter said, and what it was asked for.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace simulation {

/// Values by key.
class Record {
public:
  explicit Record(std::map<std::string, std::string> values) : values_(std::move(values)) {}

  bool has(const std::string& key) const { return values_.count(key) != 0; }
  /// \throw std::runtime_error when there is no such key or it has another type, as the others do
  double number(const std::string& key) const;
  bool truth(const std::string& key) const;
  const std::string& text(const std::string& key) const;
  /// All numbers of a point or tensor, row after row.
  std::vector<double> numbers(const std::string& key) const;

private:
  std::map<std::string, std::string> values_;
};

/// The lines `key = value` of a report.
Record readReport(const std::string& path);

/// The parameters of a MeshLab script.
Record readScript(const std::string& path);

} // namespace simulation
