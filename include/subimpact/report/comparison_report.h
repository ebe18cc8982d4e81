#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "subimpact/io/read_results.h"

namespace subimpact {

/// Finished runs beside each other as one page of HTML that needs nothing else: the keys in which
/// their cases differ, curves in common charts (see html_report()), and the sub-impacts of each run
/// matched with those of the first. `names` are the runs' names, one per run.
std::string comparison_report(const std::vector<FinishedRun>& runs,
                              const std::vector<std::string>& names,
                              const std::filesystem::path& dygraphs = {});

/// Writes comparison.html into a directory. Throws OutputError.
void write_comparison_report(const std::filesystem::path& directory,
                             const std::vector<FinishedRun>& runs,
                             const std::vector<std::string>& names,
                             const std::filesystem::path& dygraphs = {});

}  // namespace subimpact
