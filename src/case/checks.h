#pragma once

#include "model/contact_laws.h"
#include "subimpact/case/case.h"

namespace subimpact {

/// The way in which a case gives a law its constants.
const ContactConstants& constants_given(const Case& input, const BuiltInContactLaw& law);
bool uses_key(const ContactConstants& way, const char* key);

}  // namespace subimpact
