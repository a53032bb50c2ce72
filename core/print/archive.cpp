#include "core/print/archive.h"

#include <minizip/zip.h>

#include <stdexcept>

namespace massprops {
namespace {

bool add(zipFile archive, const ArchiveEntry& entry) {
  zip_fileinfo info{};
  info.tmz_date.tm_year = 1980; // the format's first day, so that no clock is in the bytes
  info.tmz_date.tm_mday = 1;
  if (zipOpenNewFileInZip64(archive, entry.name.c_str(), &info, nullptr, 0, nullptr, 0, nullptr,
                            Z_DEFLATED, Z_DEFAULT_COMPRESSION, 0) != ZIP_OK) {
    return false;
  }
  const int written = zipWriteInFileInZip(archive, entry.content.data(),
                                          static_cast<unsigned>(entry.content.size()));
  return zipCloseFileInZip(archive) == ZIP_OK && written == ZIP_OK;
}

} // namespace

void writeArchive(const std::string& path, const std::vector<ArchiveEntry>& entries) {
  const zipFile archive = zipOpen64(path.c_str(), APPEND_STATUS_CREATE);
  bool isWhole = archive != nullptr;
  for (const ArchiveEntry& entry : entries) isWhole = isWhole && add(archive, entry);
  if (archive != nullptr) isWhole = (zipClose(archive, nullptr) == ZIP_OK) && isWhole;
  if (!isWhole) throw std::runtime_error("The file " + path + " cannot be written.");
}

} // namespace massprops
