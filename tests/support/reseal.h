#pragma once

#include <filesystem>
#include <fstream>

#include "io/directory/listed_files.h"

namespace subimpact {

/// Lists the files of a directory of results as they are now in its manifest, so that what is wrong
/// in them is found by more than a checksum.
inline void reseal(const std::filesystem::path& directory) {
  Manifest manifest = *read_manifest(directory);
  for (auto& [name, seal] : manifest.files) {
    if (const auto now = fingerprint_of(directory / name)) seal = *now;
  }
  std::ofstream(directory / manifest_name) << to_json(manifest);
}

}  // namespace subimpact
