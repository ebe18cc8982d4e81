#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "subimpact/model/scene.h"

namespace subimpact {

/// State of a run at its end, from which a later run can continue. Displacements and velocities are
/// those of the mesh's unknowns, also of runs in natural modes.
struct RunState {
  double time = 0.0;  ///< s
  Striker striker;
  /// As in ResolvedSettings; a run that continues this one must have the same.
  std::string mesh, section, contact_law;
  /// Numbers by part: "motion", "contact", "sections", "accounts", "records" ..., in SI units.
  std::map<std::string, std::vector<double>> numbers;
  /// States of the runs beside it, which show its errors, by their descriptions.
  std::vector<std::pair<std::string, std::shared_ptr<const RunState>>> beside;
};

/// Whether a run with this striker continues the strike of `start` and does not begin another one
/// (see Problem::at_rest); false without `start`.
bool goes_on(const RunState* start, const Striker& striker, const std::optional<bool>& at_rest);

}  // namespace subimpact
