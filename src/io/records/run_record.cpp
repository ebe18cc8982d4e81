#include "io/records/run_record.h"

#include <fmt/format.h>
#include <toml++/toml.h>
#include <Eigen/Core>

#include "integrate/sundials.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

// The beam at rest after the run, where shapes were computed and no check failed.
struct BeamAtRest {
  double largest_set = 0.0, position = 0.0;
  std::vector<PlasticZone> plastic_zones;
};

// clang-format off
const Record<Total> total_record = {
    {"value", "", &Total::value},
    {"error", "", &Total::error}};

const Record<ZoneSummary> zone_record = {
    {"zone", "number of the zone, from 1", &ZoneSummary::zone},
    {"sub_impacts", "their number", &ZoneSummary::n_sub_impacts},
    {"subzones", "their number", &ZoneSummary::n_subzones},
    {"start_s", "start of its first sub-impact", &ZoneSummary::start},
    {"end_s", "end of its last one; null: still in contact", &ZoneSummary::end},
    {"impulse_Ns", "sum over its sub-impacts", &ZoneSummary::impulse},
    {"peak_force_N", "largest force", &ZoneSummary::peak_force}};

const Record<NearMiss> near_miss_record = {
    {"kind", "opening: a contact that nearly opened; closing: the reverse", &NearMiss::kind},
    {"time_s", "instant of the smallest margin", &NearMiss::time},
    {"margin_m", "distance between the indentation and the residual one", &NearMiss::margin}};

const Record<ToleranceOutcome> tolerance_record = {
    {"event_times_s", "error of event times that was asked for", &ToleranceOutcome::asked},
    {"reached_error_s", "largest error of a certain event time; null: not known", &ToleranceOutcome::reached},
    {"horizon_s", "up to which event times are certain and within that error", &ToleranceOutcome::horizon},
    {"reason", "why the horizon comes before the end", &ToleranceOutcome::reason},
    {"obstacle", "why no finer mesh was run", &ToleranceOutcome::obstacle},
    {"key_to_free", "key of the case that prevents it and could be freed", &ToleranceOutcome::key, Form::empty_is_null}};

const Record<ErrorEstimate::UncertainFlight> flight_record = {
    {"after_index", "number, from 1, of the sub-impact before it", &ErrorEstimate::UncertainFlight::after, Form::from_one},
    {"reason", "why it may hold another sub-impact", &ErrorEstimate::UncertainFlight::reason}};

const Record<ErrorEstimate::FinerMeshes> finer_meshes_record = {
    {"mesh", "that shows it", &ErrorEstimate::FinerMeshes::mesh},
    {"sub_impacts", "on that mesh", &ErrorEstimate::FinerMeshes::n_there},
    {"same_sub_impacts", "sub-impacts that it confirms", &ErrorEstimate::FinerMeshes::n_same},
    {"change_of_first_end_s", "what finer meshes change the end of the first sub-impact by", &ErrorEstimate::FinerMeshes::change_of_first_end},
    {"doubt", "why the mesh is too coarse", &ErrorEstimate::FinerMeshes::doubt}};

const Record<ErrorEstimate::Joined> joined_record = {
    {"opening_m", "contacts parted by less count as one", &ErrorEstimate::Joined::opening},
    {"sub_impacts", "that are left", &ErrorEstimate::Joined::n},
    {"certain", "those of them that would be certain", &ErrorEstimate::Joined::n_certain}};

const Record<ErrorEstimate> error_record = {
    {"refined_run", "the runs compared with", &ErrorEstimate::refined_run},
    {"max_time_error_s", "largest error of a certain time", &ErrorEstimate::largest_error},
    {"first_unresolved_index", "number, from 1, of the first sub-impact that is not certain", &ErrorEstimate::first_unresolved, Form::from_one},
    {"reason", "why it is uncertain", &ErrorEstimate::reason},
    {"uncertain_flights", "", &ErrorEstimate::uncertain_flights, flight_record},
    {"finer_meshes", "of a mesh that the case fixes: what finer ones would change", &ErrorEstimate::finer_meshes, finer_meshes_record},
    {"joined", "where many sub-impacts are not certain: with output.opening", &ErrorEstimate::joined, joined_record}};

const Record<ZoneTotals> zone_totals_record = {
    {"start_s", "", &ZoneTotals::start, total_record},
    {"end_s", "", &ZoneTotals::end, total_record},
    {"impulse_Ns", "", &ZoneTotals::impulse, total_record},
    {"sub_impacts", "", &ZoneTotals::sub_impacts, total_record}};

