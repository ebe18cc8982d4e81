#include "study/judgement/totals.h"

#include <map>
#include <utility>

#include "numerics/estimates.h"
#include "study/judgement/judge.h"
#include "subimpact/study/judgement/event_errors.h"

namespace subimpact {
namespace {

// Safety factors, measured on random scenes: the tables of validation/truth/judgement.
constexpr double usual_safety = 3.8;
constexpr double safety_of_beam_velocity = 5.0;
constexpr double safety_of_dissipated = 5.5;
constexpr double safety_of_largest = 7.0;          // of the force and of the indentation
constexpr std::nullopt_t as_it_is = std::nullopt;  // of counts: the error is the difference itself
// Relative error of the largest strain above which no error is stated: where a hinge forms, strains
// grow without limit on finer meshes.
constexpr double largest_error_of_strain = 0.5;

enum class From { every_run, shapes };

// `v0`: velocity of the strike, m/s.
struct Quantity {
  RunTotal name;
  double (*value)(const Result& run, double v0);
  std::optional<double> safety = usual_safety;
  From from = From::every_run;
  double largest_share = HUGE_VAL;  // of an error in the value; none is stated beyond
  // Set for an extreme along the beam: runs are compared at the instants that they share, and the
  // error has a part due to the distance between instants.
  SampledPeak FieldPeaks::*peak = nullptr;
  EnvelopeRow::Range EnvelopeRow::*range = nullptr;  // the same at a place

