#include "command_line/output_files.h"

#include "core/base/types.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace massprops {

namespace fs = std::filesystem;

OutputFiles::~OutputFiles() {
  std::error_code ignored;
  for (const File& file : files_) fs::remove(file.unfinished, ignored);
}

std::string OutputFiles::add(const std::string& path) {
  const fs::path whole(path);
  const std::string name =
      whole.stem().string() + ".part" + std::to_string(getpid()) + whole.extension().string();
  const std::string unfinished = (whole.parent_path() / name).string();
  if (fs::is_directory(whole)) throw InvalidInput("'" + path + "' is a folder: name a file in it.");
  if (!std::ofstream(unfinished)) {
    throw InvalidInput("'" + path + "' cannot be written: see that its folder is there.");
  }
  files_.push_back({unfinished, path});
  return unfinished;
}

void OutputFiles::drop(const std::string& path) {
  const auto file =
      std::find_if(files_.begin(), files_.end(), [&](const File& one) { return one.path == path; });
  if (file == files_.end()) return;
  fs::remove(file->unfinished);
  files_.erase(file);
}

void OutputFiles::keep() {
  for (const File& file : files_) fs::rename(file.unfinished, file.path);
  files_.clear();
}

} // namespace massprops
