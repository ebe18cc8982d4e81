#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "subimpact/case/simulate.h"

namespace subimpact::peers {

/// One way to run the strike, and what came of it.
struct Attempt {
  std::string text;             ///< "rtol 1e-07"
  std::function<Result()> run;  ///< none: run by another program
  double seconds = 0.0;         ///< processor time, least of all runs
  double error = 0.0;           ///< s, the largest of all starts and ends
  bool right = false;           ///< completed, no sub-impact lost or invented
};

struct Contestant {
  std::string name;
  bool ours = false;
  /// Attempts of one kind, loosest first. Which kind is best is part of the competition.
  std::vector<std::vector<Attempt>> sweeps;
};

/// All that this build has. `input` is the scene, up to the time to compare; names of libraries
/// that it lacks are added to `skipped`.
std::vector<Contestant> contestants(const Case& input, std::vector<std::string>& skipped);

/// Runs of another program, read from its file: lines "SETTING seconds count start end ..." in s.
Contestant read_contestant(const std::string& name, const std::string& file,
                           const std::vector<SubImpact>& reference);

/// Judges sub-impacts against the reference.
void judge(Attempt& attempt, const std::vector<SubImpact>& found,
           const std::vector<SubImpact>& reference);

}  // namespace subimpact::peers
