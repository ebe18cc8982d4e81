// Shapes of the whole beam, and the envelope of a run.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figure_script.h"

namespace subimpact {
namespace {

constexpr std::size_t n_drawn = 7;
constexpr FigureSize panel{660, 260};

// The first rows of shapes nearest to instants that cut the run into equal parts.
std::vector<std::size_t> shapes_drawn(const Result& result, std::size_t n_points) {
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

double largest_of(const std::vector<ShapeRow>& rows, double ShapeRow::*member) {
  double found = 0.0;
  for (const ShapeRow& row : rows) found = std::max(found, std::abs(row.*member));
  return found;
}

// A line of the envelope, y(row) over x in m.
template <class Value>
std::vector<Point> envelope_line(const Result& result, Value value) {
  std::vector<Point> line;
  for (const EnvelopeRow& row : result.envelope) line.push_back({row.position, value(row)});
  return line;
}

}  // namespace

FigureScript shapes_figure(const Case& input, const Result& result) {
  FigureScript figure("shapes",
                      "Displacement and bending moment along the whole beam at some instants of "
                      "the run, from dark to light.",
                      {800, 700});
  const std::size_t n_points = result.used.n_shape_points;
  const TimeUnit unit = time_unit(result.outcome.time);
  const Unit metre = length_unit(largest_of(result.shapes, &ShapeRow::displacement));
  NumberRows instants;
  const auto table = [&](const char* name, double ShapeRow::*member, double factor) {
    NumberRows rows;
    double number = 1.0;
    for (const std::size_t first : shapes_drawn(result, n_points)) {
      std::vector<Point> line;
      for (std::size_t i = first; i < first + n_points; ++i) {
        line.push_back({result.shapes[i].position, factor * (result.shapes[i].*member)});
      }
      for (const Point& p : thin_for_panel(line, panel)) rows.push_back({number, p.x, p.y});
      ++number;
    }
    figure.table(name, "shape,x,y", rows);
  };
  table("displacement", &ShapeRow::displacement, metre.factor);
  table("moment", &ShapeRow::moment, 1.0);
  for (const std::size_t first : shapes_drawn(result, n_points)) {
    instants.push_back({result.shapes[first].time * unit.per_second});
  }
  figure.table("instants", "time", instants);
  figure.set("length", input.scene.beam.length);
  figure.set("time_unit", unit.name).set("length_unit", metre.name);
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
  const auto add = [&](const char* name, EnvelopeRow::Range EnvelopeRow::*range, double factor) {
    figure.line(
        std::string(name) + "_largest",
        envelope_line(result,
                      [=](const EnvelopeRow& row) { return factor * (row.*range).largest.value; }),
        panel);
    figure.line(
        std::string(name) + "_smallest",
        envelope_line(result,
                      [=](const EnvelopeRow& row) { return factor * (row.*range).smallest.value; }),
        panel);
  };
  double largest_set = 0.0, largest_displacement = 0.0;
  for (const EnvelopeRow& row : result.envelope) {
    largest_set = std::max(largest_set, std::abs(row.permanent_set));
    largest_displacement = std::max(
        {largest_displacement, row.displacement.largest.value, -row.displacement.smallest.value});
  }
  const Unit metre = length_unit(yields ? largest_set : largest_displacement);
  add("moment", &EnvelopeRow::moment, 1.0);
  add("strain", &EnvelopeRow::strain, 1e3);
  add("displacement", &EnvelopeRow::displacement, metre.factor);
  figure.line("set",
              envelope_line(
                  result, [&](const EnvelopeRow& row) { return metre.factor * row.permanent_set; }),
              panel);
  NumberRows zones;
  for (const PlasticZone& zone : result.plastic_zones) zones.push_back({zone.from, zone.to});
  figure.table("zones", "from,to", zones);
  figure.set("length", beam.length).set("length_unit", metre.name).set("yields", yields);
  figure.set("yield_moment", yields ? beam.yield_moment() : 0.0);
  figure.set("yield_strain", yields ? 1e3 * beam.yield_stress / beam.youngs_modulus : 0.0);
  return figure;
}

}  // namespace subimpact
