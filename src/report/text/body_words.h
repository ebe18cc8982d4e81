#pragma once

#include <string>

#include "subimpact/simulate/answers.h"

namespace subimpact {

/// "contact law".
std::string label_of(BodyPart part);

/// What makes this part of an error of the body smaller, or why nothing does.
std::string remedy_of(BodyPart part);

}  // namespace subimpact