  std::optional<double> of(const Case& input, const Result& run) const {
    if (from == From::shapes && run.envelope.empty()) return std::nullopt;
    const double x = value(run, input.scene.bodies().velocity_scale());
    return std::isnan(x) ? std::nullopt : std::optional(x);
  }
};

using Run = const Result&;
// clang-format off
const Quantity quantities[] = {
    {RunTotal::zones, [](Run run, double) { return run.sub_impacts.empty() ? 0.0 : run.sub_impacts.back().zone; }, as_it_is},
    {RunTotal::striker_velocity, [](Run run, double) { return run.striker_velocity; }},
    {RunTotal::beam_mean_velocity, [](Run run, double) { return run.beam_mean_velocity; }, safety_of_beam_velocity},
    {RunTotal::restitution, [](Run run, double) { return run.restitution.value_or(NAN); }},
    {RunTotal::impulse, [](Run run, double) { return run.impulse(); }},
    {RunTotal::peak_force, [](Run run, double) { return run.max_force; }, safety_of_largest},
    {RunTotal::max_indentation, [](Run run, double) { return run.max_indentation; }, safety_of_largest},
    {RunTotal::residual_indentation, [](Run run, double) { return run.sub_impacts.empty() ? NAN : run.sub_impacts.back().residual_indentation; }},
    {RunTotal::max_displacement, [](Run run, double) { return run.peaks.displacement.largest; }, usual_safety, From::shapes, HUGE_VAL, &FieldPeaks::displacement, &EnvelopeRow::displacement},
    {RunTotal::max_moment, [](Run run, double) { return run.peaks.moment.largest; }, usual_safety, From::shapes, HUGE_VAL, &FieldPeaks::moment, &EnvelopeRow::moment},
    {RunTotal::max_strain, [](Run run, double) { return run.peaks.strain.largest; }, usual_safety, From::shapes, largest_error_of_strain, &FieldPeaks::strain, &EnvelopeRow::strain},
    {RunTotal::reaction_along, [](Run run, double) { return run.peaks.reaction_along.largest > 0.0 ? run.peaks.reaction_along.largest : NAN; }, usual_safety, From::shapes, HUGE_VAL, &FieldPeaks::reaction_along},
    {RunTotal::reaction_against, [](Run run, double) { return run.peaks.reaction_against.largest > 0.0 ? run.peaks.reaction_against.largest : NAN; }, usual_safety, From::shapes, HUGE_VAL, &FieldPeaks::reaction_against},
    {RunTotal::permanent_set, [](Run run, double) { return largest_magnitude(run.envelope, &EnvelopeRow::set_from_supports); }, usual_safety, From::shapes},
    {RunTotal::hinge_rotation, [](Run run, double) { return largest_magnitude(run.plastic_zones, &PlasticZone::rotation); }, usual_safety, From::shapes},
    {RunTotal::striker_energy_share, [](Run run, double v0) { return std::pow(run.striker_velocity / v0, 2); }},
    {RunTotal::dissipated, [](Run run, double) { return run.final_energies.dissipated(); }, safety_of_dissipated},
};
// clang-format on

// Of a contact with a support, over the largest: weaker ones change nothing that counts.
constexpr double felt_force = 1e-3;

// The contact of another run with the same support that overlaps most, if that is mutual.
const SupportContact* partner_of(const SupportContact& here, const Result& run,
                                 const Result& other) {
  const auto end_of = [](const SupportContact& c) { return c.end.value_or(HUGE_VAL); };
  const auto best = [&](const SupportContact& of, const std::vector<SupportContact>& all) {
    const SupportContact* found = nullptr;
    double most = 0.0;
    for (const SupportContact& there : all) {
      const double common =
          std::min({end_of(of), end_of(there), run.outcome.time}) - std::max(of.start, there.start);
      if (there.position != of.position || there.spring != of.spring || !(common > most)) continue;
      most = common;
      found = &there;
    }
    return found;
  };
  const SupportContact* there = best(here, other.support_contacts);
  const bool is_mutual = there != nullptr && best(*there, run.support_contacts) == &here;
  return is_mutual && there->end.has_value() == here.end.has_value() ? there : nullptr;
}

// Sums the errors of the parts, each the largest over its runs. `value`: of a run; none where the
// run has no such thing.
Total total_of(const Result& run, std::span<const RunBeside> beside,
               const std::optional<double>& safety,
               const std::function<std::optional<double>(const Result&)>& value) {
  Total total{value(run).value_or(0.0), {}};
  std::map<ErrorSource, double> parts;
  for (const RunBeside& other : beside) {
    const bool shows_errors_alone = other.of.of_rows && !other.of.of_existence;
    if (!safety && shows_errors_alone) continue;
    const std::optional<double> there = value(other.result);
    if (!there || !other.result.outcome.completed()) return total;
    const auto source_of = [](const RunBeside& run_beside) { return run_beside.of.source; };
    const bool alone = std::ranges::count(beside, other.of.source, source_of) == 1;
    const double factor =
        safety ? *safety * other.of.gain * (alone ? single_run_factor : 1.0) : 1.0;
    double& error = parts[other.of.source];
    error = std::max(error, factor * std::abs(total.value - *there));
  }
  total.error = 0.0;
  for (const auto& [source, error] : parts) *total.error += error;
  return total;
}

constexpr double near = 1.0 / 16.0;            // of the length, to either side
constexpr double between_points = 1.0 / 32.0;  // by which points of two meshes may be apart
constexpr double safety_of_first_order = 1.5;
constexpr double largest_gain_of_first_order = 2.0;

// The largest magnitude near a place; runs have their points at different ones.
double largest_near(const Result& run, double position, double width,
                    EnvelopeRow::Range EnvelopeRow::*range) {
  const auto from =
      std::ranges::lower_bound(run.envelope, position - width, {}, &EnvelopeRow::position);
  double largest = 0.0;
  for (auto row = from; row != run.envelope.end() && row->position <= position + width; ++row) {
    largest = std::max(largest, ((*row).*range).magnitude());
  }
  return largest;
}

// By how much another place of the beam may exceed the largest magnitude of the run: as far off as
// the coarsest mesh shows it there, to first order, as a moment under a point force converges.
double excess_elsewhere(const Case& input, const Result& run, std::span<const RunBeside> beside,
                        double largest, EnvelopeRow::Range EnvelopeRow::*range) {
  const auto count = [](const RunBeside& other) { return mesh_count(other.of.input); };
  const auto coarsest = std::ranges::min_element(beside, {}, count);
  if (coarsest == beside.end() || run.envelope.empty()) return 0.0;
  const double ratio = static_cast<double>(mesh_count(input)) / count(*coarsest);
  if (!(ratio > 1.0)) return 0.0;
  const double factor =
      safety_of_first_order * std::min(1.0 / (ratio - 1.0), largest_gain_of_first_order);
  const double length = input.scene.beam.length;
  double excess = 0.0;
  for (const EnvelopeRow& row : run.envelope) {
    const auto there = [&](double width) {
      return largest_near(coarsest->result, row.position, width * length, range);
    };
    const double here = largest_near(run, row.position, near * length, range);
    const double same =
        std::clamp(here, there(near - between_points), there(near + between_points));
    excess = std::max(excess, here + factor * std::abs(here - same) - largest);
  }
  return excess;
}

// The same time is known no better as a bound of a zone than as one of a sub-impact.
void widen(Total& total, const std::optional<double>& error) {
  if (total.error && error) total.error = std::max(*total.error, *error);
}

double end_of(const ZoneSummary& zone, const Result& run) {
  return zone.end.value_or(run.outcome.time);
}

// The number of sub-impacts of a zone. Its error: how many of them, and of the flights after them,
// are not certain; where there are any, or a run shows errors of totals alone, at least the
// difference to each run beside from the zone's start to that of the next. 0 where all is certain.
// `first`: of its sub-impacts, from 0.
Total count_of(const ZoneSummary& zone, std::size_t first, const Result& run,
               std::span<const RunBeside> beside, const ErrorEstimate& estimate) {
  const auto n = static_cast<std::size_t>(zone.n_sub_impacts);
  const auto here = std::span(run.sub_impacts).subspan(first, n);
  const bool is_last = first + n == run.sub_impacts.size();
  const double from = first == 0 ? -HUGE_VAL : zone.start;
  const double until = is_last ? HUGE_VAL : run.sub_impacts[first + n].start;
  const auto n_flights_before = [&](std::size_t i) {
    const auto& flights = estimate.uncertain_flights;
    return std::ranges::lower_bound(flights, i, {}, &ErrorEstimate::UncertainFlight::after) -
           flights.begin();
  };
  const auto n_doubts = std::ranges::count(here, std::optional(false), &SubImpact::certain) +
                        n_flights_before(first + n) - n_flights_before(first);
  Total count{static_cast<double>(zone.n_sub_impacts), static_cast<double>(n_doubts)};
  for (const auto& [of, other] : beside) {
    if (!other.outcome.completed()) return {count.value, std::nullopt};
    if (of.of_rows && (n_doubts == 0 || !of.of_existence)) continue;
    const auto n_before = [&all = other.sub_impacts](double time) {
      return std::ranges::lower_bound(all, time, {}, &SubImpact::start) - all.begin();
    };
    const auto n_there = n_before(until) - n_before(from);
    count.error = std::max(*count.error, std::abs(count.value - static_cast<double>(n_there)));
  }
  return count;
}

// The number of sub-impacts of a run, and its error, from those of its zones.
Total sum_of_counts(const std::vector<ZoneTotals>& zones) {
  Total sum{0.0, 0.0};
  for (const auto& [start, end, impulse, count] : zones) {
    sum.value += count.value;
    sum.error = sum.error && count.error ? std::optional(*sum.error + *count.error) : std::nullopt;
  }
  return sum;
}

}  // namespace

void set_totals(const Case& input, const Result& run, std::span<const RunBeside> beside,
                ErrorEstimate& estimate) {
  for (const Quantity& quantity : quantities) {
    if (!quantity.of(input, run)) continue;
    Total total = total_of(run, beside, quantity.safety, [&](const Result& of) {
      return quantity.peak != nullptr ? (of.peaks.*quantity.peak).shared : quantity.of(input, of);
    });
    total.value = *quantity.of(input, run);
    if (quantity.peak != nullptr && total.error) {
      *total.error += (run.peaks.*quantity.peak).sampling_error();
    }
    if (quantity.range != nullptr && total.error) {
      const double elsewhere = excess_elsewhere(input, run, beside, total.value, quantity.range);
      total.error = std::max(*total.error, elsewhere);
    }
    if (total.error && *total.error > quantity.largest_share * std::abs(total.value)) {
      total.error.reset();
    }
    estimate.totals.push_back({quantity.name, total});
  }
  std::map<const Result*, std::vector<ZoneSummary>> zones_of;
  for (const RunBeside& other : beside) {
    zones_of[&other.result] = summarise_zones(other.result.sub_impacts);
  }
  std::size_t next = 0;  // sub-impact
  for (const ZoneSummary& zone : summarise_zones(run.sub_impacts)) {
    const std::size_t first =
        std::exchange(next, next + static_cast<std::size_t>(zone.n_sub_impacts));
    const auto total = [&](auto value) {
      return total_of(run, beside, usual_safety, [&](const Result& of) -> std::optional<double> {
        if (&of == &run) return value(zone, of);
        const ZoneSummary* there =
            most_overlapping(zone.start, end_of(zone, run), zones_of.at(&of),
                             [&](const ZoneSummary& other) { return end_of(other, of); });
        return there ? std::optional<double>(value(*there, of)) : std::nullopt;
      });
    };
    using Zone = const ZoneSummary&;
    estimate.zones.push_back({total([](Zone z, Run) { return z.start; }), total(end_of),
                              total([](Zone z, Run) { return z.impulse; }),
                              count_of(zone, first, run, beside, estimate)});
    ZoneTotals& totals = estimate.zones.back();
    widen(totals.start, zone.start_error);
    widen(totals.end, zone.end_error);
    // The time at which its last sub-impact ends, if no other one may follow that.
    const bool rows_have_all_errors =
        std::ranges::all_of(beside, [](const RunBeside& other) { return other.of.of_rows; });
    const bool is_last =
        run.sub_impacts[next - 1].certain.value_or(false) && !estimate.doubt_after(next - 1);
    if (zone.end_error && rows_have_all_errors && is_last) totals.end.error = zone.end_error;
  }
  Total count = sum_of_counts(estimate.zones);
  if (run.sub_impacts.empty() && estimate.first_unresolved) count.error = 1.0;
  estimate.totals.insert(estimate.totals.begin(), {RunTotal::sub_impacts, count});
}

double set_support_errors(Result& run, std::span<const RunBeside> beside) {
  double lost = HUGE_VAL, largest = 0.0;
  for (const SupportContact& here : run.support_contacts) {
    largest = std::max(largest, here.peak_force);
  }
  const auto lose = [&](const SupportContact& contact) {
    if (contact.peak_force > felt_force * largest) lost = std::min(lost, contact.start);
  };
  const auto shows_existence = [&](const Result& other) {
    return std::ranges::any_of(
        beside, [&](const RunBeside& one) { return &one.result == &other && one.of.of_existence; });
  };
  for (SupportContact& here : run.support_contacts) {
    using Time = std::optional<double> (*)(const SupportContact&);
    const auto error_of = [&](Time time) {
      return total_of(run, beside, usual_safety,
                      [&](const Result& other) -> std::optional<double> {
                        if (&other == &run) return time(here);
                        const SupportContact* there = partner_of(here, run, other);
                        if (there == nullptr)
                          return shows_existence(other) ? std::nullopt : time(here);
                        return time(*there);
                      })
          .error;
    };
    here.start_error = error_of([](const SupportContact& c) { return std::optional(c.start); });
    here.end_error = error_of([](const SupportContact& c) { return c.end; });
    if (!here.start_error) lose(here);
  }
  for (const RunBeside& other : beside) {
    if (!other.of.of_existence) continue;
    for (const SupportContact& there : other.result.support_contacts) {
      if (partner_of(there, other.result, run) == nullptr) lose(there);
    }
  }
  return lost;
}

}  // namespace subimpact
