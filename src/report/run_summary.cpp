#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/case_choices.h"
#include "case/counted.h"
#include "case/problem.h"
#include "io/printable.h"
#include "numerics/units.h"
#include "report/uncertain.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/results.h"
#include "subimpact/report/text.h"
#include "subimpact/study/run_as_asked.h"

namespace subimpact {
namespace {

constexpr std::size_t line_width = 100;
constexpr int label_width = 19;
constexpr std::size_t most_zones = 4;        // with a line of their own
constexpr int digits_of_energies = 4;        // at most
constexpr int least_digits_of_energies = 2;  // whatever their errors

// A label and what belongs to it, on lines of at most line_width.
std::string labelled(const std::string& label, const std::string& words) {
  std::string text = fmt::format("  {:<{}}", label, label_width);
  std::size_t column = text.size();
  for (std::size_t at = 0; at < words.size();) {
    std::size_t end = std::min(words.find(' ', at), words.size());
    while (words.substr(end, 4) == " +- ") end = std::min(words.find(' ', end + 4), words.size());
    if (column + 1 + end - at > line_width && column > label_width + 2) {
      text += fmt::format("\n{:{}}", "", label_width + 2);
      column = label_width + 2;
    }
    text += ' ' + words.substr(at, end - at);
    column += 1 + end - at;
    at = end + 1;
  }
  return text + '\n';
}

std::string mass_text(double mass) {
  if (mass >= 1e4) return fmt::format("{:.6g} t", 1e-3 * mass);
  if (mass < 1e-3) return fmt::format("{:.6g} g", 1e3 * mass);
  return fmt::format("{:.4g} kg", mass);
}

// "48 +- 2", "12"; without an error estimate the number alone.
std::string count_text(const Total& total) {
  const double error = std::ceil(total.error.value_or(0.0));
  return error > 0.0 ? fmt::format("{:.0f} +- {:.0f}", total.value, error)
                     : fmt::format("{:.0f}", total.value);
}

}  // namespace

std::string others_in_scene(const Scene& scene) {
  const Beam& beam = scene.beam;
  std::vector<std::string> words;
  const auto add = [&](bool is_there, std::string what) {
    if (is_there) words.push_back(std::move(what));
  };
  add(scene.gravity != 0.0, fmt::format("gravity {:.6g} m/s2", scene.gravity));
  add(scene.gravity == 0.0 && scene.striker.drop_height,
      "gravity sets the velocity and does not act in the run");
  add(beam.load != 0.0, fmt::format("load {:.6g} N/m", beam.load));
  add(!beam.forces.empty(), counted(beam.forces.size(), "force"));
  add(!beam.springs.empty(), counted(beam.springs.size(), "spring"));
  add(beam.foundation > 0.0, fmt::format("bedding {:.6g} N/m2", beam.foundation));
  add(beam.start == BeamStart::equilibrium, "beam in equilibrium at the start");
  add(beam.velocity != 0.0, fmt::format("beam moving at {:.6g} m/s", beam.velocity));
  add(beam.angular_velocity != 0.0,
      fmt::format("beam turning at {:.6g} rad/s about {:.6g} of its length", beam.angular_velocity,
                  beam.used_pivot()));
  return fmt::format("{}", fmt::join(words, ", "));
}

namespace {

std::string striker_words(const Scene& scene, const std::string& contact) {
  const Striker& striker = scene.striker;
  const std::string law = contact.empty() ? "" : " (" + contact + ")";
  if (striker.fixed) return "a stop" + law;
  return fmt::format(
      "{}{} at {:.4g} m/s{}", mass_text(striker.mass), law, scene.bodies().striker_velocity(),
      striker.drop_height ? fmt::format(" after a fall of {:.4g} m", *striker.drop_height) : "");
}

Answer strike(const Case& input, const Result& result) {
  const Scene& scene = input.scene;
  const double x = scene.striker.position;
  const std::string where = x == 0.5 ? std::string("the middle")
                            : x == 0.0 || x == 1.0
                                ? fmt::format("the {} end", name_of(scene.beam.ends[x == 1.0]))
                                : fmt::format("{:.4g} of the length", x);
  const std::string contact = contact_words(input);
  const std::string reached = duration_text(result.outcome.time);
  const std::string end = duration_text(input.end_time);
  const std::string others = others_in_scene(scene);
  return {"strike",
          fmt::format("{}, at {} of a {} beam of {}{}", striker_words(scene, contact), where,
                      scene.beam.fixed ? std::string("fixed")
                                       : fmt::format("{}-{}", name_of(scene.beam.ends[0]),
                                                     name_of(scene.beam.ends[1])),
                      mass_text(scene.beam.mass()), others.empty() ? "" : "; " + others),
          fmt::format("{} computed in {:.2g} s", reached == end ? end : reached + " of " + end,
                      result.work.all_seconds)};
}

Answer restitution(const Case& input, const Result& result) {
  if (!result.restitution) return {"restitution", "none", "striker and beam never touched"};
  const Scene& scene = input.scene;
  // Without loads and stops both keep their velocities after they part.
  const bool until_end = scene.gravity == 0.0 && !scene.beam.has_loads() && !scene.striker.fixed;
  const auto [time, striker, beam] = result.parting;
  std::string words;
  if (until_end) {
    words = "striker " +
            total_text(result, "striker_velocity_m_per_s", result.striker_velocity, 1.0, 6, "m/s");
    if (scene.beam.is_unsupported()) {
      words += ", beam " +
               total_text(result, "beam_mean_velocity_m_per_s", result.beam_mean_velocity, 1.0, 6,
                          "m/s") +
               " (mean)";
    }
    words += " at the end";
  } else {
    words = scene.striker.fixed ? fmt::format("beam {:.4g} m/s (mean)", beam)
            : scene.beam.is_unsupported()
                ? fmt::format("striker {:.4g} m/s, beam {:.4g} m/s (mean)", striker, beam)
                : fmt::format("striker {:.4g} m/s, against its own of the first touch", striker);
    words += result.sub_impacts.front().end
                 ? fmt::format("; at the last separation, {:.6g} us", us * time)
                 : std::string("; at the end, without a separation");
  }
  return {"restitution", total_text(result, "restitution", *result.restitution, 1.0, 6, ""), words};
}

Answer largest_force(const Result& result) {
  const auto hit = std::ranges::max_element(result.sub_impacts, {}, &SubImpact::peak_force);
  const double error = std::max(hit->start_error.value_or(0.0), hit->end_error.value_or(0.0));
  const auto rounding = rounding_of(hit->certain.value_or(true) ? us * error : HUGE_VAL, 1);
  return {"largest force", total_text(result, "peak_force_N", result.max_force, 1.0, 2, "N"),
          fmt::format("at {} us, in sub-impact {}",
                      rounding ? with_decimals(us * hit->peak_time, rounding->decimals)
                               : with_digits(us * hit->peak_time, 3),
                      hit - result.sub_impacts.begin() + 1)};
}

void add_impulses(const Result& result, std::vector<Answer>& answers) {
  const std::vector<ZoneSummary> zones = summarise_zones(result.sub_impacts);
  const auto& estimate = result.error_estimate;
  const bool has_totals = estimate && estimate->zones.size() == zones.size();
  answers.push_back(
      {"impulse", total_text(result, "impulse_Ns", result.impulse(), 1.0, 6, "N s"), ""});
  for (std::size_t k = 0; k < std::min(zones.size(), most_zones); ++k) {
    const ZoneSummary& zone = zones[k];
    const ZoneTotals* totals = has_totals ? &estimate->zones[k] : nullptr;
    const auto time = [&](double value, const Total ZoneTotals::*total) {
      if (!totals) return fmt::format("{:.1f}", value * us);
      return value == 0.0 ? std::string("0") : text_of(totals->*total, us, 4);
    };
    answers.push_back(
        {fmt::format("  zone {}", zone.zone),
         (totals ? text_of(totals->impulse, 1.0, 6) : fmt::format("{:.6f}", zone.impulse)) + " N s",
         fmt::format("{} {}{}, {} to {} us",
                     totals ? count_text(totals->sub_impacts) : std::to_string(zone.n_sub_impacts),
                     noun_after(zone.n_sub_impacts, "sub-impact"),
                     zone.n_subzones > 1 ? fmt::format(" in {} sub-zones", zone.n_subzones) : "",
                     time(zone.start, &ZoneTotals::start),
                     zone.end ? time(*zone.end, &ZoneTotals::end) : "(open)")});
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
    const EnvelopeRow& most =
        where_largest(result, [](const EnvelopeRow& row) { return std::abs(row.permanent_set); });
    const PlasticZone& hinge = *std::ranges::max_element(
        result.plastic_zones, {}, [](const PlasticZone& zone) { return std::abs(zone.rotation); });
    const double set = std::abs(most.permanent_set);
    const double error = error_of_total(result, "permanent_set_m").value_or(0.0);
    answer.value = set < error ? fmt::format("below {} mm", rounding_of(mm * error, 6)->error)
                               : total_text(result, "permanent_set_m", set, mm, 3, "mm");
    answer.note = fmt::format(
        "at {:.4g} m, against the chord; largest plastic hinge {} at {:.4g} m", most.position,
        total_text(result, "hinge_rotation_rad", std::abs(hinge.rotation), 1.0, 4, "rad"),
        0.5 * (hinge.from + hinge.to));
  } else if (!(first_yield_strain(input, result) < HUGE_VAL)) {
    answer.note = "the beam has no yield stress";
  } else if (!result.envelope.empty()) {
    const EnvelopeRow& most =
        where_largest(result, [](const EnvelopeRow& row) { return magnitude(row.strain); });
    const std::string share = total_text(result, "max_strain", magnitude(most.strain),
                                         100.0 / first_yield_strain(input, result), 0, "%");
    const bool is_kept_elastic = input.model.section == SectionKind::elastic;
    answer.note =
        fmt::format("{}reaches {} of first yield, at {:.4g} m",
                    is_kept_elastic ? "sections are kept elastic by the case; the beam " : "",
                    share, most.position);
  }
  return answer;
}

Answer dent(const Result& result) {
  const SubImpact& last = result.sub_impacts.back();
  const std::string deepest =
      total_text(result, "max_indentation_m", result.max_indentation, mm, 6, "mm");
  if (!(last.residual_indentation > 0.0)) {
    return {"dent", "none", "the contact stays elastic, pressed in by at most " + deepest};
  }
  const Total depth{last.residual_indentation, last.residual_indentation_error};
  const bool has_errors = result.error_estimate.has_value();
  return {"dent",
          (has_errors ? text_of(depth, mm, 6) : fmt::format("{:.6f}", mm * depth.value)) + " mm",
          "pressed in by at most " + deepest};
}

// Shares of the energy at the end, which add up as they are printed: each is the difference of two
// rounded sums.
Answer energy(const Result& result) {
  const Energies& end = result.final_energies;
  const double initial = result.used.initial_energy;
  const double size = std::max(initial, end.work == 0.0 ? 0.0 : end.taken_up());
  const int digits_before = 1 + static_cast<int>(std::floor(std::log10(size)));
  const auto error_of = [&](const char* name) {
    return error_of_total(result, name).value_or(0.0);
  };
  const double error =
      std::max(error_of("dissipated_J"), initial * error_of("striker_energy_share"));
  const auto rounding = rounding_of(error, digits_of_energies - digits_before);
  const int decimals =
      std::max(rounding ? rounding->decimals : 0, least_digits_of_energies - digits_before);
  const std::pair<const char*, double> shares[] = {
      {"striker", end.striker},
      {"motion and vibration of the beam", end.beam_kinetic + end.bending_elastic},
      {"plastic bending", end.bending_plastic},
      {"elastic contact", end.contact_elastic},
      {"dent", end.contact_plastic - result.contact_damping_loss},
      {"damping of the contact", result.contact_damping_loss},
      {"damping of the beam", end.beam_damping}};
  const double power = std::pow(10.0, decimals);
  double sum = 0.0;
  std::string words;
  for (const auto& [name, share] : shares) {
    const double before = std::round(sum * power);
    sum += share;
    const double printed = (std::round(sum * power) - before) / power;
    if (printed == 0.0) continue;
    words +=
        fmt::format("{}{} {}", words.empty() ? "" : " + ", with_decimals(printed, decimals), name);
  }
  const std::string work =
      end.work == 0.0 ? "" : fmt::format("{} work of loads = ", with_decimals(end.work, decimals));
  return {"energy", with_decimals(initial, decimals) + " J",
          (work.empty() ? "" : "+ " + work) + words + ", at the end"};
}

// How far shear, which bending theory leaves out, moves the end of the first contact.
std::string neglected_shear_words(const NeglectedShear& shear) {
  const std::string without = fmt::format("{:.3g}", us * shear.without);
  const std::string change =
      !is_notable(shear) ? fmt::format(", at {} us, by less than 0.5 %", without)
      : shear.with       ? fmt::format(" from {} to {:.3g} us", without, us * *shear.with)
                         : fmt::format(" from {} us to beyond three times that", without);
  return fmt::format(
      "shear, which on a coarse mesh moves the end of the first contact{}; beam.theory = "
      "\"timoshenko\" has it",
      change);
}

std::string time_or_never(const std::optional<double>& time) {
  return time ? fmt::format("{:.4f} us", *time * us) : "never";
}

// The mesh, the method, their errors by source, what they cost and what they conserve.
std::string details(const Case& input, const Result& result) {
  const Work& work = result.work;
  std::string text = "\n";
  const auto line = [&](const std::string& label, const std::string& words) {
    text += labelled(label, words);
  };
  if (!result.envelope.empty() && result.used.section != "rigid") {
    const EnvelopeRow& most =
        where_largest(result, [](const EnvelopeRow& row) { return magnitude(row.moment); });
    line("bending",
         fmt::format("moment up to {:.4g} N m at {:.4g} m", magnitude(most.moment), most.position));
  }
  line("first yield", fmt::format("section {}, contact {}; {} of {} sections have yielded",
                                  time_or_never(result.first_section_yield),
                                  time_or_never(result.first_contact_yield),
                                  result.n_yielded_sections, result.used.n_sections));
  line("model", fmt::format("{}; section {}; {}", result.used.mesh,
                            to_text(*find_case_key("model.section")->get(input)),
                            counted(result.used.n_unknowns, "unknown")));
  if (!result.choice.empty()) line("chosen because", printable(result.choice));
  if (result.error_estimate) {
    for (const auto& [name, words] : error_part_words(result)) line(name, words);
  }
  line("method", fmt::format("{}{}", to_string(input.solver.method),
                             result.used.table ? ", table " + *result.used.table : ""));
  line("conservation",
       result.max_momentum_error
           ? fmt::format("energy to {:.1e}, momentum to {:.1e}, relative", result.max_energy_error,
                         *result.max_momentum_error)
           : fmt::format(
                 "energy to {:.1e}, relative; momentum is not conserved: the supports take it up",
                 result.max_energy_error));
  line("work", fmt::format("{}, {} rejected, {}, {}; {}", counted(work.steps, "step"),
                           work.rejected_steps, counted(work.right_hand_sides, "right-hand side"),
                           counted(work.roots, "event"), duration_text(work.wall_seconds)));
  return text;
}

}  // namespace

std::string contact_over_words(const Result& result) {
  if (result.contact_over) {
    return fmt::format("proven{}, striker and beam never touch again",
                       result.error_estimate ? "" : " on this mesh");
  }
  if (result.sub_impacts.empty()) return "striker and beam have not touched yet";
  if (result.rests_since) {
    return fmt::format(
        "loads hold striker and beam together since {:.6g} us: a contact without end",
        us * *result.rests_since);
  }
  if (!result.sub_impacts.back().end) return "striker and beam are still in contact";
  const std::optional<ClosestApproach>& closest = result.closest_approach;
  if (!closest) return "the gap grows until the run ends, but no proof excludes a later contact";
  const Total gap{closest->gap, closest->error};
  return fmt::format("the gap falls to {} um at {:.4g} us, and no proof excludes a later contact",
                     text_of(gap, um, 3), us * closest->time);
}

std::vector<Answer> answers(const Case& input, const Result& result) {
  const bool is_in_contact = !result.sub_impacts.empty() && !result.sub_impacts.back().end;
  std::vector<Answer> all = {strike(input, result)};
  all.push_back({"sub-impacts",
                 fmt::format("{} in {}", result.sub_impacts.size(),
                             counted(summarise_zones(result.sub_impacts).size(), "zone")) +
                     certain_words(result),
                 error_words(result)});
  all.push_back(restitution(input, result));
  if (!result.sub_impacts.empty()) {
    all.push_back(largest_force(result));
    add_impulses(result, all);
    all.push_back(dent(result));
  }
  if (result.used.section != "rigid") all.push_back(permanent_set(input, result));
  if (result.final_energies.taken_up() > 0.0) all.push_back(energy(result));
  all.push_back({"contact over",
                 result.contact_over ? "yes"
                 : is_in_contact     ? "no"
                                     : "may not be",
                 contact_over_words(result)});
  return all;
}

std::string run_summary(const Case& input, const Result& result, bool verbose) {
  std::string text = (input.title.empty() ? "untitled case" : printable(input.title)) + '\n';
  const auto line = [&](const char* label, const std::string& words) {
    text += labelled(label, words);
  };
  if (const std::string caveat = outcome_caveat(result); !caveat.empty()) line("outcome", caveat);
  if (result.tolerance) line("tolerance", tolerance_words(*result.tolerance, result));
  for (const Answer& answer : answers(input, result)) {
    text += labelled(answer.name, answer.value + (answer.note.empty() ? "" : ": " + answer.note));
  }
  if (result.error_estimate && !error_of_total(result, "impulse_Ns")) {
    line("errors", "a run beside did not complete, so errors of totals are not known");
  }
  if (result.error_estimate && result.error_estimate->finer_meshes) {
    line("finer meshes", finer_meshes_words(result));
  }
  if (result.predictability) line("predictable", predictability_words(result));
  if (result.neglected_shear) line("left out", neglected_shear_words(*result.neglected_shear));
  for (const std::string& warning : result.warnings) line("warning", warning);
  return verbose ? text + details(input, result) : text;
}

}  // namespace subimpact
