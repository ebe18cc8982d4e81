#pragma once

/// Studies as text and CSV files. Functions that write files throw OutputError.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "subimpact/io/output_directory.h"
#include "subimpact/study/compare.h"
#include "subimpact/study/stability.h"
#include "subimpact/study/work_precision.h"

namespace subimpact {

/// Writes comparison.csv (one row per method) and matches.csv (one row per method and sub-impact).
void write_comparison(const std::filesystem::path& directory, const Comparison& comparison);
std::string comparison_csv(const Comparison& comparison);
std::string matches_csv(const Comparison& comparison);

/// The reference, one line per point, and why a point is not right, in words.
std::string work_precision_table(const WorkPrecision& study);

/// One sentence for each wanted error.
std::string recommendation_text(const std::vector<Recommendation>& recommendations);

/// work_precision.csv: one row per point of each study.
std::string work_precision_csv(const std::vector<WorkPrecision>& studies);

/// Identifies a case: a fingerprint of the program's version and of all keys except the title, the
/// outputs and those that a study sets (method, table, tolerance, step).
std::string case_id(const Case& input);

/// One letter for each run, and outcomes.csv, one row for each.
std::string outcome_table(const OutcomeMap& map);
std::string outcomes_csv(const OutcomeMap& map);

}  // namespace subimpact
