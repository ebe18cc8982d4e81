#include "subimpact/io/output_directory.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

#include "case/refuse.h"
#include "io/directory/listed_files.h"
#include "subimpact/io/read_results.h"

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

// Whether a file is one of numbers, which a run leaves by itself, not one that a user had drawn.
bool is_data(const fs::path& name) {
  return name.extension() == ".csv" || name.extension() == ".json";
}

// A name that is free: "events.csv.kept", "events.csv.kept-2" ...
fs::path name_to_keep(const fs::path& file) {
  fs::path kept = file.string() + ".kept";
  for (int n = 2; fs::exists(fs::symlink_status(kept)); ++n) {
    kept = fmt::format("{}.kept-{}", file.string(), n);
  }
  return kept;
}

// Whether the file is as one of these fingerprints has it.
bool is_as_listed(const fs::path& file, const std::string& name,
                  const std::map<std::string, Fingerprint>& fingerprints) {
  const auto found = fingerprints.find(name);
  if (found == fingerprints.end()) return false;
  std::error_code error;
  return fs::file_size(file, error) == found->second.bytes && fingerprint_of(file) == found->second;
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

// What the holder has written into its lock file: "process 123 on host".
std::string holder_of(int descriptor) {
  std::array<char, 256> text;
  const ssize_t n = pread(descriptor, text.data(), text.size(), 0);
  return n > 0 ? std::string(text.data(), static_cast<std::size_t>(n)) : "another process";
}

std::string this_process() {
  std::array<char, 128> host{};
  gethostname(host.data(), host.size() - 1);
  return fmt::format("process {} on {}", getpid(), host.data());
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
  /// Throws DirectoryInUse if another process holds the lock, naming the process and its host;
  /// OutputError if the lock file cannot be made.
  explicit DirectoryLock(const std::filesystem::path& directory)
      : file_(directory / ".subimpact-lock") {
    const auto message = [&](const std::string& cause, const char* remedy) {
      return fmt::format("{}: {}; {} choose another directory with --out", directory.string(),
                         cause, remedy);
    };
    const auto fail = [&](const char* what, const char* remedy) {
      const std::string cause = fmt::format("{} ({})", what, std::strerror(errno));
      if (descriptor_ >= 0) close(descriptor_);
      throw OutputError(message(cause, remedy));
    };
    constexpr const char* unwritable = "this output directory cannot be written to";
    for (;;) {
      descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
      if (descriptor_ < 0) fail(unwritable, "change its permissions, free the disk, or");
      if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
        if (errno == EINTR) continue;
        if (errno == EWOULDBLOCK) {
          const std::string holder = holder_of(descriptor_);
          close(descriptor_);
          throw DirectoryInUse(
              message(holder + " is writing into this directory", "wait until it has ended, or"));
        }
        fail("this directory cannot be locked against other writers",
             "use a file system that has locks:");
      }
      if (is_open_as(descriptor_, file_)) break;
      close(descriptor_);
    }
    const std::string holder = this_process();
    if (ftruncate(descriptor_, 0) != 0 ||
        pwrite(descriptor_, holder.data(), holder.size(), 0) < 0) {
      fail(unwritable, "free the disk, or");
    }
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
    : kind_(std::move(kind)), identity_(identity.empty() ? new_identity() : std::move(identity)) {
  open(directory);
}

OutputDirectory::~OutputDirectory() {
  std::error_code ignored;
  if (!staging_.empty()) fs::remove_all(staging_, ignored);
  if (!is_new_ || is_committed_) return;
  lock_.reset();
  fs::remove(path_, ignored);  // if empty
}

void OutputDirectory::open(const fs::path& directory) {
  std::error_code error;
  const fs::file_type kind_of_file = fs::status(directory, error).type();
  const bool is_missing = kind_of_file == fs::file_type::not_found;
  const auto refuse_to_make = [&](const std::string& cause) {
    refuse(directory, fmt::format("this output directory cannot be made ({})", cause));
  };
  if (kind_of_file == fs::file_type::none) refuse_to_make(error.message());
  if (is_missing && fs::is_symlink(directory, error)) refuse_to_make("a symbolic link to nothing");
  if (!is_missing && kind_of_file != fs::file_type::directory) {
    refuse_to_make("a file has that name");
  }
  is_new_ = fs::create_directories(directory, error);
  if (error) refuse_to_make(error.message());
  lock_ = std::make_unique<DirectoryLock>(directory);
  path_ = directory;
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
    begin_staging();
  } catch (const std::system_error& failure) {
    refuse(path_, fmt::format("this output directory cannot be written to ({})",
                              failure.code().message()));
  }
}

void OutputDirectory::begin_staging() {
  commit_ = new_identity();
  staging_ = staging_of(path_, commit_);
  fs::create_directory(staging_);
}

void OutputDirectory::commit() {
  try {
    write_manifest();
  } catch (const std::system_error& failure) {
    fail<OutputError>(
        "{}: the results cannot be put in place ({}); free the disk or choose another directory "
        "with --out",
        path_.string(), failure.code().message());
  }
  // The files are readable from here on, wherever they are found.
  if (is_relocated() && !is_committed_) {
    notes_.push_back(fmt::format("{}; the results are in {} instead", relocation_, path_.string()));
  }
  is_committed_ = true;
  const fs::path committed = std::exchange(staging_, fs::path());
  try {
    synchronise(path_, O_DIRECTORY);
    settle();
    begin_staging();
  } catch (const std::exception& failure) {
    notes_.push_back(fmt::format(
        "{}: some files are still in {} ({}); the next command that writes into this directory "
        "will move them",
        path_.string(), committed.filename().string(), failure.what()));
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
    next.files[name] = fingerprint_of(file).value();
  }
  const fs::path manifest = staging_ / manifest_name;
  write_file(manifest, to_json(next));
  synchronise(manifest);
  synchronise(staging_);
  fs::rename(manifest, path_ / manifest_name);
}

// Puts what the manifest lists in place; removes what it replaces and what killed writers left.
void OutputDirectory::settle() {
  if (const std::optional<Manifest> manifest = manifest_for_writing(path_)) {
    const fs::path waiting = staging_of(path_, manifest->commit);
    if (fs::exists(fs::symlink_status(waiting))) {
      for (const std::string& name : files_in(waiting)) put_in_place(name, *manifest);
      std::vector<std::string> removed;
      for (const auto& [name, fingerprint] : manifest->replaced) {
        if (manifest->files.contains(name) || !remove_replaced(name, *manifest)) continue;
        if (!is_data(name)) removed.push_back(name);
      }
      if (!removed.empty()) {
        notes_.push_back(fmt::format(
            "{}: pages and figures of the earlier results are removed: {}; `subimpact report` and "
            "`subimpact plot` make those of the new ones",
            path_.string(), fmt::join(removed, ", ")));
      }
    }
  }
  for (const auto& entry : fs::directory_iterator(path_)) {
    const bool is_directory = entry.symlink_status().type() == fs::file_type::directory;
    if (is_directory && is_staging(entry.path().filename().string())) {
      fs::remove_all(entry.path());
    }
  }
}

bool OutputDirectory::remove_replaced(const std::string& name, const Manifest& manifest) {
  const fs::path file = path_ / name;
  if (is_as_listed(file, name, manifest.replaced)) return fs::remove(file);
  if (fs::exists(fs::symlink_status(file))) {
    notes_.push_back(
        fmt::format("{}: is of an earlier run and was changed since; kept", file.string()));
  }
  return false;
}

void OutputDirectory::put_in_place(const std::string& name, const Manifest& manifest) {
  const fs::path file = path_ / name;
  const bool is_there = fs::exists(fs::symlink_status(file));
  if (is_there && !is_as_listed(file, name, manifest.replaced)) {
    const fs::path kept = name_to_keep(file);
    fs::rename(file, kept);
    notes_.push_back(fmt::format("{}: was changed, or is not of this program; kept as {}",
                                 file.string(), kept.filename().string()));
  }
  fs::rename(staging_of(path_, manifest.commit) / name, file);
}

void OutputDirectory::relocate(const std::string& cause) {
  const auto give_up = [&](const std::string& second_cause) {
    fail<OutputError>("{}; nor can the results be written to a directory for temporary files ({})",
                      relocation_, second_cause);
  };
  if (is_relocated()) give_up(cause);
  relocation_ = cause;
  const fs::path left = staging_;
  std::error_code ignored;
  try {
    std::string place = (fs::temp_directory_path() / "subimpact-results-XXXXXX").string();
    if (mkdtemp(place.data()) == nullptr) {
      throw std::system_error(errno, std::generic_category(), place);
    }
    path_ = place;
    is_new_ = true;
    lock_ = std::make_unique<DirectoryLock>(path_);
    begin_staging();
    if (fs::exists(left, ignored)) {  // else somebody has removed or renamed the directory
      for (const std::string& name : files_in(left)) fs::copy_file(left / name, staging_ / name);
      fs::remove_all(left, ignored);
    }
  } catch (const std::exception& failure) {
    fs::remove_all(left, ignored);
    give_up(failure.what());
  }
}

}  // namespace subimpact
