#pragma once

#include <string>

#include "subimpact/case/keys_without_effect.h"

namespace subimpact {

/// Identifies the results of a case: a hash, 32 hexadecimal digits, of the program's version, the
/// values of all keys but the title, what the case leaves to the program (open_choices), and `how`
/// it is run, in words of the caller. Cases that give other results have other identities.
std::string case_identity(const Case& input, const GivenKeys& given, const std::string& how = {});

}  // namespace subimpact
