#pragma once

#include <vector>

#include "subimpact/simulate/records.h"

namespace subimpact {

/// The sub-impacts of another run that correspond to those of a base run, one to one.
struct Counterparts {
  /// By number in the base run; null where contacts have merged, split or vanished. They point into
  /// the list of the other run.
  std::vector<const SubImpact*> of;
  /// By number in the base run: whether the other run has a contact before it that the base run
  /// lacks.
  std::vector<bool> follows_new_one;
};

Counterparts counterparts(const std::vector<SubImpact>& base, const std::vector<SubImpact>& other);

}  // namespace subimpact
