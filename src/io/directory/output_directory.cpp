#include "subimpact/io/output_directory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "io/directory/listed_files.h"
#include "simulate/settings/refuse.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& cause) {
  fail<OutputError>("{}: {}; choose another with --out", path.string(), cause);
}

// Waits until a file, or the names in a directory, are on the disk. A link is followed for the
// directory that the user has named alone.
void synchronise(const fs::path& path, int follow = O_NOFOLLOW) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | follow);
  const bool failed = descriptor < 0 || (fsync(descriptor) != 0 && errno != EINVAL);
  const int cause = errno;
  if (descriptor >= 0) close(descriptor);
  if (failed) throw std::system_error(cause, std::generic_category(), path.string());
}

std::vector<std::string> files_in(const fs::path& directory) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(directory)) {
    if (entry.symlink_status().type() == fs::file_type::regular) {
      names.push_back(entry.path().filename().string());
    }
  }
  return names;
}

std::optional<Manifest> manifest_for_writing(const fs::path& directory) {
  try {
    return read_manifest(directory);
  } catch (const ResultsError& error) {
    fail<OutputError>(
        "{}; nothing is written next to it: move it away, or choose another directory with --out",
        error.what());
  }
}

std::string command_of(const std::string& kind) {
  if (kind == "sweep") return "subimpact-sweep";
  return "subimpact " + (kind == "figures" ? "plot" : kind);
}

// The place that a staged file will have.
fs::path place_of(const fs::path& path) {
  const fs::path directory = path.parent_path();
  return is_staging(directory.filename().string()) ? directory.parent_path() / path.filename()
                                                   : path;
}

