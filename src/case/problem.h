#pragma once

#include <memory>

#include "subimpact/case/simulate.h"

namespace subimpact {

/// Whether a section of the beam may ever yield.
bool may_yield(const Case& input);

/// Whether the case is modelled by one half.
bool uses_symmetry(const Case& input);

/// The contact law of a case: its own part, or the one that the scene names.
std::shared_ptr<const ContactLaw> contact_law_of(const Case& input);

}  // namespace subimpact
