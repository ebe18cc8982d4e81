#pragma once

#include <filesystem>
#include <string>

#include "subimpact/study/sensitivity.h"

namespace subimpact {

/// sensitivity.csv: one row per number of a sub-impact, and for each key of the study its
/// derivative by the logarithm of the key (d_<key>) and the error of that (error_<key>).
std::string sensitivity_csv(const Sensitivity& study);

/// Writes sensitivity.csv into a directory. Throws OutputError.
void write_sensitivity(const std::filesystem::path& directory, const Sensitivity& study);

/// Starts and ends of all sub-impacts, and how much later they come per 1 % more of each key, with
/// the digits that the errors allow.
std::string sensitivity_table(const Sensitivity& study);

}  // namespace subimpact
