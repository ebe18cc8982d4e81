#pragma once

/// Case files (TOML) and the settings that override them.

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/case/keys_without_effect.h"
#include "subimpact/case/simulate.h"

namespace subimpact {

/// One setting from outside the file, which goes before the file's own.
struct Override {
  std::string key;     ///< "beam.length"
  std::string value;   ///< as in TOML; quotes around a text may be left out
  std::string origin;  ///< how it was given, for messages: "--set beam.length=1"
};

/// Takes "table.key=value" apart. Throws CaseFileError.
Override parse_override(const std::string& setting);

/// A case that cannot be read. `what()` is one line a problem, each with place, key, what is wrong,
/// what is allowed and what to do.
class CaseFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A case and where each of its values came from.
class LoadedCase {
 public:
  Case value;
  GivenKeys given;

  LoadedCase(std::string path, std::map<std::string, std::string> places)
      : path_(std::move(path)), places_(std::move(places)) {}

  /// keys_without_effect() of the case.
  std::vector<std::string> notes() const { return keys_without_effect(value, given); }

  /// The error's message with the place of its key: "case.toml:12:8: solver.step is ...".
  std::string message(const InvalidCase& error) const;

 private:
  std::string path_;
  std::map<std::string, std::string> places_;  // key -> "file:line:column" or an override's origin
};

/// Reads a case file, replaces its values by the overrides, and checks the whole case. Every
/// problem found is reported at once. Throws CaseFileError.
LoadedCase read_case_file(const std::filesystem::path& path,
                          const std::vector<Override>& overrides = {});

/// The same for a text; `name` stands for the file in messages.
LoadedCase read_case_text(const std::string& text, const std::string& name,
                          const std::vector<Override>& overrides = {});

/// A case as the text of a case file: every key that has a value, under its table, with its unit.
/// read_case_text() reads the same case back.
std::string case_file_text(const Case& input);

}  // namespace subimpact
