#pragma once

namespace subimpact {

/// The energies of a run (J). Their total() is the initial energy, but for errors.
struct Energies {
  double striker = 0.0;          ///< U_m = m v_m^2/2
  double beam_kinetic = 0.0;     ///< U_k = v^T Mass v/2
  double bending_elastic = 0.0;  ///< U_e, with that of shear, tension, springs and bedding
  double bending_plastic = 0.0;  ///< U_p, with that of tension
  double contact_elastic = 0.0;  ///< U_c
  double contact_plastic = 0.0;  ///< D_c, dissipated by the contact, with its damping
  double beam_damping = 0.0;     ///< D_b, dissipated by the damping of the beam
  double work = 0.0;             ///< W, of gravity and loads since the start

  /// Energy in the bodies and the contact, dissipated energy included.
  double taken_up() const {
    return striker + beam_kinetic + bending_elastic + bending_plastic + contact_elastic +
           contact_plastic + beam_damping;
  }
  double total() const { return taken_up() - work; }
};

}  // namespace subimpact
