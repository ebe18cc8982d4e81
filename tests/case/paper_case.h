#pragma once

#include "paper_scene.h"
#include "print.h"
#include "runs.h"

namespace subimpact {

/// The paper's example, erk at rtol = 1e-9, no history rows.
inline Case paper_case(SectionKind section, double end_time) {
  Case input;
  input.title = "free-free beam struck at mid-span";
  input.scene = paper_scene();
  input.model.segments = 501;
  input.model.section = section;
  input.model.layers = 40;
  input.end_time = end_time;
  input.solver.rtol = 1e-9;
  input.output.interval = 0.0;
  return input;
}

struct ReferenceEvent {
  double start_us, end_us, max_indentation_mm, error_us;
};

/// A table of tests/data.
inline std::vector<ReferenceEvent> reference_table(const std::string& name) {
  std::ifstream file(std::string(SUBIMPACT_TEST_DATA) + "/" + name + ".csv");
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

}  // namespace subimpact
