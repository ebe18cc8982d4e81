#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <map>
#include <optional>
#include <string>

namespace subimpact {

/// What a file must be: its length in bytes and its SHA-256 in hexadecimal digits.
struct Seal {
  std::uintmax_t bytes = 0;
  std::string sha256;
  bool operator==(const Seal&) const = default;
};

/// Of all that can be read; the file is at its beginning then.
Seal seal_of(std::istream& file);
/// Of a regular file; nothing if there is none of that name (a symbolic link is none). Throws
/// std::system_error if the file cannot be opened.
std::optional<Seal> seal_of(const std::filesystem::path& file);

/// What manifest.json holds.
struct Manifest {
  std::string kind;                      ///< "run", "figures", "compare" ...
  std::string identity;                  ///< of the run or study
  std::string commit;                    ///< names the directory that the files are moved from
  std::map<std::string, Seal> files;     ///< by their names
  std::map<std::string, Seal> replaced;  ///< files that these take the place of
};

inline constexpr const char* manifest_name = "manifest.json";

/// Where the files of a commit wait for being put in place.
std::filesystem::path staging_of(const std::filesystem::path& directory, const std::string& commit);
/// Whether this is the name of such a directory.
bool is_staging(const std::string& name);

/// Nothing if the directory has no manifest.json. Throws ResultsError if the file is not a manifest
/// of this program.
std::optional<Manifest> read_manifest(const std::filesystem::path& directory);

std::string to_json(const Manifest& manifest);

}  // namespace subimpact
