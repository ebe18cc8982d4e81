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

/// The files of a directory as its manifest lists them, to be read.
class SealedFiles {
 public:
  /// Throws ResultsError.
  explicit SealedFiles(std::filesystem::path directory);

  const std::optional<Manifest>& manifest() const { return manifest_; }

  /// Opens a file whose length and checksum are those of the manifest. A directory without a
  /// manifest, or with one of figures alone, is of an older version of this program: its files are
  /// opened as they are. Throws ResultsError, ReplacedMeanwhile.
  std::ifstream open(const std::string& name) const;
  std::string text(const std::string& name) const;

 private:
  std::filesystem::path directory_;
  std::optional<Manifest> manifest_;
};

}  // namespace subimpact
