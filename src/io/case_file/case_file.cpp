#include "subimpact/io/case_file.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

#include <toml++/toml.h>

#include "case/keys/materials.h"
#include "case/keys/slips.h"
#include "case/keys/units.h"
#include "case/meshes.h"
#include "io/case_file/toml_nodes.h"
#include "simulate/settings/refuse.h"

namespace subimpact {
namespace {

constexpr std::size_t largest_case = 1'000'000;  // bytes
constexpr std::size_t most_problems = 100;       // reported at once
constexpr const char* by_default = "default";    // as if the file did not have the key

// On a command line quotes are a nuisance: what is no TOML is a text where one is wanted.
std::optional<KeyValue> parse_setting(const CaseKey& key, const std::string& text) {
  const bool is_word = std::ranges::find(key.choices, text, &Choice::name) != key.choices.end();
  const bool wants_text = key.type == KeyType::text || key.type == KeyType::choice || is_word;
  const bool has_units =
      key.type == KeyType::numbers && std::isalpha(text.empty() ? 0 : text.back());
  const bool wants_pair = (key.type == KeyType::pair || has_units) && !text.starts_with('[');
  const bool wants_numbers = key.type == KeyType::numbers && !text.starts_with('[');
  const bool is_quoted = text.starts_with('"') || text.starts_with('\'');
  if (wants_text && !is_quoted) return KeyValue(text);
  if (key.type == KeyType::number && !split_unit(text).unit.empty()) return KeyValue(text);
  if (wants_pair) {
    std::vector<std::string> names;
    std::istringstream items(text);
    for (std::string item; std::getline(items, item, ',');) names.push_back(item);
    return KeyValue(std::move(names));
  }
  try {
    const std::string line = "value = " + (wants_numbers ? '[' + text + ']' : text);
    if (too_deep_at(line)) return std::nullopt;
    const toml::table parsed = toml::parse(line);
    if (parsed.size() != 1) return std::nullopt;
    return key_value_of(key, json_of(*parsed.get("value")));
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

/// Gathers the values of a case and everything that is wrong with them.
class Reader {
 public:
  explicit Reader(std::string name) : name_(std::move(name)) {}

  /// The keys of a table, those within it too; empty: outside all tables.
  void read(const toml::table& content, const std::string& table = {}) {
    for (const auto& [key, node] : content) {
      if (is_full()) return;
      const std::string leaf(key.str());
      const std::string where = place(key.source().begin);
      const std::string name = full_key_name(table, leaf);
      const toml::table* inner = node.as_table();
      const bool is_outermost = table.empty();
      const CaseKey* known = find_case_key(name);
      const bool is_table = known == nullptr && is_case_table(name);
      if (is_outermost && is_table) tables_[name] = where;
      if (known != nullptr) {
        take(*known, key_value_of(*known, json_of(node)), where, true, describe_type(node));
      } else if (is_table && inner != nullptr) {
        read(*inner, name);
      } else if (is_table && is_outermost) {
        complain(where,
                 fmt::format("\"{0}\" is {1}; allowed: a table; write [{0}] on a line of its "
                             "own, and its keys below it",
                             name, node.is_array() ? "a list" : describe_type(node)));
      } else {
        complain(where,
                 is_outermost && inner != nullptr ? unknown_table(name) : unknown_key(table, leaf));
      }
    }
  }

  void apply(const Override& setting) {
    const CaseKey* key = find_case_key(setting.key);
    if (key == nullptr) {
      const auto dot = setting.key.rfind('.');
      const std::string table = dot == std::string::npos ? "" : setting.key.substr(0, dot);
      const bool has_table = table.empty() || is_case_table(table);
      complain(setting.origin,
               has_table ? unknown_key(table, setting.key.substr(dot + 1)) : unknown_table(table));
      return;
    }
    std::erase(refused_, key->name);
    if (setting.value == by_default && key->type != KeyType::text) {
      given_.erase(key->name);
      return;
    }
    take(*key, parse_setting(*key, setting.value), setting.origin, false,
         "'" + setting.value + "'");
  }

  LoadedCase finish(const KeyChooser& choose) {
    give_values_of_material();
    std::map<std::string, std::string> places;
    Case read;
    for (const CaseKey& key : case_keys()) {
      const auto given = given_.find(key.name);
      if (given == given_.end()) continue;
      places[key.name] = given->second.place;
      const double length = read.scene.beam.length;
      const bool in_metres = make_fractions(key, given->second.value, length);
      if (const auto problem = problem_with(key, given->second.value)) {
        complain(given->second.place,
                 key.name + " " + *problem +
                     (in_metres ? fmt::format("; beam.length is {} m", length) : ""));
      } else {
        key.set(read, given->second.value);
      }
    }
    choose_mesh(read);
    const auto& size = descriptor_of(read.model.mesh).refinement;
    if (size && !given_.contains(size->key)) make_room_for_strike(read);
    complain_of_missing_keys(read);
    complain_of_stiffness(read);
    LoadedCase loaded(name_, std::move(places));
    loaded.value = std::move(read);
    loaded.given = given_keys();
    for (const char* key : {"beam.poisson", "scene.gravity"}) {
      if (!loaded.given.contain(key)) loaded.value.assumed.insert(key);
    }
    if (problems_.empty()) {
      try {
        if (choose) loaded.chosen = choose(loaded.value, loaded.given);
        check(loaded.value);
      } catch (const InvalidCase& error) {
        problems_.push_back(loaded.message(error));
      }
    }
    if (!problems_.empty()) fail<CaseFileError>("{}", fmt::join(problems_, "\n"));
    // The size that a setting names chooses the mesh.
    const bool by_size = std::ranges::any_of(meshes(), [&](const MeshDescriptor& mesh) {
      return mesh.refinement && is_given(mesh.refinement->key, false);
    });
    if (by_size && !given_.contains("model.mesh")) loaded.given.in_settings.insert("model.mesh");
    return loaded;
  }

 private:
  struct Given {
    KeyValue value;
    std::string place;
    bool in_file;
    std::string unit;  // that stands with the value; empty: none
  };

  std::string place(const toml::source_position& at) const {
    return fmt::format("{}:{}:{}", name_, at.line, at.column);
  }
  void complain(const std::string& where, const std::string& message) {
    if (!is_full()) problems_.push_back(where + ": " + message);
  }
  // Further problems are not looked for: their messages take longer than reading the file.
  bool is_full() const { return problems_.size() >= most_problems; }

  // `found`: what is there, if it is no value of the key.
  void take(const CaseKey& key, const std::optional<KeyValue>& value, const std::string& where,
            bool in_file, const std::string& found) {
    if (!value) {
      refused_.push_back(key.name);
      return complain(where, key.name + " " + refusal(key, found));
    }
    const auto* text = std::get_if<std::string>(&*value);
    const bool may_have_unit = text != nullptr && key.type == KeyType::number;
    given_[key.name] = {in_unit_of(key, *value), where, in_file,
                        may_have_unit ? std::string(split_unit(*text).unit) : ""};
  }

  // Fractions of the beam's length in place of lengths; whether there were any.
  static bool make_fractions(const CaseKey& key, KeyValue& value, double length) {
    if (is_position(key)) {
      CaseKey in_metres = key;
      in_metres.unit = "m";
      KeyValue lengths = in_unit_of(in_metres, value);
      if (lengths == value) return false;
      if (auto* list = std::get_if<std::vector<double>>(&lengths)) {
        for (double& x : *list) x /= length;
      } else {
        std::get<double>(lengths) /= length;
      }
      value = std::move(lengths);
      return true;
    }
    auto* placed = std::get_if<PlacedValues>(&value);
    bool any = false;
    if (placed == nullptr) return any;
    for (PlacedValues::Entry& entry : placed->entries) {
      if (!std::exchange(entry.in_metres, false)) continue;
      entry.position /= length;
      any = true;
    }
    return any;
  }

  // A stiffness in the unit of the other law.
  void complain_of_stiffness(const Case& read) {
    const auto given = given_.find("contact.stiffness");
    if (given == given_.end() || given->second.unit.empty()) return;
    const ContactKind law = read.scene.contact.kind;
    const bool has_power = given->second.unit.find('^') != std::string::npos;
    if (has_power ? law != ContactKind::linear : law != ContactKind::hertz) return;
    complain(
        given->second.place,
        fmt::format("contact.stiffness is in {}, but contact.law = \"{}\" allows {}; change "
                    "one of the two",
                    given->second.unit, name_of(law), units_beside(has_power ? "N/m" : "N/m^1.5")));
  }

  void complain_of_missing_keys(const Case& read) {
    std::vector<std::string> missing_tables;
    for (const CaseKey& key : case_keys()) {
      const bool refused = std::ranges::count(refused_, key.name) > 0;
      if (!key.required || given_.contains(key.name) || refused) continue;
      if (key.is_needless && key.is_needless(read)) continue;
      if (given_.contains("beam.material") && is_value_of_material(key.name)) continue;
      const std::string table = key.table();
      const auto present = tables_.find(table);
      if (present != tables_.end()) {
        complain(present->second,
                 fmt::format("{} is missing; allowed: {}; add \"{} = ...\" under [{}]: the {}",
                             key.name, allowed_values(key), key.leaf(), table, key.meaning));
      } else if (missing_tables.empty() || missing_tables.back() != table) {
        missing_tables.push_back(table);
        std::vector<std::string> needed;
        for (const CaseKey& other : case_keys()) {
          if (other.required && other.table() == table) needed.push_back(other.leaf());
        }
        complain(name_, fmt::format("table [{0}] is missing; add [{0}] with at least: {1}", table,
                                    fmt::join(needed, ", ")));
      }
    }
  }

  bool is_given(const char* key, bool in_file) const {
    const auto given = given_.find(key);
    return given != given_.end() && given->second.in_file == in_file;
  }

  // Values that the case gives itself go before those of its material, but the material of a
  // setting goes before the values of the file.
  void give_values_of_material() {
    const auto given = given_.find("beam.material");
    if (given == given_.end()) return;
    const auto* name = std::get_if<std::string>(&given->second.value);
    const auto* material = std::ranges::find(materials, name ? *name : "", &Material::name);
    if (material == std::end(materials)) return;  // refused below
    const bool in_file = given->second.in_file;
    for (const auto& [key, value] : material_values) {
      if (given_.contains(key) && (in_file || !given_.at(key).in_file)) continue;
      const bool is_given_otherwise =
          key == std::string_view("beam.poisson") && given_.contains("contact.beam_poisson");
      if (is_given_otherwise) continue;
      given_[key] = {material->*value, given->second.place, in_file, {}};
    }
  }

  // A case that names the size of a mesh and no mesh means that mesh. Settings go before the file.
  void choose_mesh(Case& read) {
    if (given_.contains("model.mesh")) return;
    for (const bool in_file : {false, true}) {
      const MeshDescriptor* chosen = nullptr;
      for (const MeshDescriptor& mesh : meshes()) {
        if (!mesh.suits(read.scene.beam)) continue;
        if (!mesh.refinement || !is_given(mesh.refinement->key, in_file)) continue;
        if (chosen != nullptr) {
          const char* first = chosen->refinement->key;
          const char* second = mesh.refinement->key;
          complain(given_.at(second).place,
                   fmt::format("{} is given, and {} too, but each is the size of another mesh; "
                               "allowed without model.mesh: one of them; leave one out, or "
                               "choose with model.mesh = \"{}\" ({}) or \"{}\" ({})",
                               second, first, mesh.name, find_case_key(second)->leaf(),
                               chosen->name, find_case_key(first)->leaf()));
        }
        chosen = &mesh;
      }
      if (chosen == nullptr) continue;
      read.model.mesh = chosen->kind;
      return;
    }
    read.model.mesh = default_mesh(read);
  }

  GivenKeys given_keys() const {
    GivenKeys keys;
    for (const auto& [name, given] : given_) {
      (given.in_file ? keys.in_file : keys.in_settings).insert(name);
    }
    return keys;
  }

  std::string name_;
  std::map<std::string, Given> given_;
  std::map<std::string, std::string> tables_;  // present ones, and their places
  std::vector<std::string> refused_;           // keys already complained of
  std::vector<std::string> problems_;
};

// No more than can be a case: a path may lead to a device that never ends.
std::string read_text(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw CaseFileError(name + ": is a directory; give the case file itself, such as " +
                        (path / "case.toml").string());
  }
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    fail<CaseFileError>("{}: cannot be read ({}); give the path of a case file (TOML)", name,
                        std::strerror(errno));
  }
  std::string text(largest_case + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (file.bad()) throw CaseFileError(name + ": reading it failed; check the file and its disk");
  return text;
}

std::string malformed(const std::string& name, const toml::parse_error& error) {
  const toml::source_position at = error.source().begin;
  return fmt::format(
      "{}:{}:{}: not valid TOML: {}; correct this line: a setting is written key = value, a table "
      "[name], a number with a decimal point, a text or a value with its unit in quotes",
      name, at.line, at.column, error.description());
}

}  // namespace

Override parse_override(const std::string& setting) {
  const auto equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) {
    fail<CaseFileError>(
        "--set {}: not a setting; allowed: table.key=value; write for example --set "
        "solver.rtol=1e-9",
        setting);
  }
  const std::string_view text = setting;
  return {std::string(trimmed(text.substr(0, equals))),
          std::string(trimmed(text.substr(equals + 1))), "--set " + setting};
}

std::string LoadedCase::message(const InvalidCase& error) const {
  const auto at = places_.find(error.key);
  const std::string place = at == places_.end() ? path_ : at->second;
  const CaseKey* key = find_case_key(error.key);
  const bool has_value = key == nullptr || key->get(value).has_value();
  const std::string origin = at == places_.end() && has_value ? " (the default)" : "";
  std::string text;
  for (const std::string& doubt : doubtful_units(value)) {
    text += fmt::format("{}: check the unit first: {}\n", path_, doubt);
  }
  return text + fmt::format("{}: {}{} {}", place, error.key, origin, error.message);
}

LoadedCase read_case_text(const std::string& text, const std::string& name,
                          const std::vector<Override>& overrides, const KeyChooser& choose) {
  if (text.size() > largest_case) {
    fail<CaseFileError>(
        "{}: is larger than {} bytes; allowed: a case file (TOML), which has some 1000; give the "
        "path of one",
        name, largest_case);
  }
  if (const auto line = too_deep_at(text)) {
    fail<CaseFileError>(
        "{}:{}: keys, tables or lists are nested deeper than {}; allowed: tables of keys, such as "
        "[beam] with length = 1; correct this line",
        name, *line, deepest_nesting);
  }
  Reader reader(name);
  try {
    reader.read(toml::parse(text));
  } catch (const toml::parse_error& error) {
    throw CaseFileError(malformed(name, error));
  }
  for (const Override& setting : overrides) reader.apply(setting);
  return reader.finish(choose);
}

LoadedCase read_case_file(const std::filesystem::path& path, const std::vector<Override>& overrides,
                          const KeyChooser& choose) {
  return read_case_text(read_text(path), path.string(), overrides, choose);
}

}  // namespace subimpact
