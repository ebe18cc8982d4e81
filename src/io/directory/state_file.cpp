#include <fmt/ranges.h>

#include <array>
#include <ranges>

#include "case/refuse.h"
#include "io/directory/listed_files.h"
#include "io/records/run_record.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"
#include "subimpact/io/read_results.h"

namespace subimpact {
namespace {

constexpr int state_layout = 4;

template <auto path>
constexpr auto of_striker = [](auto& state) -> auto& {
  return state.striker.*path;
};

const Record<RunState>& state_record();
std::shared_ptr<const RunState> state_of(const Json& json);

Json beside_json(const RunState& state) {
  Json list = Json::array();
  for (const auto& [description, other] : state.beside) {
    list.push_back({{"description", description}, {"state", json_of(state_record(), *other)}});
  }
  return list;
}

void read_beside(const Json& list, RunState& state) {
  for (const Json& other : list) {
    state.beside.emplace_back(other.at("description").get<std::string>(),
                              state_of(other.at("state")));
  }
}

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
      {"contact_law", "", &RunState::contact_law},
      {"numbers", "", [](const RunState& state) { return Json(state.numbers); },
       [](const Json& json, RunState& state) { json.get_to(state.numbers); }},
      {"beside", "", &beside_json, &read_beside}};
  return record;
}

std::shared_ptr<const RunState> state_of(const Json& json) {
  auto state = std::make_shared<RunState>();
  assign(state_record(), json, *state);
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
  json.update(json_of(state_record(), state));
  return json.dump() + "\n";
}

FinishedRun continue_from(const std::filesystem::path& directory, LoadedCase& loaded) {
  FinishedRun run = read_results(directory);
  read_listed(directory, [&](const ListedFiles& files) {
    if (!files.manifest()->files.contains(state_name)) {
      fail<ResultsError>(
          "{}: holds no {}: the run failed, or an older version made it; no run can go on from "
          "there",
          directory.string(), state_name);
    }
    const auto read = [&](const Json& json) {
      if (integer<int>(json.at("subimpact_state")) != state_layout) {
        throw ResultsError("is of another version of this program");
      }
      run.result.end_state = state_of(json);
    };
    read_json(directory / state_name, files.text(state_name), "the state of a run",
              "; run the case again", read);
  });
  Scene& scene = loaded.value.scene;
  for (const std::string& name : loaded.chosen) {
    const CaseKey& key = *find_case_key(name);
    if (name == "beam.poisson") scene.beam.poisson.reset();
    if (name == "contact.indentation") scene.contact.indentation.reset();
    if (name == "contact.yield_pressure") scene.contact.pressure_by_depth = false;
    if (const auto value = key.get(run.input)) key.set(loaded.value, *value);
  }
  loaded.value.model_choice = run.input.model_choice;
  const auto is_given = [&](const CaseKey& key) { return loaded.given.contain(key.name); };
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
    fail<CaseFileError>(
        "--continue {}: the case differs from that of the run there: {}; allowed to differ: the "
        "striker's mass, velocity and gap, and the tables time, solver, accuracy, output, strike "
        "and repeat",
        directory.string(), fmt::join(differences, "; "));
  }
  loaded.value.parts.start = run.result.end_state;
  return run;
}

}  // namespace subimpact
