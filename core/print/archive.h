// Files in a ZIP archive.
#pragma once

#include <string>
#include <vector>

namespace massprops {

struct ArchiveEntry {
  std::string name; ///< with folders, separated by slashes
  std::string content;
};

/// A new archive, the same bytes for the same entries: all are dated 1980.
/// \throw std::runtime_error when it cannot be written
void writeArchive(const std::string& path, const std::vector<ArchiveEntry>& entries);

} // namespace massprops
