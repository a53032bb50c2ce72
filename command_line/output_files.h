// Files that appear when all of them are whole, or not at all.
#pragma once

#include <atomic>
#include <csignal>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace massprops {

/// While it lives, signals that end the program take away what was not kept, at once and whatever
/// the program does. One at a time, made on the thread that starts all others.
class OutputFiles {
public:
  OutputFiles();
  OutputFiles(const OutputFiles&) = delete;
  OutputFiles& operator=(const OutputFiles&) = delete;
  /// Takes away what was not kept.
  ~OutputFiles();

  /// Where to write what is to become `path`: a file of the same name in a new folder beside it.
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
  void watch();
  void remove() const;

  std::vector<File> files_;
  std::mutex mutex_; ///< of files
  sigset_t ending_{}, before_{};
  std::atomic<bool> isOver_ = false;
  std::thread watcher_;
};

} // namespace massprops
