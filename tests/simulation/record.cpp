#include "simulation/record.h"

#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace simulation {
namespace {

/// The first two groups of every line's match.
Record read(const std::string& path, const std::regex& pattern) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot open " + path);
  std::map<std::string, std::string> values;
  for (std::string line; std::getline(file, line);) {
    std::smatch match;
    if (std::regex_search(line, match, pattern)) values[match[1]] = match[2];
  }
  return Record(std::move(values));
}

} // namespace

double Record::number(const std::string& key) const {
  const std::string& value = text(key);
  std::size_t read = 0;
  const double result = std::stod(value, &read);
  if (read != value.size()) throw std::runtime_error(key + " = " + value + " is no number");
  return result;
}

bool Record::truth(const std::string& key) const {
  const std::string& value = text(key);
  if (value != "true" && value != "false") {
    throw std::runtime_error(key + " = " + value + " is neither true nor false");
  }
  return value == "true";
}

std::vector<double> Record::numbers(const std::string& key) const {
  std::string value = text(key);
  for (char& c : value) {
    if (c == '(' || c == ')' || c == ',') c = ' ';
  }
  std::istringstream words(value);
  return {std::istream_iterator<double>(words), std::istream_iterator<double>()};
}

const std::string& Record::text(const std::string& key) const {
  const auto found = values_.find(key);
  if (found == values_.end()) throw std::runtime_error("there is no " + key);
  return found->second;
}

Record readReport(const std::string& path) {
  return read(path, std::regex("^([a-z][a-z0-9_]*) = (.*)$"));
}

Record readScript(const std::string& path) {
  return read(path, std::regex("<Param [^>]*name=\"([^\"]*)\" value=\"([^\"]*)\""));
}

} // namespace simulation
