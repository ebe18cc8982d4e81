#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "subimpact/model/scene.h"

namespace subimpact {

/// Where a run stood at its end: what a later run needs to go on from there. Displacements and
/// velocities are those of the mesh's unknowns, in natural modes too.
struct RunState {
  double time = 0.0;  ///< s
  Striker striker;
  /// Of the run, as in ResolvedSettings; a run that goes on must have the same.
  std::string mesh, section, contact_law;
  /// Numbers by part: "motion", "contact", "sections", "accounts", "records" ..., in SI units.
  std::map<std::string, std::vector<double>> numbers;
  /// Those of the runs beside it, which show its errors, by their descriptions.
  std::vector<std::pair<std::string, std::shared_ptr<const RunState>>> beside;
};

/// Whether a run with this striker continues the strike of its start, and does not begin another
/// one (see Problem::at_rest). Not without a start.
bool goes_on(const RunState* start, const Striker& striker, const std::optional<bool>& at_rest);

}  // namespace subimpact
