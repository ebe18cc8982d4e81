#pragma once

#include <optional>
#include <vector>

#include "subimpact/case/case_keys.h"
#include "subimpact/simulate/assessment.h"

namespace subimpact {

/// The scene with one thing put in that its model leaves out or its case leaves open.
struct BodyVariant {
  BodyPart kind = BodyPart::shear;
  std::vector<Case> cases = {};  ///< the largest change counts; none: not known
  /// What they are compared with, on coarse cells, where the method of the run does not take them.
  std::optional<Case> base = {};
};

/// Those that a run can show. `yields`: whether sections of the run do.
std::vector<BodyVariant> body_variants(const Case& input, const GivenKeys& given, bool yields);

/// The case with a contact that never yields.
Case with_elastic_contact(Case input);

}  // namespace subimpact
