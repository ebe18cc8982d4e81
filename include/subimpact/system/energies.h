#pragma once

namespace subimpact {

/// Every joule has a place (J); their sum is the initial energy m v0^2/2.
struct Energies {
  double striker = 0.0;          ///< U_m = m v_m^2/2
  double beam_kinetic = 0.0;     ///< U_k = v^T Mass v/2
  double bending_elastic = 0.0;  ///< U_e
  double bending_plastic = 0.0;  ///< U_p
  double contact_elastic = 0.0;  ///< U_c
  double contact_plastic = 0.0;  ///< D_c, dissipated by the contact, with its damping
  double beam_damping = 0.0;     ///< D_b, dissipated by the damping of the beam

  double total() const {
    return striker + beam_kinetic + bending_elastic + bending_plastic + contact_elastic +
           contact_plastic + beam_damping;
  }
};

}  // namespace subimpact
