#include "subimpact/report/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "case/counted.h"
#include "report/text/uncertain.h"

namespace subimpact {
namespace {

// Whether the only event time is that of the first touch, which is exact.
bool has_first_touch_alone(const Result& result) {
  return result.sub_impacts.size() == 1 && !result.sub_impacts.front().end;
}

std::string first_failure_text(const Outcome& outcome) {
  const Interval& failure = *outcome.first_failure;
  return fmt::format("results up to {} passed every check; first failure between {:.6g} and {}",
                     time_text(failure.from), unit_for(failure.to, as_time).per_si * failure.from,
                     time_text(failure.to));
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
  return finer.doubt ? text + "; " + words_of(finer.doubt) : text;
}

std::string duration_text(double seconds) {
  if (seconds < 1e-3) return time_text(seconds, 4);
  if (seconds < 1.0) return fmt::format("{:.4g} ms", seconds * 1e3);
  return fmt::format("{:.4g} s", seconds);
}

std::string outcome_caveat(const Result& result) {
  const Outcome& outcome = result.outcome;
  if (outcome.completed()) return {};
  const std::string kind(to_string(outcome.kind));
  if (outcome.first_failure) return kind + ": " + first_failure_text(outcome);
  return fmt::format("{} at {}", kind, time_text(outcome.time));
}

std::string error_words(const Result& result) {
  if (!result.error_estimate) {
    return "errors are not known; without --error-bars=off runs on coarser meshes estimate them";
  }
  const ErrorEstimate& estimate = *result.error_estimate;
  if (result.sub_impacts.empty() && result.all_certain()) return {};
  if (!estimate.first_unresolved) {
    return has_first_touch_alone(result)
               ? "no event time up to " + duration_text(result.outcome.time) +
                     " but the first touch, which is exact"
               : fmt::format("all times to {} up to {}", error_text(estimate.largest_error),
                             duration_text(result.outcome.time));
  }
  return fmt::format("{}; {}: {}",
                     result.n_certain() == std::size_t{0}
                         ? "no sub-impact is certain"
                         : "times of the certain ones to " + error_text(estimate.largest_error),
                     place_of_doubt(result, estimate), words_of(estimate.reason));
}

std::string certain_words(const Result& result) {
  const std::optional<std::size_t> n = result.n_certain();
  if (!n) return {};
  const char* of_mesh = result.error_estimate->finer_meshes ? " on this mesh" : "";
  if (result.all_certain()) return fmt::format(", all certain{}", of_mesh);
  if (*n == result.sub_impacts.size()) {
    return fmt::format(", {} certain{}, which may not be all", *n, of_mesh);
  }
  // What the error of the number has besides those that are not certain.
  const double more = error_of_total(result, RunTotal::sub_impacts).value_or(0.0) -
                      static_cast<double>(result.sub_impacts.size() - *n);
  return fmt::format(", {} certain{}{}", *n, of_mesh,
                     more > 0.0 ? fmt::format(", {:.0f} more possible", more) : "");
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
  if (tolerance.reason)
    text += (tolerance.met && !to_the_end ? "; beyond: " : "; ") + words_of(tolerance.reason);
  if (tolerance.obstacle) text += "; " + words_of(tolerance.obstacle);
  if (!tolerance.key.empty()) text += "; free " + tolerance.key;
  return text;
}

// Uncertain sub-impacts in succession, in one line: their sums.
std::string folded_line(const Result& result, std::size_t first, std::size_t last) {
  const auto all = std::span(result.sub_impacts).subspan(first, last - first + 1);
  Total impulse{0.0, 0.0};
  for (const SubImpact& s : all) {
    impulse.value += s.impulse;
    if (impulse.error && s.impulse_error) *impulse.error += *s.impulse_error;
    if (!s.impulse_error) impulse.error.reset();
  }
  const SubImpact& largest = *std::ranges::max_element(all, {}, &SubImpact::peak_force);
  const double end = result.end_of(all.back());
  const ReadUnit unit = unit_for(result.outcome.time, as_instant);
  const int decimals = decimals_of_times(result, unit);
  return fmt::format(
      "  {}-{}? {} to {} {}: {} in this run, not certain one by one; forces up to {}, impulse {} "
      "in "
      "all",
      first + 1, last + 1, with_decimals(unit.per_si * all.front().start, decimals),
      with_decimals(unit.per_si * end, decimals), unit.name, all.size(),
      rough_text({largest.peak_force, largest.peak_force_error}, as_force),
      rough_text(impulse, as_impulse));
}

std::string strike_table(const Result& result, bool all) {
  constexpr std::size_t shown_all = 20;
  constexpr double thinning = 1.25;  // from one that is shown to the next
  constexpr const char* line = "{:>6} {:>11} {:>18} {:>18} {:>10} {:>20} {:>10} {:>10}\n";
  std::string text = fmt::format(line, "strike", "sub-impacts", "restitution", "peak force", "dent",
                                 "permanent set", "bending", "dent");
  const std::size_t n = result.strikes.size();
  double next = 1.0;
  for (const StrikeRow& row : result.strikes) {
    const bool is_last = &row == &result.strikes.back();
    if (!all && n > shown_all && !is_last && row.strike < next) continue;
    next = std::max(row.strike + 1.0, thinning * row.strike);
    text += fmt::format(
        line, row.strike, row.sub_impacts,
        row.restitution ? text_of({*row.restitution, row.restitution_error}, as_ratio) : "not yet",
        text_of({row.peak_force, row.peak_force_error}, as_force),
        text_of({row.dent, {}}, as_length),
        text_of({row.permanent_set, row.permanent_set_error}, as_length),
        text_of({row.bending_dissipated, {}}, as_energy),
        text_of({row.contact_dissipated, {}}, as_energy));
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
  const auto add_cells = [&](const auto& cell_of) {
    std::string line;
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
      line += fmt::format("{}{:>{}}", k == 0 ? "" : " ", cell_of(k), table.columns[k].width);
    }
    add_line(line);
  };
  add_cells([&](std::size_t k) { return table.columns[k].name; });
  add_cells([&](std::size_t k) { return table.columns[k].unit; });
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
    add_cells([&](std::size_t k) { return table.rows[i].cells[k]; });
  }
  if (const auto* flight = doubt_after_last(result)) {
    add_line("after the last one there may be another: " + words_of(flight->reason));
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
    last = fmt::format("{} at {}", to_string(event.kind), time_text(event.time));
  }
  std::string text =
      fmt::format("{} at {} ({}; method {}; last event {}): {}", to_string(result.outcome.kind),
                  time_text(result.outcome.time), mode, to_string(input.solver.method), last,
                  result.outcome.message);
  if (result.outcome.first_failure) text += "; " + first_failure_text(result.outcome);
  if (result.outcome.kind == OutcomeKind::left_validity) {
    for (const std::string& doubt : doubtful_units(input)) text += "; check the unit: " + doubt;
  }
  return text;
}

}  // namespace subimpact
