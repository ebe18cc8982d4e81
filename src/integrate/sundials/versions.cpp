#include "integrate/sundials.h"

#include <klu.h>
#include <sundials/sundials_version.h>

#include <array>
#include <stdexcept>

namespace subimpact {

std::string sundials_version() {
  std::array<char, 64> text{};
  if (SUNDIALSGetVersion(text.data(), static_cast<int>(text.size())) != 0) {
    throw std::runtime_error("SUNDIALSGetVersion failed");
  }
  return text.data();
}

std::string klu_version() {
  return std::to_string(KLU_MAIN_VERSION) + "." + std::to_string(KLU_SUB_VERSION) + "." +
         std::to_string(KLU_SUBSUB_VERSION);
}

}  // namespace subimpact
