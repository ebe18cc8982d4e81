#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "case/case_choices.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/results.h"
#include "subimpact/io/versions.h"

namespace subimpact {
namespace {

using Json = nlohmann::ordered_json;  // readers see the sections in the order written here

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json setting(const KeyValue& value) {
  if (const auto* real = std::get_if<double>(&value); real != nullptr && !std::isfinite(*real)) {
    return to_text(value);
  }
  return std::visit([](const auto& x) { return Json(x); }, value);
}

// One object a table of the case file; a key left open is null.
Json case_as_asked(const Case& input) {
  Json json;
  for (const CaseKey& key : case_keys()) {
    const std::optional<KeyValue> value = key.get(input);
    Json& place = key.table().empty() ? json[key.leaf()] : json[key.table()][key.leaf()];
    place = value ? setting(*value) : Json(nullptr);
  }
  return json;
}

Json case_units() {
  Json json = Json::object();
  for (const CaseKey& key : case_keys()) {
    if (!key.unit.empty()) json[key.name] = key.unit;
  }
  return json;
}

Json versions() {
  Json json;
  for (const auto& [name, version] : library_versions()) json[name] = version;
  return json;
}

// With its unit: N/m^n for the exponent n.
std::string contact_stiffness_name(const ResolvedSettings& used) {
  const std::string power =
      used.contact_exponent == 1.0 ? "" : fmt::format("{:.6g}", used.contact_exponent);
  return "contact_stiffness_N_per_m" + power;
}

Json what_was_used(const Case& input, const ResolvedSettings& used) {
  const bool adaptive = !used.step;
  return {
      {"method", to_string(input.solver.method)},
      {"table", used.table ? Json(*used.table) : Json(nullptr)},
      {"half_model", used.half_model},
      {"mesh", used.mesh},
      {"contact_law", used.contact_law},
      {"section", used.section},
      {"n_unknowns", used.n_unknowns},
      {"n_sections", used.n_sections},
      {"highest_frequency_rad_per_s", number(used.highest_frequency)},
      {"largest_contact_slope_N_per_m", number(used.largest_contact_slope)},
      {"joined_frequency_rad_per_s", number(used.joined_frequency)},
      {"contact_time_s", number(used.contact_time)},
      {"critical_step_s", number(used.critical_step)},
      {"step_s", number(used.step)},
      {"position_tolerance_m", adaptive ? number(used.position_tolerance) : Json(nullptr)},
      {"velocity_tolerance_m_per_s", adaptive ? number(used.velocity_tolerance) : Json(nullptr)},
      {"events", to_string(used.events)},
      {"reversals", name_of(used.reversals)},
      {"max_order", used.max_order ? Json(*used.max_order) : Json(nullptr)},
      {contact_stiffness_name(used), number(used.contact_stiffness)},
      {"yield_indentation_m", number(used.yield_indentation)},
      {"yield_curvature_per_m", number(used.yield_curvature)},
      {"first_period_s", number(used.first_period)},
      {"initial_energy_J", number(used.initial_energy)},
      {"energy_tolerance_relative", number(used.energy_tolerance)},
      {"shape_interval_s", number(used.shape_interval)},
      {"n_shape_points", used.n_shape_points},
  };
}

Json counts(const Result& result, const std::vector<ZoneSummary>& zones) {
  int n_subzones = 0;
  for (const ZoneSummary& zone : zones) n_subzones += zone.n_subzones;
  Json by_kind;
  for (const EventKind kind :
       {EventKind::contact_begins, EventKind::contact_yields, EventKind::contact_unloads,
        EventKind::contact_ends, EventKind::section_reverses}) {
    by_kind[std::string(to_string(kind))] =
        std::count_if(result.transitions.begin(), result.transitions.end(),
                      [&](const Transition& event) { return event.kind == kind; });
  }
  return {
      {"sub_impacts", result.sub_impacts.size()},
      {"zones", zones.size()},
      {"subzones", n_subzones},
      {"transitions", by_kind},
      {"yielded_sections", result.n_yielded_sections},
      {"history_rows", result.n_history_rows},
      {"shape_rows", result.n_shape_rows},
  };
}

Json zone_list(const std::vector<ZoneSummary>& zones) {
  Json json = Json::array();
  for (const ZoneSummary& zone : zones) {
    json.push_back({{"zone", zone.zone},
                    {"sub_impacts", zone.n_sub_impacts},
                    {"subzones", zone.n_subzones},
                    {"start_s", number(zone.start)},
                    {"end_s", number(zone.end)},
                    {"impulse_Ns", number(zone.impulse)},
                    {"peak_force_N", number(zone.peak_force)}});
  }
  return json;
}

Json near_miss_list(const std::vector<NearMiss>& near_misses) {
  Json json = Json::array();
  for (const NearMiss& here : near_misses) {
    json.push_back({{"kind", to_string(here.kind)},
                    {"time_s", number(here.time)},
                    {"margin_m", number(here.margin)}});
  }
  return json;
}

// The largest permanent set, and the plastic hinges; null without shapes, or if a check failed.
Json rest_of_bending(const Result& result) {
  if (result.envelope.empty() || result.outcome.first_failure) return nullptr;
  const auto largest =
      std::max_element(result.envelope.begin(), result.envelope.end(),
                       [](const EnvelopeRow& a, const EnvelopeRow& b) {
                         return std::abs(a.permanent_set) < std::abs(b.permanent_set);
                       });
  Json zones = Json::array();
  for (const PlasticZone& zone : result.plastic_zones) {
    zones.push_back({{"from_m", number(zone.from)},
                     {"to_m", number(zone.to)},
                     {"rotation_rad", number(zone.rotation)}});
  }
  return {{"largest_permanent_set_m", number(largest->permanent_set)},
          {"position_m", number(largest->position)},
          {"plastic_zones", zones}};
}

Json work_counts(const Work& work) {
  return {
      {"steps", work.steps},
      {"rejected_steps", work.rejected_steps},
      {"partial_steps", work.partial_steps},
      {"right_hand_sides", work.right_hand_sides},
      {"mass_solves", work.mass_solves},
      {"jacobians", work.jacobians},
      {"factorisations", work.factorisations},
      {"roots", work.roots},
      {"nonlinear_iterations", work.nonlinear_iterations},
      {"nonlinear_failures", work.nonlinear_failures},
      {"setup_s", number(work.setup_seconds)},
      {"wall_s", number(work.wall_seconds)},
  };
}

Json interval(const std::optional<Interval>& times) {
  if (!times) return nullptr;
  return {number(times->from), number(times->to)};
}

Json text_or_null(const std::string& words) { return words.empty() ? Json(nullptr) : Json(words); }

Json wish_or_null(const std::optional<WishOutcome>& wish) {
  if (!wish) return nullptr;
  return {
      {"event_times_s", number(wish->wished)},  {"reached_error_s", number(wish->reached)},
      {"horizon_s", number(wish->horizon)},     {"reason", text_or_null(wish->reason)},
      {"key_to_free", text_or_null(wish->key)},
  };
}

Json unresolved(const std::optional<std::size_t>& index) {
  return index ? Json(*index + 1) : Json(nullptr);
}

Json error_estimate_in_times(const std::optional<ErrorEstimate>& estimate) {
  if (!estimate) return nullptr;
  Json parts = Json::array();
  for (const ErrorEstimate::Part& part : estimate->parts) {
    parts.push_back({{"name", part.name},
                     {"refined_run", part.refined_run},
                     {"max_error_s", number(part.largest_error)},
                     {"first_unresolved_index", unresolved(part.first_unresolved)},
                     {"reason", text_or_null(part.reason)}});
  }
  return {
      {"refined_run", estimate->refined_run},
      {"max_time_error_s", number(estimate->largest_error)},
      {"first_unresolved_index", unresolved(estimate->first_unresolved)},
      {"reason", text_or_null(estimate->reason)},
      {"parts", parts},
  };
}

Json shear_or_null(const std::optional<NeglectedShear>& shear) {
  if (!shear) return nullptr;
  return {{"first_contact_end_without_s", number(shear->without)},
          {"first_contact_end_with_s", number(shear->with)}};
}

Json predictability_or_null(const std::optional<Predictability>& predictability) {
  if (!predictability) return nullptr;
  Json zones = Json::array();
  for (const Predictability::Zone& zone : predictability->zones) {
    zones.push_back({{"start_scatter_s", number(zone.start_scatter)},
                     {"end_scatter_s", number(zone.end_scatter)},
                     {"impulse_scatter_Ns", number(zone.impulse_scatter)}});
  }
  return {
      {"horizon_s", number(predictability->horizon)},
      {"first_unpredictable_index", unresolved(predictability->first_unpredictable)},
      {"reason", text_or_null(predictability->reason)},
      {"max_time_scatter_s", number(predictability->largest_scatter)},
      {"zones", zones},
      {"striker_velocity_scatter_m_per_s", number(predictability->striker_velocity_scatter)},
  };
}

}  // namespace

std::vector<ZoneSummary> summarise_zones(const std::vector<SubImpact>& sub_impacts) {
  std::vector<ZoneSummary> zones;
  for (const SubImpact& s : sub_impacts) {
    if (zones.empty() || zones.back().zone != s.zone) {
      zones.push_back({});
      zones.back().zone = s.zone;
      zones.back().start = s.start;
    }
    ZoneSummary& zone = zones.back();
    ++zone.n_sub_impacts;
    zone.n_subzones = std::max(zone.n_subzones, s.subzone);
    zone.end = s.end;
    zone.impulse += s.impulse;
    zone.peak_force = std::max(zone.peak_force, s.peak_force);
  }
  return zones;
}

std::string summary_json(const Case& input, const Result& result) {
  const std::vector<ZoneSummary> zones = summarise_zones(result.sub_impacts);
  const Json json = {
      {"layout", summary_layout},
      {"program", {{"name", "subimpact"}, {"version", project_version()}}},
      {"libraries", versions()},
      {"case", case_as_asked(input)},
      {"case_units", case_units()},
      {"used", what_was_used(input, result.used)},
      {"outcome",
       {{"kind", to_string(result.outcome.kind)},
        {"time_s", number(result.outcome.time)},
        {"message", result.outcome.message},
        {"first_failure_s", interval(result.outcome.first_failure)}}},
      {"wish_met", result.wish ? Json(result.wish->met) : Json(nullptr)},
      {"wish", wish_or_null(result.wish)},
      {"choice", result.choice},
      {"neglected_shear", shear_or_null(result.neglected_shear)},
      {"warnings", result.warnings},
      {"counts", counts(result, zones)},
      {"zones", zone_list(zones)},
      {"near_misses", near_miss_list(result.near_misses)},
      {"first_yield",
       {{"section_s", number(result.first_section_yield)},
        {"contact_s", number(result.first_contact_yield)}}},
      {"no_more_contact_s", number(result.no_more_contact)},
      {"maxima",
       {{"force_N", number(result.max_force)}, {"indentation_m", number(result.max_indentation)}}},
      {"final",
       {{"striker_velocity_m_per_s", number(result.striker_velocity)},
        {"beam_mean_velocity_m_per_s", number(result.beam_mean_velocity)}}},
      {"dissipated_by_damping",
       {{"contact_J", number(result.contact_damping_loss)},
        {"beam_J", number(result.beam_damping_loss)}}},
      {"rest", rest_of_bending(result)},
      {"conservation",
       {{"max_energy_error_relative", number(result.max_energy_error)},
        {"max_momentum_error_relative", number(result.max_momentum_error)},
        {"max_impulse_error_relative", number(result.max_impulse_error)}}},
      {"error_bars", error_estimate_in_times(result.error_estimate)},
      {"predictability", predictability_or_null(result.predictability)},
      {"work", work_counts(result.work)},
  };
  // A title may hold bytes that are no UTF-8; they are replaced rather than the file lost.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace subimpact
