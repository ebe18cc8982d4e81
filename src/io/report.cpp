#include "subimpact/io/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "case/counted.h"
#include "io/printable.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/case/doubtful_units.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace {

constexpr double us = 1e6;  // per second
constexpr double mm = 1e3;  // per metre

std::string time_or_never(const std::optional<double>& time) {
  return time ? fmt::format("{:.4f} us", *time * us) : "never";
}

std::string zone_text(const std::vector<ZoneSummary>& zones) {
  fmt::memory_buffer text;
  for (const ZoneSummary& zone : zones) {
    fmt::format_to(std::back_inserter(text), "  zone {:<14} {} in {}, {:.1f} to {} us\n", zone.zone,
                   counted(zone.n_sub_impacts, "sub-impact"), counted(zone.n_subzones, "sub-zone"),
                   zone.start * us, zone.end ? fmt::format("{:.1f}", *zone.end * us) : "(open)");
  }
  return fmt::to_string(text);
}

std::string error_estimate_text(const Result& result, double largest_error,
                                const std::optional<std::size_t>& first_unresolved,
                                const std::string& reason) {
  if (!first_unresolved) return fmt::format("all times to {:.1e} us", largest_error * us);
  const std::size_t i = *first_unresolved;
  const std::string when = i < result.sub_impacts.size()
                               ? fmt::format(" at {:.3f} us", result.sub_impacts[i].start * us)
                               : std::string(", which this run does not have");
  return fmt::format(
      "times to {:.1e} us before sub-impact {}{}; from there on count and order are "
      "uncertain: {}",
      largest_error * us, i + 1, when, reason);
}

std::string first_failure_text(const Outcome& outcome) {
  const Interval& failure = *outcome.first_failure;
  return fmt::format(
      "results up to {:.6g} us passed every check; first failure between {:.6g} and {:.6g} us",
      failure.from * us, failure.from * us, failure.to * us);
}

// "0.226056 kg", "226.1 t".
std::string mass_text(double mass) {
  if (mass >= 1e4) return fmt::format("{:.6g} t", 1e-3 * mass);
  if (mass < 1e-3) return fmt::format("{:.6g} g", 1e3 * mass);
  return fmt::format("{:.6g} kg", mass);
}

// The sub-impacts that the error bars resolve, part by part and in total.
void add_error_estimate(const Result& result, fmt::memory_buffer& text) {
  const ErrorEstimate& estimate = *result.error_estimate;
  const auto line = [&](const std::string& label, const std::string& value) {
    fmt::format_to(std::back_inserter(text), "  {:<19} {}\n", label, value);
  };
  for (const ErrorEstimate::Part& part : estimate.parts) {
    line("error of " + part.name,
         fmt::format(
             "{} (refined run: {})",
             error_estimate_text(result, part.largest_error, part.first_unresolved, part.reason),
             part.refined_run));
  }
  if (estimate.parts.size() == 1) return;
  line("error bars", error_estimate_text(result, estimate.largest_error, estimate.first_unresolved,
                                         estimate.reason));
}

}  // namespace

std::string duration_text(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.4g} us", seconds * 1e6);
  if (seconds < 1.0) return fmt::format("{:.4g} ms", seconds * 1e3);
  return fmt::format("{:.4g} s", seconds);
}

std::string outcome_caveat(const Result& result) {
  const Outcome& outcome = result.outcome;
  if (outcome.completed()) return {};
  const std::string kind(to_string(outcome.kind));
  if (outcome.first_failure) return kind + ": " + first_failure_text(outcome);
  return fmt::format("{} at {:.6g} us", kind, outcome.time * us);
}

std::string wish_words(const WishOutcome& wish, const Result& result) {
  const std::vector<SubImpact>& all = result.sub_impacts;
  const auto n_before = std::count_if(
      all.begin(), all.end(), [&](const SubImpact& s) { return result.end_of(s) <= wish.horizon; });
  const bool to_the_end = wish.horizon >= result.outcome.time;
  const std::string range = to_the_end
                                ? "to the end"
                                : fmt::format("up to {}, {} of {}", duration_text(wish.horizon),
                                              n_before, counted(all.size(), "sub-impact"));
  const bool is_known = std::isfinite(wish.reached);
  std::string text = fmt::format("event times within {}: ", duration_text(wish.wished));
  if (wish.met) {
    text += "met " + range;
    if (is_known) text += fmt::format(" ({} reached)", duration_text(wish.reached));
  } else {
    text += is_known ? fmt::format("not met; {} reached {}", duration_text(wish.reached), range)
                     : std::string("not met; the error reached is not known");
  }
  if (!wish.reason.empty()) text += (wish.met && !to_the_end ? "; beyond: " : "; ") + wish.reason;
  if (!wish.key.empty()) text += "; free " + wish.key;
  return text;
}