const Record<ClosestApproach> approach_record = {
    {"time_s", "when", &ClosestApproach::time},
    {"gap_m", "smallest gap", &ClosestApproach::gap},
    {"error_m", "error of the gap", &ClosestApproach::error}};

const Record<PlasticZone> plastic_zone_record = {
    {"from_m", "where a plastic hinge begins", &PlasticZone::from},
    {"to_m", "where it ends", &PlasticZone::to},
    {"rotation_rad", "its rotation", &PlasticZone::rotation}};

const Record<NextStep> next_step_record = {
    {"command", "as the shell takes it", &NextStep::command},
    {"gain", "what it shows, and how long it takes", &NextStep::gain}};

const Record<EnvelopeRow::Range> reaction_record = {
    {"least_N", "smallest force of the support on the beam, positive along the strike", [](const auto& r) -> auto& { return r.smallest.value; }},
    {"least_time_s", "when", [](const auto& r) -> auto& { return r.smallest.time; }},
    {"largest_N", "largest one", [](const auto& r) -> auto& { return r.largest.value; }},
    {"largest_time_s", "when", [](const auto& r) -> auto& { return r.largest.time; }}};

const Record<BeamAtRest> rest_record = {
    {"largest_permanent_set_m", "largest displacement of the beam at rest, against its supports; of a free one against the chord", &BeamAtRest::largest_set},
    {"position_m", "where that is", &BeamAtRest::position},
    {"plastic_zones", "", &BeamAtRest::plastic_zones, plastic_zone_record}};
// clang-format on

// The member of a result, or of what it holds, that a path of pointers leads to.
template <class... Members>
auto result(Members... path) {
  return [=](const auto& run) -> auto& { return (*run.result.*....*path); };
}

template <class Member>
auto used(Member member) {
  return result(&Result::used, member);
}

Json json_of_setting(const KeyValue& value) {
  if (const auto* real = std::get_if<double>(&value); real != nullptr && !std::isfinite(*real)) {
    return to_text(value);
  }
  return json_of(value);
}

Json case_json(const DescribedRun& run) {
  Json json;
  for (const CaseKey& key : case_keys()) {
    const std::optional<KeyValue> value = key.get(*run.input);
    place_in(json, key.name) = value ? json_of_setting(*value) : Json(nullptr);
  }
  return json;
}

Json case_units(const DescribedRun&) {
  Json json = Json::object();
  for (const CaseKey& key : case_keys()) {
    if (!key.unit.empty()) json[key.name] = key.unit;
  }
  return json;
}

Json libraries_json(const DescribedRun&) {
  Json json;
  for (const auto& [name, version] : library_versions()) json[name] = version;
  return json;
}

// "contact_stiffness_N_per_m1.5": the exponent follows the unit, if it is not 1.
Entry<DescribedRun> contact_stiffness_entry() {
  static constexpr const char* start = "contact_stiffness_N_per_m";
  Entry<DescribedRun> entry(
      "used.contact_stiffness_N_per_m^n",
      "stiffness of the contact; n: the exponent of the indentation, left out if 1");
  entry.write = [](Json& object, const DescribedRun& run) {
    const ResolvedSettings& used = run.result->used;
    const std::string power =
        used.contact_exponent == 1.0 ? "" : fmt::format("{:.6g}", used.contact_exponent);
    object["used"][start + power] = json_of(used.contact_stiffness, Form::plain);
  };
  return entry;
}

std::vector<ZoneSummary> zones_of(const DescribedRun& run) {
  return summarise_zones(run.result->sub_impacts);
}

int count_subzones(const DescribedRun& run) {
  int n_subzones = 0;
  for (const ZoneSummary& zone : zones_of(run)) n_subzones += zone.n_subzones;
  return n_subzones;
}

Json count_transitions(const DescribedRun& run) {
  Json json;
  using enum EventKind;
  for (const EventKind kind : {contact_begins, contact_yields, contact_unloads, contact_ends,
                               section_reverses, support_touches, support_lifts}) {
    json[std::string(to_string(kind))] =
        std::ranges::count(run.result->transitions, kind, &Transition::kind);
  }
  return json;
}

std::optional<bool> tolerance_met(const DescribedRun& run) {
  const std::optional<ToleranceOutcome>& tolerance = run.result->tolerance;
  return tolerance ? std::optional(tolerance->met) : std::nullopt;
}

