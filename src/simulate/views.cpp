#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "simulate/loop/observed_step.h"
#include "subimpact/simulate/observer.h"
#include "subimpact/simulate/result.h"
#include "system/readings/accounts.h"

namespace subimpact {

double StepView::start() const { return step_.t0(); }
double StepView::end() const { return step_.t1(); }
RunView StepView::at(double time) const {
  SectionCorrection correction;
  if (time <= start()) return {start(), step_.y0(), beam_};
  if (time >= end()) return {end(), step_.y1(), beam_};
  step_.corrected_state_at(time, state_, correction);
  return {time, state_, beam_};
}

PointMotion RunView::striker() const {
  return {Accounts(beam_).displacements(state_).striker, state_.back()};
}

PointMotion RunView::struck_point() const {
  return {Accounts(beam_).displacements(state_).struck,
          state_.back() - beam_.indentation_rate(state_)};
}

bool RunView::in_contact() const { return beam_.contact().is_closed(); }
double RunView::indentation() const { return beam_.indentation(state_); }
double RunView::residual_indentation() const { return beam_.contact().residual_indentation(); }
double RunView::contact_force() const { return beam_.contact_force(state_); }
double RunView::curvature(double x) const {
  const BeamMesh& mesh = beam_.mesh();
  return mesh.curvature(mesh.nearest_section(x), beam_.beam_positions(state_));
}
std::optional<double> RunView::displacement(double x) const {
  const std::optional<SparseFunctional> here = beam_.mesh().displacement_at(x);
  return here ? std::optional((*here)(beam_.beam_positions(state_))) : std::nullopt;
}
Energies RunView::energies() const { return Accounts(beam_).energies(state_); }

double Result::impulse() const {
  return std::accumulate(sub_impacts.begin(), sub_impacts.end(), 0.0,
                         [](double sum, const SubImpact& s) { return sum + s.impulse; });
}

std::optional<std::size_t> Result::n_certain() const {
  if (!error_estimate) return std::nullopt;
  return std::ranges::count(sub_impacts, std::optional(true), &SubImpact::certain);
}

std::string Result::brief_report() const {
  return fmt::format("{} at {:.6g} s: {} sub-impacts, energy error {:.1e}, {} steps, {:.3g} s",
                     to_string(outcome.kind), outcome.time, sub_impacts.size(), max_energy_error,
                     work.steps, work.wall_seconds);
}

std::string_view to_string(OutcomeKind kind) {
  static constexpr std::string_view names[] = {"completed",    "stopped",    "inaccurate",
                                               "unstable",     "chattering", "solver-failed",
                                               "left-validity"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view to_string(RunTotal name) {
  // clang-format off
  static constexpr std::string_view names[] = {
      "sub_impacts", "zones", "striker_velocity_m_per_s", "beam_mean_velocity_m_per_s",
      "restitution", "impulse_Ns", "peak_force_N", "max_indentation_m", "residual_indentation_m",
      "max_displacement_m", "max_moment_Nm", "max_strain", "reaction_along_N", "reaction_against_N",
      "permanent_set_m", "hinge_rotation_rad", "striker_energy_share", "dissipated_J"};
  // clang-format on
  return names[static_cast<std::size_t>(name)];
}

std::string_view to_string(NearMissKind kind) {
  return kind == NearMissKind::opening ? "opening" : "closing";
}

void assign_zones(std::vector<SubImpact>& sub_impacts, double zone_gap, double subzone_gap) {
  int zone = 0;
  int subzone = 0;
  const SubImpact* previous = nullptr;
  for (SubImpact& here : sub_impacts) {
    const double gap = previous && previous->end ? here.start - *previous->end : 0.0;
    if (!previous || gap >= zone_gap) {
      ++zone;
      subzone = 1;
    } else if (gap >= subzone_gap) {
      ++subzone;
    }
    here.zone = zone;
    here.subzone = subzone;
    previous = &here;
  }
}

void join_sub_impacts(std::vector<SubImpact>& sub_impacts, double opening) {
  std::size_t n = 0;  // of those kept so far
  for (SubImpact& here : sub_impacts) {
    SubImpact* last = n > 0 ? &sub_impacts[n - 1] : nullptr;
    if (last == nullptr || !(last->opening.value_or(HUGE_VAL) < opening)) {
      if (&sub_impacts[n] != &here) sub_impacts[n] = std::move(here);
      ++n;
      continue;
    }
    SubImpact joined = here;  // with its end, and what is left then
    joined.start = last->start;
    joined.start_rate = last->start_rate;
    joined.impulse += last->impulse;
    joined.force_integral += last->force_integral;
    joined.max_indentation = std::max(joined.max_indentation, last->max_indentation);
    joined.inner_opening = std::max(
        {*last->opening, last->inner_opening.value_or(0.0), joined.inner_opening.value_or(0.0)});
    if (last->peak_force >= joined.peak_force) {
      joined.peak_force = last->peak_force;
      joined.peak_time = last->peak_time;
    }
    *last = std::move(joined);
  }
  sub_impacts.resize(n);
}

std::size_t n_parted_by(double opening, const std::vector<SubImpact>& sub_impacts) {
  return static_cast<std::size_t>(std::ranges::count_if(sub_impacts, [&](const SubImpact& s) {
    return s.end && s.opening.value_or(HUGE_VAL) >= opening;
  }));
}

std::vector<ZoneSummary> summarise_zones(const std::vector<SubImpact>& sub_impacts) {
  std::vector<ZoneSummary> zones;
  for (const SubImpact& s : sub_impacts) {
    if (zones.empty() || zones.back().zone != s.zone) {
      zones.push_back({});
      zones.back().zone = s.zone;
      zones.back().start = s.start;
      zones.back().start_error = s.start_error;
    }
    ZoneSummary& zone = zones.back();
    ++zone.n_sub_impacts;
    zone.n_subzones = std::max(zone.n_subzones, s.subzone);
    zone.end = s.end;
    zone.end_error = s.end_error;
    zone.impulse += s.impulse;
    zone.peak_force = std::max(zone.peak_force, s.peak_force);
  }
  return zones;
}

}  // namespace subimpact
