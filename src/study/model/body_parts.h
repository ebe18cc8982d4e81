#pragma once

#include <optional>
#include <string>
#include <vector>

#include "subimpact/case/case_keys.h"
#include "subimpact/simulate/result.h"

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

/// A bound on the force (N) of any contact of the run: the contact law loaded for the first time
/// by all energy that striker, beam, gravity and loads can put into it, as by a striker on an
/// anvil. Momentum is not used: a light beam gives less. Infinite for a law with damping.
double largest_possible_force(const Case& input, const Result& result);

/// The scene with what the case leaves open about the bodies in contact, and the program takes as
/// rigid, of steel (210 GPa, 0.3), and the keys that would settle it.
struct SteelContact {
  Case input;
  std::vector<std::string> keys;
};
/// Of the nose, and of a plane; nothing where their moduli are given or the law does not use them.
std::optional<SteelContact> with_steel_contact(const Case& input);

}  // namespace subimpact
