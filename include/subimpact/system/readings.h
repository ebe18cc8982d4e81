#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace subimpact {

/// The energies of a run (J). Their total() is the initial energy, but for errors.
struct Energies {
  double striker = 0.0;       ///< U_m = m v_m^2/2
  double beam_kinetic = 0.0;  ///< U_k = v^T Mass v/2
  double bending_elastic =
      0.0;  ///< U_e, with that of shear, tension, springs, supports and bedding
  double bending_plastic = 0.0;  ///< U_p, with that of tension
  double contact_elastic = 0.0;  ///< U_c
  double contact_plastic = 0.0;  ///< D_c, dissipated by the contact, with its damping
  double beam_damping = 0.0;     ///< D_b, dissipated by the damping of the beam and its supports
  double work = 0.0;             ///< W, of gravity and loads since the start

  double dissipated() const { return bending_plastic + contact_plastic + beam_damping; }
  /// Energy in the bodies and the contact, dissipated energy included.
  double taken_up() const {
    return striker + beam_kinetic + bending_elastic + bending_plastic + contact_elastic +
           contact_plastic + beam_damping;
  }
  double total() const { return taken_up() - work; }
};

/// Events, at which the equations of motion change.
enum class EventKind {
  contact_begins,    ///< the gap closes: indentation rises through the residual one
  contact_yields,    ///< the indentation rises through its largest value so far (or first yield)
  contact_unloads,   ///< the indentation stops growing while the contact flows
  contact_ends,      ///< the force falls to zero
  section_reverses,  ///< a flowing section reverses
  support_touches,   ///< the beam touches a support that it can lift off
  support_lifts      ///< it lifts off
};

/// The name used in transitions.csv.
std::string_view to_string(EventKind kind);

/// One located event. `value` is the indentation (m) for events of contact and supports, the
/// curvature (1/m) for those of a section; `section` is its index from the first end, `spring` that
/// of the support in Beam::springs; or none.
struct Transition {
  double time = 0.0;  ///< s
  EventKind kind = EventKind::contact_begins;
  std::optional<std::size_t> section;
  double value = 0.0;
  std::optional<std::size_t> spring = {};
};

/// Neighbouring sections whose plastic curvature has one sign: a plastic hinge of some extent.
struct PlasticZone {
  double from, to;  ///< m, ends of the stretch that the sections represent
  double rotation;  ///< rad: the integral of the plastic curvature
};

}  // namespace subimpact
