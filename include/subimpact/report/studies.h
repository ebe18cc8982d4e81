#pragma once

/// Studies of methods and meshes as text, CSV and figures.

#include <filesystem>
#include <string>
#include <vector>

#include "subimpact/study/plan.h"
#include "subimpact/study/stability.h"
#include "subimpact/study/work_precision.h"

namespace subimpact {

// Each function of a kind takes one part of a study of stability; see subimpact/study/stability.h
// for what is in it.
std::string critical_step_table(const std::vector<CriticalStep>& rows);
std::string stiff_contact_table(const std::vector<StiffContact>& rows);
std::string damping_table(const std::vector<Damping>& rows);
std::string outcome_table(const OutcomeMap& map);
std::string missed_pairs_table(const std::vector<MissedPairs>& rows);
std::string layer_table(const LayerStudy& study);

/// Each writes its CSV (critical_steps.csv, stiff_contact.csv, damping.csv, bdf_growth.csv,
/// outcomes.csv, missed_pairs.csv, layers.csv) and its figure of the same name (SVG and PNG;
/// damping and bdf_growth share one). Throw OutputError.
void write_critical_steps(const std::filesystem::path& directory,
                          const std::vector<CriticalStep>& rows);
void write_stiff_contact(const std::filesystem::path& directory,
                         const std::vector<StiffContact>& rows);
void write_damping(const std::filesystem::path& directory, const std::vector<Damping>& rows,
                   const std::vector<MultistepGrowth>& growths);
void write_outcomes(const std::filesystem::path& directory, const OutcomeMap& map);
void write_missed_pairs(const std::filesystem::path& directory,
                        const std::vector<MissedPairs>& rows);
void write_layers(const std::filesystem::path& directory, const LayerStudy& study);

/// plan.svg and .png from plan.csv, which write_plan() has written into the directory: error on x,
/// counted work on y, one line per sequence of meshes. Filled marks are admitted. Throws
/// OutputError.
void draw_plan(const std::filesystem::path& directory, const Plan& plan);

/// work_precision.svg and .png (wall time), work_precision_evaluations.svg and .png (right-hand
/// sides): error on x, cost on y, one panel per study. Runs that found all sub-impacts are filled
/// marks, those that lost or invented some hollow, those that failed crosses at the right edge.
/// Throws OutputError.
void draw_work_precision(const std::filesystem::path& directory,
                         const std::vector<WorkPrecision>& studies);

}  // namespace subimpact
