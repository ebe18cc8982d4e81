#pragma once

#include "subimpact/case/case.h"

namespace subimpact {

/// Whether the keys of the contact go together: what its law needs is there, and nothing is given
/// that the law would not use. Throws InvalidCase.
void check_contact(const Case& input);

}  // namespace subimpact
