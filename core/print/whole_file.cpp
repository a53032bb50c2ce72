#include "core/print/whole_file.h"

#include "core/base/types.h"

#include <filesystem>
#include <fstream>
#include <system_error>

namespace massprops {
namespace {

namespace fs = std::filesystem;

/// Beside the file, so that renaming moves no data between disks; nothing has this name yet.
fs::path besides(const fs::path& path) {
  std::error_code none;
  for (int i = 0;; ++i) {
    fs::path temporary = path;
    temporary += ".part" + std::to_string(i);
    if (!fs::exists(temporary, none)) return temporary;
  }
}

void discard(const fs::path& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
}

} // namespace

void requireWritable(const std::string& path) {
  const fs::path file = fs::u8path(path);
  std::error_code none;
  const bool isTaken = fs::exists(file, none);
  if (file.extension() != ".3mf") {
    throw InvalidInput("The name of print_file must end in .3mf, but it is " + path + ".");
  }
  const bool isFree = !isTaken || (fs::is_regular_file(file, none) &&
                                   std::ofstream(file, std::ios::binary | std::ios::app).good());
  const fs::path temporary = besides(file);
  const bool canWrite = isFree && std::ofstream(temporary, std::ios::binary).good();
  discard(temporary);
  if (canWrite) return;
  throw InvalidInput("The file " + path +
                     " of print_file cannot be written: choose a folder that "
                     "exists and that you may write to.");
}

void writeWhole(const std::string& path,
                const std::function<void(const std::string& temporary)>& write) {
  const fs::path file = fs::u8path(path);
  const fs::path temporary = besides(file);
  try {
    write(temporary.u8string());
    fs::rename(temporary, file);
  } catch (...) {
    discard(temporary);
    throw;
  }
}

} // namespace massprops
