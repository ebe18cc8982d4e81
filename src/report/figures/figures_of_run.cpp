// The tables and variables of a run's figures; figures/<name>.gp draws them.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "case/problem.h"
#include "report/figures/figure_script.h"
#include "study/judgement/totals.h"

namespace subimpact {
namespace {

// Adds points to a table of lines that begins with the number of the line.
void add_line(NumberRows& rows, std::size_t number, const std::vector<Point>& points) {
  for (const Point& p : points) rows.push_back({static_cast<double>(number), p.x, p.y});
}

// $sub_impacts, and where zones and sub-zones are. Without an error estimate all count as certain.
void add_sub_impacts(FigureScript& figure, const Result& result) {
  const std::size_t n_certain = result.n_certain().value_or(result.sub_impacts.size());
  NumberRows rows, zones, subzones;
  for (const SubImpact& s : result.sub_impacts) {
    const std::size_t i = rows.size();
    rows.push_back({1.0 + static_cast<double>(i), 1.0 * s.zone, s.start, result.end_of(s),
                    s.impulse, s.certain.value_or(true) ? 1.0 : 0.0, s.start_error.value_or(0.0),
                    s.start_scatter.value_or(0.0)});
    const bool begins_zone = i == 0 || result.sub_impacts[i - 1].zone != s.zone;
    const bool begins = begins_zone || result.sub_impacts[i - 1].subzone != s.subzone;
    if (begins_zone) zones.push_back({s.start, 0.0, 1.0 * s.zone});
    if (begins) subzones.push_back({s.start, 0.0, 1.0 * s.subzone});
    zones.back()[1] = subzones.back()[1] = result.end_of(s);
  }
  figure.table("sub_impacts", "number,zone,from,to,impulse,certain,start_error,start_scatter",
               rows);
  figure.table("zones", "from,to,number", zones);
  figure.table("subzones", "from,to,number", subzones);
  figure.set("end", result.outcome.time);
  figure.set("n_uncertain", static_cast<double>(rows.size() - n_certain));
}

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
      loop.points.push_back({lambda, law.contact_force(history, lambda)});
    }
    loop.times.push_back(row.time);
    loop.points.push_back({row.indentation, row.force});
    history = law.commit(history, row.indentation);
  }
  return loop;
}

struct YieldingAgain {
  std::size_t n = 0;                 // of later sub-impacts that yield again
  std::vector<std::size_t> deepest;  // as many of them as insets can show, in order of time
};

YieldingAgain yielding_again(const Result& result) {
  const auto growth = [&](std::size_t i) {
    return result.sub_impacts[i].residual_indentation -
           result.sub_impacts[i - 1].residual_indentation;
  };
  std::vector<std::size_t> all;
  for (std::size_t i = 1; i < result.sub_impacts.size(); ++i) {
    if (growth(i) > 0.0) all.push_back(i);
  }
  const std::size_t n = all.size();
  if (n > most_insets) {
    std::ranges::stable_sort(all, std::ranges::greater(), growth);
    all.resize(most_insets);
    std::ranges::sort(all);
  }
  return {n, all};
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

// The first rows of shapes nearest to instants that cut the run into equal parts.
std::vector<std::size_t> shapes_drawn(const Result& result, std::size_t n_points) {
  constexpr std::size_t n_drawn = 7;
  std::vector<std::size_t> drawn;
  const std::size_t n_shapes = result.shapes.size() / n_points;
  std::size_t shape = 0;
  for (std::size_t k = 1; k <= n_drawn; ++k) {
    const double t = result.shapes.back().time * static_cast<double>(k) / n_drawn;
    const auto distance = [&](std::size_t i) {
      return std::abs(result.shapes[i * n_points].time - t);
    };
    while (shape + 1 < n_shapes && distance(shape + 1) <= distance(shape)) ++shape;
    if (drawn.empty() || drawn.back() != shape * n_points) drawn.push_back(shape * n_points);
  }
  return drawn;
}

}  // namespace

