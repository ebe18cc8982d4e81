#pragma once

#include <filesystem>
#include <string>

#include "subimpact/study/plan.h"

namespace subimpact {

/// The reference's event times with their errors.
std::string plan_reference_table(const Plan& plan);

/// What was tried, the cheapest that is admitted with the options that select it, and the horizon.
std::string plan_table(const Plan& plan);

/// Writes reference.csv and plan.csv. Throws OutputError.
void write_plan(const std::filesystem::path& directory, const Plan& plan);

}  // namespace subimpact
