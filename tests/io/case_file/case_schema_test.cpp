#include "subimpact/io/case_file.h"

#include <toml++/toml.h>
#include <nlohmann/json.hpp>
#include <regex>

#include "small_case.h"
#include "subimpact/case/case_keys.h"
#include "testing.h"

namespace subimpact {
namespace {

using Json = nlohmann::json;

const Json& schema() {
  static const Json parsed = Json::parse(case_schema());
  return parsed;
}

// The object of a table, such as "beam.damping".
const Json& object_of(const std::string& table) {
  const Json* object = &schema();
  std::istringstream names(table);
  for (std::string name; std::getline(names, name, '.');) {
    object = &object->at("properties").at(name);
  }
  return *object;
}

const Json& schema_of(const CaseKey& key) {
  const Json& top = schema().at("properties");
  if (key.table().empty()) return top.at(key.leaf());
  return object_of(key.table()).at("properties").at(key.leaf());
}

Json as_json(const std::string& toml_text) {
  std::ostringstream text;
  text << toml::json_formatter{toml::parse(toml_text)};
  return Json::parse(text.str());
}

bool has_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  return type == "null" && value.is_null();
}

bool has_a_type_of(const Json& value, const Json& types) {
  if (types.is_string()) return has_type(value, types);
  for (const Json& type : types) {
    if (has_type(value, type)) return true;
  }
  return false;
}

bool is_within(const Json& value, const Json& rules) {
  if (!value.is_number()) return true;
  const double x = value;
  return x >= rules.value("minimum", -HUGE_VAL) && x > rules.value("exclusiveMinimum", -HUGE_VAL) &&
         x <= rules.value("maximum", HUGE_VAL) &&
         (!rules.contains("multipleOf") || std::fmod(x, rules["multipleOf"].get<double>()) == 0.0);
}

// The part of JSON schema that a case file's needs; the place of the first fault, or "" if none.
std::string fault(const Json& value, const Json& rules, const std::string& place = "case") {
  if (!has_a_type_of(value, rules.at("type"))) return place + ": type";
  if (!is_within(value, rules)) return place + ": range";
  if (value.is_string() && rules.contains("pattern") &&
      !std::regex_match(value.get<std::string>(),
                        std::regex(rules["pattern"].get<std::string>()))) {
    return place + ": pattern";
  }
  if (rules.contains("enum")) {
    const Json& names = rules["enum"];
    if (std::find(names.begin(), names.end(), value) == names.end()) return place + ": choice";
  }
  if (value.is_array()) {
    if (value.size() < rules.value("minItems", std::size_t{0}) ||
        value.size() > rules.value("maxItems", std::numeric_limits<std::size_t>::max())) {
      return place + ": items";
    }
    for (const Json& item : value) {
      if (const std::string found = fault(item, rules.at("items"), place); !found.empty()) {
        return found;
      }
    }
  }
  if (value.is_object()) {
    for (const auto& name : rules.value("required", Json::array())) {
      if (!value.contains(name)) return place + "." + name.get<std::string>() + ": missing";
    }
    for (const auto& [name, member] : value.items()) {
      const std::string inner = place + "." + name;
      if (!rules.at("properties").contains(name)) return inner + ": unknown";
      const std::string found = fault(member, rules["properties"][name], inner);
      if (!found.empty()) return found;
    }
  }
  return {};
}

std::string fault_in(const std::string& toml_text) { return fault(as_json(toml_text), schema()); }

// In an object and those within it.
std::size_t count_keys(const Json& object) {
  std::size_t n = 0;
  for (const auto& [name, entry] : object.at("properties").items()) {
    n += entry.at("type") == "object" ? count_keys(entry) : 1;
  }
  return n;
}

TEST(CaseSchema, HasEveryKeyOfTheTableAndNoOther) {
  EXPECT_EQ(count_keys(schema()), case_keys().size());
  for (const CaseKey& key : case_keys()) {
    const Json& rules = schema_of(key);
    const std::string description = rules.at("description");
    EXPECT_EQ(description.find(key.meaning), 0u) << key.name;
    expect_in(description, key.unit, key.range);
  }
}

TEST(CaseSchema, RequiresWhatTheTableRequires) {
  for (const CaseKey& key : case_keys()) {
    const Json& owner = key.table().empty() ? schema() : object_of(key.table());
    const Json names = owner.value("required", Json::array());
    EXPECT_EQ(std::count(names.begin(), names.end(), key.leaf()),
              key.required && !key.is_needless ? 1 : 0)
        << key.name;
  }
  EXPECT_EQ(schema().at("required"), Json({"beam", "striker", "time"}));
}

TEST(CaseSchema, OffersTheChoicesOfTheTableWithTheirNotes) {
  for (const CaseKey& key : case_keys()) {
    if (key.choices.empty()) continue;
    if (key.type == KeyType::number) {  // words in place of a number
      const std::regex pattern(schema_of(key).at("pattern").get<std::string>());
      for (const Choice& choice : key.choices) EXPECT_TRUE(std::regex_search(choice.name, pattern));
      continue;
    }
    const Json& rules = key.type == KeyType::pair ? schema_of(key).at("items")
                        : key.type == KeyType::placed
                            ? schema_of(key).at("items").at("properties").at("face")
                            : schema_of(key);
    const Json& notes = rules.at("x-taplo").at("docs").at("enumValues");
    ASSERT_EQ(rules.at("enum").size(), key.choices.size()) << key.name;
    ASSERT_EQ(notes.size(), key.choices.size()) << key.name;
    for (std::size_t i = 0; i < key.choices.size(); ++i) {
      EXPECT_EQ(rules.at("enum")[i], key.choices[i].name);
      EXPECT_EQ(notes[i], key.choices[i].note);
    }
  }
}

TEST(CaseSchema, StatesDefaultsThatArePlainValues) {
  const auto default_of = [](const char* name) {
    return schema_of(*find_case_key(name)).value("default", Json());
  };
  EXPECT_EQ(default_of("solver.rtol"), 1e-8);
  EXPECT_EQ(default_of("model.layers"), 40);
  EXPECT_EQ(default_of("solver.method"), "erk");
  EXPECT_EQ(default_of("beam.ends"), Json({"free", "free"}));
  EXPECT_TRUE(default_of("model.mesh").is_null()) << "depends on model.elements";
  EXPECT_TRUE(default_of("solver.step").is_null()) << "depends on the method";
  EXPECT_TRUE(default_of("beam.yield_stress").is_null()) << "inf";
}

TEST(CaseSchema, AcceptsThePapersCaseAndTheSmallOne) {
  std::ifstream file(SUBIMPACT_PAPER_CASE);
  std::ostringstream text;
  text << file.rdbuf();
  EXPECT_EQ(fault_in(text.str()), "");
  EXPECT_EQ(fault_in(small_case_text()), "");
}

TEST(CaseSchema, RefusesWhatACaseFileRefuses) {
  EXPECT_EQ(fault_in(small_case_with("density", "densiti")), "case.beam.densiti: unknown");
  EXPECT_EQ(fault_in(small_case_with("end =", "# end =")), "case.time.end: missing");
  EXPECT_EQ(fault_in(small_case_text() + "ende = 1\n"), "case.time.ende: unknown");
  EXPECT_EQ(fault_in(small_case_with("0.7112", "\"0,7112\"")), "case.beam.length: pattern");
  EXPECT_EQ(fault_in(small_case_with("0.7112", "\"711.2 mm\"")), "");
  EXPECT_EQ(fault_in(small_case_with("0.7112", "\"711.2 kg\"")), "case.beam.length: pattern");
  EXPECT_EQ(fault_in(small_case_with("0.7112", "\"711200 \u00b5m\"")), "");
  EXPECT_EQ(fault_in(small_case_with("71.96e9", "\"71960 N/mm^2\"")), "");
  EXPECT_EQ(fault_in(small_case_with("0.7112", "0")), "case.beam.length: range");
  EXPECT_EQ(fault_in(small_case_text() + "[model]\nlayers = 41\n"), "case.model.layers: range");
  EXPECT_EQ(fault_in(small_case_text() + "[model]\nmesh = \"fine\"\n"), "case.model.mesh: choice");
  EXPECT_EQ(fault_in(small_case_with("length", "ends = [\"free\"]\nlength")),
            "case.beam.ends: items");
  EXPECT_EQ(fault_in(small_case_text() + "[output]\nsections = [0.5, 1.5]\n"),
            "case.output.sections: range");
}

TEST(CaseSchema, AndTheTableDrawTheSameLimits) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const CaseKey& key : case_keys()) {
    if (key.type != KeyType::number) continue;
    const Json& rules = schema_of(key);
    for (const double x : {-1.0, 0.0, 1e-300, 1e-14, 1e-3, 0.1, 0.5, 1.0, 2.0, 999.0, 1e9}) {
      EXPECT_EQ(fault(x, rules).empty(), !problem_with(key, x)) << key.name << " = " << x;
    }
    EXPECT_EQ(fault(nullptr, rules).empty(), !problem_with(key, infinity)) << key.name;
  }
}

}  // namespace
}  // namespace subimpact
