#include <fmt/format.h>

#include <algorithm>

#include "case/counted.h"
#include "case/keys/case_choices.h"
#include "numerics/units.h"
#include "report/study_columns.h"
#include "report/text/uncertain.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/report/text.h"

namespace subimpact {
namespace {

template <auto count>
constexpr auto work = member<&ComparedRun::work, count>;
template <auto number>
constexpr auto errors = member<&ComparedRun::errors, number>;
StudyColumns<ComparedRun> columns_of(const Comparison& comparison) {
  std::size_t width = 22, setting_width = 14;
  for (const ComparedRun& run : comparison.runs) {
    width = std::max(width, run.setting.method.size());
    if (run.input.solver.max_order) setting_width = 22;
  }
  const auto time = [](const char* heading) { return Print{heading, ">10", ".2e", us}; };
  const auto share = [](const char* heading) { return Print{heading, ">9", ".1e"}; };
  const auto setting = [](const ComparedRun& run) {
    const std::optional<int>& order = run.input.solver.max_order;
    return (run.setting.fixed_step ? run.setting.text()
                                   : fmt::format("rtol {:.1e}", run.setting.value)) +
           (order ? fmt::format(", order {}", *order) : "");
  };
  const auto correspondence = [](const ComparedRun& run) {
    return fmt::format("{}/{}", run.errors.n_corresponding, run.errors.n_reference);
  };
  const auto wall_time = [](const ComparedRun& run) { return duration_text(run.seconds); };
  const auto rtol = [](const ComparedRun& run) {
    return run.setting.fixed_step ? std::nullopt : std::optional(run.setting.value);
  };
  return {
      {"method",
       member<&ComparedRun::setting, &Setting::method>,
       {"method", fmt::format("<{}", width)}},
      {"", setting, {"setting", fmt::format("<{}", setting_width)}},
      {"outcome", [](const ComparedRun& run) { return run.result.outcome.kind; }},
      {"sub_impacts", errors<&EventErrors::n_found>, {"sub-\nimp.", ">6"}},
      {"reference_sub_impacts", errors<&EventErrors::n_reference>},
      {"corresponding", errors<&EventErrors::n_corresponding>},
      {"", correspondence, {"corre-\nspond", ">7"}},
      {"max_start_difference_s", known_error<&EventErrors::starts>, time("start\nmax, us")},
      {"max_end_difference_s", known_error<&EventErrors::ends>, time("end\nmax, us")},
      {"max_peak_difference_relative", known_error<&EventErrors::peak_force>,
       share("peak\nmax, rel.")},
      {"max_impulse_difference_relative", known_error<&EventErrors::impulse>,
       share("impulse\nmax, rel.")},
      {"steps", work<&Work::steps>},
      {"rejected_steps", work<&Work::rejected_steps>},
      {"right_hand_sides", work<&Work::right_hand_sides>, {"right-hand\nsides", ">10"}},
      {"mass_solves", work<&Work::mass_solves>},
      {"jacobians", work<&Work::jacobians>},
      {"factorisations", work<&Work::factorisations>},
      {"wall_s", work<&Work::wall_seconds>},
      {"", wall_time, {"wall\ntime", ">11"}},
      {"rtol", rtol},
      {"step_s", member<&ComparedRun::result, &Result::used, &ResolvedSettings::step>},
      {"max_order", member<&ComparedRun::result, &Result::used, &ResolvedSettings::max_order>},
      {"table", member<&ComparedRun::result, &Result::used, &ResolvedSettings::table>},
      {"events", member<&ComparedRun::result, &Result::used, &ResolvedSettings::events>},
      {"reference_error_s", [error = comparison.reference.error](const auto&) { return error; }},
      {"message", &ComparedRun::message}};
}

// "+20.29": how much later than in the first model, to a hundredth of a microsecond.
std::string later(const std::optional<double>& time, const std::optional<double>& first) {
  return time && first ? fmt::format("{:+.2f}", us * (*time - *first)) : std::string("-");
}

void add_rows(const ModelRun& run, const ModelRun& first, std::string& text) {
  const SubImpactRows table = sub_impact_rows(run.result);
  text +=
      fmt::format("{:>4} {:>{}} {:>{}} {:>12} {:>12}\n", "no.", "start, us", table.columns[1].width,
                  "end, us", table.columns[2].width, "start later", "end later");
  for (const MatchedPair& pair : run.pairs) {
    if (!pair.second) continue;
    const auto& cells = table.rows[*pair.second].cells;
    const SubImpact& here = run.result.sub_impacts[*pair.second];
    const SubImpact* there = pair.first ? &first.result.sub_impacts[*pair.first] : nullptr;
    text += fmt::format("{:>4} {:>{}} {:>{}} {:>12} {:>12}\n", cells[0], cells[1],
                        table.columns[1].width, cells[2], table.columns[2].width,
                        there ? later(here.start, there->start) : "-",
                        there ? later(here.end, there->end) : "-");
  }
}

std::string sentence(const ModelRun& run, const ModelRun& first) {
  const EventErrors errors = event_errors(run.result.sub_impacts, first.result.sub_impacts);
  const std::size_t n = errors.n_corresponding;
  std::string text = fmt::format("{}: {}, {} by {}", run.name,
                                 counted(run.result.sub_impacts.size(), "sub-impact"),
                                 first.result.sub_impacts.size(), first.name);
  if (n > 0) {
    text += fmt::format("; the first {} correspond, with times up to {:.2f} us apart", n,
                        us * std::max(errors.starts, errors.ends));
  }
  return text;
}

}  // namespace

std::string comparison_table(const Comparison& comparison) {
  const Result& reference = comparison.reference.result;
  std::string text = printed_table(columns_of(comparison), comparison.runs);
  text += fmt::format(
      "\nlargest differences: of the leading sub-impacts, all of which correspond\n"
      "reference: {}; {}, times to {:.1e} us",
      comparison.reference.description, counted(reference.sub_impacts.size(), "sub-impact"),
      comparison.reference.error * us);
  if (reference.error_estimate->first_unresolved) {
    text += fmt::format(" before sub-impact {}; from there on the reference itself is uncertain",
                        *reference.error_estimate->first_unresolved + 1);
  }
  text += '\n';
  for (const ComparedRun& run : comparison.runs) {
    text += fmt::format("{}: {}\n", run.setting.method, run.message);
  }
  return text;
}

std::string comparison_csv(const Comparison& comparison) {
  return csv_text(columns_in_file(columns_of(comparison)), comparison.runs);
}

std::string matches_csv(const Comparison& comparison) {
  struct Match {
    const ComparedRun* run;
    MatchedPair pair;
  };
  std::vector<Match> matches;
  for (const ComparedRun& run : comparison.runs) {
    for (const MatchedPair& pair : run.pairs) matches.push_back({&run, pair});
  }
  const auto number = [](std::optional<std::size_t> MatchedPair::*index) {
    return [index](const Match& m) {
      return m.pair.*index ? std::optional(*(m.pair.*index) + 1) : std::nullopt;
    };
  };
  Columns<Match> columns = {{"method", [](const Match& m) { return m.run->setting.method; }},
                            {"reference_index", number(&MatchedPair::first)},
                            {"index", number(&MatchedPair::second)}};
  const auto add = [&](const std::string& name, const std::string& unit, auto SubImpact::*member,
                       bool has_difference) {
    using Value = std::optional<double>;
    const auto reference = [&comparison, member](const Match& m) {
      return m.pair.first ? Value(comparison.reference.sub_impacts[*m.pair.first].*member)
                          : Value();
    };
    const auto own = [member](const Match& m) {
      return m.pair.second ? Value(m.run->result.sub_impacts[*m.pair.second].*member) : Value();
    };
    columns.push_back({"reference_" + name + unit, reference});
    columns.push_back({name + unit, own});
    if (!has_difference) return;
    columns.push_back({name + "_difference" + unit, [=](const Match& m) {
                         const Value here = own(m), there = reference(m);
                         return here && there ? Value(*here - *there) : Value();
                       }});
  };
  add("start", "_s", &SubImpact::start, true);
  add("end", "_s", &SubImpact::end, true);
  add("peak_force", "_N", &SubImpact::peak_force, false);
  add("impulse", "_Ns", &SubImpact::impulse, false);
  return csv_text(columns, matches);
}

std::string model_table(const std::vector<ModelRun>& runs) {
  std::string text;
  for (const ModelRun& run : runs) {
    const Result& result = run.result;
    text += fmt::format(
        "{}: {}, largest force {}, striker {} at the end\n", run.name,
        counted(result.sub_impacts.size(), "sub-impact"),
        total_text(result, RunTotal::peak_force, result.max_force, as_force),
        total_text(result, RunTotal::striker_velocity, result.striker_velocity, as_velocity));
    add_rows(run, runs.front(), text);
    text += '\n';
  }
  for (std::size_t i = 1; i < runs.size(); ++i) text += sentence(runs[i], runs.front()) + '\n';
  return text;
}

}  // namespace subimpact
