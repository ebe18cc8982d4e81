#pragma once

#include "model/contact/contact_laws.h"
#include "model/contact/power_contact.h"

namespace subimpact {

/// The law that a scene names, with its constants.
inline PowerContact law_of(const Scene& scene) {
  return dynamic_cast<const PowerContact&>(*make_contact_law(scene));
}

}  // namespace subimpact
