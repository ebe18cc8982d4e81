#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace subimpact {

/// Writes a file, in the place of one of that name. Throws OutputError.
void write_file(const std::filesystem::path& path, const std::string& content);

/// Writes all of it to an open file; returns 0, or the error's number.
int write_all(int file, std::string_view content);

}  // namespace subimpact
