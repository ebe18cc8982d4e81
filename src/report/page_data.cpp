#include "report/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/problem.h"
#include "io/row_thinning.h"
#include "report/figure_script.h"
#include "report/packing.h"

namespace subimpact {
namespace {

// Sizes that keep a page below 5 MB.
constexpr std::size_t most_history_rows = 22'000;
constexpr std::size_t most_points = 600;          // of a shape
constexpr std::size_t most_shape_rows = 240'000;  // of all shapes

using Member = double HistoryRow::*;
struct HistoryColumn {
  const char* name;
  Member member;
};
constexpr HistoryColumn drawn_columns[] = {{"force_N", &HistoryRow::force},
                                           {"indentation_m", &HistoryRow::indentation},
                                           {"w_c_m", &HistoryRow::struck_displacement},
                                           {"w_m_m", &HistoryRow::striker_displacement},
                                           {"f_c_m", &HistoryRow::struck_deflection},
                                           {"v_m_m_per_s", &HistoryRow::striker_velocity},
                                           {"U_m_J", &HistoryRow::striker_energy},
                                           {"U_k_J", &HistoryRow::beam_kinetic_energy},
                                           {"U_e_J", &HistoryRow::bending_elastic},
                                           {"U_p_J", &HistoryRow::bending_plastic},
                                           {"U_c_J", &HistoryRow::contact_elastic},
                                           {"D_c_J", &HistoryRow::contact_plastic},
                                           {"D_b_J", &HistoryRow::beam_damping}};

// --- history -------------------------------------------------------------------------------------

std::vector<HistoryRow> thinned(const std::vector<HistoryRow>& history, std::size_t most_rows) {
  std::vector<Member> drawn;
  for (const HistoryColumn& column : drawn_columns) drawn.push_back(column.member);
  RowThinning<HistoryRow> rows(history.size(), 1, drawn, most_rows);
  for (const HistoryRow& row : history) rows.add(row);
  return rows.take();
}

Json history_json(const std::vector<HistoryRow>& rows) {
  Json json = Json::object();
  if (rows.empty()) return json;
  json["time_s"] = packed<double>(rows, [](const HistoryRow& row) { return row.time; });
  for (const auto& [name, member] : drawn_columns) {
    json[name] =
        packed<float>(rows, [member = member](const HistoryRow& row) { return row.*member; });
  }
  return json;
}

Json packed_times(const std::vector<double>& times) {
  return packed<double>(times, [](double x) { return x; });
}

// --- shapes --------------------------------------------------------------------------------------

// Every n-th index so that at most `most` are left, and the last.
std::vector<std::size_t> every_nth(std::size_t n, std::size_t most) {
  const std::size_t stride = (n + most - 1) / most;
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < n; i += stride) indices.push_back(i);
  if (!indices.empty() && indices.back() + 1 != n) indices.push_back(n - 1);
  return indices;
}

void insert_sorted(std::vector<std::size_t>& indices, std::size_t index) {
  const auto at = std::lower_bound(indices.begin(), indices.end(), index);
  if (at == indices.end() || *at != index) indices.insert(at, index);
}

// Which points of a shape the page has: all, or every n-th and the struck one.
std::vector<std::size_t> points_kept(const Case& input, const Result& result) {
  const std::size_t n = result.used.n_shape_points;
  std::vector<std::size_t> kept = every_nth(n, most_points);
  if (kept.size() == n) return kept;
  const double struck = input.scene.striker.position * input.scene.beam.length;
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const auto distance = [&](std::size_t k) {
      return std::abs(result.shapes[k].position - struck);
    };
    if (distance(i) < distance(nearest)) nearest = i;
  }
  insert_sorted(kept, nearest);
  return kept;
}

bool is_contact_event(const Transition& event) { return event.kind != EventKind::section_reverses; }

// Which shapes the page has: all, or those at events, and every n-th of the others.
std::vector<std::size_t> shapes_kept(const Result& result, std::size_t n_points_kept) {
  const std::size_t n_points = result.used.n_shape_points;
  const std::size_t n = result.shapes.size() / n_points;
  const std::size_t most = std::max<std::size_t>(most_shape_rows / n_points_kept, 2);
  if (n <= most) return every_nth(n, n);
  std::vector<std::size_t> kept = every_nth(n, most / 2);
  std::size_t k = 0;
  for (const Transition& event : result.transitions) {
    if (!is_contact_event(event)) continue;
    while (k + 1 < n && result.shapes[k * n_points].time < event.time) ++k;
    if (kept.size() < most) insert_sorted(kept, k);
  }
  return kept;
}

struct Shapes {
  const Result& result;
  std::vector<std::size_t> shapes, points;

  std::vector<double> column(double ShapeRow::*member, const std::vector<std::size_t>& at) const {
    std::vector<double> values;
    values.reserve(shapes.size() * at.size());
    for (const std::size_t shape : shapes) {
      for (const std::size_t point : at) {
        values.push_back(result.shapes[shape * result.used.n_shape_points + point].*member);
      }
    }
    return values;
  }
  // Positions in `points` of those that are plastic in some shape.
  std::vector<std::size_t> plastic() const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool yields = std::any_of(shapes.begin(), shapes.end(), [&](std::size_t shape) {
        return result.shapes[shape * result.used.n_shape_points + points[i]].plastic_curvature !=
               0.0;
      });
      if (yields) found.push_back(i);
    }
    return found;
  }
};

