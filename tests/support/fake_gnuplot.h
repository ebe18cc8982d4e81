#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "read_file.h"

namespace subimpact {

/// Sets a variable of the environment for a while.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    ::setenv(name, value.c_str(), 1);
  }
  ~Environment() {
    if (before_) {
      ::setenv(name_, before_->c_str(), 1);
    } else {
      ::unsetenv(name_);
    }
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

/// While it exists, a shell script in a directory is what runs as gnuplot.
class FakeGnuplot {
 public:
  FakeGnuplot(const std::filesystem::path& directory, const std::string& script)
      : path_("PATH", directory.string() + ":" + std::getenv("PATH")) {
    std::filesystem::create_directories(directory);
    const std::filesystem::path program = directory / "gnuplot";
    std::ofstream(program) << "#!/bin/sh\n" << script;
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  }

 private:
  Environment path_;
};

/// Whether a process of that number, as a file has it, is there and has not ended.
inline bool is_running(const std::filesystem::path& number) {
  const std::string text = read_file(number);
  const std::string status =
      read_file(std::filesystem::path("/proc") / text.substr(0, text.find('\n')) / "status");
  return !status.empty() && status.find("State:\tZ") == std::string::npos;
}

}  // namespace subimpact
