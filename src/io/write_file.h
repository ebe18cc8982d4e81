#pragma once

#include <filesystem>
#include <string>

namespace subimpact {

/// Writes the file under another name and moves it into place, so that it is never incomplete.
/// Throws OutputError.
void write_file(const std::filesystem::path& path, const std::string& content);

}  // namespace subimpact
