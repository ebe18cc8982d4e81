#pragma once

#include <filesystem>
#include <string>

namespace subimpact {

/// Writes the whole file or none of it: under another name, then moved into place. Throws
/// OutputError.
void write_file(const std::filesystem::path& path, const std::string& content);

}  // namespace subimpact
