#include "subimpact/report/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/counted.h"
#include "numerics/units.h"
#include "report/uncertain.h"
#include "subimpact/case/doubtful_units.h"

namespace subimpact {
namespace {

// Whether the only event time is that of the first touch, which is exact.
bool has_first_touch_alone(const Result& result) {
  return result.sub_impacts.size() == 1 && !result.sub_impacts.front().end;
}

// How certain: "times of the certain ones to 2 us; <first reason why others are not>".
std::string certain_text(const Result& result, double largest_error,
                         const std::optional<std::size_t>& first_unresolved,
                         const std::string& reason) {
  if (!first_unresolved) {
    return has_first_touch_alone(result)
               ? "no event time up to " + duration_text(result.outcome.time) +
                     " but the first touch, which is exact"
               : fmt::format("all times to {} up to {}", error_text(largest_error),
                             duration_text(result.outcome.time));
  }
  const std::string which = place_of_doubt(result, *first_unresolved, reason);
  if (result.n_certain() == std::size_t{0})
    return fmt::format("no sub-impact is certain; {}: {}", which, reason);
  return fmt::format("times of the certain ones to {}; {}: {}", error_text(largest_error), which,
                     reason);
}

std::string first_failure_text(const Outcome& outcome) {
  const Interval& failure = *outcome.first_failure;
  return fmt::format(
      "results up to {:.6g} us passed every check; first failure between {:.6g} and {:.6g} us",
      failure.from * us, failure.from * us, failure.to * us);
}

}  // namespace

std::string finer_meshes_words(const Result& result) {
  const ErrorEstimate::FinerMeshes& finer = *result.error_estimate->finer_meshes;
  const std::size_t n = result.sub_impacts.size();
  std::string text =
      fmt::format("{} have {} and ", finer.mesh, counted(finer.n_there, "sub-impact"));
  if (n == 1) {
    text += finer.n_same == 1 ? "confirm the one here" : "do not confirm the one here";
  } else {
    text += fmt::format("confirm {} of these {}", finer.n_same, n);
  }
  if (finer.change_of_first_end) {
    const double change = *finer.change_of_first_end;
    text += fmt::format("; on finer meshes the first contact ends some {} {}",
                        error_text(std::abs(change)), change < 0.0 ? "earlier" : "later");
  }
  text += "; errors of times are those on this mesh, errors of totals include it";
  return finer.doubt.empty() ? text : text + "; " + finer.doubt;
}

std::vector<std::pair<std::string, std::string>> error_part_words(const Result& result) {
  const ErrorEstimate& estimate = *result.error_estimate;
  std::vector<std::pair<std::string, std::string>> parts;
  for (const ErrorEstimate::Part& part : estimate.parts) {
    const bool is_repeated = part.first_unresolved == estimate.first_unresolved &&
                             part.reason == estimate.reason && !part.reason.empty();
    const std::string words =
        is_repeated ? std::string("as above")
                    : certain_text(result, part.largest_error, part.first_unresolved, part.reason);
    parts.emplace_back(part.name + " error",
                       fmt::format("{} (runs beside: {})", words, part.refined_run));
  }
  return parts;
}

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

std::string error_words(const Result& result) {
  if (!result.error_estimate) {
    return "errors are not known; without --error-bars=off runs on coarser meshes estimate them";
  }
  const ErrorEstimate& estimate = *result.error_estimate;
  return certain_text(result, estimate.largest_error, estimate.first_unresolved, estimate.reason);
}

std::string certain_words(const Result& result) {
  const std::optional<std::size_t> n = result.n_certain();
  if (!n) return {};
  const char* of_mesh = result.error_estimate->finer_meshes ? " on this mesh" : "";
  if (result.all_certain()) return fmt::format(", all certain{}", of_mesh);
  return fmt::format(", {} certain{}{}", *n, of_mesh,
                     *n == result.sub_impacts.size() ? ", which may not be all" : "");
}

std::string tolerance_words(const ToleranceOutcome& tolerance, const Result& result) {
  const std::vector<SubImpact>& all = result.sub_impacts;
  const auto n_before = std::count_if(all.begin(), all.end(), [&](const SubImpact& s) {
    return result.end_of(s) <= tolerance.horizon;
  });
  const bool to_the_end = tolerance.horizon >= result.outcome.time;
  const std::string range =
      to_the_end ? "to the end"
                 : fmt::format("up to {}, {} of {}", duration_text(tolerance.horizon), n_before,
                               counted(all.size(), "sub-impact"));
  const bool is_known = std::isfinite(tolerance.reached);
  std::string text = fmt::format("event times within {}: ", duration_text(tolerance.asked));
  if (tolerance.met) {
    text += "met " + range;
    if (is_known) {
      text += has_first_touch_alone(result)
                  ? std::string(" (there is no event time but the first touch)")
                  : fmt::format(" ({} reached)", error_text(tolerance.reached));
    }
  } else {
    text += is_known ? fmt::format("not met; {} reached {}", error_text(tolerance.reached), range)
                     : std::string("not met; the error reached is not known");
  }
  if (!tolerance.reason.empty())
    text += (tolerance.met && !to_the_end ? "; beyond: " : "; ") + tolerance.reason;
  if (!tolerance.key.empty()) text += "; free " + tolerance.key;
  return text;
}

// Uncertain sub-impacts in succession, in one line: their sums.
std::string folded_line(const Result& result, std::size_t first, std::size_t last) {
  double impulse = 0.0, force = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    impulse += result.sub_impacts[i].impulse;
    force = std::max(force, result.sub_impacts[i].peak_force);
  }
  const SubImpact& end = result.sub_impacts[last];
  return fmt::format(
      "  {}-{}? {:.1f} to {:.1f} us: {} in this run, not certain one by one; forces up to "
      "{} N, impulse {} N s in all",
      first + 1, last + 1, us * result.sub_impacts[first].start, us * result.end_of(end),
      last - first + 1, with_digits(force, 3), with_digits(impulse, 3));
}

