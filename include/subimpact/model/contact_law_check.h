#pragma once

#include <optional>
#include <string>

#include "subimpact/model/contact_law.h"

namespace subimpact {

/// Samples a contact law up to an indentation (m) and returns, in one sentence, the first rule of
/// ContactLaw that it breaks; nothing if it keeps to all of them. Forces and energies may be off by
/// 1e-3 of their largest values: this finds mistakes, not rounding. simulate(Case) calls it for a
/// law of the caller's own.
std::optional<std::string> broken_rule(const ContactLaw& law, double largest_indentation);

}  // namespace subimpact
