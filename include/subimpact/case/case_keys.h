#pragma once

/// The keys of a case, as one table. All code that reads, checks, echoes or documents a case uses
/// this table, so that a new key is a new row and nothing else.

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// Loads, springs or gauges at points, each with a position and, under the name `quantity`, a
/// number, a table of pairs (t, F) or a word: [{ position = 0.5, stiffness = 100 }]; of springs
/// perhaps what makes them push only.
struct PlacedValues {
  std::string quantity;  ///< "stiffness", "force", "face"
  struct Entry {
    double position = 0.0;                         ///< as a fraction of the length, or in m
    std::vector<std::pair<double, double>> table;  ///< a plain number is one pair (0, number)
    std::string word = {};                         ///< in place of a table
    bool in_metres = false;
    std::optional<OneSided> one_sided = {};
    bool operator==(const Entry&) const = default;
  };
  std::vector<Entry> entries;
  bool operator==(const PlacedValues&) const = default;
};

/// What a key can hold, independent of any file format.
using KeyValue = std::variant<bool, std::int64_t, double, std::string, std::vector<std::string>,
                              std::vector<double>, PlacedValues>;

enum class KeyType {
  text,     ///< any text
  number,   ///< finite, unless the key allows infinity
  count,    ///< whole number
  flag,     ///< true or false
  choice,   ///< one of the key's choices
  pair,     ///< two of the key's choices
  numbers,  ///< a list of finite numbers
  placed    ///< a list of loads, springs or gauges at points (PlacedValues)
};

/// A name a key accepts, with a line on what it stands for.
struct Choice {
  std::string name;
  std::string note;
};

/// The limits of a number, as far as a schema can express them.
struct Limits {
  std::optional<double> minimum = std::nullopt;            ///< allowed itself
  std::optional<double> exclusive_minimum = std::nullopt;  ///< not allowed itself
  std::optional<double> maximum = std::nullopt;            ///< allowed itself
  std::optional<int> multiple_of = std::nullopt;
  bool infinity = false;  ///< whether inf is allowed

  bool hold(double x) const;
};

struct CaseKey {
  std::string name;  ///< with its table: "beam.length"
  KeyType type;
  std::string unit;             ///< empty: none
  std::string range;            ///< in words, for numbers and counts, each of a list: "above 0"
  Limits limits;                ///< the same, to check and to write schemas with
  std::vector<Choice> choices;  ///< for choice, pair and faces
  bool required;                ///< has no default
  /// Whether other keys of the case make a required key needless; empty: always needed.
  std::function<bool(const Case&)> is_needless;
  std::string default_text;  ///< in words or as it would be written; empty if required
  std::string meaning;       ///< a noun phrase
  /// The case's present value; nothing if it is left open there.
  std::function<std::optional<KeyValue>(const Case&)> get;
  /// Stores a value with which problem_with() has no problem.
  std::function<void(Case&, const KeyValue&)> set;

  std::string table() const;  ///< "beam"; empty for a key outside all tables
  std::string leaf() const;   ///< "length"
  std::vector<std::string> choice_names() const;
  const char* quantity() const;  ///< of the things at points: "force", "stiffness", "face"
};

/// All keys, in the order in which they are written and listed.
const std::vector<CaseKey>& case_keys();

/// The key of that name ("beam.length"), or nullptr.
const CaseKey* find_case_key(std::string_view name);

/// What the key accepts: "a number, above 0 (m)".
std::string allowed_values(const CaseKey& key);

/// The message for a value that is refused: what was found, what is allowed, what to do.
std::string refusal(const CaseKey& key, const std::string& found);

/// Why the key cannot take the value, as a message that begins with "is"; nothing if it can.
std::optional<std::string> problem_with(const CaseKey& key, const KeyValue& value);

/// Checks and stores a value. Throws InvalidCase.
void assign(Case& target, const CaseKey& key, const KeyValue& value);

/// Checks every key of a case, and rules that involve several keys. Throws InvalidCase for the
/// first key that is not allowed. Rules that depend on the mesh are checked by resolve() and
/// simulate().
void check(const Case& input);

/// The keys that a user gave, in the file and on the command line.
struct GivenKeys {
  std::set<std::string> in_file;
  std::set<std::string> in_settings;  ///< of the command line, which override the file
  bool contain(const std::string& key) const {
    return in_file.contains(key) || in_settings.contains(key);
  }
};

/// The choices that a case leaves to the program.
struct OpenChoices {
  bool mesh = true;       ///< model.mesh
  bool size = true;       ///< model.segments or model.elements
  bool method = true;     ///< solver.method
  bool tolerance = true;  ///< solver.rtol, or solver.step

  bool all() const { return mesh && size && method && tolerance; }
};

/// The choices that the user's keys leave open. Keys of one mesh or method fix that mesh or method.
OpenChoices open_choices(const GivenKeys& given);

/// Keys that were given but have no effect because of another key: one sentence per key, such as
/// 'model.layers = 40 has no effect with model.section = "exact"'. There is none for a key of the
/// file that has no effect because of a setting on the command line: files are often run with other
/// choices.
std::vector<std::string> keys_without_effect(const Case& input, const GivenKeys& given);
/// 'has no effect with model.section = "exact"', of one key; empty if it has one.
std::string why_without_effect(const Case& input, const CaseKey& key);

/// A value as a case file writes it; that of a key in a case, or its default in words.
std::string to_text(const KeyValue& value);
std::string value_text(const Case& input, std::string_view key);

/// The candidate nearest to a mistyped name, or an empty string if none is near.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

std::string_view to_string(Method method);
std::string_view to_string(EventHandling events);

/// Values that are probably given in another unit than that of the case file, such as lengths in mm
/// or stresses in MPa: one sentence per key, with the value, what makes it doubtful and what to
/// write if that unit was meant. Empty for every plausible scene; a doubtful one can still be run.
std::vector<std::string> doubtful_units(const Case& input);

/// A warning: what it is about, in a word, and the sentence.
struct Beyond {
  std::string_view kind;
  std::string sentence;
};
/// Results of a run that exceed the validity of the model (docs/model.md), one sentence each with
/// the number and what to do; empty if there are none. Rotations are sampled at separations and at
/// the end of the run.
std::vector<Beyond> beyond_the_model(const Case& input, const Result& result);

}  // namespace subimpact
