#pragma once

#include <fmt/format.h>

#include "paper_run.h"
#include "print.h"
#include "runs.h"

namespace subimpact {

/// The paper's example, erk at rtol = 1e-9, no history rows.
inline Case paper_case(SectionKind section, double end_time, int segments = 501,
                       Method method = Method::erk) {
  Case input = paper_run(section, end_time, segments, method);
  input.solver.rtol = 1e-9;
  return input;
}

struct ReferenceEvent {
  double start_us, end_us, max_indentation_mm, error_us;
};

/// A table of tests/data.
inline std::vector<ReferenceEvent> reference_table(const std::string& name) {
  std::ifstream file(fmt::format("{}/{}.csv", SUBIMPACT_TEST_DATA, name));
  std::vector<ReferenceEvent> table;
  std::string line;
  std::getline(file, line);  // column names
  while (std::getline(file, line)) {
    std::istringstream in(line);
    int index = 0;
    char comma = 0;
    ReferenceEvent row{};
    in >> index >> comma >> row.start_us >> comma >> row.end_us >> comma >>
        row.max_indentation_mm >> comma >> row.error_us;
    EXPECT_FALSE(in.fail()) << line;
    table.push_back(row);
  }
  EXPECT_FALSE(table.empty()) << "no table " << name;
  return table;
}

/// Errors of the first `n` starts and ends by turns, us; the first start is given.
inline std::vector<double> errors_us(const Result& result,
                                     const std::vector<ReferenceEvent>& reference, std::size_t n) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < n; ++i) {
    const SubImpact& here = result.sub_impacts.at(i);
    errors.push_back(std::abs(start_us(here) - reference.at(i).start_us));
    errors.push_back(std::abs(end_us(here) - reference.at(i).end_us));
  }
  return errors;
}

inline double root_of_squares(const std::vector<double>& errors) {
  return std::sqrt(std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0));
}

/// The first nine sub-impacts of the paper's example with exact sections in the limit of fine
/// meshes: extrapolated from 4003 and 8007 cells of this program.
inline std::vector<ReferenceEvent> yielding_limit() {
  return {{0.000, 201.471, 0, 0},   {203.299, 216.261, 0, 0}, {222.386, 275.651, 0, 0},
          {290.740, 314.837, 0, 0}, {347.832, 371.940, 0, 0}, {428.736, 460.403, 0, 0},
          {552.670, 567.946, 0, 0}, {572.759, 588.389, 0, 0}, {785.357, 796.643, 0, 0}};
}

}  // namespace subimpact
