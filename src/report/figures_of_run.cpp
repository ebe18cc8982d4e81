// The tables and variables of a run's figures; figures/<name>.gp draws them. That of force against
// indentation has a file of its own.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_script.h"
#include "subimpact/study/strike_account.h"

namespace subimpact {
namespace {

template <class Row, class Value>
double largest(const std::vector<Row>& rows, Value value) {
  double found = 0.0;
  for (const Row& row : rows) found = std::max(found, std::abs(std::invoke(value, row)));
  return found;
}

// The table $sub_impacts, and where their zones and sub-zones are. Without an error estimate all
// count as decided.
void add_sub_impacts(FigureScript& figure, const Result& result) {
  const std::size_t n_decided = result.n_decided().value_or(result.sub_impacts.size());
  NumberRows rows, zones, subzones;
  for (const SubImpact& s : result.sub_impacts) {
    const std::size_t i = rows.size();
    rows.push_back({1.0 + static_cast<double>(i), 1.0 * s.zone, s.start, result.end_of(s),
                    s.impulse, i < n_decided ? 1.0 : 0.0, s.start_error.value_or(0.0),
                    s.start_scatter.value_or(0.0)});
  }
  for (const StrikePart& part : strike_parts(result)) {
    if (part.kind == StrikePart::Kind::zone) {
      zones.push_back({part.start, part.end, 1.0 * part.zone});
    } else if (part.kind == StrikePart::Kind::subzone) {
      subzones.push_back({part.start, part.end, 1.0 * part.subzone});
    }
  }
  figure.table("sub_impacts", "number,zone,from,to,impulse,decided,start_error,start_scatter",
               rows);
  figure.table("zones", "from,to,number", zones);
  figure.table("subzones", "from,to,number", subzones);
  figure.set("end", result.outcome.time);
  figure.set("n_undecided", static_cast<double>(rows.size() - n_decided));
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

FigureScript response_figure(const Case&, const Result& result) {
  FigureScript figure("response",
                      "Contact force and displacements over the strike: w_c of the struck point, "
                      "w_m of the striker, f_c = w_c − w(0) the beam's deflection at the struck "
                      "point. Shaded: sub-impacts, hatched where they are not decided.",
                      {800, 580});
  figure.history({"force_N", "w_c_m", "w_m_m", "f_c_m"}, result.history, {690, 210});
  add_sub_impacts(figure, result);
  figure.set("largest_force", result.max_force);
  figure.set("largest_displacement",
             std::max(largest(result.history, &HistoryRow::struck_displacement),
                      largest(result.history, &HistoryRow::striker_displacement)));
  return figure;
}

FigureScript first_sub_impact_figure(const Case& input, const Result& result) {
  FigureScript figure(
      "first-sub-impact",
      "Contact force, and stress in the outermost fibre behind the struck point, in "
      "the first sub-impact (shaded). Broken lines: the yield stress and the "
      "instant at which a fibre of the beam first yields.",
      {800, 580});
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

FigureScript energies_figure(const Case&, const Result& result) {
  FigureScript figure("energies",
                      "Energies, and the motion of striker (u_mf = w_m − w(0)) and struck point "
                      "(f_c = w_c − w(0)) relative to the beam's end. Above: zones, sub-zones and "
                      "sub-impacts, pale where they are not decided; zones are shaded.",
                      {800, 660});
  figure.history({"U_m_J", "U_k_J", "U_e_J", "U_p_J", "D_c_J", "D_b_J", "f_c_m", "u_mf_m"},
                 result.history, {660, 280});
  add_sub_impacts(figure, result);
  figure.set("is_damped", result.beam_damping_loss > 0.0);
  figure.set("initial_energy", result.used.initial_energy);
  figure.set("largest_displacement",
             std::max(largest(result.history, &HistoryRow::struck_deflection),
                      largest(result.history, &HistoryRow::striker_relative)));
  return figure;
}

FigureScript timeline_figure(const Case&, const Result& result) {
  std::string caption =
      "Every sub-impact at the time it begins: duration and impulse, on logarithmic "
      "axes; numbers count the sub-impacts. Pale with open circles: not decided.";
  const auto any = [&](std::optional<double> SubImpact::*bar) {
    return std::ranges::any_of(
        result.sub_impacts, [&](double x) { return x > 0.0; },
        [&](const SubImpact& s) { return (s.*bar).value_or(0.0); });
  };
  if (any(&SubImpact::start_error)) caption += " Black bars: numerical error of the start.";
  if (any(&SubImpact::start_scatter)) {
    caption += " Purple bars: its standard deviation by the scatter of the case.";
  }
  FigureScript figure("timeline", caption, {800, 580});
  add_sub_impacts(figure, result);
  const std::optional<Predictability>& found = result.predictability;
  figure.set("horizon", found && found->first_unpredictable ? found->horizon : NAN);
  return figure;
}

FigureScript bending_figure(const Case& input, const Result& result) {
  const Beam& beam = input.scene.beam;
  const bool yields = may_yield(result);
  const std::size_t n = input.output.sections.size();
  const std::size_t n_panels = std::min(n, most_bending_panels);
  const std::size_t n_columns = n_panels > 4 ? 3 : std::min<std::size_t>(n_panels, 2);
  const int n_rows = static_cast<int>((n_panels + n_columns - 1) / n_columns);
  const FigureSize size{n_columns > 2 ? 1100 : 800, n_rows > 1 ? 360 * n_rows : 420};
  FigureScript figure(
      "bending",
      fmt::format("Bending moment against curvature of {} over the whole run{}. Dots: end of the "
                  "run.",
                  n_panels == 1 ? "a section" : "sections",
                  yields ? ", in units of first yield" : ""),
      size);
  if (n > n_panels) {
    figure.mark(fmt::format("left out: sections {} to {} of output.sections", n_panels + 1, n));
  }
  NumberRows sections, loops, ends;
  for (std::size_t k = 0; k < n_panels; ++k) {
    const double number = static_cast<double>(k + 1);
    std::vector<Point> line;
    for (std::size_t i = k; i < result.section_history.size(); i += n) {
      line.push_back({result.section_history[i].curvature, result.section_history[i].moment});
    }
    for (const Point& p : thin_for_panel(line, {300, 300})) loops.push_back({number, p.x, p.y});
    sections.push_back({result.section_history[k].position / beam.length});
    ends.push_back({number, line.back().x, line.back().y});
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
  FigureScript figure("shapes",
                      "Displacement and bending moment along the whole beam at some instants of "
                      "the run, from dark to light.",
                      {800, 700});
  const std::size_t n_points = result.used.n_shape_points;
  NumberRows instants, displacements, moments;
  for (const std::size_t first : shapes_drawn(result, n_points)) {
    instants.push_back({result.shapes[first].time});
    const auto begin = result.shapes.begin() + static_cast<std::ptrdiff_t>(first);
    const std::vector<ShapeRow> shape(begin, begin + static_cast<std::ptrdiff_t>(n_points));
    const double number = static_cast<double>(instants.size());
    const auto add = [&](NumberRows& rows, double ShapeRow::*member) {
      for (const Point& p :
           thin_for_panel(line_of(shape, &ShapeRow::position, member), {660, 260})) {
        rows.push_back({number, p.x, p.y});
      }
    };
    add(displacements, &ShapeRow::displacement);
    add(moments, &ShapeRow::moment);
  }
  figure.table("displacement", "shape,x,y", displacements);
  figure.table("moment", "shape,x,y", moments);
  figure.table("instants", "time", instants);
  figure.set("end", result.outcome.time).set("length", input.scene.beam.length);
  figure.set("largest_displacement", largest(result.shapes, &ShapeRow::displacement));
  return figure;
}

FigureScript envelope_figure(const Case& input, const Result& result) {
  const Beam& beam = input.scene.beam;
  const bool yields = !result.plastic_zones.empty();
  FigureScript figure(
      "envelope",
      yields ? "Envelope of the run along the beam: largest and smallest bending moment (dashed: "
               "first yield) and strain of the outer fibre (cut off at six times first yield), and "
               "the "
               "permanent set, the beam's displacement at rest against its chord, with the plastic "
               "zones."
             : "Envelope of the run along the beam: largest and smallest bending moment, strain of "
               "the outer fibre and displacement.",
      {800, 860});
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
  add("set", &EnvelopeRow::permanent_set);
  NumberRows zones;
  for (const PlasticZone& zone : result.plastic_zones) zones.push_back({zone.from, zone.to});
  figure.table("zones", "from,to", zones);
  figure.set("length", beam.length).set("yields", yields);
  figure.set("yield_moment", beam.yield_moment());
  figure.set("yield_strain", beam.yield_stress / beam.youngs_modulus);
  figure.set("largest_displacement", largest(result.envelope, [=](const EnvelopeRow& row) {
               const EnvelopeRow::Range& w = row.displacement;
               return yields ? row.permanent_set : std::max(w.largest.value, -w.smallest.value);
             }));
  return figure;
}

}  // namespace subimpact
