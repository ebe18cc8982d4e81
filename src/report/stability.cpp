#include <fmt/format.h>

#include <algorithm>

#include "case/counted.h"
#include "io/directory/listed_files.h"
#include "numerics/units.h"
#include "report/study_columns.h"
#include "subimpact/report/studies.h"

namespace subimpact {
namespace {

template <auto number>
constexpr auto errors = [](const auto& row) { return row.errors.*number; };

template <class Row>
StabilityPart part_of(const char* name, const StudyColumns<Row>& columns,
                      const std::vector<Row>& rows) {
  return {printed_table(columns, rows),
          {{name + std::string(".csv"), csv_text(columns_in_file(columns), rows)}}};
}

std::string map_text(const OutcomeMap& map) {
  constexpr std::string_view letters = "+wiUFr.";  // in the order of verdicts
  std::string text = fmt::format(
      "reference: {}; {} up to {:.3f} us\n"
      "+ right   w wrong count   i inaccurate   U unstable   F solver failed   r refused   . left "
      "out\n",
      map.reference.description, counted(map.reference.sub_impacts.size(), "sub-impact"),
      map.reference.horizon * us);
  std::optional<bool> fixed_step;
  std::string row;
  for (const OutcomePoint& point : map.points) {
    if (point.setting.fixed_step != fixed_step) {
      if (fixed_step) text += '\n';
      fixed_step = point.setting.fixed_step;
      row.clear();
      text += fmt::format("\n{:<28}", *fixed_step ? "omega_max h" : "rtol");
      for (const OutcomePoint& other : map.points) {
        if (other.setting.fixed_step != fixed_step || other.row != point.row) continue;
        text += fmt::format(" {:>6g}", other.x);
      }
    }
    if (point.row != row) {
      row = point.row;
      text += fmt::format("\n{:<28}", row);
    }
    text += fmt::format(" {:>6}", letters[static_cast<std::size_t>(point.verdict)]);
  }
  return text + '\n';
}

}  // namespace

StabilityPart part_of(const OutcomeMap& map) {
  const auto if_completed = [](const OutcomePoint& point, double value) {
    const bool completed = point.verdict == Verdict::right || point.verdict == Verdict::wrong_count;
    return completed ? std::optional(value) : std::nullopt;
  };
  const Columns<OutcomePoint> columns = {
      {"group",
       [](const OutcomePoint& p) {
         return std::string(p.setting.fixed_step ? "fixed step" : "tolerance");
       }},
      {"row", &OutcomePoint::row},
      {"omega_h_or_rtol", &OutcomePoint::x},
      {"verdict", [](const OutcomePoint& p) { return p.verdict; }},
      {"reference_sub_impacts", errors<&EventErrors::n_reference>},
      {"sub_impacts", errors<&EventErrors::n_found>},
      {"corresponding", errors<&EventErrors::n_corresponding>},
      {"median_error_s", [=](const OutcomePoint& p) { return if_completed(p, p.errors.median); }},
      {"max_error_s", [=](const OutcomePoint& p) { return if_completed(p, p.errors.maximum); }},
      {"energy_error", [=](const OutcomePoint& p) { return if_completed(p, p.energy_error); }},
      {"message", &OutcomePoint::message}};
  return {map_text(map), {{"outcomes.csv", csv_text(columns, map.points)}}};
}

StabilityPart part_of(const std::vector<MissedPairs>& rows) {
  using Row = MissedPairs;
  const StudyColumns<Row> columns = {
      {"step_s", &Row::step, {"step, us", ">9", ".3g", us}},
      {"runs", &Row::n_runs},
      {"right_with_search", &Row::right_with_search, {"all found, pairs looked for", ">28"}},
      {"right_without", &Row::right_without, {"all found, ends of steps only", ">28"}},
      {"shortest_s", &Row::shortest}};
  StabilityPart part = part_of("missed_pairs", columns, rows);
  part.text =
      fmt::format("{}; shortest sub-impact or separation {:.3g} us\n{}",
                  counted(rows.at(0).n_runs, "strike"), rows.at(0).shortest * us, part.text);
  return part;
}

StabilityPart part_of(const LayerStudy& study) {
  const auto first_unmatched = [](const LayerPoint& p) {
    return fmt::format(" {}", p.errors.unmatched ? p.errors.unmatched->description : "");
  };
  const StudyColumns<LayerPoint> columns = {
      {"layers", &LayerPoint::layers, {"layers", ">7"}},
      {"sub_impacts", errors<&EventErrors::n_found>, {"sub-impacts", ">11"}},
      {"exact_sub_impacts", errors<&EventErrors::n_reference>},
      {"corresponding", errors<&EventErrors::n_corresponding>, {"correspond", ">12"}},
      {"median_difference_s", errors<&EventErrors::median>, {"median, us", ">14", ".3e", us}},
      {"max_difference_s", errors<&EventErrors::maximum>, {"largest, us", ">12", ".3e", us}},
      {"", first_unmatched, {" ", "<"}}};
  StabilityPart part = part_of("layers", columns, study.points);
  part.text.insert(printed_heading(columns).size(),
                   fmt::format("{:>7} {:>11}\n", "exact", study.exact.sub_impacts.size()));
  return part;
}

void write(const std::filesystem::path& directory, const StabilityPart& part) {
  for (const auto& [name, content] : part.tables) write_file(directory / name, content);
}

}  // namespace subimpact
