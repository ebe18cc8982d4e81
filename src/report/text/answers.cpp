#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/counted.h"
#include "case/problem.h"
#include "io/records/run_record.h"
#include "model/contact/contact_laws.h"
#include "numerics/units.h"
#include "report/text/uncertain.h"
#include "subimpact/report/text.h"
#include "subimpact/study/answers.h"

namespace subimpact {
namespace {

constexpr int digits_of_energies = 4;        // at most
constexpr int least_digits_of_energies = 2;  // whatever their errors
constexpr double worth_saying = 0.005;       // of a value: a known share of an error that is not
constexpr double doubtful_pressure = 1e9;    // Pa
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

// Shares of the energy at the end, which add up as they are printed: each is the difference of two
// rounded sums. One below its error is joined to the one before it.
std::string energy_note(const Case&, const Result& result) {
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
  std::string before = with_unit(with_decimals(initial, decimals), unit);
  if (end.work != 0.0) {
    before += fmt::format(" {} {} work of loads", end.work < 0.0 ? '-' : '+',
                          with_decimals(std::abs(unit.per_si * end.work), decimals));
  }
  return fmt::format("{} = {}{}, at the end", before, unit.is_power ? "in this unit " : "", words);
}

// ", 9.3 m/s of the beam": the other velocities behind a restitution.
std::string velocities_note(const Case& input, const Result& result) {
  const Scene& scene = input.scene;
  // Without loads and stops both keep their velocities after they part.
  const bool until_end = scene.gravity == 0.0 && !scene.beam.has_loads() && !scene.striker.fixed;
  if (until_end) {
    if (!scene.beam.is_unsupported()) return "after the last separation";
    return fmt::format(
        "beam {}{} at the end",
        total_text(result, RunTotal::beam_mean_velocity, result.beam_mean_velocity, as_velocity),
        scene.striker.position == 0.5 ? " (mean)" : " (mean; it turns)");
  }
  const auto [time, striker, beam] = result.parting;
  const std::string of_striker = "striker " + rough_text({striker, {}}, as_velocity);
  const std::string of_beam = "beam " + rough_text({beam, {}}, as_velocity);
  return fmt::format("{} at the last separation, {}",
                     scene.striker.fixed ? of_beam
                     : beam != 0.0       ? of_striker + ", " + of_beam
                                         : of_striker + ", against its own of the first touch",
                     time_text(time));
}

auto strongest(const Result& result) {
  return std::ranges::max_element(result.sub_impacts, {}, &SubImpact::peak_force);
}

// When the largest force acts: " at 8.8 us".
std::string time_of_force(const Result& result) {
  const auto hit = strongest(result);
  const double error = std::max(hit->start_error.value_or(0.0), hit->end_error.value_or(0.0));
  const ReadUnit unit = unit_for(hit->peak_time, as_instant);
  const auto rounding = rounding_of(hit->certain.value_or(true) ? unit.per_si * error : HUGE_VAL,
                                    decimals_of_times(result, unit));
  const double time = unit.per_si * hit->peak_time;
  return " at " +
         with_unit(rounding ? with_decimals(time, rounding->decimals) : with_digits(time, 3), unit);
}

std::string force_note(const Case&, const Result& result) {
  return fmt::format("in sub-impact {}", strongest(result) - result.sub_impacts.begin() + 1);
}

std::string counts_note(const Case& input, const Result& result) {
  std::string words = parted_words(input, result);
  if (result.all_certain() || words.empty()) return words + error_words(result);
  return words.substr(0, words.size() - 2);  // what is not certain has a line of its own
}

std::string joined_note(const Case&, const Result& result) {
  return fmt::format("contacts parted by less than {0:.4g} um as one (--opening {0:.4g}um)",
                     um * result.error_estimate->joined->opening);
}

std::string end_note(const Case&, const Result& result) { return contact_over_words(result); }

// "zone 2": "7 +- 1 sub-impacts in 2 sub-zones, 5000.0 +- 0.3 us to the end of the run, 0.1 N s".
void add_zone(const Result& result, Answer::Item& zone) {
  const ReadUnit unit = unit_for(result.outcome.time, as_instant);
  const auto time = [&](const Total& total) {
    if (total.error && total.value == 0.0) return std::string("0");
    return total.error ? number_in(unit, total, as_time.most_digits)
                       : with_decimals(unit.per_si * total.value, decimals_of_times(result, unit));
  };
  const auto [begin, error, is_lost] = number_and_error(unit, zone.start, as_time.most_digits);
  const std::string count = fmt::format("{} sub-impact{}", count_text(zone.sub_impacts),
                                        zone.sub_impacts.value == 1.0 ? "" : "s");
  const bool is_plain = is_lost || !zone.start.error || zone.start.value == 0.0;
  zone.begin_text =
      fmt::format("from {}: {}", with_unit(is_plain ? time(zone.start) : begin, unit), count);
  zone.error_text = zone.start.error ? error : "not known";
  zone.body_text = zone.start_body_error ? with_digits(unit.per_si * *zone.start_body_error, 2)
                   : zone.number == 1    ? "0"  // it begins with the first touch
                                         : "not known";
  zone.text =
      fmt::format("{}{}, {} to {}, {}", count,
                  zone.n_subzones > 1 ? fmt::format(" in {} sub-zones", zone.n_subzones) : "",
                  zone.has_end ? time(zone.start) : with_unit(time(zone.start), unit),
                  zone.has_end ? with_unit(time(zone.end), unit) : "the end of the run",
                  result.error_estimate ? text_of(zone.impulse, as_impulse)
                                        : plain_text(zone.impulse.value, as_impulse));
}

std::string set_note(const Case& input, const Result& result) {
  const auto& ends = input.scene.beam.ends;
  const bool is_open = std::ranges::count(ends, EndSupport::free) > 0;
  const bool has_tip = is_open && std::ranges::count(ends, EndSupport::clamped) > 0;
  const PlasticZone& hinge = *std::ranges::max_element(
      result.plastic_zones, {}, [](const PlasticZone& zone) { return std::abs(zone.rotation); });
  return fmt::format(
      "against the {}; largest plastic hinge {} at {:.4g} m",
      has_tip   ? "clamp"
      : is_open ? "chord"
                : "supports",
      total_text(result, RunTotal::hinge_rotation, std::abs(hinge.rotation), as_rotation),
      0.5 * (hinge.from + hinge.to));
}

// The extremes of the forces of both supports.
std::string reactions_note(const Case&, const Result& result) {
  std::string words = "positive along the strike";
  for (const std::size_t end : {0, 1}) {
    if (!result.reactions[end]) continue;
    for (const auto* extreme :
         {&result.reactions[end]->smallest, &result.reactions[end]->largest}) {
      words += fmt::format("; {} at x = {} at {}", rough_text({extreme->value, {}}, as_force),
                           end == 0 ? "0" : "length", time_text(extreme->time, 4));
    }
  }
  return words;
}

// Of a nose of known moduli; doubted where it is high and the metal's strength is not given.
std::string pressure_note(const Case& input, const Result& result) {
  const ContactPressure pressure = *contact_pressure(input.scene, result.max_force);
  std::string words = pressure.is_mean ? "the mean" : "in the middle";
  const double stress = input.scene.beam.yield_stress;
  if (std::isfinite(pressure.first_yield)) {
    words += fmt::format("; {} from {} in the middle", pressure.is_mean ? "yielded" : "yields",
                         plain_text(pressure.first_yield, as_stress));
    if (std::isfinite(stress)) {
      words += fmt::format("; {:.3g} of beam.yield_stress", pressure.at_force / stress);
    }
  } else if (pressure.at_force > doubtful_pressure) {
    words += ": few metals bear it without a dent; give beam.yield_stress";
  }
  return words;
}

std::string share_note(const Case& input, const Result&) {
  return input.model.section == SectionKind::elastic ? "sections are kept elastic by the case" : "";
}

struct Words {
  const char* label;
  Measure measure;
  std::string (*note)(const Case&, const Result&) = nullptr;
};
// In the order of AnswerKey.
constexpr Words words_of_keys[] = {{"sub-impacts", as_ratio, counts_note},
                                   {"joined", as_ratio, joined_note},
                                   {"largest force", as_answered_force, force_note},
                                   {"first parting", as_instant},
                                   {"last contact ends", as_instant, end_note},
                                   {"at rest since", as_instant},
                                   {"striker", as_velocity},
                                   {"restitution", as_ratio, velocities_note},
                                   {"impulse", as_impulse},
                                   {"zones", as_ratio},
                                   {"pressed in by", as_length},
                                   {"dent", as_length},
                                   {"contact pressure", as_stress, pressure_note},
                                   {"permanent set", as_length, set_note},
                                   {"share of yield", as_ratio, share_note},
                                   {"largest reaction", as_answered_force, reactions_note},
                                   {"energy dissipated", as_energy, energy_note}};
static_assert(std::size(words_of_keys) == static_cast<std::size_t>(AnswerKey::energy) + 1);
const Words& words_of(AnswerKey key) { return words_of_keys[static_cast<std::size_t>(key)]; }

// In the order of WhyNot.
constexpr const char* words_of_reasons[] = {
    "striker and beam never touched",
    "striker and beam are in contact at the end",
    "striker and beam approach each other at the end",
    "striker and beam met at rest",
    "no sub-impact is uncertain",
    "no contact without end is found",
    "it does not move or bend",
    "it stays elastic",
    "sections have yielded",
    "the beam has no yield stress",
    "the contact law does not have it",
    "it is not computed: the run failed, or output.shapes = 0",
    "the beam has no supports",
    "sections turn too far for this model"};

std::string label_of(const Result& result, const Answer& answer) {
  std::string label = words_of(answer.key).label;
  if (answer.key == AnswerKey::striker_velocity) {
    return label + " at " + duration_text(result.outcome.time);
  }
  if (answer.key != AnswerKey::joined || !answer.value) return label;
  return fmt::format("{} at {:.4g} um", label, um * result.error_estimate->joined->opening);
}

// What follows the value: " at 8.8 us".
std::string place_of(const Case& input, const Result& result, const Answer& answer) {
  if (answer.key == AnswerKey::largest_force) return time_of_force(result);
  if (answer.key == AnswerKey::energy) {
    return fmt::format(" of {}", rough_text({result.used.initial_energy, {}}, as_energy));
  }
  const auto& ends = input.scene.beam.ends;
  const bool has_tip = (ends[0] == EndSupport::free) != (ends[1] == EndSupport::free) &&
                       std::ranges::count(ends, EndSupport::clamped) == 1;
  if (!answer.position) return {};
  const bool is_tip =
      has_tip && *answer.position == (ends[0] == EndSupport::free ? 0.0 : input.scene.beam.length);
  return is_tip ? " at the tip" : fmt::format(" at {:.4g} m", *answer.position);
}

void add_numbers(const Case& input, const Result& result, Answer& answer) {
  const Measure& measure = words_of(answer.key).measure;
  const Total total{*answer.value, answer.error};
  const ReadUnit unit = unit_for(total, measure);
  const auto [number, error, is_lost] = number_and_error(unit, total, measure.most_digits);
  answer.text = result.error_estimate ? with_unit(number, unit) : plain_text(total.value, measure);
  if (answer.from) {
    answer.text = fmt::format("between {} and {}", with_digits(unit.per_si * *answer.from, 4),
                              with_unit(with_digits(unit.per_si * *answer.value, 4), unit));
  } else {
    answer.text += place_of(input, result, answer);
    if (answer.key == AnswerKey::contact_end && !result.contact_over) answer.text += ", so far";
    answer.error_text = error.empty() ? "not known" : error;
  }
  const auto rough = [&](double x) { return with_digits(unit.per_si * x, 2); };
  double at_least = 0.0;
  for (Answer::Part& part : answer.parts) {
    at_least += part.change.value_or(0.0);
    const auto& words = *std::ranges::find(names_of(part.kind), part.kind, &BodyPartWords::kind);
    part.label = words.label;
    part.text = part.change ? rough(*part.change) : "not known";
    part.remedy = words.remedy;
  }
  if (answer.error && answer.body_error) {
    answer.total_text = rough(std::hypot(*answer.error, *answer.body_error));
  }
  answer.body_text =
      answer.body_error ? rough(*answer.body_error)
      : at_least > std::max(answer.error.value_or(0.0), worth_saying * std::abs(*answer.value))
          ? "at least " + rough(at_least)
          : "not known";
}

// A number of sub-impacts has no decimals, and its own words.
void add_counts(const Result& result, Answer& answer) {
  answer.error_text =
      answer.error ? with_decimals(std::ceil(*answer.error), 0) : std::string("not known");
  answer.body_text = "not known";
  if (answer.key == AnswerKey::sub_impacts) {
    answer.text = fmt::format("{:.0f} in {}{}", *answer.value,
                              counted(summarise_zones(result.sub_impacts).size(), "zone"),
                              certain_words(result));
  } else if (answer.key == AnswerKey::joined) {
    answer.text =
        fmt::format("{:.0f}, {:.0f} certain", *answer.value, *answer.value - *answer.error);
  } else {
    answer.text = fmt::format("{:.0f}", *answer.value);
    for (Answer::Item& zone : answer.items) add_zone(result, zone);
  }
}

// ... with its total error: "13.6 +- 3.2 kN".
std::string with_total_error(const Answer& answer) {
  if (!answer.value) return "an amount that is not known";
  const Measure& measure = words_of(answer.key).measure;
  if (answer.error && answer.body_error) {
    const double error = std::hypot(*answer.error, *answer.body_error);
    const ReadUnit unit = unit_for({*answer.value, error}, measure);
    const double place = std::floor(std::log10(std::max(unit.per_si * error, 1e-9)));
    return with_unit(
        with_decimals(unit.per_si * *answer.value, std::max(1 - static_cast<int>(place), 0)) +
            " +- " + with_digits(unit.per_si * error, 2),
        unit);
  }
  return rough_text({*answer.value, {}}, measure) + " (+- not known)";
}

std::string verdict_words(const Result& result) {
  using Contact = StrikeVerdict::Contact;
  using Beam = StrikeVerdict::Beam;
  const StrikeVerdict& verdict = result.verdict;
  const std::string end = duration_text(result.outcome.time);
  const auto find = [&](AnswerKey key) -> const Answer& { return answer_of(result.answers, key); };
  std::string before;
  if (verdict.beam == Beam::turned_too_far) {
    before = fmt::format("Not a result: rotations of {:.2g} rad are beyond a model of small ones. ",
                         result.largest_rotation);
  }
  if (verdict.contact == Contact::none) {
    return fmt::format("{}No contact in {}{}.", before, end,
                       verdict.certainty == StrikeVerdict::Certainty::all ? ", for certain" : "");
  }
  std::string beam;
  switch (verdict.beam) {
    case Beam::rigid:
    case Beam::turned_too_far:
      break;
    case Beam::elastic: {
      const double share = find(AnswerKey::yield_share).value.value_or(0.0);
      beam = share > 1.0
                 ? fmt::format(
                       "strained to {:.2g} times first yield, which this model leaves out; ", share)
                 : "the beam stays elastic; ";
      break;
    }
    case Beam::not_computed:
      beam = "the beam has yielded; ";
      break;
    case Beam::bent:
      beam = fmt::format("bent by {}; ", with_total_error(find(AnswerKey::permanent_set)));
      break;
  }
  // In the order of Contact.
  static constexpr const char* states[] = {"", "contact is over", "may not be over",
                                           "still in contact",
                                           "in the end they rest on each other"};
  return fmt::format("{}{} in {}{}; up to {}; {}{}.", before,
                     counted(result.sub_impacts.size(), "sub-impact"), end,
                     result.error_estimate ? certain_words(result) : ", certainty not known",
                     with_total_error(find(AnswerKey::largest_force)), beam,
                     states[static_cast<std::size_t>(verdict.contact)]);
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

void make_answers(const Case& input, Result& result) {
  result.answers = answers_of(input, result);
  for (Answer& answer : result.answers) {
    answer.label = label_of(result, answer);
    if (!answer.value) {
      answer.note = words_of_reasons[static_cast<std::size_t>(*answer.why)];
      continue;
    }
    const bool is_count = answer.key == AnswerKey::sub_impacts || answer.key == AnswerKey::joined ||
                          answer.key == AnswerKey::zones;
    if (is_count) {
      add_counts(result, answer);
    } else {
      add_numbers(input, result, answer);
    }
    if (const auto note = words_of(answer.key).note) answer.note = note(input, result);
  }
  result.verdict = verdict_of(result);
  result.verdict.text = verdict_words(result);
}

}  // namespace subimpact
