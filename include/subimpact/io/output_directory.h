#pragma once

/// A directory whose files belong together, those of one run, one comparison, one study, and become
/// valid together (docs/files.md, "One directory, one run"). commit() replaces manifest.json in a
/// single rename and then moves the files; readers find each under one of two names by its
/// checksum, and the next writer moves what a killed one left.

#include <filesystem>
#include <memory>
#include <string>

#include "subimpact/simulate/error.h"

namespace subimpact {

/// A random identity of a run: 32 hexadecimal digits.
std::string new_identity();

class DirectoryLock;
struct Manifest;

class OutputDirectory {
 public:
  /// Makes the directory if missing, locks it and makes sure that files can be written. `kind`
  /// names what the directory holds: "run", "compare" ...; `identity` is that of the run, a new one
  /// if empty. Throws DirectoryInUse, and OutputError also if the directory holds files of another
  /// kind ("figures" go with the run or sweep of that identity).
  OutputDirectory(const std::filesystem::path& directory, std::string kind,
                  std::string identity = new_identity());
  /// Removes what was not committed.
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& staging() const { return staging_; }

  /// Puts all files of staging() in place; more may follow and be committed in turn. Throws
  /// OutputError; the older files are then in place unless manifest.json lists the newer ones.
  void commit();

 private:
  void write_manifest();
  // Puts what the manifest lists in place, removes what it replaces and what killed writers left,
  // and begins to stage files.
  void settle();

  std::filesystem::path path_, staging_;
  std::string kind_, identity_, commit_;
  std::unique_ptr<DirectoryLock> lock_;
  bool is_new_ = false;  // made here: removed again if nothing is put into it
  bool is_committed_ = false;
};

}  // namespace subimpact
