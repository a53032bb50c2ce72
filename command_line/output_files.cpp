#include "command_line/output_files.h"

#include "core/base/types.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace massprops {

namespace fs = std::filesystem;

OutputFiles::~OutputFiles() {
  std::error_code ignored;
  for (const File& file : files_) fs::remove_all(fs::path(file.unfinished).parent_path(), ignored);
}

std::string OutputFiles::add(const std::string& path) {
  if (fs::is_directory(path)) throw InvalidInput("'" + path + "' is a folder: name a file in it.");
  const fs::path folder =
      fs::path(path).parent_path() / (".massprops.part" + std::to_string(getpid()));
  const fs::path unfinished = folder / fs::path(path).filename();
  std::error_code failure;
  fs::create_directory(folder, failure);
  if (failure) {
    throw InvalidInput("'" + path +
                       "' cannot be written: choose a folder that exists and that you "
                       "may write to.");
  }
  files_.push_back({unfinished.string(), path});
  return unfinished.string();
}

bool OutputFiles::isWritten(const std::string& path) const {
  return std::any_of(files_.begin(), files_.end(), [&](const File& file) {
    return file.path == path && fs::exists(file.unfinished);
  });
}

void OutputFiles::keep() {
  for (const File& file : files_) {
    if (fs::exists(file.unfinished)) fs::rename(file.unfinished, file.path);
  }
}

} // namespace massprops
