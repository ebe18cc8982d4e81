#pragma once

#include <filesystem>
#include <string>

#include "subimpact/study/plan.h"

namespace subimpact {

/// Extrapolated times with their uncertainty, and every mesh's error against them.
std::string mesh_limit_table(const MeshLimit& limit);

/// What was tried on which mesh, and the cheapest combination with the options that select it.
std::string plan_table(const Plan& plan);

/// Writes meshes.csv, mesh_limit.csv and plan.csv. Throws OutputError.
void write_plan(const std::filesystem::path& directory, const Plan& plan);

}  // namespace subimpact
