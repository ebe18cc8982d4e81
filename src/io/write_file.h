#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace subimpact {

/// Writes a file, in the place of one of that name. Throws OutputError.
void write_file(const std::filesystem::path& path, const std::string& content);

/// Writes the whole content to an open file. Returns 0, or the number of the error.
int write_all(int file, std::string_view content);

}  // namespace subimpact
