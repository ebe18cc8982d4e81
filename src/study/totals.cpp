#include "study/totals.h"

#include <map>

#include "numerics/richardson.h"
#include "subimpact/study/match.h"
#include "subimpact/study/other_mesh.h"

namespace subimpact {
namespace {

// Measured on random scenes (validation/judgement).
constexpr double usual_safety = 2.7;
constexpr double safety_of_beam_velocity = 3.5;
constexpr double safety_of_dissipated = 4.0;
constexpr double safety_of_largest = 5.0;  // of the force and of the indentation
constexpr double of_one_run = 1.5;         // more where one run alone shows a part of the error
constexpr double of_count = 0.0;           // the difference itself
// Relative error of the largest strain above which no error is stated: where a hinge forms, strains
// grow without limit on finer meshes.
constexpr double largest_error_of_strain = 0.5;

double dissipated(const Energies& end) {
  return end.bending_plastic + end.contact_plastic + end.beam_damping;
}

enum class From { every_run, shapes };

// `v0`: velocity of the strike, m/s.
struct Quantity {
  const char* name;
  double (*value)(const Result& run, double v0);
  double safety = usual_safety;
  From from = From::every_run;
  double largest_share = HUGE_VAL;  // of an error in the value; none is stated beyond
  // Set for an extreme along the beam: runs are compared at the instants that they share, and the
  // error has a part due to the distance between instants.
  SampledPeak FieldPeaks::*peak = nullptr;

