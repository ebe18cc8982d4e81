#pragma once

#include <string>

namespace subimpact {

std::string sundials_version();  ///< of the library that runs
std::string klu_version();       ///< of the headers compiled against

}  // namespace subimpact
