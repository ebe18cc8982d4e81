#include "io/state_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <ranges>

#include "case/case_choices.h"
#include "io/listed_files.h"
#include "io/record.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"
#include "subimpact/io/read_results.h"

namespace subimpact {
namespace {

constexpr int state_layout = 3;
constexpr int deepest_state = 8;

template <auto path>
constexpr auto of_striker = [](auto& state) -> auto& {
  return state.striker.*path;
};

const Record<RunState>& state_record() {
  static const Record<RunState> record = {
      {"time_s", "", &RunState::time, Form::from_zero},
      {"striker_mass_kg", "", of_striker<&Striker::mass>, Form::from_zero},
      {"striker_velocity_m_per_s", "", of_striker<&Striker::velocity>, Form::finite},
      {"striker_drop_height_m", "", of_striker<&Striker::drop_height>, Form::above_zero},
      {"striker_gap_m", "", of_striker<&Striker::gap>, Form::from_zero},
      {"striker_position", "", of_striker<&Striker::position>, Form::from_zero},
      {"mesh", "", &RunState::mesh},
      {"section", "", &RunState::section},
      {"contact_law", "", &RunState::contact_law}};
  return record;
}

Json json_of(const RunState& state) {
  Json json = json_of(state_record(), state);
  json["numbers"] = state.numbers;
  json["beside"] = Json::array();
  for (const auto& [description, other] : state.beside) {
    json["beside"].push_back({{"description", description}, {"state", json_of(*other)}});
  }
  return json;
}

std::shared_ptr<const RunState> state_of(const Json& json) {
  auto state = std::make_shared<RunState>();
  assign(state_record(), json, *state);
  state->numbers = json.at("numbers").get<decltype(state->numbers)>();
  for (const Json& other : json.at("beside")) {
    state->beside.emplace_back(other.at("description").get<std::string>(),
                               state_of(other.at("state")));
  }
  return state;
}

// Tables whose keys may differ between a run and one that goes on from it, and such keys.
constexpr std::array free_tables = {"",      "time",   "solver", "accuracy", "output",
                                    "study", "strike", "repeat", "scatter"};
constexpr std::array free_keys = {"striker.mass", "striker.velocity", "striker.gap"};
// Tables that a later run takes from the earlier one where it says nothing.
constexpr std::array kept_tables = {"model", "solver"};

bool is_among(const auto& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

std::string text_of(const CaseKey& key, const Case& input) {
  const std::optional<KeyValue> value = key.get(input);
  return value ? to_text(*value) : "not given";
}

}  // namespace

std::string state_json(const RunState& state) {
  Json json = {{"subimpact_state", state_layout}};
  json.update(json_of(state));
  return json.dump() + "\n";
}

std::shared_ptr<const RunState> state_from(const std::string& text) {
  try {
    const auto refuse_deep = [](int depth, Json::parse_event_t, Json&) {
      if (depth <= deepest_state) return true;
      throw ResultsError("is nested too deep");
    };
    const Json json = Json::parse(text, refuse_deep);
    if (integer<int>(json.at("subimpact_state")) != state_layout) {
      throw ResultsError("is of another version of this program; run the case again");
    }
    return state_of(json);
  } catch (const ResultsError&) {
    throw;
  } catch (const std::exception& error) {
    throw ResultsError(fmt::format("is not the state of a run ({})", error.what()));
  }
}

FinishedRun continue_from(const std::filesystem::path& directory, LoadedCase& loaded) {
  FinishedRun run = read_results(directory);
  run.result.end_state = read_listed(directory, [&](const ListedFiles& files) {
    if (!files.manifest()->files.contains(state_name)) {
      throw ResultsError(
          fmt::format("{}: holds no {}: the run failed, or an older version made it; "
                      "no run can go on from there",
                      directory.string(), state_name));
    }
    try {
      return state_from(files.text(state_name));
    } catch (const ResultsError& error) {
      throw ResultsError(fmt::format("{}: {}", (directory / state_name).string(), error.what()));
    }
  });
  const auto is_given = [&](const CaseKey& key) {
    return loaded.given.in_file.contains(key.name) || loaded.given.in_settings.contains(key.name);
  };
  const auto gives_table = [&](const std::string& table) {
    return std::ranges::any_of(
        case_keys(), [&](const CaseKey& key) { return key.table() == table && is_given(key); });
  };
  std::vector<std::string> differences;
  for (const CaseKey& key : case_keys()) {
    if (is_among(kept_tables, key.table()) && !gives_table(key.table())) {
      if (const auto value = key.get(run.input)) key.set(loaded.value, *value);
    }
    if (is_among(free_tables, key.table()) || is_among(free_keys, key.name)) continue;
    const std::string here = text_of(key, loaded.value), there = text_of(key, run.input);
    if (here != there) differences.push_back(fmt::format("{} = {}, not {}", key.name, here, there));
  }
  if (!differences.empty()) {
    throw CaseFileError(fmt::format(
        "--continue {}: the case differs from that of the run there: {}; allowed to differ: the "
        "striker's mass, velocity and gap, and the tables time, solver, accuracy, output, strike "
        "and repeat",
        directory.string(), fmt::join(differences, "; ")));
  }
  loaded.value.parts.start = run.result.end_state;
  return run;
}

}  // namespace subimpact
