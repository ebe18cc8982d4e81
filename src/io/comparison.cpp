#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "case/counted.h"
#include "io/csv_text.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/report.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace {

constexpr double us = 1e6;  // per second

std::string setting_of(const ComparedRun& run) {
  if (run.result.used.step) return fmt::format("step {:.4g} us", *run.result.used.step * us);
  return fmt::format("rtol {:.1e}", run.input.solver.rtol);
}

// The times of the sub-impact at `index` of a list, or nothing.
const SubImpact* at(const std::vector<SubImpact>& list, const std::optional<std::size_t>& index) {
  return index ? &list[*index] : nullptr;
}

std::optional<double> difference(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? std::optional(*a - *b) : std::nullopt;
}

}  // namespace

std::string comparison_table(const Comparison& comparison) {
  const Result& reference = comparison.reference;
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{:<22} {:<14} {:>6} {:>6} {:>10} {:>10} {:>9} {:>9} {:>10} {:>11}\n", "", "",
                 "sub-", "corre-", "start", "end", "peak", "impulse", "right-hand", "wall");
  fmt::format_to(out, "{:<22} {:<14} {:>6} {:>6} {:>10} {:>10} {:>9} {:>9} {:>10} {:>11}\n",
                 "method", "setting", "imp.", "spond", "max, us", "max, us", "max, rel.",
                 "max, rel.", "sides", "time");
  for (const ComparedRun& run : comparison.runs) {
    fmt::format_to(
        out, "{:<22} {:<14} {:>6} {:>6} {:>10.2e} {:>10.2e} {:>9.1e} {:>9.1e} {:>10} {:>11}\n",
        run.name, setting_of(run), run.result.sub_impacts.size(), run.n_corresponding,
        run.max_start_difference * us, run.max_end_difference * us, run.max_peak_difference,
        run.max_impulse_difference, run.result.work.right_hand_sides,
        duration_text(run.result.work.wall_seconds));
  }
  fmt::format_to(
      out, "\nreference: {} at rtol {:.0e}, {}, times to {:.1e} us",
      to_string(comparison.reference_input.solver.method), comparison.reference_input.solver.rtol,
      counted(reference.sub_impacts.size(), "sub-impact"), reference.trust->largest_error * us);
  if (reference.trust->first_undecided) {
    fmt::format_to(out, " before sub-impact {}; from there on the reference itself is uncertain",
                   *reference.trust->first_undecided + 1);
  }
  fmt::format_to(out, "\n");
  for (const ComparedRun& run : comparison.runs) {
    fmt::format_to(out, "{}: {}\n", run.name, run.remark);
  }
  return fmt::to_string(text);
}

std::string comparison_csv(const Comparison& comparison) {
  CsvText csv(
      "method,outcome,sub_impacts,reference_sub_impacts,corresponding,max_start_difference_s,"
      "max_end_difference_s,max_peak_difference_relative,max_impulse_difference_relative,steps,"
      "rejected_steps,right_hand_sides,mass_solves,jacobians,factorisations,wall_s,rtol,step_s\n");
  for (const ComparedRun& run : comparison.runs) {
    const Work& work = run.result.work;
    const auto count = [&](long value) { csv.whole(static_cast<std::size_t>(value)); };
    csv.word(run.name).word(to_string(run.result.outcome.kind));
    csv.whole(run.result.sub_impacts.size()).whole(comparison.reference.sub_impacts.size());
    csv.whole(run.n_corresponding).number(run.max_start_difference).number(run.max_end_difference);
    csv.number(run.max_peak_difference).number(run.max_impulse_difference);
    for (const long value : {work.steps, work.rejected_steps, work.right_hand_sides,
                             work.mass_solves, work.jacobians, work.factorisations}) {
      count(value);
    }
    csv.number(work.wall_seconds);
    if (run.result.used.step) {
      csv.empty().number(run.result.used.step);
    } else {
      csv.number(run.input.solver.rtol).empty();
    }
    csv.end_row();
  }
  return csv.str();
}

std::string matches_csv(const Comparison& comparison) {
  CsvText csv(
      "method,reference_index,index,reference_start_s,start_s,start_difference_s,reference_end_s,"
      "end_s,end_difference_s,reference_peak_force_N,peak_force_N,reference_impulse_Ns,impulse_"
      "Ns\n");
  for (const ComparedRun& run : comparison.runs) {
    for (const MatchedPair& pair : run.pairs) {
      const SubImpact* there = at(comparison.reference.sub_impacts, pair.first);
      const SubImpact* here = at(run.result.sub_impacts, pair.second);
      const auto value = [](const SubImpact* s, double SubImpact::*member) {
        return s ? std::optional(s->*member) : std::nullopt;
      };
      const auto end = [](const SubImpact* s) { return s ? s->end : std::nullopt; };
      const auto index = [&](const std::optional<std::size_t>& i) {
        if (i) {
          csv.whole(*i + 1);
        } else {
          csv.empty();
        }
      };
      csv.word(run.name);
      index(pair.first);
      index(pair.second);
      const auto start_there = value(there, &SubImpact::start);
      const auto start_here = value(here, &SubImpact::start);
      csv.number(start_there).number(start_here).number(difference(start_here, start_there));
      csv.number(end(there)).number(end(here)).number(difference(end(here), end(there)));
      for (const auto member : {&SubImpact::peak_force, &SubImpact::impulse}) {
        csv.number(value(there, member)).number(value(here, member));
      }
      csv.end_row();
    }
  }
  return csv.str();
}

}  // namespace subimpact
