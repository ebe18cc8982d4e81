#pragma once

#include <filesystem>
#include <string>

#include "subimpact/io/read_sweep.h"

namespace subimpact {

/// A sweep as one page of HTML that needs nothing else: a map of its runs over two of their keys,
/// with those marked whose counts are not decided, and the numbers and sub-impacts of the run that
/// is chosen on the map. `name`: of the sweep, a directory for example.
std::string sweep_report(const SweptRuns& runs, const std::string& name);

/// Writes sweep.html into a directory. Throws OutputError.
void write_sweep_report(const std::filesystem::path& directory, const SweptRuns& runs,
                        const std::string& name);

}  // namespace subimpact
