#include "subimpact/io/read_results.h"

#include <fmt/format.h>

#include <limits>

#include <nlohmann/json.hpp>

#include "case/case_choices.h"
#include "io/check_results.h"
#include "io/csv_reader.h"
#include "io/json_integer.h"
#include "io/read_summary.h"
#include "io/row_thinning.h"
#include "io/run_tables.h"
#include "io/sealed_files.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace {

using Json = nlohmann::ordered_json;

constexpr int first_sealed_layout = 4;

constexpr int deepest_summary = 16;
constexpr double infinity = std::numeric_limits<double>::infinity();

std::optional<double> optional_number(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return json.get<double>();
}

std::optional<std::string> optional_text(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return json.get<std::string>();
}

// A number that is not finite was written as null.
double number(const Json& json, double if_null = infinity) {
  return optional_number(json).value_or(if_null);
}

KeyValue key_value(const CaseKey& key, const Json& json) {
  switch (key.type) {
    case KeyType::flag:
      return json.get<bool>();
    case KeyType::count:
      return integer<std::int64_t>(json);
    case KeyType::number:
      return json == "inf" ? infinity : json.get<double>();
    case KeyType::text:
    case KeyType::choice:
      return json.get<std::string>();
    case KeyType::pair:
      return json.get<std::vector<std::string>>();
    case KeyType::numbers:
      return json.get<std::vector<double>>();
  }
  throw std::logic_error("read_results: a key of unknown type");
}

// The entry of a key by its full name; nullptr if there is none.
const Json* entry_of(const Json& json, const std::string& name) {
  const std::size_t dot = name.rfind('.');
  if (dot != std::string::npos && !json.contains(name.substr(0, dot))) return nullptr;
  const Json& place = dot == std::string::npos ? json : json.at(name.substr(0, dot));
  const auto entry = place.find(dot == std::string::npos ? name : name.substr(dot + 1));
  return entry == place.end() ? nullptr : &*entry;
}

Case case_from(const Json& json) {
  Case input;
  for (const CaseKey& key : case_keys()) {
    const Json* entry = entry_of(json, key.name);
    if (entry == nullptr || entry->is_null()) continue;
    assign(input, key, key_value(key, *entry));
  }
  return input;
}

OutcomeKind outcome_kind(const std::string& name) {
  for (const OutcomeKind kind :
       {OutcomeKind::completed, OutcomeKind::stopped, OutcomeKind::inaccurate,
        OutcomeKind::unstable, OutcomeKind::chattering, OutcomeKind::solver_failed,
        OutcomeKind::left_validity}) {
    if (to_string(kind) == name) return kind;
  }
  throw ResultsError(fmt::format("summary.json: unknown outcome \"{}\"; run the case again", name));
}

// "contact_stiffness_N_per_m1.5": the exponent follows the unit's name, if it is not 1.
void read_contact_stiffness(const Json& json, ResolvedSettings& used) {
  const std::string start = "contact_stiffness_N_per_m";
  for (const auto& [name, value] : json.items()) {
    if (!name.starts_with(start)) continue;
    const std::string exponent = name.substr(start.size());
    used.contact_exponent = exponent.empty() ? 1.0 : std::stod(exponent);
    used.contact_stiffness = number(value);
    return;
  }
  used.contact_stiffness = number(json.at(start + "1.5"));  // throws, naming the missing field
}

ResolvedSettings used_from(const Json& json) {
  ResolvedSettings used;
  used.half_model = json.at("half_model").get<bool>();
  used.n_unknowns = integer<std::size_t>(json.at("n_unknowns"));
  used.n_sections = integer<std::size_t>(json.at("n_sections"));
  used.mesh = json.at("mesh").get<std::string>();
  used.contact_law = json.value("contact_law", "");
  used.section = json.value("section", "");
  used.highest_frequency = number(json.at("highest_frequency_rad_per_s"));
  used.largest_contact_slope = number(json.value("largest_contact_slope_N_per_m", Json(0.0)));
  used.joined_frequency = number(json.value("joined_frequency_rad_per_s", Json(0.0)));
  used.contact_time = number(json.value("contact_time_s", Json(0.0)));
  used.critical_step = number(json.at("critical_step_s"));
  used.step = optional_number(json.at("step_s"));
  used.table = optional_text(json.at("table"));
  used.events = value_of<EventHandling>(json.at("events").get<std::string>());
  used.reversals = value_of<ReversalHandling>(json.at("reversals").get<std::string>());
  if (const Json& order = json.at("max_order"); !order.is_null())
    used.max_order = integer<int>(order);
  used.position_tolerance = number(json.at("position_tolerance_m"), 0.0);
  used.velocity_tolerance = number(json.at("velocity_tolerance_m_per_s"), 0.0);
  read_contact_stiffness(json, used);
  used.yield_indentation = number(json.at("yield_indentation_m"));
  used.yield_curvature = number(json.at("yield_curvature_per_m"));
  used.first_period = number(json.at("first_period_s"));
  used.initial_energy = number(json.at("initial_energy_J"));
  used.energy_tolerance = number(json.value("energy_tolerance_relative", Json(0.0)));
  used.shape_interval = number(json.value("shape_interval_s", Json(0.0)));
  used.n_shape_points = integer<std::size_t>(json.value("n_shape_points", Json(0)));
  return used;
}

