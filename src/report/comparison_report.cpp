#include "subimpact/report/comparison_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/counted.h"
#include "io/uncertain.h"
#include "io/write_file.h"
#include "report/files.h"
#include "report/page_data.h"
#include "report/page_parts.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/report.h"
#include "subimpact/io/results.h"
#include "subimpact/study/match.h"

namespace subimpact {
namespace {

std::string letter(std::size_t i) {
  return i < 26 ? std::string(1, static_cast<char>('A' + i)) : fmt::format("run {}", i + 1);
}

std::string text_of(const CaseKey& key, const Case& input) {
  const std::optional<KeyValue> value = key.get(input);
  return value ? to_text(*value) + (key.unit.empty() ? "" : " " + key.unit) : "–";
}

FieldList differing_keys(const std::vector<FinishedRun>& runs) {
  FieldList list;
  for (const CaseKey& key : case_keys()) {
    std::vector<std::string> values;
    for (const FinishedRun& run : runs) values.push_back(text_of(key, run.input));
    if (std::ranges::all_of(values, [&](const std::string& v) { return v == values.front(); })) {
      continue;
    }
    list.push_back({{{"key", key.name}}, {{"values", list_of("value", values)}}});
  }
  return list;
}

FieldList run_list(const std::vector<FinishedRun>& runs, const std::vector<std::string>& names) {
  FieldList list;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Result& result = runs[i].result;
    list.push_back(
        {{{"letter", letter(i)},
          {"name", names[i]},
          {"outcome", fmt::format("{} at {}", to_string(result.outcome.kind),
                                  duration_text(result.outcome.time))},
          {"sub_impacts", fmt::format("{} in {}{}", result.sub_impacts.size(),
                                      counted(summarise_zones(result.sub_impacts).size(), "zone"),
                                      decided_words(result))},
          {"force", fmt::format("{:.5g} N", result.max_force)},
          {"mesh", result.used.mesh},
          {"method", std::string(to_string(runs[i].input.solver.method))},
          {"wall", duration_text(result.work.wall_seconds)}},
         {}});
  }
  return list;
}

// Both error bars together, s; none where one of them is not known.
std::optional<double> both_errors(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? std::optional(*a + *b) : std::nullopt;
}

// A number with its sign, as it is set in print.
std::string signed_text(double x, const char* format) {
  std::string text = fmt::format(fmt::runtime(format), x);
  if (text.front() == '-') text.replace(0, 1, "−");
  return text;
}

struct PairRow {
  std::vector<std::string> cells;
  double from, to;
  bool matched;
};

PairRow pair_row(const MatchedPair& pair, const Result& first, const Result& second) {
  if (!pair.first || !pair.second) {
    const Result& owner = pair.first ? first : second;
    const std::size_t index = pair.first ? *pair.first : *pair.second;
    const SubImpact& s = owner.sub_impacts[index];
    const std::string number = fmt::format("{}", index + 1);
    return {{pair.first ? number : "none", pair.first ? "none" : number,
             fmt::format("{:.3f}", 1e6 * s.start), "", "", "", "", ""},
            s.start,
            owner.end_of(s),
            false};
  }
  const SubImpact& a = first.sub_impacts[*pair.first];
  const SubImpact& b = second.sub_impacts[*pair.second];
  const std::optional<double> error = both_errors(a.start_error, b.start_error);
  const bool both_end = a.end && b.end;
  return {{fmt::format("{}", *pair.first + 1), fmt::format("{}", *pair.second + 1),
           fmt::format("{:.3f}", 1e6 * a.start), signed_text(1e6 * (b.start - a.start), "{:+.4f}"),
           both_end ? signed_text(1e6 * (*b.end - *a.end), "{:+.4f}") : "",
           error ? fmt::format("± {:.4f}", 1e6 * *error) : "not known",
           signed_text(100.0 * (b.peak_force / a.peak_force - 1.0), "{:+.3f}"),
           signed_text(100.0 * (b.impulse / a.impulse - 1.0), "{:+.3f}")},
          a.start,
          first.end_of(a),
          true};
}

std::string pair_words(const std::vector<MatchedPair>& pairs, const Result& first,
                       const Result& second, std::size_t run) {
  const std::size_t n = n_leading_matches(pairs);
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    largest = std::max(largest, std::abs(second.sub_impacts[*pairs[i].second].start -
                                         first.sub_impacts[*pairs[i].first].start));
  }
  std::string text = fmt::format("The first {} correspond one to one", counted(n, "sub-impact"));
  if (n > 0) text += fmt::format("; their starts differ by {} at most", error_text(largest));
  if (n == pairs.size()) return text + ".";
  if (const auto other = first_unmatched(pairs, first.sub_impacts, second.sub_impacts)) {
    text += fmt::format("; from {} on they part, where a contact of {} is in one of A and {} only",
                        duration_text(other->start), duration_text(other->duration), letter(run));
  }
  return text + ".";
}

