#pragma once

#include "model/contact_laws.h"
#include "subimpact/case/case.h"

namespace subimpact {

/// Whether the keys of the contact go together: what its law needs is there, and nothing is given
/// that the law would not use. Throws InvalidCase.
void check_contact(const Case& input);

/// The way in which a case gives a law its constants.
const ContactConstants& constants_given(const Case& input, const BuiltInContactLaw& law);
bool uses_key(const ContactConstants& way, const char* key);

}  // namespace subimpact
