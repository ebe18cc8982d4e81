#include "report/pages/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <ranges>
#include <set>
#include <variant>

#include "case/problem.h"
#include "io/records/row_thinning.h"
#include "io/records/run_tables.h"
#include "report/text/uncertain.h"

namespace subimpact {
namespace {

// Sizes that keep a page below 5 MB.
constexpr std::size_t most_history_rows = 22'000;
constexpr std::size_t most_points = 600;          // of a shape
constexpr std::size_t most_shape_rows = 240'000;  // of all shapes

using HistoryColumn = Column<HistoryRow>;

// All columns of the history except the time.
Columns<HistoryRow> value_columns(const OutputOptions& output) {
  Columns<HistoryRow> columns = run_table<HistoryRow>().columns_of(output);
  columns.erase(columns.begin());
  return columns;
}

std::vector<HistoryRow> thinned(const std::vector<HistoryRow>& history, std::size_t most_rows) {
  std::vector<double HistoryRow::*> drawn;
  for (const HistoryColumn& column : value_columns({})) {
    if (column.member != nullptr) drawn.push_back(column.member);
  }
  RowThinning<HistoryRow> rows(history.size(), 1, drawn, most_rows);
  for (const HistoryRow& row : history) rows.add(row);
  return rows.take();
}

Json history_json(const std::vector<HistoryRow>& rows, const OutputOptions& output) {
  Json json = Json::object();
  if (rows.empty()) return json;
  json["time_s"] = packed<double>(rows, &HistoryRow::time);
  for (const HistoryColumn& column : value_columns(output)) {
    json[column.name] = packed<float>(rows, [&](const HistoryRow& row) -> std::optional<double> {
      const Cell cell = column.cell(row, 0);
      const double* value = std::get_if<double>(&cell);
      return value != nullptr ? std::optional(*value) : std::nullopt;
    });
  }
  return json;
}

Json meanings_of_columns(const OutputOptions& output) {
  Json json = Json::object();
  for (const HistoryColumn& column : value_columns(output)) json[column.name] = column.meaning;
  return json;
}

using Indices = std::set<std::size_t>;

// Every n-th index so that at most `most` are left, and the last.
Indices every_nth(std::size_t n, std::size_t most) {
  const std::size_t stride = (n + most - 1) / most;
  Indices indices;
  for (std::size_t i = 0; i < n; i += stride) indices.insert(i);
  if (n > 0) indices.insert(n - 1);
  return indices;
}

// Which points of a shape the page has: all, or every n-th and the struck one.
Indices points_kept(const Case& input, const Result& result) {
  const std::size_t n = result.used.n_shape_points;
  const double struck = input.scene.striker.position * sized_beam(input).length;
  const auto nearest = std::min_element(
      result.shapes.begin(), result.shapes.begin() + static_cast<std::ptrdiff_t>(n),
      [&](const ShapeRow& a, const ShapeRow& b) {
        return std::abs(a.position - struck) < std::abs(b.position - struck);
      });
  Indices kept = every_nth(n, most_points);
  kept.insert(static_cast<std::size_t>(nearest - result.shapes.begin()));
  return kept;
}

bool is_contact_event(const Transition& event) { return event.kind != EventKind::section_reverses; }

// Which shapes the page has: all, or those at events, and every n-th of the others.
Indices shapes_kept(const Result& result, std::size_t n_points_kept) {
  const std::size_t n_points = result.used.n_shape_points;
  const std::size_t n = result.shapes.size() / n_points;
  const std::size_t most = std::max<std::size_t>(most_shape_rows / n_points_kept, 2);
  if (n <= most) return every_nth(n, n);
  Indices kept = every_nth(n, most / 2);
  std::size_t k = 0;
  for (const Transition& event : result.transitions) {
    if (!is_contact_event(event)) continue;
    while (k + 1 < n && result.shapes[k * n_points].time < event.time) ++k;
    if (kept.size() < most) kept.insert(k);
  }
  return kept;
}

struct Shapes {
  const Result& result;
  Indices shapes, points;

