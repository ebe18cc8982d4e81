#include "io/directory_lock.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string>

#include "subimpact/io/output_directory.h"

namespace subimpact {
namespace {

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
bool is_open_as(int descriptor, const std::filesystem::path& file) {
  struct stat opened {};
  struct stat named {};
  return fstat(descriptor, &opened) == 0 && lstat(file.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace

DirectoryLock::DirectoryLock(const std::filesystem::path& directory)
    : file_(directory / ".subimpact-lock") {
  const auto message = [&](const std::string& cause, const char* remedy) {
    return fmt::format("{}: {}; {} choose another directory with --out", directory.string(), cause,
                       remedy);
  };
  const auto fail = [&](const std::string& cause, const char* remedy) {
    if (descriptor_ >= 0) close(descriptor_);
    throw OutputError(message(cause, remedy));
  };
  for (;;) {
    descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor_ < 0) {
      fail(fmt::format("this output directory cannot be written to ({})", std::strerror(errno)),
           "change its permissions, free the disk, or");
    }
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      if (errno == EINTR) continue;
      if (errno == EWOULDBLOCK) {
        const std::string holder = holder_of(descriptor_);
        close(descriptor_);
        throw DirectoryInUse(
            message(holder + " is writing into this directory", "wait until it has ended, or"));
      }
      fail(fmt::format("this directory cannot be locked against other writers ({})",
                       std::strerror(errno)),
           "use a file system that has locks:");
    }
    if (is_open_as(descriptor_, file_)) break;
    close(descriptor_);
  }
  const std::string holder = this_process();
  if (ftruncate(descriptor_, 0) != 0 || pwrite(descriptor_, holder.data(), holder.size(), 0) < 0) {
    fail(fmt::format("this output directory cannot be written to ({})", std::strerror(errno)),
         "free the disk, or");
  }
}

DirectoryLock::~DirectoryLock() {
  unlink(file_.c_str());
  close(descriptor_);
}

}  // namespace subimpact
