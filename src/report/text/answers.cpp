#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/counted.h"
#include "case/keys/case_choices.h"
#include "case/problem.h"
#include "numerics/units.h"
#include "report/text/strike_answer.h"
#include "report/text/uncertain.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/report/text.h"
#include "subimpact/study/run_as_asked.h"

namespace subimpact {
namespace {

constexpr std::size_t most_zones = 4;      // with a line of their own
constexpr int digits_of_energies = 4;      // at most
constexpr double doubtful_pressure = 1e9;  // Pa
constexpr Measure as_stress{"Pa", 6, 3};
constexpr int least_digits_of_energies = 2;          // whatever their errors
constexpr double openings_counted[] = {1e-6, 1e-5};  // m

// "37 parted by more than 1 um, 13 by more than 10 um; "; empty for a single contact.
std::string parted_words(const Case& input, const Result& result) {
  const double joined = input.output.opening;
  std::string words;
  if (joined > 0.0)
    words = fmt::format("contacts parted by less than {:.4g} um joined", um * joined);
  if (result.sub_impacts.size() > 1) {
    const char* parted = "parted ";
    for (const double opening : openings_counted) {
      if (!(opening > joined)) continue;
      words += fmt::format("{}{} {}by more than {:.4g} um", words.empty() ? "" : ", ",
                           n_parted_by(opening, result.sub_impacts), std::exchange(parted, ""),
                           um * opening);
    }
  }
  return words.empty() ? words : words + "; ";
}

Answer restitution(const Case& input, const Result& result) {
  if (result.sub_impacts.empty()) return {"restitution", "none", "striker and beam never touched"};
  if (!result.restitution) {
    if (result.first_touch.striker <= result.first_touch.beam) {
      return {"restitution", "none", "striker and beam met at rest"};
    }
    const bool apart = result.sub_impacts.back().end.has_value();
    return {"restitution", "not yet",
            apart ? "striker and beam approach each other at the end"
                  : "striker and beam are in contact at the end"};
  }
  const Scene& scene = input.scene;
  // Without loads and stops both keep their velocities after they part.
  const bool until_end = scene.gravity == 0.0 && !scene.beam.has_loads() && !scene.striker.fixed;
  const auto [time, striker, beam] = result.parting;
  std::string words;
  if (until_end) {
    words = "striker " +
            total_text(result, RunTotal::striker_velocity, result.striker_velocity, as_velocity);
    if (scene.beam.is_unsupported()) {
      words +=
          ", beam " +
          total_text(result, RunTotal::beam_mean_velocity, result.beam_mean_velocity, as_velocity) +
          (scene.striker.position == 0.5 ? " (mean)" : " (mean; it turns)");
    }
    words += " at the end";
  } else {
    const std::string of_striker = "striker " + rough_text({striker, {}}, as_velocity);
    const std::string of_beam = "beam " + rough_text({beam, {}}, as_velocity);
    words = scene.striker.fixed ? of_beam
            : beam != 0.0       ? of_striker + ", " + of_beam
                                : of_striker + ", against its own of the first touch";
    words += " at the last separation, " + time_text(time);
  }
  return {"restitution", total_text(result, RunTotal::restitution, *result.restitution, as_ratio),
          words};
}

Answer largest_force(const Result& result) {
  const auto hit = std::ranges::max_element(result.sub_impacts, {}, &SubImpact::peak_force);
  const double error = std::max(hit->start_error.value_or(0.0), hit->end_error.value_or(0.0));
  const ReadUnit unit = unit_for(result.outcome.time, as_instant);
  const auto rounding = rounding_of(hit->certain.value_or(true) ? unit.per_si * error : HUGE_VAL,
                                    decimals_of_times(result, unit));
  const double time = unit.per_si * hit->peak_time;
  return {"largest force", total_text(result, RunTotal::peak_force, result.max_force, as_force),
          fmt::format(
              "at {}, in sub-impact {}",
              with_unit(rounding ? with_decimals(time, rounding->decimals) : with_digits(time, 3),
                        unit),
              hit - result.sub_impacts.begin() + 1)};
}

void add_impulses(const Result& result, std::vector<Answer>& answers) {
  const std::vector<ZoneSummary> zones = summarise_zones(result.sub_impacts);
  const auto& estimate = result.error_estimate;
  const bool has_totals = estimate && estimate->zones.size() == zones.size();
  answers.push_back(
      {"impulse", total_text(result, RunTotal::impulse, result.impulse(), as_impulse), ""});
  for (std::size_t k = 0; k < std::min(zones.size(), most_zones); ++k) {
    const ZoneSummary& zone = zones[k];
    const Total count{static_cast<double>(zone.n_sub_impacts), {}};
    const ZoneTotals totals =
        has_totals ? estimate->zones[k]
                   : ZoneTotals{{zone.start, {}}, {zone.end.value_or(0.0), {}}, {}, count};
    const ReadUnit unit = unit_for(result.outcome.time, as_instant);
    const auto time = [&](const Total& total) {
      if (!total.error) {
        return with_decimals(unit.per_si * total.value, decimals_of_times(result, unit));
      }
      return total.value == 0.0 ? std::string("0") : number_in(unit, total, as_time.most_digits);
    };
    answers.push_back(
        {fmt::format("  zone {}", zone.zone),
         has_totals ? text_of(totals.impulse, as_impulse) : plain_text(zone.impulse, as_impulse),
         fmt::format("{} {}{}, {} to {}", count_text(totals.sub_impacts),
                     noun_after(zone.n_sub_impacts, "sub-impact"),
                     zone.n_subzones > 1 ? fmt::format(" in {} sub-zones", zone.n_subzones) : "",
                     zone.end ? time(totals.start) : with_unit(time(totals.start), unit),
                     zone.end ? with_unit(time(totals.end), unit) : "the end of the run")});
  }
  if (zones.size() > most_zones) {
    answers.back().note += fmt::format("; {} more zones follow", zones.size() - most_zones);
  }
}

template <class Value>
const EnvelopeRow& where_largest(const Result& result, Value value) {
  return *std::ranges::max_element(result.envelope, {}, value);
}

double magnitude(const EnvelopeRow::Range& range) {
  return std::max(range.largest.value, -range.smallest.value);
}

// Strain of the outer fibre at which a section first yields.
double first_yield_strain(const Case& input, const Result& result) {
  const double n = input.model.layers;
  const bool has_layers = descriptor_of(input.model.section).has_layers;
  const double share = input.parts.section ? input.parts.section->first_yield()
                       : has_layers        ? n / (n - 1.0)
                                           : 1.0;
  return 0.5 * input.scene.beam.height() * result.used.yield_curvature * share;
}

Answer permanent_set(const Case& input, const Result& result) {
  Answer answer{"permanent set", "none", ""};
  if (result.n_yielded_sections > 0 && result.plastic_zones.empty()) {
    answer.value = fmt::format("{} of {} sections have yielded", result.n_yielded_sections,
                               result.used.n_sections);
    answer.note = "the set is not computed with output.shapes = 0";
  } else if (!result.plastic_zones.empty()) {
    const EnvelopeRow& most = where_largest(
        result, [](const EnvelopeRow& row) { return std::abs(row.set_from_supports); });
    const PlasticZone& hinge = *std::ranges::max_element(
        result.plastic_zones, {}, [](const PlasticZone& zone) { return std::abs(zone.rotation); });
    const auto& ends = input.scene.beam.ends;
    const bool is_open = std::ranges::count(ends, EndSupport::free) > 0;
    const bool has_tip = is_open && std::ranges::count(ends, EndSupport::clamped) > 0;
    const bool is_tip =
        &most == (ends[0] == EndSupport::free ? &result.envelope.front() : &result.envelope.back());
    const std::string place =
        has_tip && is_tip ? "the tip" : fmt::format("{:.4g} m", most.position);
    const std::string hinge_place = fmt::format("{:.4g} m", 0.5 * (hinge.from + hinge.to));
    const double set = std::abs(most.set_from_supports);
    const double error = error_of_total(result, RunTotal::permanent_set).value_or(0.0);
    answer.value = set < error ? "below " + rough_text({set + error, 0.0}, as_length)
                               : total_text(result, RunTotal::permanent_set, set, as_length);
    answer.note = fmt::format(
        "at {}, against the {}; largest plastic hinge {} {}", place,
        has_tip   ? "clamp"
        : is_open ? "chord"
                  : "supports",
        total_text(result, RunTotal::hinge_rotation, std::abs(hinge.rotation), as_rotation),
        hinge_place == place ? "there" : "at " + hinge_place);
  } else if (!(first_yield_strain(input, result) < HUGE_VAL)) {
    answer.note = "the beam has no yield stress";
  } else if (!result.envelope.empty()) {
    const EnvelopeRow& most =
        where_largest(result, [](const EnvelopeRow& row) { return magnitude(row.strain); });
    const double percent = 100.0 / first_yield_strain(input, result);
    Total strain{percent * magnitude(most.strain), error_of_total(result, RunTotal::max_strain)};
    if (strain.error) *strain.error *= percent;
    const std::string share =
        strain.error ? text_of(strain, as_ratio) : fmt::format("{:.3g}", strain.value);
    const bool is_kept_elastic = input.model.section == SectionKind::elastic;
    answer.note =
        fmt::format("{}reaches {} % of first yield, at {:.4g} m",
                    is_kept_elastic ? "sections are kept elastic by the case; the beam " : "",
                    share, most.position);
  }
  return answer;
}

// Extremes of the forces of the supports, where there are any.
void add_reactions(const Result& result, std::vector<Answer>& answers) {
  const auto& first = result.reactions.front();
  const auto& last = result.reactions.back();
  if (!first && !last) return;
  const bool has_errors = result.error_estimate.has_value();
  const auto words = [&](auto extreme, double sense) {
    const bool at_first =
        first && (!last || sense * ((*first).*extreme).value >= sense * ((*last).*extreme).value);
    const auto& [force, time] = (at_first ? *first : *last).*extreme;
    const auto name = force > 0.0 ? RunTotal::reaction_along : RunTotal::reaction_against;
    return fmt::format("{} at x = {} at {}",
                       has_errors ? text_of({force, error_of_total(result, name)}, as_force)
                                  : rough_text({force, {}}, as_force),
                       at_first ? "0" : "length", time_text(time, 4));
  };
  answers.push_back({"supports", words(&EnvelopeRow::Range::smallest, -1.0),
                     "least force on the beam, positive along the strike; largest " +
                         words(&EnvelopeRow::Range::largest, 1.0)});
}

Answer dent(const Result& result) {
  const SubImpact& last = result.sub_impacts.back();
  const std::string deepest =
      total_text(result, RunTotal::max_indentation, result.max_indentation, as_length);
  if (!(last.residual_indentation > 0.0)) {
    return {"dent", "none", "the contact stays elastic, pressed in by at most " + deepest};
  }
  return {"dent",
          total_text(result, RunTotal::residual_indentation, last.residual_indentation, as_length),
          "pressed in by at most " + deepest};
}

// Under a nose of known moduli; doubted where it is high and the metal's strength is not given.
void add_contact_pressure(const Case& input, const Result& result, std::vector<Answer>& answers) {
  if (input.parts.contact_law) return;
  const auto pressure = contact_pressure(input.scene, result.max_force);
  if (!pressure) return;
  Answer answer{"contact pressure", plain_text(pressure->at_force, as_stress),
                pressure->is_mean ? "the mean" : "in the middle"};
  if (std::isfinite(pressure->first_yield)) {
    answer.note +=
        fmt::format("; yields from {} in the middle", plain_text(pressure->first_yield, as_stress));
    const double stress = input.scene.beam.yield_stress;
    if (std::isfinite(stress)) {
      answer.value += fmt::format(", {:.3g} of beam.yield_stress", pressure->at_force / stress);
    }
  } else if (pressure->at_force > doubtful_pressure) {
    answer.note += ": few metals bear it without a dent; give beam.yield_stress";
  }
  answers.push_back(std::move(answer));
}

// Shares of the energy at the end, which add up as they are printed: each is the difference of two
// rounded sums. One below its error is joined to the one before it.
Answer energy(const Result& result) {
  const Energies& end = result.final_energies;
  const double largest =
      std::max(result.used.initial_energy, end.work == 0.0 ? 0.0 : end.taken_up());
  const ReadUnit unit = unit_for(largest, as_energy);
  const double initial = unit.per_si * result.used.initial_energy;
  const int digits_before = 1 + static_cast<int>(std::floor(std::log10(unit.per_si * largest)));
  const auto error_of = [&](RunTotal name) { return error_of_total(result, name).value_or(0.0); };
  const double error = std::max(unit.per_si * error_of(RunTotal::dissipated),
                                initial * error_of(RunTotal::striker_energy_share));
  const auto rounding = rounding_of(error, digits_of_energies - digits_before);
  const int decimals =
      std::max(rounding ? rounding->decimals : 0, least_digits_of_energies - digits_before);
  const double power = std::pow(10.0, decimals);
  std::vector<std::pair<std::string, double>> shares = {{"", 0.0}};
  const auto add = [&](const char* name, double joules) {
    auto& [names, sum] = shares.back();
    const double share = unit.per_si * joules;
    const bool is_named = std::abs(share) * power >= 0.5;
    if (is_named && !names.empty() && std::abs(share) >= error && std::abs(sum) >= error) {
      return shares.emplace_back(name, share), void();
    }
    sum += share;
    if (is_named) names += names.empty() ? name : std::string(" and ") + name;
  };
  add("striker", end.striker);
  add("motion and vibration of the beam", end.beam_kinetic + end.bending_elastic);
  add("plastic bending", end.bending_plastic);
  add("elastic contact", end.contact_elastic);
  add("dent", end.contact_plastic - result.contact_damping_loss);
  add("damping of the contact", result.contact_damping_loss);
  add("damping of the beam", end.beam_damping);
  double sum = 0.0;
  std::string words;
  for (const auto& [names, share] : shares) {
    const double before = std::round(sum * power);
    sum += share;
    words +=
        fmt::format("{}{} {}", words.empty() ? "" : " + ",
                    with_decimals((std::round(sum * power) - before) / power, decimals), names);
  }
  if (end.work != 0.0) {
    words = fmt::format("{} {} work of loads = {}", end.work < 0.0 ? '-' : '+',
                        with_decimals(std::abs(unit.per_si * end.work), decimals), words);
  }
  if (unit.name.starts_with('e')) words = "all in 1" + unit.name + ": " + words;
  return {"energy", with_unit(with_decimals(initial, decimals), unit), words + ", at the end"};
}

// The parts of an error of the model, the largest first; those that are not known at the end.
std::string part_words(const ModelErrors& errors, std::optional<double> StrikeFigures::*figure,
                       const ReadUnit& unit) {
  std::vector<const ModelErrors::Part*> parts;
  for (const ModelErrors::Part& part : errors.parts) parts.push_back(&part);
  const auto size = [&](const auto* part) { return -(part->change.*figure).value_or(-1.0); };
  std::ranges::stable_sort(parts, {}, size);
  constexpr double felt = 1e-3;  // of the largest part
  const double largest = parts.empty() ? 0.0 : (parts.front()->change.*figure).value_or(0.0);
  std::string words;
  for (const ModelErrors::Part* part : parts) {
    const std::optional<double>& change = part->change.*figure;
    if (change && *change <= felt * largest) continue;
    words += fmt::format("{}{} {}", words.empty() ? "" : ", ", part->name,
                         change ? with_digits(unit.per_si * *change, 2) : "not known");
  }
  return words;
}

// How far the body itself may be from the exact solution of the equations.
void add_model_errors(const Result& result, std::vector<Answer>& answers) {
  if (!result.model_errors) return;
  const ModelErrors& errors = *result.model_errors;
  const auto add = [&](const char* name, std::optional<double> StrikeFigures::*figure,
                       const Measure& measure) {
    const std::optional<double>& value = errors.value.*figure;
    if (!value) return;
    answers.push_back({name, text_of({*value, errors.error.*figure}, measure),
                       part_words(errors, figure, unit_for(std::abs(*value), measure))});
  };
  add("model: parting", &StrikeFigures::parting, as_time);
  add("model: force", &StrikeFigures::peak_force, as_force);
  add("model: velocity", &StrikeFigures::striker_velocity, as_velocity);
  add("model: set", &StrikeFigures::permanent_set, as_length);
}

}  // namespace

std::string contact_over_words(const Result& result) {
  if (result.contact_over) {
    return fmt::format("proven{}, striker and beam never touch again",
                       result.error_estimate ? "" : " on this mesh");
  }
  if (result.sub_impacts.empty()) return "striker and beam have not touched yet";
  if (result.rests_since) {
    return fmt::format("loads hold striker and beam together since {}: a contact without end",
                       time_text(*result.rests_since));
  }
  if (!result.sub_impacts.back().end) return "striker and beam are still in contact";
  if (const auto* flight = doubt_after_last(result)) {
    return "after the last sub-impact there may be another: " + words_of(flight->reason);
  }
  const std::optional<ClosestApproach>& closest = result.closest_approach;
  if (!closest) return "the gap grows until the run ends, but no proof excludes a later contact";
  return fmt::format("the gap falls to {} at {}, and no proof excludes a later contact",
                     text_of({closest->gap, closest->error}, as_gap), time_text(closest->time, 4));
}

std::vector<Answer> answers(const Case& input, const Result& result) {
  const bool is_in_contact = !result.sub_impacts.empty() && !result.sub_impacts.back().end;
  std::vector<Answer> all = {strike_answer(input, result)};
  all.push_back({"sub-impacts",
                 fmt::format("{} in {}", result.sub_impacts.size(),
                             counted(summarise_zones(result.sub_impacts).size(), "zone")) +
                     certain_words(result),
                 parted_words(input, result) + error_words(result)});
  if (result.error_estimate && result.error_estimate->joined) {
    const auto& [opening, n, n_certain] = *result.error_estimate->joined;
    all.push_back({"joined", fmt::format("{}, {} certain", counted(n, "sub-impact"), n_certain),
                   fmt::format("contacts parted by less than {0:.4g} um as one (--opening "
                               "{0:.4g}um)",
                               um * opening)});
  }
  all.push_back(restitution(input, result));
  if (!result.sub_impacts.empty()) {
    all.push_back(largest_force(result));
    add_impulses(result, all);
    all.push_back(dent(result));
    add_contact_pressure(input, result, all);
  }
  if (result.used.bends()) all.push_back(permanent_set(input, result));
  add_reactions(result, all);
  if (result.final_energies.taken_up() > 0.0) all.push_back(energy(result));
  if (!input.model_choice.empty()) all.push_back({"model", "chosen", input.model_choice});
  add_model_errors(result, all);
  all.push_back({"contact over",
                 result.contact_over ? "yes"
                 : is_in_contact     ? "no"
                                     : "may not be",
                 contact_over_words(result)});
  return all;
}

}  // namespace subimpact
