#pragma once

#include <filesystem>
#include <string>

#include "subimpact/io/read_results.h"

namespace subimpact {

/// Reads what summary.json holds of a run; `path` is for messages. Returns the layout. Throws
/// ResultsError.
int read_summary(const std::filesystem::path& path, const std::string& text, FinishedRun& run);

}  // namespace subimpact
