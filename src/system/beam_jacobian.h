#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "ode/second_order_ode.h"
#include "subimpact/model/mesh/beam_mesh.h"
#include "system/contact/contact_state.h"

namespace subimpact {

/// Mass and tangent stiffness of a struck beam as sparse matrices of one pattern: the beam's band,
/// the striker's diagonal entry, and a row and a column that couple it to the unknowns under it by
/// dF/dlambda g g^T, g = [-S; 1] the gradient of the indentation. A stop has 1 in place of the mass
/// and no row of g g^T, so that it stays at rest. Supports that lift add dF_j/dd_j a_j a_j^T within
/// the band.
class BeamJacobian {
 public:
  BeamJacobian(const BeamMesh& mesh, double striker_mass,
               std::span<const LiftingSupport> supports = {});

  const SparsityPattern& pattern() const { return pattern_; }
  void mass_entries(std::span<double> values) const;
  /// Without contacts: `tangents` = dM/dkappa (N m2) of the sections; `tension` (N) times `form`
  /// (G), if any, joins the beam's stiffness.
  void stiffness_entries(std::span<const double> tangents, std::span<double> values,
                         double tension = 0.0, const BandedMatrix* form = nullptr);
  /// Adds slope (N/m) g g^T, or that of a support (from 1).
  void add_contact(std::size_t contact, double slope, std::span<double> values) const;

 private:
  void copy_band(const BandedMatrix& band, std::span<double> values) const;

  const BeamMesh& mesh_;
  double striker_mass_;
  std::size_t n_;  // unknowns of the beam
  BandedMatrix bending_;
  SparsityPattern pattern_;
  struct ContactEntry {
    std::size_t position;  // in the pattern
    double coefficient;
  };
  std::vector<std::vector<ContactEntry>> contact_entries_;  // g g^T, and of each support
};

}  // namespace subimpact