Fields pair_table(const Result& first, const Result& second, std::size_t run) {
  const auto pairs = match_sub_impacts(first.sub_impacts, second.sub_impacts);
  FieldList rows;
  for (const MatchedPair& pair : pairs) {
    const PairRow row = pair_row(pair, first, second);
    rows.push_back({{{"from", fmt::format("{}", row.from)},
                     {"to", fmt::format("{}", row.to)},
                     {"row_class", row.matched ? "" : " class=\"undecided\""}},
                    {{"cells", list_of("cell", row.cells)}}});
  }
  return {{{"letter", letter(run)}, {"words", in_print(pair_words(pairs, first, second, run))}},
          {{"rows", rows}}};
}

FieldList headlines(const std::vector<FinishedRun>& runs) {
  FieldList list;
  const Result& first = runs.front().result;
  for (std::size_t i = 1; i < runs.size(); ++i) {
    const Result& result = runs[i].result;
    const auto pairs = match_sub_impacts(first.sub_impacts, result.sub_impacts);
    const bool all = n_leading_matches(pairs) == pairs.size();
    Fields line = headline(all, pair_words(pairs, first, result, i));
    line.texts["about"] = fmt::format("{} beside A:", letter(i));
    list.push_back(line);
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string caveat = outcome_caveat(runs[i].result);
    if (!caveat.empty()) list.push_back(headline(false, letter(i) + ": " + caveat + "."));
  }
  return list;
}

}  // namespace

std::string comparison_report(const std::vector<FinishedRun>& runs,
                              const std::vector<std::string>& names,
                              const std::filesystem::path& dygraphs) {
  std::vector<std::string> labels;
  std::vector<const Result*> results;
  FieldList pairs;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    labels.push_back(letter(i) + ": " + names[i]);
    results.push_back(&runs[i].result);
    if (i > 0) pairs.push_back(pair_table(runs.front().result, runs[i].result, i));
  }
  const FieldList keys = differing_keys(runs);
  const std::string& title = runs.front().input.title;
  Fields page{{{"title", title.empty() ? "a strike" : title},
               {"versions", runs.front().program_version},
               {"data", comparison_data(labels, results)}},
              {{"headlines", headlines(runs)},
               {"runs", run_list(runs, names)},
               {"keys", keys},
               {"same_keys", if_given(keys.empty())},
               {"pairs", pairs}}};
  add_scripts(page, chart_library(dygraphs), "pages/compare.js");
  return filled(embedded_file("pages/compare.html"), page);
}

void write_comparison_report(const std::filesystem::path& directory,
                             const std::vector<FinishedRun>& runs,
                             const std::vector<std::string>& names,
                             const std::filesystem::path& dygraphs) {
  write_file(directory / "comparison.html", comparison_report(runs, names, dygraphs));
}

}  // namespace subimpact
