#include "io/check_results.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "case/problem.h"

namespace subimpact {
namespace {

template <class Row>
using Numbers = std::vector<std::pair<const char*, double Row::*>>;

const Numbers<SubImpact> numbers_of_sub_impacts = {
    {"peak_force_N", &SubImpact::peak_force},
    {"impulse_Ns", &SubImpact::impulse},
    {"max_indentation_m", &SubImpact::max_indentation},
    {"residual_indentation_m", &SubImpact::residual_indentation},
    {"striker_velocity_m_per_s", &SubImpact::striker_velocity}};

const std::vector<std::pair<const char*, std::optional<double> SubImpact::*>>
    errors_of_sub_impacts = {{"start_error_s", &SubImpact::start_error},
                             {"end_error_s", &SubImpact::end_error},
                             {"error_time_s", &SubImpact::error_time},
                             {"error_mesh_s", &SubImpact::error_mesh},
                             {"error_layers_s", &SubImpact::error_layers},
                             {"start_mesh_limit_s", &SubImpact::start_mesh_limit},
                             {"end_mesh_limit_s", &SubImpact::end_mesh_limit},
                             {"mesh_limit_error_s", &SubImpact::mesh_limit_error},
                             {"start_scatter_s", &SubImpact::start_scatter},
                             {"end_scatter_s", &SubImpact::end_scatter}};

const Numbers<HistoryRow> numbers_of_history = {{"force_N", &HistoryRow::force},
                                                {"indentation_m", &HistoryRow::indentation},
                                                {"w_c_m", &HistoryRow::struck_displacement},
                                                {"w_m_m", &HistoryRow::striker_displacement},
                                                {"f_c_m", &HistoryRow::struck_deflection},
                                                {"u_mf_m", &HistoryRow::striker_relative},
                                                {"v_c_m_per_s", &HistoryRow::struck_velocity},
                                                {"v_m_m_per_s", &HistoryRow::striker_velocity},
                                                {"stress_back_Pa", &HistoryRow::back_stress},
                                                {"U_m_J", &HistoryRow::striker_energy},
                                                {"U_k_J", &HistoryRow::beam_kinetic_energy},
                                                {"U_e_J", &HistoryRow::bending_elastic},
                                                {"U_p_J", &HistoryRow::bending_plastic},
                                                {"U_c_J", &HistoryRow::contact_elastic},
                                                {"D_c_J", &HistoryRow::contact_plastic},
                                                {"D_b_J", &HistoryRow::beam_damping},
                                                {"energy_error", &HistoryRow::energy_error}};

const Numbers<SectionRow> numbers_of_sections = {
    {"position_m", &SectionRow::position},
    {"curvature_per_m", &SectionRow::curvature},
    {"moment_Nm", &SectionRow::moment},
    {"plastic_curvature_per_m", &SectionRow::plastic_curvature}};

const Numbers<PointRow> numbers_of_points = {{"position_m", &PointRow::position},
                                             {"displacement_m", &PointRow::displacement},
                                             {"velocity_m_per_s", &PointRow::velocity}};

const Numbers<ShapeRow> numbers_of_shapes = {
    {"position_m", &ShapeRow::position},
    {"displacement_m", &ShapeRow::displacement},
    {"velocity_m_per_s", &ShapeRow::velocity},
    {"rotation_rad", &ShapeRow::rotation},
    {"curvature_per_m", &ShapeRow::curvature},
    {"moment_Nm", &ShapeRow::moment},
    {"plastic_curvature_per_m", &ShapeRow::plastic_curvature}};

}  // namespace

void RowChecks::refuse(const char* column, double value, const char* allowed) const {
  throw ResultsError(fmt::format("{}:{}: {} is {:.17g}; allowed: {}; run the case again", file_,
                                 line_, column, value, allowed));
}

void RowChecks::check_finite(const char* column, double value) const {
  if (!std::isfinite(value)) refuse(column, value, "a finite number");
}

void RowChecks::check_time(const char* column, double time) {
  ++line_;
  if (!std::isfinite(time) || time < 0.0) refuse(column, time, "a finite number, 0 or above");
  if (time < last_time_)
    refuse(column, time,
           "the time of the row above, or later (older versions of this program wrote other rows "
           "with central-difference)");
  last_time_ = time;
}

void RowChecks::check(const SubImpact& row) {
  check_time("start_s", row.start);
  if (row.end && !(std::isfinite(*row.end) && *row.end >= row.start)) {
    refuse("end_s", *row.end, "start_s or later, or an empty cell");
  }
  for (const auto& [column, member] : numbers_of_sub_impacts) check_finite(column, row.*member);
  for (const auto& [column, member] : errors_of_sub_impacts) {
    if (row.*member) check_finite(column, *(row.*member));
  }
  if (row.zone != last_zone_ && row.zone != last_zone_ + 1) {
    refuse("zone", row.zone, "the zone of the row above or the next one, from 1");
  }
  if (row.zone != last_zone_) last_subzone_ = 0;
  if (row.zone < 1) refuse("zone", row.zone, "1 or above");
  if (row.subzone < 1 || (row.subzone != last_subzone_ && row.subzone != last_subzone_ + 1)) {
    refuse("subzone", row.subzone, "the sub-zone of the row above or the next one, from 1");
  }
  last_zone_ = row.zone;
  last_subzone_ = row.subzone;
}

void RowChecks::check(const Transition& row) {
  check_time("time_s", row.time);
  check_finite("value", row.value);
}

void RowChecks::check(const HistoryRow& row) {
  check_time("time_s", row.time);
  for (const auto& [column, member] : numbers_of_history) check_finite(column, row.*member);
  if (row.momentum_error) check_finite("momentum_error", *row.momentum_error);
  if (row.first_reaction) check_finite("R_0_N", *row.first_reaction);
  if (row.last_reaction) check_finite("R_l_N", *row.last_reaction);
}

void RowChecks::check(const SectionRow& row) {
  check_time("time_s", row.time);
  for (const auto& [column, member] : numbers_of_sections) check_finite(column, row.*member);
}

void RowChecks::check(const PointRow& row) {
  check_time("time_s", row.time);
  for (const auto& [column, member] : numbers_of_points) check_finite(column, row.*member);
}

void RowChecks::check(const ShapeRow& row) {
  check_time("time_s", row.time);
  for (const auto& [column, member] : numbers_of_shapes) check_finite(column, row.*member);
}

void RowChecks::check(const EnvelopeRow& row) {
  ++line_;
  check_finite("position_m", row.position);
  check_finite("permanent_set_m", row.permanent_set);
  for (const EnvelopeRow::Range& range :
       {row.displacement, row.moment, row.strain, row.plastic_curvature}) {
    for (const EnvelopeRow::Extreme& end : {range.smallest, range.largest}) {
      check_finite("an extreme", end.value);
      check_finite("the time of an extreme", end.time);
    }
  }
}

void check_summary(const std::string& file, const FinishedRun& run) {
  const auto require = [&](bool allowed, const char* field, double value, const char* words) {
    if (allowed) return;
    throw ResultsError(fmt::format("{}: {} is {:.17g}; allowed: {}; run the case again", file,
                                   field, value, words));
  };
  const auto require_finite = [&](const char* field, double value) {
    require(std::isfinite(value), field, value, "a finite number");
  };
  const Result& result = run.result;
  const double end = result.outcome.time;
  require(std::isfinite(end) && end >= 0.0, "outcome.time_s", end, "a finite number, 0 or above");
  if (const auto& failure = result.outcome.first_failure) {
    require_finite("outcome.first_failure_s", failure->from);
    require_finite("outcome.first_failure_s", failure->to);
  }
  if (result.wish) {
    require_finite("wish.event_times_s", result.wish->wished);
    require_finite("wish.horizon_s", result.wish->horizon);
  }
  if (result.predictability) {
    require_finite("predictability.horizon_s", result.predictability->horizon);
    require_finite("predictability.max_time_scatter_s", result.predictability->largest_scatter);
  }
  for (const NearMiss& here : result.near_misses) {
    require(std::isfinite(here.time) && here.time >= 0.0, "near_misses.time_s", here.time,
            "a finite number, 0 or above");
    require(std::isfinite(here.margin) && here.margin > 0.0, "near_misses.margin_m", here.margin,
            "a finite number above 0");
  }
  require_finite("maxima.force_N", result.max_force);
  require_finite("maxima.indentation_m", result.max_indentation);
  require_finite("final.striker_velocity_m_per_s", result.striker_velocity);
  require_finite("final.beam_mean_velocity_m_per_s", result.beam_mean_velocity);
  try {
    contact_law_of(run.input);  // of which figures draw branches
  } catch (const std::invalid_argument& error) {
    throw ResultsError(
        fmt::format("{}: the case in this file is not valid: {}", file, error.what()));
  }
  require_finite("used.first_period_s", result.used.first_period);
  require_finite("used.initial_energy_J", result.used.initial_energy);
}

}  // namespace subimpact