Json shapes_json(const Shapes& kept) {
  const std::size_t n_points = kept.result.used.n_shape_points;
  std::vector<double> times, positions;
  for (const std::size_t shape : kept.shapes) {
    times.push_back(kept.result.shapes[shape * n_points].time);
  }
  for (const std::size_t point : kept.points) {
    positions.push_back(kept.result.shapes[point].position);
  }
  const std::vector<std::size_t> plastic = kept.plastic();
  std::vector<std::size_t> plastic_points;
  for (const std::size_t i : plastic) plastic_points.push_back(kept.points[i]);
  return {{"times", packed_times(times)},
          {"positions", packed_times(positions)},
          {"displacement", packed_i24(kept.column(&ShapeRow::displacement, kept.points))},
          {"moment", packed_i24(kept.column(&ShapeRow::moment, kept.points))},
          {"plastic_points", plastic},
          {"plastic", packed_i24(kept.column(&ShapeRow::plastic_curvature, plastic_points))}};
}

Json envelope_json(const Result& result, const std::vector<std::size_t>& points) {
  if (result.envelope.size() != result.used.n_shape_points) return nullptr;
  Json positions = Json::array(), set = Json::array();
  Json displacement{{"largest", Json::array()}, {"smallest", Json::array()}};
  Json moment = displacement;
  for (const std::size_t i : points) {
    const EnvelopeRow& row = result.envelope[i];
    positions.push_back(row.position);
    set.push_back(row.permanent_set);
    displacement["largest"].push_back(row.displacement.largest.value);
    displacement["smallest"].push_back(row.displacement.smallest.value);
    moment["largest"].push_back(row.moment.largest.value);
    moment["smallest"].push_back(row.moment.smallest.value);
  }
  return {{"positions", positions},
          {"displacement", displacement},
          {"moment", moment},
          {"permanent_set", set}};
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

// --- events --------------------------------------------------------------------------------------

Json number_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json sub_impacts_json(const Result& result) {
  Json list = Json::array();
  const std::size_t n_decided = result.n_decided().value_or(result.sub_impacts.size());
  for (const SubImpact& s : result.sub_impacts) {
    list.push_back({{"start", s.start},
                    {"end", result.end_of(s)},
                    {"ongoing", !s.end.has_value()},
                    {"peak_force", s.peak_force},
                    {"start_error", number_or_null(s.start_error)},
                    {"end_error", number_or_null(s.end_error)},
                    {"start_scatter", number_or_null(s.start_scatter)},
                    {"end_scatter", number_or_null(s.end_scatter)},
                    {"decided", list.size() < n_decided}});
  }
  return list;
}

// s, up to which the strike can be predicted; null where its end can.
Json horizon_json(const Result& result) {
  const std::optional<Predictability>& found = result.predictability;
  return found && found->first_unpredictable ? Json(found->horizon) : Json(nullptr);
}

Json events_json(const Result& result) {
  Json list = Json::array();
  for (const Transition& event : result.transitions) {
    if (!is_contact_event(event)) continue;
    list.push_back({{"time", event.time}, {"kind", to_string(event.kind)}});
  }
  return list;
}

Json zones_json(const Result& result) {
  Json list = Json::array();
  for (const PlasticZone& zone : result.plastic_zones) {
    list.push_back({{"from", zone.from}, {"to", zone.to}, {"rotation", zone.rotation}});
  }
  return list;
}

Json unit_json(double end) {
  const TimeUnit unit = end > 0.1 ? time_unit(end) : time_unit(0.0);
  return {{"name", unit.name}, {"per_second", unit.per_second}};
}

std::string_view name_of(EndSupport end) {
  return end == EndSupport::free ? "free" : end == EndSupport::pinned ? "pinned" : "clamped";
}

}  // namespace

PageData page_data(const Case& input, const Result& result) {
  const Beam& beam = input.scene.beam;
  PageData data;
  const std::vector<HistoryRow> history = thinned(result.history, most_history_rows);
  const std::size_t n_rows = std::max(result.n_history_rows, result.history.size());
  if (history.size() < n_rows) {
    data.history_note = fmt::format(
        "Of {} rows the charts have {}, with the largest and smallest values of each span.", n_rows,
        history.size());
  }
  Json json = {{"end", result.outcome.time},
               {"time_unit", unit_json(result.outcome.time)},
               {"length", beam.length},
               {"thickness", beam.thickness},
               {"ends", Json::array({name_of(beam.ends[0]), name_of(beam.ends[1])})},
               {"struck_at", input.scene.striker.position * beam.length},
               {"nose_radius", input.scene.striker.nose_radius.value_or(0.0)},
               {"yield_moment", may_yield(input) ? Json(beam.yield_moment()) : Json(nullptr)},
               {"yields", !result.plastic_zones.empty()},
               {"max_force", result.max_force},
               {"max_indentation", result.max_indentation},
               {"sub_impacts", sub_impacts_json(result)},
               {"horizon", horizon_json(result)},
               {"events", events_json(result)},
               {"plastic_zones", zones_json(result)},
               {"history", history_json(history)}};
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
         {"history", history_json(thinned(result.history, most_history_rows / results.size()))}});
  }
  return within_script({{"end", end}, {"time_unit", unit_json(end)}, {"runs", runs}});
}

}  // namespace subimpact
