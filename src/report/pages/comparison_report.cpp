#include "subimpact/report/pages.h"

#include <fmt/format.h>

#include <algorithm>

#include "case/counted.h"
#include "report/pages/page.h"
#include "report/text/uncertain.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/report/text.h"
#include "subimpact/study/judgement/event_errors.h"

namespace subimpact {
namespace {

std::string letter(std::size_t i) {
  return i < 26 ? std::string(1, static_cast<char>('A' + i)) : fmt::format("run {}", i + 1);
}

Json differing_keys(const std::vector<FinishedRun>& runs) {
  Json list = Json::array();
  for (const CaseKey& key : case_keys()) {
    const Json values = list_of(runs, [&](const FinishedRun& run) -> std::string {
      const std::optional<KeyValue> value = key.get(run.input);
      return value ? to_text(*value) + (key.unit.empty() ? "" : " " + key.unit) : "–";
    });
    const bool differ =
        std::ranges::any_of(values, [&](const Json& value) { return value != values.front(); });
    if (differ) list.push_back({{"key", key.name}, {"values", values}});
  }
  return list;
}

// What is asked of each run first, and how it was computed.
Json answer_rows(const std::vector<FinishedRun>& runs) {
  std::vector<std::vector<LabelledText>> all;
  std::vector<std::string> names;
  for (const FinishedRun& run : runs) {
    Result result = run.result;
    make_answers(run.input, result);
    std::vector<LabelledText>& list = all.emplace_back();
    for (const Answer& answer : result.answers) {
      if (answer.value) list.push_back({answer.label, answer.text, ""});
    }
    list.push_back({"outcome", std::string(to_string(run.result.outcome.kind)), ""});
    list.push_back({"mesh", run.result.used.mesh, ""});
    list.push_back({"method", std::string(to_string(run.input.solver.method)), ""});
    list.push_back({"time to compute", duration_text(run.result.work.all_seconds), ""});
    for (const LabelledText& answer : list) {
      if (std::ranges::find(names, answer.label) == names.end()) names.push_back(answer.label);
    }
  }
  return list_of(names, [&](const std::string& name) -> Json {
    const auto value_in = [&](const std::vector<LabelledText>& list) {
      const auto found = std::ranges::find(list, name, &LabelledText::label);
      return found == list.end() ? std::string("–") : in_print(found->text);
    };
    return {{"name", name}, {"values", list_of(all, value_in)}};
  });
}

std::string signed_text(double x, const char* format) {
  std::string text = fmt::format(fmt::runtime(format), x);
  if (text.front() == '-') text.replace(0, 1, "−");
  return text;
}

Json pair_row(const MatchedPair& pair, const Result& first, const Result& second) {
  const SubImpact* a = pair.first ? &first.sub_impacts[*pair.first] : nullptr;
  const SubImpact* b = pair.second ? &second.sub_impacts[*pair.second] : nullptr;
  const SubImpact& shown = a ? *a : second.sub_impacts[pair.second.value()];
  const auto number = [](const std::optional<std::size_t>& index) {
    return index ? fmt::format("{}", *index + 1) : "none";
  };
  std::vector<std::string> cells = {number(pair.first), number(pair.second),
                                    fmt::format("{:.3f}", 1e6 * shown.start)};
  if (a && b) {
    cells.push_back(signed_text(1e6 * (b->start - a->start), "{:+.4f}"));
    cells.push_back(a->end && b->end ? signed_text(1e6 * (*b->end - *a->end), "{:+.4f}") : "");
    cells.push_back(a->start_error && b->start_error
                        ? fmt::format("± {:.4f}", 1e6 * (*a->start_error + *b->start_error))
                        : "not known");
    cells.push_back(signed_text(100.0 * (b->peak_force / a->peak_force - 1.0), "{:+.3f}"));
    cells.push_back(signed_text(100.0 * (b->impulse / a->impulse - 1.0), "{:+.3f}"));
  }
  cells.resize(8);
  return {{"from", shown.start},
          {"to", (a ? first : second).end_of(shown)},
          {"row_class", a && b ? "" : " class=\"uncertain\""},
          {"cells", cells}};
}

std::string pair_words(const std::vector<MatchedPair>& pairs, const Result& first,
                       const Result& second, std::size_t run) {
  const std::size_t n = n_leading_matches(pairs);
  const double largest = event_errors(second.sub_impacts, first.sub_impacts).starts;
  std::string text =
      n == 1 ? std::string("The first sub-impacts correspond")
             : fmt::format("The first {} correspond one to one", counted(n, "sub-impact"));
  if (n > 0) text += fmt::format("; their starts differ by {} at most", error_text(largest));
  if (n == pairs.size()) return text + ".";
  if (const auto other = first_unmatched(pairs, first.sub_impacts, second.sub_impacts)) {
    text += fmt::format("; from {} on they differ: a contact of {} is in only one of A and {}",
                        duration_text(other->start), duration_text(other->duration), letter(run));
  }
  return text + ".";
}

}  // namespace

std::string comparison_report(const std::vector<FinishedRun>& runs,
                              const std::vector<std::string>& names,
                              const std::filesystem::path& dygraphs) {
  const Result& first = runs.front().result;
  std::vector<std::string> labels;
  std::vector<const Result*> results;
  Json lines = Json::array(), rows = Json::array(), pairs = Json::array();
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Result& result = runs[i].result;
    labels.push_back(letter(i) + ": " + names[i]);
    results.push_back(&result);
    rows.push_back({{"letter", letter(i)}, {"name", names[i]}});
    if (i == 0) continue;
    const auto matched = match_sub_impacts(first.sub_impacts, result.sub_impacts);
    const std::string words = in_print(pair_words(matched, first, result, i));
    lines.push_back(headline(n_leading_matches(matched) == matched.size(), words));
    lines.back()["about"] = fmt::format("{} compared with A:", letter(i));
    const auto row = [&](const MatchedPair& pair) { return pair_row(pair, first, result); };
    pairs.push_back({{"letter", letter(i)}, {"words", words}, {"rows", list_of(matched, row)}});
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::string caveat = outcome_caveat(runs[i].result);
    if (!caveat.empty()) lines.push_back(headline(false, letter(i) + ": " + caveat + "."));
  }
  const Json keys = differing_keys(runs);
  const std::string& title = runs.front().input.title;
  const Json page = {{"title", fmt::format("Comparison: {}", title.empty() ? "a strike" : title)},
                     {"versions", runs.front().program_version},
                     {"data", comparison_data(labels, results)},
                     {"headlines", lines},
                     {"runs", rows},
                     {"answers", answer_rows(runs)},
                     {"keys", keys},
                     {"same_keys", keys.empty()},
                     {"pairs", pairs}};
  return whole_page("pages/web/compare.html", page, chart_library(dygraphs),
                    {"pages/web/data.js", "pages/web/axes.js", "pages/web/motion.js",
                     "pages/web/panels.js", "pages/web/compare.js"});
}

}  // namespace subimpact
