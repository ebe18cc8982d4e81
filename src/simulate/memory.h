#pragma once

#include <filesystem>

namespace subimpact {

/// Bytes that a process may still take: what the machine has free (Linux: MemAvailable), and less
/// where a limit of the process (ulimit -v), of its control group or of one above is lower. Pages
/// of files, which the system drops when memory is short, count as free. `root`: where the files
/// of the system lie, for tests.
double available_memory(const std::filesystem::path& root = "/");

}  // namespace subimpact
