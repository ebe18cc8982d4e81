#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>

#include "io/manifest.h"

namespace subimpact {

/// The whole of a file. Throws ResultsError.
std::string read_whole_file(const std::filesystem::path& path);

/// Thrown where a file differs from its manifest because another process has put newer files in
/// place since: what was read so far is to be read again.
struct ReplacedMeanwhile {};

/// Throws ResultsError.
[[noreturn]] void throw_always_replaced(const std::filesystem::path& directory);

/// The files of a directory as its manifest lists them, to be read.
class SealedFiles {
 public:
  /// Throws ResultsError.
  explicit SealedFiles(std::filesystem::path directory);

  const std::optional<Manifest>& manifest() const { return manifest_; }
  /// Whether the manifest lists tables. A directory without a manifest, or with one of figures or
  /// pages alone, is of an older version of this program.
  bool are_sealed() const;

  /// Opens a file whose length and checksum are those of the manifest or, if there is no list of
  /// tables, the file as it is. Throws ResultsError, ReplacedMeanwhile.
  std::ifstream open(const std::string& name) const;
  std::string text(const std::string& name) const;

 private:
  std::filesystem::path directory_;
  std::optional<Manifest> manifest_;
};

/// What `read(files)` returns for the files of one writer, though another one may replace them
/// meanwhile. Throws ResultsError.
template <class Read>
auto read_sealed(const std::filesystem::path& directory, Read read) {
  constexpr int most_attempts = 20;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    try {
      return read(SealedFiles(directory));
    } catch (const ReplacedMeanwhile&) {
    }
  }
  throw_always_replaced(directory);
}

}  // namespace subimpact
