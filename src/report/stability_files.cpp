#include <fmt/format.h>

#include <cmath>

#include "case/case_choices.h"
#include "io/csv_text.h"
#include "io/write_file.h"
#include "report/gnuplot.h"
#include "report/stability_figures.h"
#include "subimpact/report/stability.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

}  // namespace

void write_critical_steps(const fs::path& directory, const std::vector<CriticalStep>& rows) {
  CsvText csv(
      "method,theory,segments,highest_frequency_rad_per_s,limit_omega_h,predicted_s,measured_s\n");
  for (const CriticalStep& row : rows) {
    csv.word(row.method).word(name_of(row.theory)).whole(static_cast<std::size_t>(row.segments));
    csv.number(row.highest_frequency).number(row.limit).number(row.predicted);
    csv.number(row.measured).end_row();
  }
  write_file(directory / "critical_steps.csv", csv.str());
  draw_figure(directory, "critical_steps", critical_step_figure(rows), {1180, 560});
}

void write_stiff_contact(const fs::path& directory, const std::vector<StiffContact>& rows) {
  CsvText csv("stiffness_N_per_m,beam_only_s,predicted_s,measured_s\n");
  for (const StiffContact& row : rows) {
    csv.number(row.stiffness).number(row.beam_only).number(row.predicted).number(row.measured);
    csv.end_row();
  }
  write_file(directory / "stiff_contact.csv", csv.str());
  draw_figure(directory, "stiff_contact", stiff_contact_figure(rows), {760, 500});
}

void write_damping(const fs::path& directory, const std::vector<Damping>& rows,
                   const std::vector<MultistepGrowth>& growths) {
  CsvText csv("method,omega_h,predicted,measured\n");
  for (const Damping& row : rows) {
    csv.word(row.method).number(row.angle).number(row.predicted).number(row.measured).end_row();
  }
  write_file(directory / "damping.csv", csv.str());
  CsvText growth("order,omega_h,growth\n");
  for (const MultistepGrowth& row : growths) {
    growth.whole(static_cast<std::size_t>(row.order)).number(row.angle).number(row.growth);
    growth.end_row();
  }
  write_file(directory / "bdf_growth.csv", growth.str());
  draw_figure(directory, "damping", damping_figure(rows, growths), {1150, 520});
}

void write_outcomes(const fs::path& directory, const OutcomeMap& map) {
  CsvText csv(
      "group,row,omega_h_or_rtol,verdict,reference_sub_impacts,sub_impacts,corresponding,"
      "median_error_s,max_error_s,energy_error,message\n");
  for (const OutcomePoint& point : map.points) {
    const EventErrors& errors = point.errors;
    csv.word(point.group).text(point.row).number(point.x);
    csv.word(to_string(point.verdict)).whole(errors.n_reference).whole(errors.n_found);
    csv.whole(errors.n_corresponding);
    if (point.verdict == Verdict::right || point.verdict == Verdict::wrong_count) {
      csv.number(errors.median).number(errors.maximum).number(point.energy_error);
    } else {
      csv.empty().empty().empty();
    }
    csv.text(point.message).end_row();
  }
  write_file(directory / "outcomes.csv", csv.str());
  draw_figure(directory, "outcomes", outcome_figure(map), {1400, 560});
}

void write_missed_pairs(const fs::path& directory, const std::vector<MissedPairs>& rows) {
  CsvText csv("step_s,runs,right_with_search,right_without,shortest_s\n");
  for (const MissedPairs& row : rows) {
    csv.number(row.step).whole(static_cast<std::size_t>(row.n_runs));
    csv.whole(static_cast<std::size_t>(row.right_with_search));
    csv.whole(static_cast<std::size_t>(row.right_without)).number(row.shortest).end_row();
  }
  write_file(directory / "missed_pairs.csv", csv.str());
  draw_figure(directory, "missed_pairs", missed_pairs_figure(rows), {760, 500});
}

void write_layers(const fs::path& directory, const LayerStudy& study) {
  CsvText csv(
      "layers,sub_impacts,exact_sub_impacts,corresponding,median_difference_s,max_difference_s\n");
  for (const LayerPoint& point : study.points) {
    csv.whole(static_cast<std::size_t>(point.layers)).whole(point.errors.n_found);
    csv.whole(point.errors.n_reference).whole(point.errors.n_corresponding);
    csv.number(point.errors.median).number(point.errors.maximum).end_row();
  }
  write_file(directory / "layers.csv", csv.str());
  draw_figure(directory, "layers", layer_figure(study), {760, 500});
}

}  // namespace subimpact
