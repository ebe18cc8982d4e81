// Force against indentation: the whole strike, and sub-impacts that yield again.

#include <fmt/format.h>

#include <algorithm>

#include "case/problem.h"
#include "report/figure_script.h"
#include "report/strike_words.h"

namespace subimpact {
namespace {

struct Units {
  Unit length, force;
};
constexpr std::size_t most_insets = 3;

// Between two rows the indentation moves one way (its turns are events and have rows of their own),
// so the contact law draws the force in between.
std::vector<Point> loop(const ContactLaw& law, const Units& units, const Result& result,
                        double from, double to) {
  constexpr int parts = 8;
  std::vector<Point> line;
  ContactHistory history;
  const HistoryRow* last = nullptr;
  const double length = units.length.factor, force = units.force.factor;
  for (const HistoryRow& row : result.history) {
    const bool shown = row.time >= from && row.time <= to;
    if (shown && last != nullptr && last->time >= from && row.time > last->time) {
      for (int k = 1; k < parts; ++k) {
        const double lambda = last->indentation + (row.indentation - last->indentation) * k / parts;
        line.push_back({lambda * length, law.force(history, lambda) * force});
      }
    }
    if (shown) line.push_back({row.indentation * length, row.force * force});
    history = law.commit(history, row.indentation);
    last = &row;
  }
  return line;
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

// Where, within the first sub-impact, the contact first does something.
const Transition* first(EventKind kind, const Result& result) {
  for (const Transition& event : result.transitions) {
    if (event.kind == EventKind::contact_ends) return nullptr;
    if (event.kind == kind) return &event;
  }
  return nullptr;
}

double force_at(double time, const Result& result) {
  for (const HistoryRow& row : result.history) {
    if (row.time >= time) return row.force;
  }
  return 0.0;
}

// A mark in the first sub-impact: its coordinates in the figure.
void set_mark(FigureScript& figure, const std::string& name, const Units& units,
              const Transition* event, const Result& result) {
  if (event == nullptr) return;
  figure.set(name + "_x", event->value * units.length.factor);
  figure.set(name + "_y", force_at(event->time, result) * units.force.factor);
}

}  // namespace

FigureScript indentation_figure(const Case& input, const Result& result) {
  const auto law = contact_law_of(input);
  const Units units{length_unit(result.max_indentation), force_unit(result.max_force)};
  const double length = units.length.factor, force = units.force.factor;
  const std::vector<std::size_t> yielding = yielding_again(result);
  const std::vector<std::size_t> again = deepest(yielding, result);
  FigureScript figure("indentation", caption_text(again.size(), yielding.size()), {800, 520});
  const AxisRange shown{0.0, 1.06 * result.max_indentation * length};
  const FigureSize panel{again.empty() ? 700 : 410, 420};
  std::vector<Point> later;
  if (result.sub_impacts.size() > 1) {
    later = loop(*law, units, result, result.sub_impacts[1].start, result.outcome.time);
  }
  const double first_end =
      result.sub_impacts.empty() ? 0.0 : result.end_of(result.sub_impacts.front());
  figure.line("later", later, panel, shown);
  figure.line("first", loop(*law, units, result, 0.0, first_end), panel, shown);
  NumberRows insets, loops;
  for (const std::size_t i : again) {
    const SubImpact& s = result.sub_impacts[i];
    const AxisRange range{result.sub_impacts[i - 1].residual_indentation * length,
                          s.max_indentation * length};
    insets.push_back(
        {static_cast<double>(i + 1), s.start * 1e3, range.from, range.to, s.peak_force * force});
    const double inset = static_cast<double>(insets.size());
    for (const Point& p : thin_for_panel(loop(*law, units, result, s.start, result.end_of(s)),
                                         {210, 380 / static_cast<int>(again.size())}, range)) {
      loops.push_back({inset, p.x, p.y});
    }
  }
  figure.table("insets", "number,start_ms,from,to,peak", insets);
  figure.table("inset_loops", "inset,x,y", loops);
  figure.set("n_later", static_cast<double>(later.size()));
  figure.set("largest", result.max_indentation * length);
  figure.set("force_unit", units.force.name).set("length_unit", units.length.name);
  set_mark(figure, "yields", units, first(EventKind::contact_yields, result), result);
  set_mark(figure, "unloads", units, first(EventKind::contact_unloads, result), result);
  return figure;
}

}  // namespace subimpact