// Names lead to objects of a value and an error; without error bars there are none.
Json totals_json(const DescribedRun& run) {
  if (!run.result->error_estimate) return nullptr;
  Json json;
  for (const auto& [name, total] : run.result->error_estimate->totals) {
    json[to_string(name)] = json_of(total_record, total);
  }
  json["by_zone"] = json_of(zone_totals_record, run.result->error_estimate->zones);
  return json;
}

std::optional<BeamAtRest> beam_at_rest(const DescribedRun& run) {
  const Result& result = *run.result;
  if (result.envelope.empty() || result.outcome.first_failure) return std::nullopt;
  const EnvelopeRow& largest = *std::ranges::max_element(
      result.envelope, {}, [](const EnvelopeRow& row) { return std::abs(row.set_from_supports); });
  return BeamAtRest{largest.set_from_supports, largest.position, result.plastic_zones};
}

// clang-format off
Record<DescribedRun> make_run_record() {
  using Used = ResolvedSettings;
  const auto outcome = [](auto member) { return result(&Result::outcome, member); };
  const auto energy = [](auto member) { return result(&Result::final_energies, member); };
  using Velocities = Result::Velocities;
  const auto work = [](auto member) { return result(&Result::work, member); };
  return {
      {"layout", "version of the layout of this file", [](const DescribedRun&) { return summary_layout; }},
      {"program.name", "", [](const DescribedRun&) { return std::string("subimpact"); }},
      {"program.version", "version of the program", [](const DescribedRun&) { return project_version(); }},
      {"libraries", "their versions", &libraries_json},
      {"case", "keys of the case as asked for", &case_json},
      {"case_units", "units of the keys", &case_units},

      {"used.method", "settings used, where the case left a choice open or it was derived", [](const DescribedRun& run) { return run.input->solver.method; }},
      {"used.table", "coefficients, of Runge-Kutta methods", used(&Used::table)},
      {"used.half_model", "whether symmetry was used", used(&Used::half_model)},
      {"used.mesh", "the mesh in words", used(&Used::mesh)},
      {"used.contact_law", "its name", used(&Used::contact_law)},
      {"used.section", "name of the bending law; elastic where the beam never yields", used(&Used::section)},
      {"used.n_unknowns", "unknowns of the beam", used(&Used::n_unknowns)},
      {"used.n_sections", "sections modelled", used(&Used::n_sections)},
      {"used.highest_frequency_rad_per_s", "upper bound, of the beam", used(&Used::highest_frequency)},
      {"used.largest_contact_slope_N_per_m", "that the energy of the strike allows", used(&Used::largest_contact_slope)},
      {"used.joined_frequency_rad_per_s", "of beam and striker joined by a spring of that slope", used(&Used::joined_frequency)},
      {"used.contact_time_s", "scale of the shortest contacts", used(&Used::contact_time)},
      {"used.critical_step_s", "of central differences", used(&Used::critical_step)},
      {"used.step_s", "of methods with fixed steps", used(&Used::step)},
      {"used.position_tolerance_m", "of adaptive methods", used(&Used::position_tolerance), Form::zero_is_null},
      {"used.velocity_tolerance_m_per_s", "of adaptive methods", used(&Used::velocity_tolerance), Form::zero_is_null},
      {"used.events", "how events are found", used(&Used::events)},
      {"used.reversals", "how reversals of sections are found", used(&Used::reversals)},
      {"used.max_order", "of multistep methods", used(&Used::max_order)},
      contact_stiffness_entry(),
      {"used.yield_indentation_m", "at which a contact without history first yields", used(&Used::yield_indentation)},
      {"used.yield_curvature_per_m", "at which a section first yields", used(&Used::yield_curvature)},
      {"used.first_period_s", "first period of the beam in bending", used(&Used::first_period)},
      {"used.initial_energy_J", "energy of the striker before the strike", used(&Used::initial_energy)},
      {"used.energy_tolerance_relative", "error of the energy that is allowed", used(&Used::energy_tolerance)},
      {"used.shape_interval_s", "time between shapes; 0: none", used(&Used::shape_interval)},
      {"used.n_shape_points", "points of a shape", used(&Used::n_shape_points)},

      {"outcome.kind", "completed, stopped, inaccurate, unstable, chattering, solver-failed or left-validity", outcome(&Outcome::kind)},
      {"outcome.time_s", "time reached", outcome(&Outcome::time)},
      {"outcome.message", "cause and what to do, of a run that did not complete", outcome(&Outcome::message)},
      {"outcome.first_failure_s", "last time at which every check passed, first at which one failed", outcome(&Outcome::first_failure)},
      {"wish_met", "whether accuracy.event_times was met; null: none was asked for", &tolerance_met},
      {"wish", "outcome of accuracy.event_times", result(&Result::tolerance), tolerance_record},
      {"choice", "why mesh and method are what they are", result(&Result::choice)},
      {"model_choice", "why theory and contact law are what they are, if they were chosen", [](const auto& run) -> auto& { return run.input->model_choice; }},
      {"body_errors", "errors of the body; null: not estimated", result(&Result::body_errors), body_record()},
      {"verdict", "first words on the run", [](const DescribedRun& run) { return std::optional(run.result->verdict); }, verdict_record()},
      {"answers", "main numbers of the run, each with both of its errors, in the order of the screen", [](const DescribedRun& run) { return run.result->answers; }, answer_record()},
      {"warnings", "warnings about results that passed all checks", result(&Result::warnings)},
      {"next", "what can be done from here", result(&Result::next_steps), next_step_record},
      {"counts.sub_impacts", "number of sub-impacts", [](const DescribedRun& run) { return run.result->sub_impacts.size(); }},
      {"counts.parted_by_1_um", "sub-impacts after which striker and beam part by as much or more", [](const DescribedRun& run) { return n_parted_by(1e-6, run.result->sub_impacts); }},
      {"counts.parted_by_10_um", "the same for 10 um", [](const DescribedRun& run) { return n_parted_by(1e-5, run.result->sub_impacts); }},
      {"counts.zones", "number of zones", [](const DescribedRun& run) { return zones_of(run).size(); }},
      {"counts.subzones", "number of sub-zones", &count_subzones},
      {"counts.transitions", "number of events of each kind", &count_transitions},
      {"counts.yielded_sections", "of the sections modelled", result(&Result::n_yielded_sections)},
      {"counts.history_rows", "rows of history.csv", result(&Result::n_history_rows)},
      {"counts.shape_rows", "rows of shapes.csv", result(&Result::n_shape_rows)},
      {"zones", "", &zones_of, zone_record},
      {"near_misses", "", result(&Result::near_misses), near_miss_record},
      {"first_yield.section_s", "when a section first yields; null: never", result(&Result::first_section_yield)},
      {"first_yield.contact_s", "when the contact first yields; null: never", result(&Result::first_contact_yield)},
      {"no_more_contact_s", "from when it is proven that no contact follows", result(&Result::no_more_contact)},
      {"contact_over", "yes: proven that no contact follows, for this run and those beside it", [](const DescribedRun& run) { return std::string(run.result->contact_over ? "yes" : "may not be"); }},
      {"closest_approach", "after the last sub-impact; null: the gap does nothing but grow", result(&Result::closest_approach), approach_record},
      {"maxima.force_N", "largest contact force", result(&Result::max_force)},
      {"maxima.indentation_m", "largest indentation", result(&Result::max_indentation)},
      {"final.striker_velocity_m_per_s", "velocity of the striker at the end", result(&Result::striker_velocity)},
      {"final.beam_mean_velocity_m_per_s", "momentum of the beam at the end over its mass", result(&Result::beam_mean_velocity)},
      {"first_touch.time_s", "when striker and beam first met; these three are 0 if they never did", result(&Result::first_touch, &Velocities::time)},
      {"first_touch.striker_velocity_m_per_s", "velocity of the striker then", result(&Result::first_touch, &Velocities::striker)},
      {"first_touch.beam_velocity_m_per_s", "velocity then, at the struck point, of the rigid body with momentum and moment of momentum of the beam", result(&Result::first_touch, &Velocities::beam)},
      {"parting.time_s", "the last separation; without one the end", result(&Result::parting, &Velocities::time)},
      {"parting.striker_velocity_m_per_s", "velocity of the striker then", result(&Result::parting, &Velocities::striker)},
      {"parting.beam_velocity_m_per_s", "velocity then of that rigid body", result(&Result::parting, &Velocities::beam)},
      {"restitution", "difference of these velocities at parting over that at the first touch; none before they part, and while they approach again", result(&Result::restitution)},
      {"rests_since_s", "start of a contact in which loads hold striker and beam together to the end and beyond", result(&Result::rests_since)},
      {"final_energies.striker_J", "at the end; these seven less work_J add up to used.initial_energy_J", energy(&Energies::striker)},
      {"final_energies.beam_kinetic_J", "of the beam's motion", energy(&Energies::beam_kinetic)},
      {"final_energies.bending_elastic_J", "stored in bending", energy(&Energies::bending_elastic)},
      {"final_energies.bending_plastic_J", "dissipated by bending", energy(&Energies::bending_plastic)},
      {"final_energies.contact_elastic_J", "stored in the contact", energy(&Energies::contact_elastic)},
      {"final_energies.contact_plastic_J", "dissipated by the contact, with its damping", energy(&Energies::contact_plastic)},
      {"final_energies.beam_damping_J", "dissipated by the damping of the beam", energy(&Energies::beam_damping)},
      {"final_energies.work_J", "work of gravity and loads since the start", energy(&Energies::work)},
      {"dissipated_by_damping.contact_J", "energy dissipated by the damping of the contact", result(&Result::contact_damping_loss)},
      {"dissipated_by_damping.beam_J", "energy dissipated by the damping of the beam", result(&Result::beam_damping_loss)},
      {"reactions.first", "of the support at x = 0; null: free end, or no rows", [](const auto& run) -> auto& { return run.result->reactions[0]; }, reaction_record},
      {"reactions.last", "of the support at x = length", [](const auto& run) -> auto& { return run.result->reactions[1]; }, reaction_record},
      {"rest", "the beam after the run", &beam_at_rest, rest_record},
      {"conservation.max_energy_error_relative", "largest error of the energy", result(&Result::max_energy_error)},
      {"conservation.max_momentum_error_relative", "largest error of the momentum; null where supports take momentum up", result(&Result::max_momentum_error)},
      {"conservation.max_impulse_error_relative", "largest difference between an impulse and the integral of its force, over m v0", result(&Result::max_impulse_error)},
      {"error_bars", "errors of event times; null: not estimated", result(&Result::error_estimate), error_record},
      {"totals", "numbers of the run as a whole, each with its value and its error, which covers 95 of 100; null: not known, as of the largest strain where a hinge forms, in which strains grow without limit on finer meshes. by_zone: for each zone start_s, end_s, impulse_Ns, sub_impacts", &totals_json},
      {"work.steps", "steps of the method", work(&Work::steps)},
      {"work.rejected_steps", "steps repeated with another length", work(&Work::rejected_steps)},
      {"work.partial_steps", "steps made to compute states within a step", work(&Work::partial_steps)},
      {"work.right_hand_sides", "evaluations of the equations", work(&Work::right_hand_sides)},
      {"work.mass_solves", "solutions with the mass matrix", work(&Work::mass_solves)},
      {"work.jacobians", "evaluations of the Jacobian", work(&Work::jacobians)},
      {"work.factorisations", "of matrices", work(&Work::factorisations)},
      {"work.roots", "events located", work(&Work::roots)},
      {"work.section_flows", "sections that flowed, summed over steps", work(&Work::section_flows)},
      {"work.nonlinear_iterations", "of implicit methods", work(&Work::nonlinear_iterations)},
      {"work.nonlinear_failures", "of implicit methods", work(&Work::nonlinear_failures)},
      {"work.setup_s", "time spent before the first step", work(&Work::setup_seconds)},
      {"work.wall_s", "time spent in all", work(&Work::wall_seconds)},
      {"work.all_s", "the same with the runs beside it and before it", work(&Work::all_seconds)}};
}
// clang-format on

}  // namespace

const Record<DescribedRun>& run_record() {
  static const Record<DescribedRun> record = make_run_record();
  return record;
}

std::string summary_json(const Case& input, const Result& result) {
  // A title may hold bytes that are no UTF-8; they are replaced rather than the file lost.
  const Json json = json_of(run_record(), DescribedRun{&input, &result});
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string project_version() { return SUBIMPACT_VERSION; }

std::vector<std::pair<std::string, std::string>> library_versions() {
  return {
      {"SUNDIALS", sundials_version()},
      {"KLU", klu_version()},
      {"Eigen",
       fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"fmt",
       fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"nlohmann-json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR,
                                    NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
      {"toml++", fmt::format("{}.{}.{}", TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH)},
  };
}

}  // namespace subimpact
