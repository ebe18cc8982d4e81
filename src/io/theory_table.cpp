#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "case/case_choices.h"
#include "case/counted.h"
#include "io/sub_impact_rows.h"
#include "subimpact/io/report.h"

namespace subimpact {
namespace {

constexpr double us = 1e6;  // per second

std::string name_of(BeamTheory theory) {
  for (const auto& row : names_of(theory)) {
    if (row.value == theory) return row.name;
  }
  return {};
}

// "+20.29": how much later than in the first theory, to a hundredth of a microsecond.
std::string later(const std::optional<double>& time, const std::optional<double>& first) {
  return time && first ? fmt::format("{:+.2f}", us * (*time - *first)) : std::string("-");
}

// One line per sub-impact of a run.
void add_rows(const TheoryRun& run, const TheoryRun& first, fmt::memory_buffer& text) {
  const SubImpactRows table = sub_impact_rows(run.result);
  fmt::format_to(std::back_inserter(text), "{:>4} {:>{}} {:>{}} {:>12} {:>12}\n", "no.",
                 "start, us", table.columns[1].width, "end, us", table.columns[2].width,
                 "start later", "end later");
  for (const MatchedPair& pair : run.pairs) {
    if (!pair.second) continue;
    const auto& cells = table.rows[*pair.second].cells;
    const SubImpact& here = run.result.sub_impacts[*pair.second];
    const SubImpact* there = pair.first ? &first.result.sub_impacts[*pair.first] : nullptr;
    fmt::format_to(std::back_inserter(text), "{:>4} {:>{}} {:>{}} {:>12} {:>12}\n", cells[0],
                   cells[1], table.columns[1].width, cells[2], table.columns[2].width,
                   there ? later(here.start, there->start) : "-",
                   there ? later(here.end, there->end) : "-");
  }
}

std::string sentence(const TheoryRun& run, const TheoryRun& first) {
  const std::size_t n = n_leading_matches(run.pairs);
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const SubImpact& here = run.result.sub_impacts[i];
    const SubImpact& there = first.result.sub_impacts[i];
    largest = std::max(largest, std::abs(here.start - there.start));
    if (here.end && there.end) largest = std::max(largest, std::abs(*here.end - *there.end));
  }
  std::string text = fmt::format("{}: {}, {} by {}", name_of(run.theory),
                                 counted(run.result.sub_impacts.size(), "sub-impact"),
                                 first.result.sub_impacts.size(), name_of(first.theory));
  if (n > 0) {
    text +=
        fmt::format("; the first {} correspond, with times up to {:.2f} us apart", n, us * largest);
  }
  return text;
}

}  // namespace

std::string theory_table(const std::vector<TheoryRun>& runs) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (const TheoryRun& run : runs) {
    fmt::format_to(out, "{}\n", name_of(run.theory));
    add_rows(run, runs.front(), text);
    fmt::format_to(out, "\n");
  }
  for (const TheoryRun& run : runs) {
    if (&run != &runs.front()) fmt::format_to(out, "{}\n", sentence(run, runs.front()));
  }
  return fmt::to_string(text);
}

}  // namespace subimpact
