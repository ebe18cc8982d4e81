#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "read_file.h"

namespace subimpact {

/// While it exists, a shell script in a directory is what runs as gnuplot.
class FakeGnuplot {
 public:
  FakeGnuplot(const std::filesystem::path& directory, const std::string& script)
      : path_(std::getenv("PATH")) {
    std::filesystem::create_directories(directory);
    const std::filesystem::path program = directory / "gnuplot";
    std::ofstream(program) << "#!/bin/sh\n" << script;
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    ::setenv("PATH", (directory.string() + ":" + path_).c_str(), 1);
  }
  ~FakeGnuplot() { ::setenv("PATH", path_.c_str(), 1); }
  FakeGnuplot(const FakeGnuplot&) = delete;
  FakeGnuplot& operator=(const FakeGnuplot&) = delete;

 private:
  std::string path_;
};

/// Whether a process of that number, as a file has it, is there and has not ended.
inline bool is_running(const std::filesystem::path& number) {
  const std::string text = read_file(number);
  const std::string status =
      read_file(std::filesystem::path("/proc") / text.substr(0, text.find('\n')) / "status");
  return !status.empty() && status.find("State:\tZ") == std::string::npos;
}

}  // namespace subimpact