// Whether the file that is open still has this name: the holder before may have removed it.
bool is_open_as(int descriptor, const fs::path& file) {
  struct stat opened {};
  struct stat named {};
  return fstat(descriptor, &opened) == 0 && lstat(file.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace

/// A file ".subimpact-lock" in a directory, locked (flock) while the object exists and removed at
/// its end. The lock ends with the process, however the process ends.
class DirectoryLock {
 public:
  /// Throws DirectoryInUse if another process holds the lock, OutputError if there can be none.
  explicit DirectoryLock(const fs::path& directory) : file_(directory / ".subimpact-lock") {
    do {
      if (descriptor_ >= 0) close(descriptor_);
      descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
      if (descriptor_ >= 0 && flock(descriptor_, LOCK_EX | LOCK_NB) == 0) continue;
      const int cause = errno;
      if (descriptor_ >= 0) close(descriptor_);
      if (descriptor_ >= 0 && cause == EWOULDBLOCK) {
        fail<DirectoryInUse>(
            "{}: another process is writing into this directory; wait until it has ended, or "
            "choose another directory with --out",
            directory.string());
      }
      refuse(directory, fmt::format("this output directory cannot be {} ({})",
                                    descriptor_ < 0 ? "written to" : "locked against other writers",
                                    std::strerror(cause)));
    } while (!is_open_as(descriptor_, file_));
  }
  ~DirectoryLock() {
    unlink(file_.c_str());
    close(descriptor_);
  }
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  fs::path file_;
  int descriptor_ = -1;
};

std::string new_identity() {
  std::uint64_t words[2];
  if (getrandom(words, sizeof words, 0) != sizeof words) {
    throw std::system_error(errno, std::generic_category(), "getrandom");
  }
  return fmt::format("{:016x}{:016x}", words[0], words[1]);
}

void write_file(const fs::path& path, const std::string& content) {
  const auto refuse_to_write = [&](int cause) {
    fail<OutputError>(
        "{}: cannot be written ({}); free the disk or choose another directory with --out",
        place_of(path).string(), std::strerror(cause));
  };
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0) refuse_to_write(errno);
  const int cause = write_all(file, content);
  if (close(file) != 0 || cause != 0) refuse_to_write(cause != 0 ? cause : errno);
}

int write_all(int file, std::string_view content) {
  while (!content.empty()) {
    const ssize_t n = write(file, content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return errno;
    content.remove_prefix(static_cast<std::size_t>(n));
  }
  return 0;
}

OutputDirectory::OutputDirectory(const fs::path& directory, std::string kind, std::string identity)
    : path_(directory),
      kind_(std::move(kind)),
      identity_(identity.empty() ? new_identity() : std::move(identity)) {
  std::error_code error;
  is_new_ = fs::create_directories(path_, error);
  if (error || !fs::is_directory(path_, error)) {
    refuse(path_, fmt::format("this output directory cannot be made ({})",
                              error ? error.message() : "a file or a dangling link has its name"));
  }
  lock_ = std::make_unique<DirectoryLock>(path_);
  const std::optional<Manifest> present = manifest_for_writing(path_);
  const bool joins_run = present && kind_ == "figures" && present->identity == identity_;
  if (present && present->kind != kind_ && !joins_run) {
    refuse(path_, present->kind == "run" && kind_ == "figures"
                      ? "holds the results of another run"
                      : fmt::format("holds the results of `{}`, with which those of `{}` would be "
                                    "mixed",
                                    command_of(present->kind), command_of(kind_)));
  }
  if (joins_run) kind_ = present->kind;
  try {
    settle();
  } catch (const std::system_error& failure) {
    refuse(path_, fmt::format("this output directory cannot be written to ({})",
                              failure.code().message()));
  }
}

OutputDirectory::~OutputDirectory() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
  if (!is_new_ || is_committed_) return;
  lock_.reset();
  fs::remove(path_, ignored);  // if empty
}

void OutputDirectory::commit() {
  try {
    write_manifest();
    // The files are readable from here on, wherever they are found.
    is_committed_ = true;
    staging_.clear();
    synchronise(path_, O_DIRECTORY);
    settle();
  } catch (const std::system_error& failure) {
    fail<OutputError>(
        "{}: the results cannot be put in place ({}); free the disk or choose another directory "
        "with --out",
        path_.string(), failure.code().message());
  }
}

void OutputDirectory::write_manifest() {
  const std::optional<Manifest> present = manifest_for_writing(path_);
  Manifest next{kind_, identity_, commit_, {}, {}};
  if (present) next.replaced = present->files;
  if (present && present->identity == identity_) next.files = present->files;
  for (const std::string& name : files_in(staging_)) {
    const fs::path file = staging_ / name;
    synchronise(file);
    std::ifstream content(file, std::ios::binary);
    if (!content) throw std::system_error(errno, std::generic_category(), file.string());
    next.files[name] = fingerprint_of(content);
  }
  const fs::path manifest = staging_ / manifest_name;
  write_file(manifest, to_json(next));
  synchronise(manifest);
  synchronise(staging_);
  fs::rename(manifest, path_ / manifest_name);
}

void OutputDirectory::settle() {
  if (const std::optional<Manifest> manifest = manifest_for_writing(path_)) {
    const fs::path waiting = staging_of(path_, manifest->commit);
    if (fs::is_directory(fs::symlink_status(waiting))) {
      std::error_code ignored;
      for (const std::string& name : files_in(waiting)) {
        const fs::path file = path_ / name;
        const bool is_own = manifest->replaced.contains(name);
        if (!is_own && fs::exists(fs::symlink_status(file)))
          fs::rename(file, file.string() + ".kept");
        fs::rename(waiting / name, file);
      }
      for (const auto& [name, fingerprint] : manifest->replaced) {
        if (!manifest->files.contains(name)) fs::remove(path_ / name, ignored);
      }
    }
  }
  for (const auto& entry : fs::directory_iterator(path_)) {
    const bool is_directory = entry.symlink_status().type() == fs::file_type::directory;
    if (is_directory && is_staging(entry.path().filename().string())) fs::remove_all(entry.path());
  }
  commit_ = new_identity();
  staging_ = staging_of(path_, commit_);
  fs::create_directory(staging_);
}

}  // namespace subimpact
