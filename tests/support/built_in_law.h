#pragma once

#include "model/contact_laws.h"

namespace subimpact {

/// The law that a scene names, with its constants.
inline PowerContact law_of(const Scene& scene) {
  return dynamic_cast<const PowerContact&>(*make_contact_law(scene));
}

}  // namespace subimpact
