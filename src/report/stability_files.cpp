#include "case/case_choices.h"
#include "io/csv_columns.h"
#include "io/write_file.h"
#include "report/gnuplot.h"
#include "subimpact/report/stability.h"

namespace subimpact {

namespace fs = std::filesystem;

void write_critical_steps(const fs::path& directory, const std::vector<CriticalStep>& rows) {
  const Columns<CriticalStep> columns = {
      {"method", &CriticalStep::method},
      {"theory", [](const CriticalStep& row) { return std::string(name_of(row.theory)); }},
      {"segments", &CriticalStep::segments},
      {"highest_frequency_rad_per_s", &CriticalStep::highest_frequency},
      {"limit_omega_h", &CriticalStep::limit},
      {"predicted_s", &CriticalStep::predicted},
      {"measured_s", &CriticalStep::measured}};
  write_file(directory / "critical_steps.csv", csv_text(columns, rows));
  draw_figure(directory, "critical_steps", figure_script("critical_steps"), {1180, 560});
}

void write_stiff_contact(const fs::path& directory, const std::vector<StiffContact>& rows) {
  const Columns<StiffContact> columns = {{"stiffness_N_per_m", &StiffContact::stiffness},
                                         {"beam_only_s", &StiffContact::beam_only},
                                         {"predicted_s", &StiffContact::predicted},
                                         {"measured_s", &StiffContact::measured}};
  write_file(directory / "stiff_contact.csv", csv_text(columns, rows));
  draw_figure(directory, "stiff_contact", figure_script("stiff_contact"), {760, 500});
}

void write_damping(const fs::path& directory, const std::vector<Damping>& rows,
                   const std::vector<MultistepGrowth>& growths) {
  const Columns<Damping> columns = {{"method", &Damping::method},
                                    {"omega_h", &Damping::angle},
                                    {"predicted", &Damping::predicted},
                                    {"measured", &Damping::measured}};
  write_file(directory / "damping.csv", csv_text(columns, rows));
  const Columns<MultistepGrowth> growth = {{"order", &MultistepGrowth::order},
                                           {"omega_h", &MultistepGrowth::angle},
                                           {"growth", &MultistepGrowth::growth}};
  write_file(directory / "bdf_growth.csv", csv_text(growth, growths));
  draw_figure(directory, "damping", figure_script("damping"), {1150, 520});
}

void write_outcomes(const fs::path& directory, const OutcomeMap& map) {
  const auto if_completed = [](const OutcomePoint& point, double value) {
    const bool completed = point.verdict == Verdict::right || point.verdict == Verdict::wrong_count;
    return completed ? std::optional(value) : std::nullopt;
  };
  const Columns<OutcomePoint> columns = {
      {"group", &OutcomePoint::group},
      {"row", &OutcomePoint::row},
      {"omega_h_or_rtol", &OutcomePoint::x},
      {"verdict", [](const OutcomePoint& p) { return p.verdict; }},
      {"reference_sub_impacts", [](const OutcomePoint& p) { return p.errors.n_reference; }},
      {"sub_impacts", [](const OutcomePoint& p) { return p.errors.n_found; }},
      {"corresponding", [](const OutcomePoint& p) { return p.errors.n_corresponding; }},
      {"median_error_s", [=](const OutcomePoint& p) { return if_completed(p, p.errors.median); }},
      {"max_error_s", [=](const OutcomePoint& p) { return if_completed(p, p.errors.maximum); }},
      {"energy_error", [=](const OutcomePoint& p) { return if_completed(p, p.energy_error); }},
      {"message", &OutcomePoint::message}};
  write_file(directory / "outcomes.csv", csv_text(columns, map.points));
  draw_figure(directory, "outcomes", figure_script("outcomes"), {1400, 560});
}

void write_missed_pairs(const fs::path& directory, const std::vector<MissedPairs>& rows) {
  const Columns<MissedPairs> columns = {{"step_s", &MissedPairs::step},
                                        {"runs", &MissedPairs::n_runs},
                                        {"right_with_search", &MissedPairs::right_with_search},
                                        {"right_without", &MissedPairs::right_without},
                                        {"shortest_s", &MissedPairs::shortest}};
  write_file(directory / "missed_pairs.csv", csv_text(columns, rows));
  draw_figure(directory, "missed_pairs", figure_script("missed_pairs"), {760, 500});
}

void write_layers(const fs::path& directory, const LayerStudy& study) {
  const Columns<LayerPoint> columns = {
      {"layers", &LayerPoint::layers},
      {"sub_impacts", [](const LayerPoint& p) { return p.errors.n_found; }},
      {"exact_sub_impacts", [](const LayerPoint& p) { return p.errors.n_reference; }},
      {"corresponding", [](const LayerPoint& p) { return p.errors.n_corresponding; }},
      {"median_difference_s", [](const LayerPoint& p) { return p.errors.median; }},
      {"max_difference_s", [](const LayerPoint& p) { return p.errors.maximum; }}};
  write_file(directory / "layers.csv", csv_text(columns, study.points));
  draw_figure(directory, "layers", figure_script("layers"), {760, 500});
}

}  // namespace subimpact