std::optional<Interval> interval_from(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return Interval{number(json.at(0)), number(json.at(1))};
}

NearMissKind near_miss_kind(const std::string& name) {
  for (const NearMissKind kind : {NearMissKind::opening, NearMissKind::closing}) {
    if (to_string(kind) == name) return kind;
  }
  throw ResultsError(
      fmt::format("summary.json: unknown near miss \"{}\"; run the case again", name));
}

std::vector<NearMiss> near_misses_from(const Json& json) {
  std::vector<NearMiss> near_misses;
  for (const Json& entry : json) {
    near_misses.push_back({number(entry.at("time_s")), number(entry.at("margin_m")),
                           near_miss_kind(entry.at("kind").get<std::string>())});
  }
  return near_misses;
}

std::vector<PlasticZone> plastic_zones_from(const Json& rest) {
  std::vector<PlasticZone> zones;
  if (rest.is_null()) return zones;
  for (const Json& zone : rest.at("plastic_zones")) {
    zones.push_back(
        {number(zone.at("from_m")), number(zone.at("to_m")), number(zone.at("rotation_rad"))});
  }
  return zones;
}

Work work_from(const Json& json) {
  Work work;
  work.steps = integer<long>(json.at("steps"));
  work.rejected_steps = integer<long>(json.at("rejected_steps"));
  work.partial_steps = integer<long>(json.at("partial_steps"));
  work.right_hand_sides = integer<long>(json.at("right_hand_sides"));
  work.mass_solves = integer<long>(json.at("mass_solves"));
  work.jacobians = integer<long>(json.at("jacobians"));
  work.factorisations = integer<long>(json.at("factorisations"));
  work.roots = integer<long>(json.at("roots"));
  work.nonlinear_iterations = integer<long>(json.at("nonlinear_iterations"));
  work.nonlinear_failures = integer<long>(json.at("nonlinear_failures"));
  work.setup_seconds = number(json.at("setup_s"));
  work.wall_seconds = number(json.at("wall_s"));
  return work;
}

// A field by its name since layout 3, or by the one before.
const Json& renamed(const Json& json, const char* name, const char* before) {
  return json.at(json.contains(name) ? name : before);
}

std::optional<ErrorEstimate> error_estimate_from(const Json& json) {
  if (json.is_null()) return std::nullopt;
  ErrorEstimate estimate;
  estimate.refined_run = renamed(json, "refined_run", "companion").get<std::string>();
  estimate.largest_error = number(json.at("max_time_error_s"));
  if (const Json& index = renamed(json, "first_unresolved_index", "first_undecided_index");
      !index.is_null()) {
    estimate.first_unresolved = integer<std::size_t>(index) - 1;
  }
  estimate.reason = optional_text(json.at("reason")).value_or("");
  for (const Json& entry : json.at("parts")) {
    ErrorEstimate::Part part;
    part.name = entry.at("name").get<std::string>();
    part.refined_run = renamed(entry, "refined_run", "companion").get<std::string>();
    part.largest_error = number(entry.at("max_error_s"));
    if (const Json& index = renamed(entry, "first_unresolved_index", "first_undecided_index");
        !index.is_null()) {
      part.first_unresolved = integer<std::size_t>(index) - 1;
    }
    part.reason = optional_text(entry.at("reason")).value_or("");
    estimate.parts.push_back(std::move(part));
  }
  return estimate;
}

// Files of older versions have no wish.
std::optional<WishOutcome> wish_from(const Json& summary) {
  const Json json = summary.value("wish", Json());
  if (json.is_null()) return std::nullopt;
  WishOutcome wish;
  wish.met = summary.at("wish_met").get<bool>();
  wish.wished = number(json.at("event_times_s"));
  wish.reached = number(json.at("reached_error_s"));
  wish.horizon = number(json.at("horizon_s"));
  wish.reason = optional_text(json.at("reason")).value_or("");
  wish.key = optional_text(json.at("key_to_free")).value_or("");
  return wish;
}