FigureScript response_figure(const Case& input, const Result& result) {
  FigureScript figure{
      "response",
      "Contact force and displacements over the strike: w_c of the struck point, "
      "w_m of the striker or stop, f_c = w_c − w(0) the beam's deflection at the struck "
      "point. Shaded: sub-impacts, hatched where they are not certain.",
      {800, 580}};
  figure.history({"force_N", "w_c_m", "w_m_m", "f_c_m"}, result.history, {690, 210});
  figure.set("is_stop", input.scene.striker.fixed);
  add_sub_impacts(figure, result);
  figure.set("largest_force", result.max_force);
  figure.set("largest_displacement",
             std::max(largest_magnitude(result.history, &HistoryRow::struck_displacement),
                      largest_magnitude(result.history, &HistoryRow::striker_displacement)));
  return figure;
}

FigureScript first_sub_impact_figure(const Case& input, const Result& result) {
  FigureScript figure{
      "first-sub-impact",
      "Contact force, and stress in the outermost fibre behind the struck point, in "
      "the first sub-impact (shaded). Broken lines: the yield stress and the "
      "instant at which a fibre of the beam first yields.",
      {800, 580}};
  const double end =
      result.sub_impacts.empty() ? result.outcome.time : result.end_of(result.sub_impacts.front());
  const double shown = std::min(1.08 * end, result.outcome.time);
  std::vector<HistoryRow> rows = result.history;
  std::erase_if(rows, [&](const HistoryRow& row) { return row.time > shown; });
  figure.history({"force_N", "stress_back_Pa"}, rows, {690, 210});
  figure.table("bands", "from,to", {{0.0, end}});
  figure.set("end", shown).set("largest_force", result.max_force);
  figure.set("yields_at", result.first_section_yield.value_or(NAN));
  figure.set("yield_stress", input.scene.beam.yield_stress);
  return figure;
}

FigureScript indentation_figure(const Case& input, const Result& result) {
  const std::vector<SubImpact>& hits = result.sub_impacts;
  const auto [n_again, again] = yielding_again(result);
  FigureScript figure{"indentation", caption_text(again.size(), n_again), {800, 520}};
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
    const std::vector<Point> part = loop.part(hits[i].start, result.end_of(hits[i]));
    add_line(loops, insets.size(), thin_for_panel(part, inset, range));
  }
  figure.table("insets", "number,start,from,to,peak", insets);
  figure.table("inset_loops", "inset,x,y", loops);
  figure.set("n_later", static_cast<double>(later.size()));
  figure.set("largest", result.max_indentation).set("largest_force", result.max_force);
  set_mark(figure, "yields", EventKind::contact_yields, result);
  set_mark(figure, "unloads", EventKind::contact_unloads, result);
  return figure;
}

FigureScript energies_figure(const Case& input, const Result& result) {
  FigureScript figure{
      "energies",
      "Energies, and the motion of striker or stop (u_mf = w_m − w(0)) and struck point "
      "(f_c = w_c − w(0)) relative to the beam's end. Above: zones, sub-zones and "
      "sub-impacts, pale where they are not certain; zones are shaded.",
      {800, 660}};
  figure.history({"U_m_J", "U_k_J", "U_e_J", "U_p_J", "D_c_J", "D_b_J", "f_c_m", "u_mf_m"},
                 result.history, {660, 280});
  add_sub_impacts(figure, result);
  figure.set("is_damped", result.beam_damping_loss > 0.0);
  figure.set("is_stop", input.scene.striker.fixed);
  figure.set("initial_energy", result.used.initial_energy);
  figure.set("largest_displacement",
             std::max(largest_magnitude(result.history, &HistoryRow::struck_deflection),
                      largest_magnitude(result.history, &HistoryRow::striker_relative)));
  return figure;
}

