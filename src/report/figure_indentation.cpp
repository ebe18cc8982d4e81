// Force against indentation: the whole strike, and sub-impacts that yield again.

#include <fmt/format.h>

#include <algorithm>

#include "case/problem.h"
#include "report/figure_script.h"
#include "subimpact/study/strike_account.h"

namespace subimpact {
namespace {

constexpr std::size_t most_insets = 3;

// Force against indentation of the whole strike. Between two rows the indentation moves one way
// (its turns are events and have rows of their own), so the contact law draws the force in between.
struct Loop {
  std::vector<double> times;
  std::vector<Point> points;

  std::vector<Point> part(double from, double to) const {
    const auto first = std::ranges::lower_bound(times, from) - times.begin();
    const auto last = std::ranges::upper_bound(times, to) - times.begin();
    return {points.begin() + first, points.begin() + std::max(first, last)};
  }
};

Loop loop_of(const ContactLaw& law, const std::vector<HistoryRow>& rows) {
  constexpr int parts = 8;
  Loop loop;
  ContactHistory history;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const HistoryRow& row = rows[i];
    for (int k = 1; k < parts && i > 0 && row.time > rows[i - 1].time; ++k) {
      const HistoryRow& last = rows[i - 1];
      const double lambda = last.indentation + (row.indentation - last.indentation) * k / parts;
      loop.times.push_back(last.time + (row.time - last.time) * k / parts);
      loop.points.push_back({lambda, law.force(history, lambda)});
    }
    loop.times.push_back(row.time);
    loop.points.push_back({row.indentation, row.force});
    history = law.commit(history, row.indentation);
  }
  return loop;
}

double growth_of_residual(std::size_t i, const Result& result) {
  return result.sub_impacts[i].residual_indentation -
         result.sub_impacts[i - 1].residual_indentation;
}

// As many as insets can show, the deepest ones, in order of time.
std::vector<std::size_t> deepest(std::vector<std::size_t> sub_impacts, const Result& result) {
  if (sub_impacts.size() <= most_insets) return sub_impacts;
  std::stable_sort(sub_impacts.begin(), sub_impacts.end(), [&](std::size_t a, std::size_t b) {
    return growth_of_residual(a, result) > growth_of_residual(b, result);
  });
  sub_impacts.resize(most_insets);
  std::sort(sub_impacts.begin(), sub_impacts.end());
  return sub_impacts;
}

std::string caption_text(std::size_t n_drawn, std::size_t n_yielding_again) {
  if (n_drawn == 0) return "Contact force against indentation over the whole strike.";
  const std::string which = n_drawn < n_yielding_again
                                ? fmt::format("the {} deepest of {}", n_drawn, n_yielding_again)
                                : std::string("the");
  return fmt::format(
      "Contact force against indentation: the whole strike, with the first yield of the contact "
      "(A) and the beginning of unloading (B) in the first sub-impact, and {} later sub-impacts "
      "that yield again.",
      which);
}

// Marks a point of the first sub-impact: where the contact first does something.
void set_mark(FigureScript& figure, const std::string& name, EventKind kind, const Result& result) {
  for (const Transition& event : result.transitions) {
    if (event.kind == EventKind::contact_ends) return;
    if (event.kind != kind) continue;
    const auto row = std::ranges::lower_bound(result.history, event.time, {}, &HistoryRow::time);
    figure.set(name + "_x", event.value);
    figure.set(name + "_y", row == result.history.end() ? 0.0 : row->force);
    return;
  }
}

}  // namespace

FigureScript indentation_figure(const Case& input, const Result& result) {
  const std::vector<SubImpact>& hits = result.sub_impacts;
  const std::vector<std::size_t> yielding = yielding_again(result);
  const std::vector<std::size_t> again = deepest(yielding, result);
  FigureScript figure("indentation", caption_text(again.size(), yielding.size()), {800, 520});
  const Loop loop = loop_of(*contact_law_of(input), result.history);
  const AxisRange shown{0.0, 1.06 * result.max_indentation};
  const FigureSize panel{again.empty() ? 700 : 410, 420};
  std::vector<Point> later;
  if (hits.size() > 1) later = loop.part(hits[1].start, result.outcome.time);
  const double first_end = hits.empty() ? 0.0 : result.end_of(hits.front());
  figure.line("later", later, panel, shown);
  figure.line("first", loop.part(0.0, first_end), panel, shown);
  NumberRows insets, loops;
  for (const std::size_t i : again) {
    const AxisRange range{hits[i - 1].residual_indentation, hits[i].max_indentation};
    insets.push_back(
        {static_cast<double>(i + 1), hits[i].start, range.from, range.to, hits[i].peak_force});
    const FigureSize inset{210, 380 / static_cast<int>(again.size())};
    for (const Point& p :
         thin_for_panel(loop.part(hits[i].start, result.end_of(hits[i])), inset, range)) {
      loops.push_back({static_cast<double>(insets.size()), p.x, p.y});
    }
  }
  figure.table("insets", "number,start,from,to,peak", insets);
  figure.table("inset_loops", "inset,x,y", loops);
  figure.set("n_later", static_cast<double>(later.size()));
  figure.set("largest", result.max_indentation).set("largest_force", result.max_force);
  set_mark(figure, "yields", EventKind::contact_yields, result);
  set_mark(figure, "unloads", EventKind::contact_unloads, result);
  return figure;
}

}  // namespace subimpact