std::string sub_impact_table(const Result& result) {
  const bool with_errors = result.error_estimate.has_value();
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  if (const std::string caveat = outcome_caveat(result); !caveat.empty()) {
    fmt::format_to(out, "{}\n", caveat);
  }
  const auto heading = [&](auto... names) {
    fmt::format_to(out, "{:>4} {:>13} {:>13} {:>11} {:>11} {:>11} {:>12} {:>12} {:>11}", names...);
  };
  // The two last columns, with error bars, and the line's end.
  const auto errors = [&](const std::string& start, const std::string& end) {
    if (with_errors) fmt::format_to(out, " {:>10} {:>10}", start, end);
    fmt::format_to(out, "\n");
  };
  heading("", "start", "end", "duration", "peak force", "impulse", "indentation", "residual",
          "striker");
  errors("+- start", "+- end");
  heading("no.", "us", "us", "us", "N", "N s", "max, mm", "mm", "m/s");
  errors("us", "us");
  int zone = 0, subzone = 0;
  std::size_t index = 0;
  const auto error_text = [](const std::optional<double>& error) {
    return error ? fmt::format("{:.1e}", *error * us) : std::string("?");
  };
  for (const SubImpact& s : result.sub_impacts) {
    if (s.zone != zone) {
      fmt::format_to(out, "zone {}\n", s.zone);
    } else if (s.subzone != subzone) {
      fmt::format_to(out, "  sub-zone {}\n", s.subzone);
    }
    zone = s.zone;
    subzone = s.subzone;
    const std::string end = s.end ? fmt::format("{:.4f}", *s.end * us) : "(open)";
    const std::string duration = s.end ? fmt::format("{:.4f}", (*s.end - s.start) * us) : "";
    fmt::format_to(
        out, "{:>4} {:>13.4f} {:>13} {:>11} {:>11.2f} {:>11.6f} {:>12.7f} {:>12.7f} {:>11.6f}",
        ++index, s.start * us, end, duration, s.peak_force, s.impulse, s.max_indentation * mm,
        s.residual_indentation * mm, s.striker_velocity);
    errors(error_text(s.start_error), error_text(s.end_error));
  }
  return fmt::to_string(text);
}

std::string run_summary(const Case& input, const Result& result) {
  const std::vector<ZoneSummary> zones = summarise_zones(result.sub_impacts);
  const Work& work = result.work;
  fmt::memory_buffer text;
  const auto line = [&](const char* label, const std::string& value) {
    fmt::format_to(std::back_inserter(text), "  {:<19} {}\n", label, value);
  };
  fmt::format_to(std::back_inserter(text), "{}\n",
                 input.title.empty() ? "untitled case" : printable(input.title));
  line("outcome", fmt::format("{} at {} of {}", to_string(result.outcome.kind),
                              duration_text(result.outcome.time), duration_text(input.end_time)));
  if (result.wish) line("wish", wish_words(*result.wish, result));
  if (result.outcome.first_failure) line("checks", first_failure_text(result.outcome));
  if (result.no_more_contact) {
    line("no more contact", "proven: striker and beam never touch again");
  }
  line("model", fmt::format("{}; section {}; {}", result.used.mesh,
                            to_text(*find_case_key("model.section")->get(input)),
                            counted(result.used.n_unknowns, "unknown")));
  line("masses", fmt::format("beam {}, striker {}", mass_text(input.scene.beam.mass()),
                             mass_text(input.scene.striker.mass)));
  line("sub-impacts",
       fmt::format("{} in {}", result.sub_impacts.size(), counted(zones.size(), "zone")));
  text.append(zone_text(zones));
  line("first yield",
       fmt::format("section {}, contact {}", time_or_never(result.first_section_yield),
                   time_or_never(result.first_contact_yield)));
  line("yielded sections",
       fmt::format("{} of {}", result.n_yielded_sections, result.used.n_sections));
  line("maxima", fmt::format("force {:.2f} N, indentation {:.6f} mm", result.max_force,
                             result.max_indentation * mm));
  line("final velocities", fmt::format("striker {:.6f} m/s, beam (mean) {:.6f} m/s",
                                       result.striker_velocity, result.beam_mean_velocity));
  line("conservation",
       result.max_momentum_error
           ? fmt::format("energy to {:.1e}, momentum to {:.1e}, relative", result.max_energy_error,
                         *result.max_momentum_error)
           : fmt::format(
                 "energy to {:.1e}, relative; momentum is not conserved: the supports take it up",
                 result.max_energy_error));
  if (result.error_estimate) add_error_estimate(result, text);
  line("method", fmt::format("{}{}", to_string(input.solver.method),
                             result.used.table ? ", table " + *result.used.table : ""));
  line("work", fmt::format("{}, {} rejected, {}, {}; {}", counted(work.steps, "step"),
                           work.rejected_steps, counted(work.right_hand_sides, "right-hand side"),
                           counted(work.roots, "event"), duration_text(work.wall_seconds)));
  for (const std::string& warning : result.warnings) line("warning", warning);
  return fmt::to_string(text);
}

std::string failure_message(const Case& input, const Result& result) {
  const bool touching = !result.sub_impacts.empty() && !result.sub_impacts.back().end;
  const std::string mode =
      touching ? fmt::format("in contact, sub-impact {}", result.sub_impacts.size())
               : fmt::format("separated after sub-impact {}", result.sub_impacts.size());
  std::string last = "none";
  if (!result.transitions.empty()) {
    const Transition& event = result.transitions.back();
    last = fmt::format("{} at {:.6g} us", to_string(event.kind), event.time * us);
  }
  std::string text = fmt::format("{} at {:.6g} us ({}; method {}; last event {}): {}",
                                 to_string(result.outcome.kind), result.outcome.time * us, mode,
                                 to_string(input.solver.method), last, result.outcome.message);
  if (result.outcome.first_failure) text += "; " + first_failure_text(result.outcome);
  if (result.outcome.kind == OutcomeKind::left_validity) {
    for (const std::string& doubt : doubtful_units(input)) text += "; check the unit: " + doubt;
  }
  return text;
}

}  // namespace subimpact
