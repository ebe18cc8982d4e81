#include <fmt/format.h>

#include "case/counted.h"
#include "case/keys/case_choices.h"
#include "case/problem.h"
#include "io/records/run_record.h"
#include "io/records/run_tables.h"
#include "report/text/uncertain.h"
#include "subimpact/io/case_file.h"
#include "subimpact/report/text.h"

namespace subimpact {
namespace {

template <class Range, class Entry>
Json list_of(const Range& range, Entry entry) {
  Json list = Json::array();
  for (const auto& x : range) list.push_back(entry(x));
  return list;
}

// Why sub-impacts from `first` on are not certain, as far as they have reasons of their own.
void add_doubts(const Result& result, std::size_t first, const auto& line) {
  constexpr std::size_t most_doubts = 8;
  std::size_t n = 0;
  for (std::size_t i = first; i < result.sub_impacts.size(); ++i) {
    const SubImpact& s = result.sub_impacts[i];
    if (s.certain.value_or(true) || !s.doubt) continue;
    if (++n <= most_doubts) {
      line(false, fmt::format("sub-impact {}: {}", i + 1, words_of(s.doubt)));
    }
  }
  if (n > most_doubts) line(false, counted(n - most_doubts, "more sub-impact"));
}

// What is certain, and what is not.
Json headlines(const Result& result) {
  Json list = Json::array();
  const auto line = [&](bool certain, const std::string& text) {
    list.push_back({{"certain", certain}, {"text", text + "."}});
  };
  const std::string certainty = error_words(result);
  if (!certainty.empty()) line(result.all_certain(), certainty);
  if (result.error_estimate && result.error_estimate->first_unresolved) {
    add_doubts(result, *result.error_estimate->first_unresolved + 1, line);
  }
  line(result.contact_over, "the end of contact: " + contact_over_words(result));
  if (result.error_estimate && result.error_estimate->finer_meshes) {
    line(false, finer_meshes_words(result));
  }
  return list;
}

// The table of sub-impacts; zones and doubts are in events.csv.
Json sub_impacts_json(const Result& result) {
  const SubImpactRows table = sub_impact_rows(result, "±");
  return {{"columns", list_of(table.columns,
                              [](const SubImpactRows::Column& column) -> Json {
                                return {{"name", column.name}, {"unit", column.unit}};
                              })},
          {"rows", list_of(table.rows, [](const SubImpactRows::Row& row) -> Json {
             return {{"certain", row.is_certain}, {"cells", row.cells}};
           })}};
}

Json time_unit(double end) {
  if (end > 0.1 && end < 1e4) return {{"name", "ms"}, {"per_second", 1e3}};
  const ReadUnit unit = unit_for(end, as_instant);
  return {{"name", unit.name}, {"per_second", unit.per_si}};
}

// What a drawing of the run needs, SI.
Json scene_json(const Case& input, const Result& result) {
  const Scene& scene = input.scene;
  const Beam beam = sized_beam(input);
  return {{"time_unit", time_unit(result.outcome.time)},
          {"length", beam.length},
          {"thickness", beam.height()},
          {"ends", Json::array({name_of(beam.ends[0]), name_of(beam.ends[1])})},
          {"held", !beam.is_unsupported() || scene.striker.fixed},
          {"stop", scene.striker.fixed},
          {"springs", list_of(beam.springs,
                              [&](const Spring& s) -> Json {
                                const bool is_before =
                                    s.one_sided && s.one_sided->side == SpringSide::before;
                                return {{"position", s.position * beam.length},
                                        {"one_sided", s.one_sided.has_value()},
                                        {"gap", s.one_sided ? s.one_sided->gap : 0.0},
                                        {"side", is_before ? -1 : 1}};
                              })},
          {"supports", list_of(result.support_contacts,
                               [&](const SupportContact& c) -> Json {
                                 return {{"position", c.position},
                                         {"start", c.start},
                                         {"end", c.end.value_or(result.outcome.time)}};
                               })},
          {"bedding", beam.foundation > 0.0},
          {"load", beam.load},
          {"forces",
           list_of(beam.forces,
                   [&](const PointForce& force) -> Json {
                     return {{"position", force.position * beam.length}, {"table", force.table}};
                   })},
          {"struck_at", scene.striker.position * beam.length},
          {"nose_radius", scene.striker.nose_radius.value_or(0.0)},
          {"ball", scene.nose() == NoseShape::sphere},
          {"yield_moment", may_yield(input) ? Json(beam.yield_moment()) : Json(nullptr)},
          {"gauges", list_of(input.output.gauges, [](const Gauge& gauge) -> Json {
             return fmt::format("x = {:.4g} l, {}", gauge.position,
                                gauge.face == Face::back ? "back" : "front");
           })}};
}

Json columns_json(const OutputOptions& output) {
  Json json = Json::object();
  for (const auto& column : run_table<HistoryRow>().columns_of(output)) {
    json[column.name] = column.meaning;
  }
  return json;
}

}  // namespace

std::string report_json(const Case& input, const Result& result) {
  Json meanings = Json::object();
  for (const auto& [name, meaning] : listing_of(run_record())) meanings[name] = meaning;
  const auto& tolerance = result.tolerance;
  const Json json = {{"layout", report_layout},
                     {"scene_text", strike_words(input, result) + "."},
                     {"caveat", outcome_caveat(result)},
                     {"headlines", headlines(result)},
                     {"tolerance", tolerance ? tolerance_words(*tolerance, result) : std::string()},
                     {"sub_impacts", sub_impacts_json(result)},
                     {"strikes", result.strikes.empty() ? "" : strike_table(result)},
                     {"computed_in", duration_text(result.work.all_seconds)},
                     {"brief", result.brief_report()},
                     {"printed", run_summary(input, result) + '\n' + sub_impact_table(result)},
                     {"verbose", run_summary(input, result, true)},
                     {"case", case_file_text(input)},
                     {"scene", scene_json(input, result)},
                     {"shape_interval", duration_text(result.used.shape_interval)},
                     {"columns", columns_json(input.output)},
                     {"meanings", meanings}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace subimpact