FigureScript timeline_figure(const Case&, const Result& result) {
  std::string caption =
      "Every sub-impact at the time it begins: duration and impulse, on logarithmic "
      "axes; numbers count the sub-impacts. Pale with open circles: not certain.";
  const auto any = [&](std::optional<double> SubImpact::*bar) {
    return std::ranges::any_of(
        result.sub_impacts, [&](double x) { return x > 0.0; },
        [&](const SubImpact& s) { return (s.*bar).value_or(0.0); });
  };
  if (any(&SubImpact::start_error)) caption += " Black bars: numerical error of the start.";
  if (any(&SubImpact::start_scatter)) {
    caption += " Purple bars: its standard deviation by the scatter of the case.";
  }
  FigureScript figure{"timeline", caption, {800, 580}};
  add_sub_impacts(figure, result);
  const std::optional<Predictability>& found = result.predictability;
  figure.set("horizon", found && found->first_unpredictable ? found->horizon : NAN);
  return figure;
}

FigureScript bending_figure(const Case& input, const Result& result) {
  const Beam& beam = input.scene.beam;
  const bool yields = may_yield(input);
  const std::size_t n = input.output.sections.size();
  const std::size_t n_panels = std::min(n, most_bending_panels);
  const std::size_t n_columns = n_panels > 4 ? 3 : std::min<std::size_t>(n_panels, 2);
  const int n_rows = static_cast<int>((n_panels + n_columns - 1) / n_columns);
  const FigureSize size{n_columns > 2 ? 1100 : 800, n_rows > 1 ? 360 * n_rows : 420};
  FigureScript figure{
      "bending",
      fmt::format("Bending moment against curvature of {} over the whole run{}. Dots: end of the "
                  "run.",
                  n_panels == 1 ? "a section" : "sections",
                  yields ? ", in units of first yield" : ""),
      size};
  if (n > n_panels) {
    figure.marks.push_back(
        fmt::format("left out: sections {} to {} of output.sections", n_panels + 1, n));
  }
  NumberRows sections, loops, ends;
  for (std::size_t k = 0; k < n_panels; ++k) {
    std::vector<Point> line;
    for (std::size_t i = k; i < result.section_history.size(); i += n) {
      line.push_back({result.section_history[i].curvature, result.section_history[i].moment});
    }
    add_line(loops, k + 1, thin_for_panel(line, {300, 300}));
    sections.push_back({result.section_history[k].position / beam.length});
    add_line(ends, k + 1, {line.back()});
  }
  figure.table("sections", "position", sections);
  figure.table("loops", "section,curvature,moment", loops);
  figure.table("ends", "section,curvature,moment", ends);
  figure.set("n_columns", static_cast<double>(n_columns)).set("n_rows", n_rows);
  figure.set("width", size.width).set("height", size.height).set("yields", yields);
  figure.set("yield_curvature", beam.yield_curvature()).set("yield_moment", beam.yield_moment());
  return figure;
}

FigureScript shapes_figure(const Case& input, const Result& result) {
  FigureScript figure{"shapes",
                      "Displacement and bending moment along the whole beam at some instants of "
                      "the run, from dark to light.",
                      {800, 700}};
  const std::size_t n_points = result.used.n_shape_points;
  NumberRows instants, displacements, moments;
  for (const std::size_t first : shapes_drawn(result, n_points)) {
    instants.push_back({result.shapes[first].time});
    const auto begin = result.shapes.begin() + static_cast<std::ptrdiff_t>(first);
    const std::vector<ShapeRow> shape(begin, begin + static_cast<std::ptrdiff_t>(n_points));
    const auto add = [&](NumberRows& rows, double ShapeRow::*member) {
      const std::vector<Point> line = line_of(shape, &ShapeRow::position, member);
      add_line(rows, instants.size(), thin_for_panel(line, {660, 260}));
    };
    add(displacements, &ShapeRow::displacement);
    add(moments, &ShapeRow::moment);
  }
  figure.table("displacement", "shape,x,y", displacements);
  figure.table("moment", "shape,x,y", moments);
  figure.table("instants", "time", instants);
  figure.set("end", result.outcome.time).set("length", input.scene.beam.length);
  figure.set("largest_displacement", largest_magnitude(result.shapes, &ShapeRow::displacement));
  return figure;
}

