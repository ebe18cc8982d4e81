#pragma once

#include <sys/resource.h>

#include <csignal>

namespace subimpact {

/// A limit of this process while it exists: of memory (RLIMIT_AS), or of the length of files
/// (RLIMIT_FSIZE), to which writing fails as on a full disk.
class ResourceLimit {
 public:
  ResourceLimit(__rlimit_resource what, rlim_t most)
      : what_(what), handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(what_, &before_);
    const rlimit limit{most, before_.rlim_max};
    ::setrlimit(what_, &limit);
  }
  ~ResourceLimit() {
    ::setrlimit(what_, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  ResourceLimit(const ResourceLimit&) = delete;
  ResourceLimit& operator=(const ResourceLimit&) = delete;

 private:
  __rlimit_resource what_;
  rlimit before_{};
  void (*handler_)(int);
};

}  // namespace subimpact