  std::optional<double> of(const Case& input, const Result& run) const {
    if (from == From::shapes && run.envelope.empty()) return std::nullopt;
    return value(run, input.scene.bodies().velocity_scale());
  }
};

using Run = const Result&;
// clang-format off
const Quantity quantities[] = {
    {"sub_impacts", [](Run run, double) { return static_cast<double>(run.sub_impacts.size()); }, of_count},
    {"zones", [](Run run, double) { return run.sub_impacts.empty() ? 0.0 : run.sub_impacts.back().zone; }, of_count},
    {"striker_velocity_m_per_s", [](Run run, double) { return run.striker_velocity; }},
    {"beam_mean_velocity_m_per_s", [](Run run, double) { return run.beam_mean_velocity; }, safety_of_beam_velocity},
    {"restitution", [](Run run, double) { return run.restitution.value_or(NAN); }},
    {"impulse_Ns", [](Run run, double) { return run.impulse(); }},
    {"peak_force_N", [](Run run, double) { return run.max_force; }, safety_of_largest},
    {"max_indentation_m", [](Run run, double) { return run.max_indentation; }, safety_of_largest},
    {"max_displacement_m", [](Run run, double) { return run.peaks.displacement.largest; }, usual_safety, From::shapes, HUGE_VAL, &FieldPeaks::displacement},
    {"max_moment_Nm", [](Run run, double) { return run.peaks.moment.largest; }, usual_safety, From::shapes, HUGE_VAL, &FieldPeaks::moment},
    {"max_strain", [](Run run, double) { return run.peaks.strain.largest; }, usual_safety, From::shapes, largest_error_of_strain, &FieldPeaks::strain},
    {"permanent_set_m", [](Run run, double) { return largest_magnitude(run.envelope, &EnvelopeRow::permanent_set); }, usual_safety, From::shapes},
    {"hinge_rotation_rad", [](Run run, double) { return largest_magnitude(run.plastic_zones, &PlasticZone::rotation); }, usual_safety, From::shapes},
    {"striker_energy_share", [](Run run, double v0) { return std::pow(run.striker_velocity / v0, 2); }},
    {"dissipated_J", [](Run run, double) { return dissipated(run.final_energies); }, safety_of_dissipated},
};
// clang-format on

// Sums the errors of the parts, each the largest over its runs. `value`: of a run; none where the
// run has no such thing.
Total total_of(const Result& run, std::span<const RunBeside> beside, double safety,
               const std::function<std::optional<double>(const Result&)>& value) {
  Total total{value(run).value_or(0.0), {}};
  std::map<std::string, double> parts;
  for (const RunBeside& other : beside) {
    const std::optional<double> there = value(other.result);
    if (!there || !other.result.outcome.completed()) return total;
    const auto part_of = [](const RunBeside& run_beside) { return run_beside.of.part; };
    const bool alone = std::ranges::count(beside, other.of.part, part_of) == 1;
    const double factor = safety * other.of.gain * (alone ? of_one_run : 1.0);
    double& error = parts[other.of.part];
    error = std::max(error, (safety == of_count ? 1.0 : factor) * std::abs(total.value - *there));
  }
  total.error = 0.0;
  for (const auto& [part, error] : parts) *total.error += error;
  return total;
}

double end_of(const ZoneSummary& zone, const Result& run) {
  return zone.end.value_or(run.outcome.time);
}

// The zone of another run that overlaps one of a run most; none if none does.
std::optional<ZoneSummary> counterpart(const ZoneSummary& here, const Result& run,
                                       const Result& other) {
  std::optional<ZoneSummary> best;
  const auto overlap = [&](const ZoneSummary& there) {
    return std::min(end_of(there, other), end_of(here, run)) - std::max(there.start, here.start);
  };
  for (const ZoneSummary& there : summarise_zones(other.sub_impacts)) {
    if (overlap(there) > (best ? overlap(*best) : 0.0)) best = there;
  }
  return best;
}

}  // namespace

void set_totals(const Case& input, const Result& run, std::span<const RunBeside> beside,
                ErrorEstimate& estimate) {
  const auto n_uncertain =
      std::ranges::count(run.sub_impacts, std::optional(false), &SubImpact::certain) +
      std::ssize(estimate.uncertain_flights);
  for (const Quantity& quantity : quantities) {
    if (!quantity.of(input, run)) continue;
    Total total = total_of(run, beside, quantity.safety, [&](const Result& of) {
      return quantity.peak != nullptr ? (of.peaks.*quantity.peak).shared : quantity.of(input, of);
    });
    total.value = *quantity.of(input, run);
    if (quantity.peak != nullptr && total.error) {
      *total.error += (run.peaks.*quantity.peak).sampling_error();
    }
    if (total.error && *total.error > quantity.largest_share * std::abs(total.value)) {
      total.error.reset();
    }
    if (quantity.name == std::string_view("sub_impacts") && total.error) {
      total.error = std::max(*total.error, static_cast<double>(n_uncertain));
    }
    estimate.totals.push_back({quantity.name, total});
  }
  for (const ZoneSummary& zone : summarise_zones(run.sub_impacts)) {
    const auto total = [&](auto value, double safety = usual_safety) {
      return total_of(run, beside, safety, [&](const Result& of) -> std::optional<double> {
        if (&of == &run) return value(zone, of);
        const std::optional<ZoneSummary> there = counterpart(zone, run, of);
        return there ? std::optional<double>(value(*there, of)) : std::nullopt;
      });
    };
    using Zone = const ZoneSummary&;
    estimate.zones.push_back({total([](Zone z, Run) { return z.start; }), total(end_of),
                              total([](Zone z, Run) { return z.impulse; }),
                              total([](Zone z, Run) { return 1.0 * z.n_sub_impacts; }, of_count)});
  }
}

void set_mesh_limits(const Case& input, Result& run, std::span<const RunBeside> beside) {
  if (beside.size() < 3 || !mesh_order(input)) return;
  constexpr double order_uncertainty = 0.35;  // of the ratio of differences for an order
  const double order = *mesh_order(input), h = 1.0 / mesh_count(input);
  const double middle_h = 1.0 / mesh_count(beside[1].of.input);
  const double expected =
      ratio_of_differences(1.0 / mesh_count(beside[2].of.input), middle_h, h, order);
  const auto limit = [&](double coarse, double middle, double fine) -> std::optional<double> {
    const double found = (coarse - middle) / (middle - fine);
    if (!(std::abs(found / expected - 1.0) <= order_uncertainty)) return std::nullopt;
    return richardson_limit(middle, fine, middle_h / h, order);
  };
  const Counterparts in_middle = counterparts(run.sub_impacts, beside[1].result.sub_impacts);
  const Counterparts in_coarse = counterparts(run.sub_impacts, beside[2].result.sub_impacts);
  for (std::size_t i = 0; i < run.sub_impacts.size(); ++i) {
    SubImpact& here = run.sub_impacts[i];
    const SubImpact* middle = in_middle.of[i];
    const SubImpact* coarse = in_coarse.of[i];
    if (!middle || !coarse) continue;
    if (i > 0) here.start_mesh_limit = limit(coarse->start, middle->start, here.start);
    if (here.end && middle->end && coarse->end) {
      here.end_mesh_limit = limit(*coarse->end, *middle->end, *here.end);
    }
    if (!here.start_mesh_limit && !here.end_mesh_limit) continue;
    const double of_start = std::abs(here.start_mesh_limit.value_or(here.start) - here.start);
    const double of_end =
        here.end ? std::abs(here.end_mesh_limit.value_or(*here.end) - *here.end) : 0.0;
    here.mesh_limit_error = std::max({here.error_time.value_or(0.0), of_start, of_end});
  }
}

}  // namespace subimpact
