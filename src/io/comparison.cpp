#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "case/counted.h"
#include "io/csv_columns.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/report.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace {

constexpr double us = 1e6;  // per second
constexpr std::size_t narrowest_name = 22;

std::string setting_of(const ComparedRun& run) {
  if (run.result.used.step) return fmt::format("step {:.4g} us", *run.result.used.step * us);
  return fmt::format("rtol {:.1e}", run.input.solver.rtol);
}

// The sub-impact at `index` of a list, or null.
const SubImpact* at(const std::vector<SubImpact>& list, const std::optional<std::size_t>& index) {
  return index ? &list[*index] : nullptr;
}

}  // namespace

std::string comparison_table(const Comparison& comparison) {
  const Result& reference = comparison.reference;
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  std::size_t width = narrowest_name;
  for (const ComparedRun& run : comparison.runs) width = std::max(width, run.name.size());
  fmt::format_to(out, "{:<{}} {:<14} {:>6} {:>6} {:>10} {:>10} {:>9} {:>9} {:>10} {:>11}\n", "",
                 width, "", "sub-", "corre-", "start", "end", "peak", "impulse", "right-hand",
                 "wall");
  fmt::format_to(out, "{:<{}} {:<14} {:>6} {:>6} {:>10} {:>10} {:>9} {:>9} {:>10} {:>11}\n",
                 "method", width, "setting", "imp.", "spond", "max, us", "max, us", "max, rel.",
                 "max, rel.", "sides", "time");
  for (const ComparedRun& run : comparison.runs) {
    fmt::format_to(
        out, "{:<{}} {:<14} {:>6} {:>6} {:>10.2e} {:>10.2e} {:>9.1e} {:>9.1e} {:>10} {:>11}\n",
        run.name, width, setting_of(run), run.result.sub_impacts.size(), run.n_corresponding,
        run.max_start_difference * us, run.max_end_difference * us, run.max_peak_difference,
        run.max_impulse_difference, run.result.work.right_hand_sides,
        duration_text(run.result.work.wall_seconds));
  }
  fmt::format_to(out, "\nreference: {} at rtol {:.0e}, {}, times to {:.1e} us",
                 to_string(comparison.reference_input.solver.method),
                 comparison.reference_input.solver.rtol,
                 counted(reference.sub_impacts.size(), "sub-impact"),
                 reference.error_estimate->largest_error * us);
  if (reference.error_estimate->first_unresolved) {
    fmt::format_to(out, " before sub-impact {}; from there on the reference itself is uncertain",
                   *reference.error_estimate->first_unresolved + 1);
  }
  fmt::format_to(out, "\n");
  for (const ComparedRun& run : comparison.runs) {
    fmt::format_to(out, "{}: {}\n", run.name, run.remark);
  }
  return fmt::to_string(text);
}

std::string comparison_csv(const Comparison& comparison) {
  const auto work = [](long Work::*count) {
    return [count](const ComparedRun& run) { return run.result.work.*count; };
  };
  const Columns<ComparedRun> columns = {
      {"method", &ComparedRun::name},
      {"outcome", [](const ComparedRun& run) { return run.result.outcome.kind; }},
      {"sub_impacts", [](const ComparedRun& run) { return run.result.sub_impacts.size(); }},
      {"reference_sub_impacts",
       [&](const ComparedRun&) { return comparison.reference.sub_impacts.size(); }},
      {"corresponding", &ComparedRun::n_corresponding},
      {"max_start_difference_s", &ComparedRun::max_start_difference},
      {"max_end_difference_s", &ComparedRun::max_end_difference},
      {"max_peak_difference_relative", &ComparedRun::max_peak_difference},
      {"max_impulse_difference_relative", &ComparedRun::max_impulse_difference},
      {"steps", work(&Work::steps)},
      {"rejected_steps", work(&Work::rejected_steps)},
      {"right_hand_sides", work(&Work::right_hand_sides)},
      {"mass_solves", work(&Work::mass_solves)},
      {"jacobians", work(&Work::jacobians)},
      {"factorisations", work(&Work::factorisations)},
      {"wall_s", [](const ComparedRun& run) { return run.result.work.wall_seconds; }},
      {"rtol",
       [](const ComparedRun& run) {
         return run.result.used.step ? std::nullopt : std::optional(run.input.solver.rtol);
       }},
      {"step_s", [](const ComparedRun& run) { return run.result.used.step; }}};
  return csv_text(columns, comparison.runs);
}

std::string matches_csv(const Comparison& comparison) {
  struct Match {
    std::string method;
    std::optional<std::size_t> reference_index, index;
    const SubImpact* reference;  // null: none corresponds
    const SubImpact* own;
  };
  std::vector<Match> matches;
  for (const ComparedRun& run : comparison.runs) {
    for (const MatchedPair& pair : run.pairs) {
      matches.push_back({run.name, pair.first, pair.second,
                         at(comparison.reference.sub_impacts, pair.first),
                         at(run.result.sub_impacts, pair.second)});
    }
  }
  const auto number = [](std::optional<std::size_t> Match::*index) {
    return [index](const Match& m) {
      return m.*index ? std::optional(*(m.*index) + 1) : std::nullopt;
    };
  };
  const auto of = [](const SubImpact* Match::*side, auto SubImpact::*member) {
    return [=](const Match& m) {
      return m.*side ? std::optional<double>(m.*side->*member) : std::nullopt;
    };
  };
  const auto difference = [=](auto SubImpact::*member) {
    return [=](const Match& m) {
      const std::optional<double> own = of(&Match::own, member)(m);
      const std::optional<double> reference = of(&Match::reference, member)(m);
      return own && reference ? std::optional(*own - *reference) : std::nullopt;
    };
  };
  const Columns<Match> columns = {
      {"method", &Match::method},
      {"reference_index", number(&Match::reference_index)},
      {"index", number(&Match::index)},
      {"reference_start_s", of(&Match::reference, &SubImpact::start)},
      {"start_s", of(&Match::own, &SubImpact::start)},
      {"start_difference_s", difference(&SubImpact::start)},
      {"reference_end_s", of(&Match::reference, &SubImpact::end)},
      {"end_s", of(&Match::own, &SubImpact::end)},
      {"end_difference_s", difference(&SubImpact::end)},
      {"reference_peak_force_N", of(&Match::reference, &SubImpact::peak_force)},
      {"peak_force_N", of(&Match::own, &SubImpact::peak_force)},
      {"reference_impulse_Ns", of(&Match::reference, &SubImpact::impulse)},
      {"impulse_Ns", of(&Match::own, &SubImpact::impulse)}};
  return csv_text(columns, matches);
}

}  // namespace subimpact