// Files of older versions and of cases without scatter have none.
std::optional<Predictability> predictability_from(const Json& summary) {
  const Json json = summary.value("predictability", Json());
  if (json.is_null()) return std::nullopt;
  Predictability result;
  result.horizon = number(json.at("horizon_s"));
  if (const Json& index = json.at("first_unpredictable_index"); !index.is_null()) {
    result.first_unpredictable = integer<std::size_t>(index) - 1;
  }
  result.reason = optional_text(json.at("reason")).value_or("");
  result.largest_scatter = number(json.at("max_time_scatter_s"));
  for (const Json& zone : json.at("zones")) {
    result.zones.push_back({optional_number(zone.at("start_scatter_s")),
                            optional_number(zone.at("end_scatter_s")),
                            optional_number(zone.at("impulse_scatter_Ns"))});
  }
  result.striker_velocity_scatter = optional_number(json.at("striker_velocity_scatter_m_per_s"));
  return result;
}

// Copies of deeply nested values exhaust the stack.
bool refuse_deep_nesting(int depth, Json::parse_event_t, Json&) {
  if (depth <= deepest_summary) return true;
  throw ResultsError(
      fmt::format("summary.json: is nested deeper than {}; run the case again", deepest_summary));
}

}  // namespace

int read_summary(const std::filesystem::path& path, const std::string& text, FinishedRun& run) {
  try {
    const Json json = Json::parse(text, refuse_deep_nesting);
    const int layout = integer<int>(json.value("layout", Json(1)));
    if (layout > summary_layout) {
      throw ResultsError(
          fmt::format("{}: has layout {}, but this program reads layouts 1 to {}; use the program "
                      "that wrote it, "
                      "or run the case again",
                      path.string(), layout, summary_layout));
    }
    run.program_version = json.at("program").at("version").get<std::string>();
    for (const auto& [name, version] : json.at("libraries").items()) {
      run.libraries.emplace_back(name, version.get<std::string>());
    }
    run.input = case_from(json.at("case"));
    Result& result = run.result;
    result.used = used_from(json.at("used"));
    const Json& outcome = json.at("outcome");
    result.outcome = {outcome_kind(outcome.at("kind").get<std::string>()),
                      number(outcome.at("time_s")), outcome.at("message").get<std::string>(),
                      interval_from(outcome.value("first_failure_s", Json()))};
    result.choice = json.value("choice", std::string());
    result.warnings = json.value("warnings", std::vector<std::string>());
    if (const Json shear = json.value("neglected_shear", Json()); !shear.is_null()) {
      result.neglected_shear = {number(shear.at("first_contact_end_without_s")),
                                optional_number(shear.at("first_contact_end_with_s"))};
    }
    result.n_history_rows = integer<std::size_t>(json.at("counts").at("history_rows"));
    result.n_shape_rows = integer<std::size_t>(json.at("counts").value("shape_rows", Json(0)));
    result.plastic_zones = plastic_zones_from(json.value("rest", Json()));
    result.n_yielded_sections = integer<std::size_t>(json.at("counts").at("yielded_sections"));
    result.near_misses = near_misses_from(json.value("near_misses", Json::array()));
    result.first_section_yield = optional_number(json.at("first_yield").at("section_s"));
    result.first_contact_yield = optional_number(json.at("first_yield").at("contact_s"));
    result.no_more_contact = optional_number(json.at("no_more_contact_s"));
    result.max_force = number(json.at("maxima").at("force_N"));
    result.max_indentation = number(json.at("maxima").at("indentation_m"));
    result.striker_velocity = number(json.at("final").at("striker_velocity_m_per_s"));
    result.beam_mean_velocity = number(json.at("final").at("beam_mean_velocity_m_per_s"));
    const Json& conservation = json.at("conservation");
    result.max_energy_error = number(conservation.at("max_energy_error_relative"));
    result.max_momentum_error = optional_number(conservation.at("max_momentum_error_relative"));
    const Json losses = json.value("dissipated_by_damping", Json::object());
    result.contact_damping_loss = number(losses.value("contact_J", Json(0.0)));
    result.beam_damping_loss = number(losses.value("beam_J", Json(0.0)));
    result.max_impulse_error = number(conservation.value("max_impulse_error_relative", Json(0.0)));
    result.error_estimate = error_estimate_from(json.at("error_bars"));
    result.wish = wish_from(json);
    result.predictability = predictability_from(json);
    result.work = work_from(json.at("work"));
    return layout;
  } catch (const nlohmann::json::exception& error) {
    throw ResultsError(fmt::format("{}: is not the summary of a run ({}); run the case again",
                                   path.string(), error.what()));
  } catch (const InvalidCase& error) {
    throw ResultsError(fmt::format("{}: the case in this file is not valid: {} {}", path.string(),
                                   error.key, error.what()));
  } catch (const std::logic_error& error) {  // of a name or number in a text
    throw ResultsError(fmt::format("{}: is not the summary of a run ({}); run the case again",
                                   path.string(), error.what()));
  }
}

