// Largest stable steps, damping and growth of methods, measured on the published beam and predicted
// from their coefficients; sub-impacts within one step, and layers against the exact section, up to
// 2 ms if a directory is named. Writes a CSV file of each into that directory. Exit status: 0 every
// claim holds.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "case/keys/case_choices.h"
#include "numerics/units.h"
#include "report/study_columns.h"
#include "stability/coefficients.h"
#include "stability/free_vibration.h"
#include "stability/steps.h"
#include "stability/within_steps.h"
#include "subimpact/io/case_file.h"

namespace {

using namespace subimpact;

bool all_hold = true;

void claim(bool holds, const std::string& words) {
  if (holds) return;
  all_hold = false;
  fmt::print("FAILS: {}\n", words);
}

void claim_near(double value, double expected, double tolerance, const std::string& words) {
  claim(std::abs(value - expected) <= tolerance,
        fmt::format("{}: {:g} in place of {:g} +- {:g}", words, value, expected, tolerance));
}

template <class Row>
void write(const std::filesystem::path& directory, const char* name,
           const StudyColumns<Row>& columns, const std::vector<Row>& rows) {
  fmt::print("{}\n", printed_table(columns, rows));
  if (directory.empty()) return;
  std::ofstream(directory / name) << csv_text(columns_in_file(columns), rows);
}

Case paper_strike(int segments) {
  Case input = read_case_file(SUBIMPACT_PAPER_CASE).value;
  input.model.section = SectionKind::elastic;
  input.model.segments = segments;
  return input;
}

std::string difference(const auto& row) {
  return fmt::format("{:.2f} %", 100.0 * (row.measured / row.predicted - 1.0));
}

void study_critical_steps(const std::filesystem::path& directory) {
  const auto theory = [](const CriticalStep& row) { return std::string(name_of(row.theory)); };
  const StudyColumns<CriticalStep> columns = {
      {"method", &CriticalStep::method, {"method", "<22"}},
      {"theory", theory, {"theory", "<16"}},
      {"segments", &CriticalStep::segments, {"cells", ">6"}},
      {"highest_frequency_rad_per_s", &CriticalStep::highest_frequency},
      {"limit_omega_h", &CriticalStep::limit, {"omega h", ">9", ".4f"}},
      {"predicted_s", &CriticalStep::predicted, {"predicted, us", ">13", ".6g", us}},
      {"measured_s", &CriticalStep::measured, {"measured, us", ">13", ".6g", us}},
      {"", difference<CriticalStep>, {"difference", ">10"}}};
  const std::vector<CriticalStep> rows = critical_steps(paper_strike(501));
  write(directory, "critical_steps.csv", columns, rows);
  claim(rows.size() == 10u * 3u * 4u, "ten methods, three theories, four meshes");
  for (const CriticalStep& row : rows) {
    claim_near(row.measured / row.predicted, 1.0, row.method == "central-difference" ? 0.01 : 0.03,
               fmt::format("step of {} on {} cells", row.method, row.segments));
  }
  const auto limit = [](const char* method, double expected, double tolerance) {
    claim_near(stability_limit(method), expected, tolerance, method);
  };
  limit("erk:bogacki-shampine", std::sqrt(3.0), 1e-3);
  limit("erk:zonneveld", std::sqrt(8.0), 1e-3);
  limit("erk:dormand-prince", 1.0, 0.005);
  limit("erk:dop853", 5.96, 0.01);
  limit("erk:fehlberg-78", 2.37, 0.01);
  limit("nystrom:dprkn12", 8.33, 0.01);
}

// Growth per step below the limits: of Cash and Karp at every step, of dprkn8 in a narrow range.
void study_growth() {
  Case input = paper_strike(101);
  input.solver.table = "cash-karp";
  const auto growth = [&](double angle) {
    FreeVibration beam(input);
    const std::size_t top = beam.n_modes() - 1;
    return beam.growth(top, angle / beam.frequency(top), 64) - 1.0;
  };
  for (const double angle : {0.5, 0.7, 0.85}) {
    claim(growth(angle) > 1e-6 && growth(angle) < 1e-4, "Cash and Karp grow at every step");
  }
  const std::vector<Resonance> found = resonances("nystrom:dprkn8");
  for (const Resonance& range : found) {
    fmt::print(
        "nystrom:dprkn8 grows for omega h from {:.4f} to {:.4f}, by up to {:.1e} per step\n\n",
        range.from, range.to, range.growth - 1.0);
  }
  claim(found.size() == 1 && resonances("central-difference").empty(), "one range of resonance");
  claim_near(found.at(0).from, 3.1404, 1e-3, "where the resonance begins");
  claim_near(found.at(0).to, 3.1417, 1e-3, "where it ends");
  claim_near(found.at(0).growth - 1.0, 5.8e-4, 0.5e-4, "its growth");
  input.solver.table.reset();
  input.solver.method = Method::nystrom;
  claim(growth(3.1410) > 4e-4 && growth(3.1300) < 0.0, "a beam resonates likewise");
}

void study_stiff_contact(const std::filesystem::path& directory) {
  const StudyColumns<StiffContact> columns = {
      {"stiffness_N_per_m", &StiffContact::stiffness, {"spring, N/m", ">14", ".4g"}},
      {"beam_only_s", &StiffContact::beam_only, {"beam only, us", ">14", ".6g", us}},
      {"predicted_s", &StiffContact::predicted, {"predicted, us", ">14", ".6g", us}},
      {"measured_s", &StiffContact::measured, {"measured, us", ">14", ".6g", us}},
      {"", difference<StiffContact>, {"difference", ">10"}}};
  const std::vector<StiffContact> rows = stiff_contact(paper_strike(501));
  write(directory, "stiff_contact.csv", columns, rows);
  for (const StiffContact& row : rows) {
    claim_near(row.measured / row.predicted, 1.0, 0.01,
               fmt::format("step with a spring of {:g} N/m", row.stiffness));
  }
  claim_near(rows.front().predicted / rows.front().beam_only, 1.0, 1e-3, "with a soft spring");
  claim(rows.back().predicted < 0.3 * rows.back().beam_only, "a stiff spring shortens the step");
}

void study_damping(const std::filesystem::path& directory) {
  const StudyColumns<Damping> columns = {
      {"method", &Damping::method, {"method", "<22"}},
      {"omega_h", &Damping::angle, {"omega h", ">9", ".4g"}},
      {"predicted", &Damping::predicted, {"predicted", ">10", ".5f"}},
      {"measured", &Damping::measured, {"left by one step", ">16", ".5f"}}};
  const std::vector<Damping> rows = damping_of_implicit_tables(paper_strike(51));
  write(directory, "damping.csv", columns, rows);
  for (const Damping& row : rows) {
    claim_near(row.measured, row.predicted, 1e-8, row.method);
    claim(row.measured < 1.0 + 1e-3, row.method + " grows");
    for (const auto& [method, left, tolerance] : {std::tuple("dirk:ark324", 0.28, 0.005),
                                                  {"dirk:esdirk436", 0.75, 0.01},
                                                  {"dirk:esdirk437", 0.86, 0.005}}) {
      if (row.method != method || std::abs(row.angle - 10.0) > 1e-9) continue;
      claim_near(row.measured, left, tolerance, row.method + " at 10");
    }
  }
  const std::vector<MultistepGrowth> growths = bdf_growths();
  const Columns<MultistepGrowth> columns_of_growth = {{"order", &MultistepGrowth::order},
                                                      {"omega_h", &MultistepGrowth::angle},
                                                      {"growth", &MultistepGrowth::growth}};
  if (!directory.empty()) {
    std::ofstream(directory / "bdf_growth.csv") << csv_text(columns_of_growth, growths);
  }
  double low[6] = {}, high[6] = {};
  for (const MultistepGrowth& row : growths) {
    if (row.growth <= 1.0 + 1e-9) continue;
    if (low[row.order] == 0.0) low[row.order] = row.angle;
    high[row.order] = row.angle;
  }
  for (int order = 1; order <= 5; ++order) {
    if (low[order] > 0.0) {
      fmt::print("bdf of order {} grows for omega h from {:.3g} to {:.3g}\n", order, low[order],
                 high[order]);
    }
  }
  claim(low[1] == 0.0 && low[2] == 0.0 && low[3] <= 0.11, "bdf grows from order 3 on");
  claim_near(high[3], 1.94, 0.15, "range of growth of order 3");
  claim_near(low[5], 0.71, 0.06, "range of growth of order 5, from");
  claim_near(high[5], 9.39, 0.7, "range of growth of order 5, to");
}

template <auto number>
constexpr auto errors = [](const LayerPoint& row) { return row.errors.*number; };

void study_pairs(const std::filesystem::path& directory) {
  using Row = MissedPairs;
  const StudyColumns<Row> columns = {
      {"step_s", &Row::step, {"step, us", ">9", ".3g", us}},
      {"runs", &Row::n_runs},
      {"right_with_search", &Row::right_with_search, {"all found, pairs looked for", ">28"}},
      {"right_without", &Row::right_without, {"all found, ends of steps only", ">28"}},
      {"shortest_s", &Row::shortest, {"shortest, us", ">13", ".3g", us}}};
  Case input = paper_strike(501);
  input.end_time = directory.empty() ? 0.25e-3 : 2e-3;
  const std::vector<Row> rows = missed_pairs(input);
  write(directory, "missed_pairs.csv", columns, rows);
  claim(rows.at(0).shortest > rows.at(0).step, "nothing is as short as the shortest step");
  claim(rows.at(0).right_without == rows.at(0).right_with_search,
        "which misses nothing either way");
  claim(rows.at(5).right_without < rows.at(5).right_with_search - 5, "steps of 8 us miss pairs");
}

void study_layers(const std::filesystem::path& directory) {
  const StudyColumns<LayerPoint> columns = {
      {"layers", &LayerPoint::layers, {"layers", ">7"}},
      {"sub_impacts", errors<&EventErrors::n_found>, {"sub-impacts", ">11"}},
      {"exact_sub_impacts", errors<&EventErrors::n_reference>, {"exact", ">6"}},
      {"corresponding", errors<&EventErrors::n_corresponding>, {"correspond", ">12"}},
      {"median_difference_s", errors<&EventErrors::median>, {"median, us", ">14", ".3e", us}},
      {"max_difference_s", errors<&EventErrors::maximum>, {"largest, us", ">12", ".3e", us}}};
  Case input = paper_strike(501);
  input.end_time = directory.empty() ? 0.6e-3 : 2e-3;
  const std::vector<LayerPoint> points = layers_against_exact(input).points;
  write(directory, "layers.csv", columns, points);
  const EventErrors &ten = points.at(0).errors, &forty = points.at(2).errors,
                    &finest = points.at(6).errors;
  claim(!ten.all_correspond() && forty.all_correspond() && finest.all_correspond(),
        "ten layers miscount, forty do not");
  claim_near(std::log2(forty.median / finest.median) / 4.0, 2.0, 0.4, "order of layers");
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path directory = argc > 1 ? argv[1] : "";
  if (!directory.empty()) std::filesystem::create_directories(directory);
  study_critical_steps(directory);
  study_growth();
  study_stiff_contact(directory);
  study_damping(directory);
  study_pairs(directory);
  study_layers(directory);
  fmt::print("\nevery claim of validation/truth/stability/README.md {}\n",
             all_hold ? "holds" : "but those above");
  return all_hold ? 0 : 1;
}
