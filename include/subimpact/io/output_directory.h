#pragma once

/// A directory whose files belong together: those of one run, one comparison, one study. New files
/// are written into a hidden directory in it. commit() puts them in place together: it replaces
/// manifest.json, which lists every file with its checksum, in a single rename, and then moves the
/// files. A process that is killed before the rename leaves the older files, one that is killed
/// after it the newer ones; readers find each file under one of two names by its checksum,
/// and the next writer moves what is left. A lock (flock) keeps other writers out,
/// including those on other hosts if the file system supports it.

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

  /// Puts all files of staging() in place; more may follow and be committed in turn. Files that a
  /// commit() of another identity has put there before are replaced or removed; a file that none
  /// has put there and whose name a new file takes becomes "name.kept". Throws OutputError; the
  /// older files are then in place unless manifest.json lists the newer ones.
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