namespace {

template <class Row>
std::vector<Row> read_checked(std::istream& file, const std::string& name,
                              const Columns<Row>& columns) {
  std::vector<Row> rows = read_rows(file, name, columns);
  RowChecks checks(name);
  for (const Row& row : rows) checks.check(row);
  return rows;
}

template <class Row>
std::vector<Row> read_thinned(std::istream& file, const std::string& name,
                              const Columns<Row>& columns, RowThinning<Row> rows) {
  CsvReader csv(file, name);
  RowChecks checks(name);
  for_each_row(csv, columns, [&](const Row& row) {
    checks.check(row);
    rows.add(row);
  });
  return rows.take();
}

RowThinning<HistoryRow> history_thinning(std::size_t n_rows) {
  return {n_rows,
          1,
          {&HistoryRow::force, &HistoryRow::indentation, &HistoryRow::struck_deflection,
           &HistoryRow::striker_relative, &HistoryRow::back_stress}};
}

RowThinning<SectionRow> section_thinning(std::size_t n_instants, std::size_t n_sections) {
  return {n_instants * n_sections, n_sections, {&SectionRow::curvature, &SectionRow::moment}};
}

RowThinning<PointRow> point_thinning(std::size_t n_instants, std::size_t n_points) {
  return {n_instants * n_points, n_points, {&PointRow::displacement}};
}

// Whole shapes, each with all its points.
RowThinning<ShapeRow> shape_thinning(std::size_t n_rows, std::size_t n_points) {
  return {n_rows, n_points, {}};
}

FinishedRun read_once(const std::filesystem::path& directory, const SealedFiles& files) {
  FinishedRun run;
  const std::filesystem::path summary = directory / "summary.json";
  const int layout = read_summary(summary, files.text("summary.json"), run);
  check_summary(summary.string(), run);
  const bool is_sealed = files.manifest() && files.manifest()->kind == "run";
  if (is_sealed) run.identity = files.manifest()->identity;
  if (!is_sealed && layout >= first_sealed_layout) {
    throw ResultsError(
        fmt::format("{}: has no {} of a run, without which nothing shows that its files belong "
                    "together; run the case again",
                    directory.string(), manifest_name));
  }
  if (!is_sealed) {
    run.result.warnings.push_back(
        fmt::format("an older version of this program wrote {}, without checksums: nothing shows "
                    "that its files belong together",
                    directory.string()));
  }
  const auto read = [&](const char* name, const auto& read_file) {
    std::ifstream file = files.open(name);
    return read_file(file, (directory / name).string());
  };
  Result& result = run.result;
  result.sub_impacts = read("events.csv", [](std::istream& file, const std::string& name) {
    return read_checked(file, name, events_columns());
  });
  result.transitions = read("transitions.csv", [](std::istream& file, const std::string& name) {
    return read_checked(file, name, transitions_columns());
  });
  result.history = read("history.csv", [&](std::istream& file, const std::string& name) {
    return read_thinned(file, name, history_columns(), history_thinning(result.n_history_rows));
  });
  if (const std::size_t n_sections = run.input.output.sections.size(); n_sections > 0) {
    result.section_history = read("sections.csv", [&](std::istream& file, const std::string& name) {
      return read_thinned(file, name, sections_columns(),
                          section_thinning(result.n_history_rows, n_sections));
    });
    if (layout < 3) {  // M had the opposite sign
      for (SectionRow& row : result.section_history) row.moment = -row.moment;
    }
  }
  if (const std::size_t n_points = run.input.output.points.size(); n_points > 0) {
    result.point_history = read("points.csv", [&](std::istream& file, const std::string& name) {
      return read_thinned(file, name, points_columns(),
                          point_thinning(result.n_history_rows, n_points));
    });
  }
  if (const std::size_t n_points = result.used.n_shape_points;
      n_points > 0 && result.n_shape_rows > 0) {
    result.shapes = read("shapes.csv", [&](std::istream& file, const std::string& name) {
      return read_thinned(file, name, shapes_columns(),
                          shape_thinning(result.n_shape_rows, n_points));
    });
    if (result.shapes.size() % n_points != 0) {
      throw ResultsError(
          fmt::format("{}: has {} rows, which are no whole shapes of {} points; run the case again",
                      (directory / "shapes.csv").string(), result.shapes.size(), n_points));
    }
    result.envelope = read("envelope.csv", [](std::istream& file, const std::string& name) {
      return read_checked(file, name, envelope_columns());
    });
  }
  return run;
}

}  // namespace

FinishedRun read_results(const std::filesystem::path& directory) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(directory, ignored)) {
    throw ResultsError(
        fmt::format("{}: is not a directory; give the output directory of "
                    "`subimpact run` (--out)",
                    directory.string()));
  }
  return read_sealed(directory,
                     [&](const SealedFiles& files) { return read_once(directory, files); });
}

}  // namespace subimpact