std::string strike_table(const Result& result, bool all) {
  constexpr std::size_t shown_all = 20;
  constexpr double thinning = 1.25;  // from one that is shown to the next
  std::string text =
      "strike  sub-impacts      restitution  peak force      dent  permanent set   bending      "
      "dent"
      "\n                                               N        mm             mm         J       "
      "  "
      "J\n";
  const std::size_t n = result.strikes.size();
  double next = 1.0;
  for (const StrikeRow& row : result.strikes) {
    const bool is_last = &row == &result.strikes.back();
    if (!all && n > shown_all && !is_last && row.strike < next) continue;
    next = std::max(row.strike + 1.0, thinning * row.strike);
    text += fmt::format("{:6} {:12} {:>16} {:11.0f} {:9.4f} {:>14} {:9.3g} {:9.3g}\n", row.strike,
                        row.sub_impacts, text_of({row.restitution, row.restitution_error}, 1.0, 4),
                        row.peak_force, 1e3 * row.dent,
                        text_of({row.permanent_set, row.permanent_set_error}, 1e3, 4),
                        row.bending_dissipated, row.contact_dissipated);
  }
  return text;
}

std::string sub_impact_table(const Result& result, bool fold) {
  const SubImpactRows table = sub_impact_rows(result);
  std::string text;
  const auto add_line = [&](const std::string& line) {
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  };
  if (const std::string caveat = outcome_caveat(result); !caveat.empty()) add_line(caveat);
  std::string names, units;
  for (const SubImpactRows::Column& column : table.columns) {
    const char* space = units.empty() ? "" : " ";
    names += fmt::format("{}{:>{}}", space, column.name, column.width);
    units += fmt::format("{}{:>{}}", space, column.unit, column.width);
  }
  add_line(names);
  add_line(units);
  const std::vector<SubImpact>& all = result.sub_impacts;
  int zone = 0, subzone = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const SubImpact& s = all[i];
    if (s.zone != zone) {
      add_line(fmt::format("zone {}", s.zone));
    } else if (s.subzone != subzone) {
      add_line(fmt::format("  sub-zone {}", s.subzone));
    }
    zone = s.zone;
    subzone = s.subzone;
    std::size_t last = i;
    while (fold && !table.rows[i].is_certain && last + 1 < all.size() &&
           !table.rows[last + 1].is_certain && all[last + 1].zone == zone &&
           all[last + 1].subzone == subzone) {
      ++last;
    }
    if (last > i + 1) {
      add_line(folded_line(result, i, last));
      i = last;
      continue;
    }
    std::string line;
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      line += fmt::format("{}{:>{}}", k == 0 ? "" : " ", table.rows[i].cells[k],
                          table.columns[k].width);
    }
    add_line(line);
  }
  if (!result.error_estimate) return text;
  for (const ErrorEstimate::UncertainFlight& flight : result.error_estimate->uncertain_flights) {
    if (flight.after + 1 < all.size()) continue;
    add_line("after the last one there may be another: " + flight.reason);
  }
  return text;
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
