#pragma once

/// A directory whose files belong together: those of one run, one comparison, one study. New files
/// are written into a hidden directory next to the present files. commit() puts them in place
/// together: it replaces manifest.json, which lists every file with its checksum, in a single
/// rename, and then moves the files. A process that is killed before the rename leaves the older
/// files, one that is killed after it the newer ones; readers find each file under one of two names
/// by its checksum (ResultFiles). So a reader never gets a mixture of old and new files. A lock
/// (flock) keeps other writers out, including those on other hosts if the file system supports it.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "subimpact/simulate/error.h"

namespace subimpact {

/// A random identity of a run: 32 hexadecimal digits.
std::string new_identity();

class DirectoryLock;
struct Manifest;

class OutputDirectory {
 public:
  /// Makes the directory if missing, locks it and makes sure that files can be written. Completes
  /// the commit of a killed writer. `kind` names what the directory holds: "run", "compare" ...;
  /// `identity` is that of the run, a new one if empty (results of an older version have none).
  /// Throws DirectoryInUse, and OutputError also if the directory holds files of another kind
  /// ("figures" go with the run or sweep of that identity).
  OutputDirectory(const std::filesystem::path& directory, std::string kind,
                  std::string identity = new_identity());
  /// Removes what was not committed.
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& staging() const { return staging_; }

  /// Puts all files of staging() in place; more may follow and be committed in turn. Files of
  /// another identity that commit() has put there before are removed, which notes() tell. A file
  /// that no commit() has put there, or that was changed since, is kept: under its own name, or as
  /// "name.kept" where a new file takes its name. Throws OutputError and leaves the older files in
  /// place.
  void commit();

  /// After an error of writing: goes on in a new directory below the system's directory for
  /// temporary files, with all that was staged. Throws OutputError.
  void relocate(const std::string& cause);
  bool is_relocated() const { return !relocation_.empty(); }

  /// Messages for the user: files that were kept or removed, another directory.
  const std::vector<std::string>& notes() const { return notes_; }
  void add_notes(const std::vector<std::string>& of_another) {
    notes_.insert(notes_.end(), of_another.begin(), of_another.end());
  }

 private:
  void open(const std::filesystem::path& directory);
  void begin_staging();
  void write_manifest();
  void settle();
  void put_in_place(const std::string& name, const Manifest& manifest);
  bool remove_replaced(const std::string& name, const Manifest& manifest);

  std::filesystem::path path_, staging_;
  std::string kind_, identity_, commit_;
  std::unique_ptr<DirectoryLock> lock_;
  std::string relocation_;  // its cause
  bool is_new_ = false;     // made here: removed again if nothing is put into it
  bool is_committed_ = false;
  std::vector<std::string> notes_;
};

}  // namespace subimpact