  const ShapeRow& row(std::size_t shape, std::size_t point) const {
    return result.shapes[shape * result.used.n_shape_points + point];
  }
  Json column(double ShapeRow::*member, const Indices& at) const {
    std::vector<double> values;
    values.reserve(shapes.size() * at.size());
    for (const std::size_t shape : shapes) {
      for (const std::size_t point : at) values.push_back(row(shape, point).*member);
    }
    return packed_i24(values);
  }
  bool is_plastic(std::size_t point) const {
    return std::ranges::any_of(
        shapes, [&](std::size_t shape) { return row(shape, point).plastic_curvature != 0.0; });
  }
};

Json shapes_json(const Shapes& kept) {
  Indices plastic, plastic_points;  // where in `points` they are; the points
  std::size_t place = 0;
  for (const std::size_t point : kept.points) {
    if (kept.is_plastic(point)) {
      plastic.insert(place);
      plastic_points.insert(point);
    }
    ++place;
  }
  const auto time = [&](std::size_t shape) { return kept.row(shape, 0).time; };
  const auto position = [&](std::size_t point) { return kept.row(0, point).position; };
  return {{"times", packed<double>(kept.shapes, time)},
          {"positions", packed<double>(kept.points, position)},
          {"displacement", kept.column(&ShapeRow::displacement, kept.points)},
          {"moment", kept.column(&ShapeRow::moment, kept.points)},
          {"plastic_points", plastic},
          {"plastic", kept.column(&ShapeRow::plastic_curvature, plastic_points)}};
}

Json envelope_json(const Result& result, const Indices& points) {
  if (result.envelope.size() != result.used.n_shape_points) return nullptr;
  const auto values = [&](auto value) {
    return list_of(points, [&](std::size_t i) { return std::invoke(value, result.envelope[i]); });
  };
  const auto range = [&](EnvelopeRow::Range EnvelopeRow::*field) -> Json {
    return {
        {"largest", values([=](const EnvelopeRow& row) { return (row.*field).largest.value; })},
        {"smallest", values([=](const EnvelopeRow& row) { return (row.*field).smallest.value; })}};
  };
  return {{"positions", values(&EnvelopeRow::position)},
          {"displacement", range(&EnvelopeRow::displacement)},
          {"moment", range(&EnvelopeRow::moment)},
          {"permanent_set", values(&EnvelopeRow::set_from_supports)}};
}

void add_shapes(Json& json, PageData& data, const Case& input, const Result& result) {
  json["shapes"] = json["envelope"] = nullptr;
  if (result.shapes.empty() || result.used.n_shape_points < 2) return;
  Shapes kept{result, {}, points_kept(input, result)};
  kept.shapes = shapes_kept(result, kept.points.size());
  json["shapes"] = shapes_json(kept);
  json["envelope"] = envelope_json(result, kept.points);
  data.shapes_note = fmt::format(
      "Between {} stored shapes ({:.3g} µs apart, and at every event of the contact) the picture "
      "is interpolated by straight lines; the striker follows the rows of the history.",
      kept.shapes.size(), 1e6 * result.used.shape_interval);
  const std::size_t n_shapes = result.shapes.size() / result.used.n_shape_points;
  if (kept.shapes.size() < n_shapes || kept.points.size() < result.used.n_shape_points) {
    data.shapes_note +=
        fmt::format(" To keep the page small it has {} of {} shapes and {} of {} points of each.",
                    kept.shapes.size(), n_shapes, kept.points.size(), result.used.n_shape_points);
  }
}

Json number_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json sub_impacts_json(const Result& result) {
  return list_of(result.sub_impacts, [&](const SubImpact& s) -> Json {
    return {{"start", s.start},
            {"end", result.end_of(s)},
            {"ongoing", !s.end.has_value()},
            {"peak_force", s.peak_force},
            {"peak_time", s.peak_time},
            {"residual", s.residual_indentation},
            {"start_error", number_or_null(s.start_error)},
            {"end_error", number_or_null(s.end_error)},
            {"start_scatter", number_or_null(s.start_scatter)},
            {"end_scatter", number_or_null(s.end_scatter)},
            {"certain", s.certain.value_or(true)}};
  });
}

Json unit_json(double end) {
  if (end > 0.1 && end < 1e4) return {{"name", "ms"}, {"per_second", 1e3}};
  const ReadUnit unit = unit_for(end, as_instant);
  return {{"name", unit.name == "us" ? "µs" : unit.name}, {"per_second", unit.per_si}};
}

std::string_view name_of(EndSupport end) {
  return end == EndSupport::free ? "free" : end == EndSupport::pinned ? "pinned" : "clamped";
}

Json place_of(const Gauge& gauge) {
  return fmt::format("x = {:.4g} l, {}", gauge.position,
                     gauge.face == Face::back ? "back" : "front");
}

}  // namespace

PageData page_data(const Case& input, const Result& result, const Json& overlay) {
  const Beam beam = sized_beam(input);
  PageData data;
  const std::vector<HistoryRow> history = thinned(result.history, most_history_rows);
  const std::size_t n_rows = std::max(result.n_history_rows, result.history.size());
  if (history.size() < n_rows) {
    data.history_note = fmt::format(
        "Of {} rows the charts have {}, with the largest and smallest values of each span.", n_rows,
        history.size());
  }
  std::vector<Transition> events = result.transitions;
  std::erase_if(events, [](const Transition& event) { return !is_contact_event(event); });
  const std::optional<Predictability>& predicted = result.predictability;
  Json json = {
      {"end", result.outcome.time},
      {"time_unit", unit_json(result.outcome.time)},
      {"length", beam.length},
      {"thickness", beam.height()},
      {"ends", Json::array({name_of(beam.ends[0]), name_of(beam.ends[1])})},
      {"held", !beam.is_unsupported() || input.scene.striker.fixed},
      {"stop", input.scene.striker.fixed},
      {"springs",
       list_of(beam.springs,
               [&](const Spring& spring) -> Json { return spring.position * beam.length; })},
      {"bedding", beam.foundation > 0.0},
      {"load", beam.load},
      {"forces",
       list_of(beam.forces,
               [&](const PointForce& force) -> Json {
                 return {{"position", force.position * beam.length}, {"table", force.table}};
               })},
      {"struck_at", input.scene.striker.position * beam.length},
      {"nose_radius", input.scene.striker.nose_radius.value_or(0.0)},
      {"ball", input.scene.nose() == NoseShape::sphere},
      {"yield_moment", may_yield(input) ? Json(beam.yield_moment()) : Json(nullptr)},
      {"yields", !result.plastic_zones.empty()},
      {"max_force", result.max_force},
      {"max_indentation", result.max_indentation},
      {"sub_impacts", sub_impacts_json(result)},
      {"horizon",
       predicted && predicted->first_unpredictable ? Json(predicted->horizon) : Json(nullptr)},
      {"events", list_of(events,
                         [](const Transition& event) -> Json {
                           return {{"time", event.time}, {"kind", to_string(event.kind)}};
                         })},
      {"plastic_zones",
       list_of(result.plastic_zones,
               [](const PlasticZone& zone) -> Json {
                 return {{"from", zone.from}, {"to", zone.to}, {"rotation", zone.rotation}};
               })},
      {"overlay", overlay},
      {"history", history_json(history, input.output)},
      {"gauges", list_of(input.output.gauges, place_of)},
      {"meanings", meanings_of_columns(input.output)}};
  add_shapes(json, data, input, result);
  data.json = within_script(json);
  return data;
}

std::string comparison_data(const std::vector<std::string>& names,
                            const std::vector<const Result*>& results) {
  Json runs = Json::array();
  double end = 0.0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Result& result = *results[i];
    end = std::max(end, result.outcome.time);
    runs.push_back(
        {{"name", names[i]},
         {"sub_impacts", sub_impacts_json(result)},
         {"history",
          history_json(thinned(result.history, most_history_rows / results.size()), {})}});
  }
  return within_script({{"end", end}, {"time_unit", unit_json(end)}, {"runs", runs}});
}

}  // namespace subimpact
