#pragma once

#include <filesystem>
#include <istream>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "simulate/settings/refuse.h"

namespace subimpact {

/// What a file must be: its length in bytes and its SHA-256 in hexadecimal digits.
struct Fingerprint {
  std::uintmax_t bytes = 0;
  std::string sha256;
  bool operator==(const Fingerprint&) const = default;
};

/// Of what is left of a stream.
Fingerprint fingerprint_of(std::istream& file);

struct Manifest {
  std::string kind;                          ///< "run", "figures", "compare" ...
  std::string identity;                      ///< of the run or study
  std::string commit;                        ///< names the directory that the files are moved from
  std::map<std::string, Fingerprint> files;  ///< by their names
  std::map<std::string, Fingerprint> replaced;  ///< files that these take the place of
};

inline constexpr const char* manifest_name = "manifest.json";

/// Where the files of a commit wait for being put in place.
std::filesystem::path staging_of(const std::filesystem::path& directory, const std::string& commit);
bool is_staging(const std::string& name);

/// Nothing if the directory has no manifest.json. Throws ResultsError if that is no manifest.
std::optional<Manifest> read_manifest(const std::filesystem::path& directory);

std::string to_json(const Manifest& manifest);

/// The whole of a file. Throws ResultsError.
std::string read_whole_file(const std::filesystem::path& path);

/// Writes a file, in the place of one of that name. Throws OutputError.
void write_file(const std::filesystem::path& path, const std::string& content);

/// Writes the whole content to an open file. Returns 0, or the number of the error.
int write_all(int file, std::string_view content);

}  // namespace subimpact
