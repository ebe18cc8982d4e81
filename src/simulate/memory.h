#pragma once

namespace subimpact {

/// Bytes that a process may still take: what the machine has free (Linux: MemAvailable), and less
/// where a limit of the process (ulimit -v) or of its control group is lower.
double available_memory();

}  // namespace subimpact
