#pragma once

/// One scene of the study, run and judged.

#include <string>
#include <vector>

#include "random_scenes/checks.h"
#include "random_scenes/generator.h"

namespace subimpact::scenes {

/// What is kept of a scene.
struct Record {
  SceneId id;
  int refused = 0, too_costly = 0;
  std::string method, setting;  ///< in words
  std::string band;             ///< of rtol; "fixed steps"
  std::string outcome;          ///< a name of OutcomeKind, "wall clock", "crashed", "hung"
  std::string message;          ///< of the outcome, where it did not complete
  bool elastic = false;         ///< the sections never yield
  bool tight = false;           ///< adaptive, at rtol 1e-6 or below
  bool plain = false;           ///< events, reversals and pair detection at their defaults
  double reached = 0.0;         ///< of the end time
  double seconds = 0.0;         ///< of wall clock, all runs
  double guess = 0.0;           ///< seconds that the first run was thought to take
  int n_sub_impacts = 0;
  std::vector<Failure> failures;
  // Of scenes for counts:
  bool compared = false;     ///< the two references completed and agree
  std::string why_not = {};  ///< they were not compared
  bool wrong_count = false;  ///< of the drawn run, completed
  bool flagged = false;      ///< it says so itself
};

/// The scene's settings, before it is run.
Record describe(const SceneId& id, const Drawn& drawn);

/// Runs it, each run for at most `limit` s of wall clock.
Record run_scene(const SceneId& id, double limit);

std::string to_line(const Record& record);
Record from_line(const std::string& line);

}  // namespace subimpact::scenes
