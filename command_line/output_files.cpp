#include "command_line/output_files.h"

#include "core/base/types.h"

#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace massprops {
namespace {

namespace fs = std::filesystem;

/// Signals that end the program, but for those that whoever started it wants ignored.
sigset_t endingSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction present {};
    sigaction(signal, nullptr, &present);
    if (present.sa_handler != SIG_IGN) sigaddset(&signals, signal);
  }
  sigaddset(&signals, SIGUSR1); // from the destructor
  return signals;
}

/// A new one: what a program that was killed has left has another name.
fs::path newFolderBeside(const std::string& path) {
  std::string folder = (fs::path(path).parent_path() / ".massprops.partXXXXXX").string();
  if (mkdtemp(folder.data()) != nullptr) return folder;
  throw InvalidInput("'" + path +
                     "' cannot be written: choose a folder that exists and that you "
                     "may write to.");
}

} // namespace

OutputFiles::OutputFiles() : ending_(endingSignals()) {
  pthread_sigmask(SIG_BLOCK, &ending_, &before_); // of all threads that start from now on
  watcher_ = std::thread([this] { watch(); });
}

OutputFiles::~OutputFiles() {
  isOver_ = true;
  pthread_kill(watcher_.native_handle(), SIGUSR1);
  watcher_.join();
  remove();
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void OutputFiles::watch() {
  int signal = 0;
  while (sigwait(&ending_, &signal) != 0) {
  }
  if (isOver_) return;
  const std::lock_guard lock(mutex_);
  remove();
  pthread_sigmask(SIG_UNBLOCK, &ending_, nullptr);
  raise(signal); // ends the program
}

void OutputFiles::remove() const {
  std::error_code ignored;
  for (const File& file : files_) fs::remove_all(fs::path(file.unfinished).parent_path(), ignored);
}

std::string OutputFiles::add(const std::string& path) {
  if (fs::is_directory(path)) throw InvalidInput("'" + path + "' is a folder: name a file in it.");
  const std::lock_guard lock(mutex_);
  const fs::path unfinished = newFolderBeside(path) / fs::path(path).filename();
  files_.push_back({unfinished.string(), path});
  return unfinished.string();
}

bool OutputFiles::isWritten(const std::string& path) const {
  return std::any_of(files_.begin(), files_.end(), [&](const File& file) {
    return file.path == path && fs::exists(file.unfinished);
  });
}

void OutputFiles::keep() {
  const std::lock_guard lock(mutex_);
  for (const File& file : files_) {
    if (fs::exists(file.unfinished)) fs::rename(file.unfinished, file.path);
  }
}

} // namespace massprops
