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

  /// Where to write what is to become `path`: a file of the same name in a folder beside it.
  /// \throw InvalidInput when nothing can be written there
  std::string add(const std::string& path);
  /// Whether something was written there since.
  bool isWritten(const std::string& path) const;
  /// Puts the files that were written into their places. \throw std::runtime_error when that fails
  void keep();

private:
  struct File {
    std::string unfinished, path;
  };
  std::vector<File> files_;
};

} // namespace massprops
