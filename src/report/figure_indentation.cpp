// Force against indentation: the whole strike, and sub-impacts that yield again.

#include <fmt/format.h>

#include <algorithm>

#include "case/problem.h"
#include "report/figure_script.h"

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

double end_of(const SubImpact& s, const Result& result) {
  return s.end.value_or(result.outcome.time);
}

double growth_of_residual(std::size_t i, const Result& result) {
  return result.sub_impacts[i].residual_indentation -
         result.sub_impacts[i - 1].residual_indentation;
}

// Those after the first in which the contact yielded.
std::vector<std::size_t> yielding_again(const Result& result) {
  std::vector<std::size_t> found;
  for (std::size_t i = 1; i < result.sub_impacts.size(); ++i) {
    if (growth_of_residual(i, result) > 0.0) found.push_back(i);
  }
  return found;
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

void mark_point(FigureScript& figure, const Units& units, const Transition* event,
                const Result& result, const char* text, const char* offset) {
  if (event == nullptr) return;
  figure << fmt::format(
      "set label '{}' at {:.7g}, {:.7g} point pt 7 ps 1.2 lc rgb '#000000' {} front\n", text,
      event->value * units.length.factor, force_at(event->time, result) * units.force.factor,
      offset);
}

}  // namespace

FigureScript indentation_figure(const Case& input, const Result& result) {
  const auto law = contact_law_of(input);
  const Units units{length_unit(result.max_indentation), force_unit(result.max_force)};
  const double length = units.length.factor, force = units.force.factor;
  const std::vector<std::size_t> yielding = yielding_again(result);
  const std::vector<std::size_t> again = deepest(yielding, result);
  FigureScript figure("indentation", caption_text(again.size(), yielding.size()), {800, 520});
  const Box main{0.10, again.empty() ? 0.97 : 0.61, 0.14, 0.95};
  const AxisRange shown{0.0, 1.06 * result.max_indentation * length};
  std::string rest;
  if (result.sub_impacts.size() > 1) {
    rest = figure.line(loop(*law, units, result, result.sub_impacts[1].start, result.outcome.time),
                       main, shown);
  }
  const double first_end =
      result.sub_impacts.empty() ? 0.0 : end_of(result.sub_impacts.front(), result);
  const std::string first_loop =
      figure.line(loop(*law, units, result, 0.0, first_end), main, shown);

  figure.place(main);
  figure << fmt::format("set xlabel 'indentation, {}'\nset ylabel 'contact force, {}' offset 0.5\n",
                        units.length.name, units.force.name)
         << "set yrange [0:*]\nset offsets 0, 0, graph 0.06, 0\n"
         // Under the yielding branch; an elastic contact leaves no room there.
         << (result.first_contact_yield
                 ? "set key bottom left Left reverse at graph 0.13, graph 0.05 samplen 2.5\n"
                 : "set key bottom right samplen 2.5\n");
  figure << fmt::format("set xrange [0:{:.7g}]\nset xtics {}\n", shown.to,
                        tic_spacing(result.max_indentation * length, 4));
  mark_point(figure, units, first(EventKind::contact_yields, result), result, "A: contact yields",
             "left offset 1, -0.4");
  mark_point(figure, units, first(EventKind::contact_unloads, result), result,
             "B: unloading begins", "right offset -1, 1");
  figure << "plot ";
  if (!rest.empty()) {
    figure << fmt::format("{} with lines lc rgb '#A0A0A0' lw 1 title 'later sub-impacts', ", rest);
  }
  figure << fmt::format("{} with lines lc 1 title 'first sub-impact'\n", first_loop)
         << "unset label\nset offsets 0, 0, graph 0.06, 0\n";

  const double height = 0.82 / static_cast<double>(std::max<std::size_t>(again.size(), 1));
  for (std::size_t k = 0; k < again.size(); ++k) {
    const SubImpact& s = result.sub_impacts[again[k]];
    const double top = 0.95 - height * static_cast<double>(k);
    const bool last = k + 1 == again.size();
    const Box inset{0.71, 0.97, top - height + (last ? 0.01 : 0.08), top - 0.045};
    const double lowest = result.sub_impacts[again[k] - 1].residual_indentation;
    const double margin = 0.1 * (s.max_indentation - lowest) * length;
    const AxisRange range{lowest * length - margin, s.max_indentation * length + margin};
    const std::string data =
        figure.line(loop(*law, units, result, s.start, end_of(s, result)), inset, range);
    figure.place(inset);
    figure << fmt::format("set title 'no. {}, at {:.4g} ms' offset 0, -0.7 font ',13'\n",
                          again[k] + 1, s.start * 1e3)
           << (last ? fmt::format("set xlabel 'indentation, {}'\n", units.length.name)
                    : std::string("unset xlabel\n"))
           << fmt::format(
                  "set ylabel '{}' offset 1.5\nset xrange [{:.7g}:{:.7g}]\nset xtics {}\nset ytics "
                  "{}\nunset key\n",
                  units.force.name, range.from, range.to,
                  tic_spacing((s.max_indentation - lowest) * length, 3),
                  tic_spacing(s.peak_force * force, 3))
           << fmt::format("plot {} with lines lc {} lw 1.2 notitle\n", data, k + 2);
  }
  return figure;
}

}  // namespace subimpact