FigureScript envelope_figure(const Case& input, const Result& result) {
  const Beam& beam = input.scene.beam;
  const bool yields = !result.plastic_zones.empty();
  FigureScript figure{
      "envelope",
      yields ? "Envelope of the run along the beam: largest and smallest bending moment (dashed: "
               "first yield) and strain of the outer fibre (cut off at six times first yield), and "
               "the "
               "permanent set, the beam's displacement at rest against its supports, of a free one "
               "against its chord, with the plastic "
               "zones."
             : "Envelope of the run along the beam: largest and smallest bending moment, strain of "
               "the outer fibre and displacement.",
      {800, 860}};
  const auto add = [&](const std::string& name, auto value) {
    figure.line(name, line_of(result.envelope, &EnvelopeRow::position, value), {660, 260});
  };
  for (const auto& [name, range] :
       {std::pair("moment", &EnvelopeRow::moment), std::pair("strain", &EnvelopeRow::strain),
        std::pair("displacement", &EnvelopeRow::displacement)}) {
    const auto field = range;
    add(std::string(name) + "_largest",
        [=](const auto& row) { return (row.*field).largest.value; });
    add(std::string(name) + "_smallest",
        [=](const auto& row) { return (row.*field).smallest.value; });
  }
  add("set", &EnvelopeRow::set_from_supports);
  NumberRows zones;
  for (const PlasticZone& zone : result.plastic_zones) zones.push_back({zone.from, zone.to});
  figure.table("zones", "from,to", zones);
  figure.set("length", beam.length).set("yields", yields);
  figure.set("yield_moment", beam.yield_moment());
  figure.set("yield_strain", beam.yield_stress / beam.youngs_modulus);
  figure.set("largest_displacement",
             largest_magnitude(result.envelope, [=](const EnvelopeRow& row) {
               const EnvelopeRow::Range& w = row.displacement;
               return yields ? row.set_from_supports : std::max(w.largest.value, -w.smallest.value);
             }));
  return figure;
}

FigureScript measured_figure(const Overlay& overlay) {
  FigureScript figure{"measured",
                      "The measured force and the computed one on the time of the run, their "
                      "difference (computed less measured), and both about the largest force.",
                      {800, 820}};
  const auto add = [&](const std::string& name, const Signal& signal, AxisRange shown) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < signal.times.size(); ++i) {
      points.push_back({signal.times[i], signal.forces[i]});
    }
    std::erase_if(points, [&](const Point& p) { return p.x < shown.from || p.x > shown.to; });
    figure.line(name, points, {690, 300});
  };
  const double peak_time = overlay.measured.peak_time, span = overlay.to - overlay.from;
  const AxisRange all{overlay.from, overlay.to};
  const AxisRange near{std::max(overlay.from, peak_time - 0.03 * span),
                       std::min(overlay.to, peak_time + 0.03 * span)};
  add("computed", overlay.computed.force, all);
  add("measured", overlay.measured.force, all);
  add("difference", overlay.difference, all);
  add("near_computed", overlay.computed.force, near);
  add("near_measured", overlay.measured.force, near);
  figure.set("from", all.from).set("to", all.to).set("near_from", near.from);
  figure.set("near_to", near.to);
  figure.set("largest_force", std::max(overlay.computed.peak, overlay.measured.peak));
  return figure;
}

FigureScript strikes_figure(const Case&, const Result& result) {
  FigureScript figure{"strikes",
                      "Strike after strike, at the end of each: restitution; dent and permanent "
                      "set of all strikes so far; energy that the strike has dissipated in bending "
                      "and in the contact. Bars: errors, where they are known.",
                      {800, 860}};
  NumberRows rows;
  for (const StrikeRow& row : result.strikes) {
    rows.push_back({static_cast<double>(row.strike), row.restitution.value_or(NAN), row.dent,
                    row.permanent_set, row.bending_dissipated, row.contact_dissipated,
                    row.restitution_error.value_or(0.0), row.permanent_set_error.value_or(0.0)});
  }
  figure.table("strikes", "strike,restitution,dent,set,bending,contact,e_error,set_error", rows);
  figure.set("n", static_cast<double>(rows.size()));
  figure.set("largest_dent", largest_magnitude(result.strikes, &StrikeRow::dent));
  figure.set("largest_set", largest_magnitude(result.strikes, &StrikeRow::permanent_set));
  return figure;
}

}  // namespace subimpact
