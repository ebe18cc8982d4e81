#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace subimpact {

/// The whole of a file; empty if there is none.
inline std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace subimpact
