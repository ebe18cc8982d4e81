#pragma once

#include <filesystem>

namespace subimpact {

/// A file ".subimpact-lock" in a directory, locked (flock) while the object exists and removed at
/// its end. The lock ends with the process, however the process ends.
class DirectoryLock {
 public:
  /// Throws DirectoryInUse if another process holds the lock, naming the process and its host;
  /// OutputError if the lock file cannot be made.
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace subimpact
