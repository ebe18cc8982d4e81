#pragma once

/// Case files (TOML), the settings that override them, and what identifies and describes a case.

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "subimpact/case/case_keys.h"

namespace subimpact {

/// One setting from outside the file, which overrides the file's own.
struct Override {
  std::string key;     ///< "beam.length"
  std::string value;   ///< as in TOML; quotes around a text may be left out
  std::string origin;  ///< how it was given, for messages: "--set beam.length=1"
};

/// Splits "table.key=value". Throws CaseFileError.
Override parse_override(const std::string& setting);

/// A case and where each of its values came from.
class LoadedCase {
 public:
  Case value;
  GivenKeys given;
  std::vector<std::string> chosen;  ///< keys that a KeyChooser has set

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

/// Sets keys of a case that are not given, and returns their names; called before the case is
/// checked.
using KeyChooser = std::function<std::vector<std::string>(Case& input, const GivenKeys& given)>;

/// Reads a case file, replaces its values by the overrides, and checks the whole case. Every
/// problem found is reported at once. Throws CaseFileError.
LoadedCase read_case_file(const std::filesystem::path& path,
                          const std::vector<Override>& overrides = {},
                          const KeyChooser& choose = {});

/// read_case_file() for a text; messages name `name` as the file.
LoadedCase read_case_text(const std::string& text, const std::string& name,
                          const std::vector<Override>& overrides = {},
                          const KeyChooser& choose = {});

/// A case as the text of a case file: every key that has a value, with its unit; those in
/// Case::assumed as comments. read_case_text() with choose_scene() reads the same case back.
std::string case_file_text(const Case& input);

/// Identifies the results of a case: a hash, 32 hexadecimal digits, of the program's version, the
/// values of all keys except the title, the choices left to the program (open_choices), and `how`,
/// the caller's words for the way it is run. Cases with different results have different
/// identities.
std::string case_identity(const Case& input, const GivenKeys& given, const std::string& how = {});

/// The JSON schema (draft 2020-12) of a case file, made from case_keys(): for editors that complete
/// and check TOML, and for programs that write case files. It expresses what each key accepts by
/// itself; rules that involve several keys are checked by check(). A key that may be infinite also
/// accepts null, since JSON has no infinity and editors hand TOML's inf to the schema as null.
std::string case_schema();

}  // namespace subimpact
