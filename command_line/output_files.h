// Files that appear when all of them are whole, or not at all.
#pragma once

#include <string>
#include <vector>

namespace massprops {

class OutputFiles {
public:
  OutputFiles() = default;
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;
  /// Takes away what was not kept.
  ~OutputFiles();

  /// Where to write what is to become `path`: a file beside it with the same suffix, which is there
  /// and empty. \throw InvalidInput when it cannot be written
  std::string add(const std::string& path);
  /// What was added under that name is not wanted.
  void drop(const std::string& path);
  /// Gives the files their names. \throw std::runtime_error when that fails
  void keep();

private:
  struct File {
    std::string unfinished, path;
  };
  std::vector<File> files_;
};

} // namespace massprops
