#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "subimpact/model/mesh/beam_mesh.h"

/// Frequencies and modes of beams and of their meshes, in addition to BeamMesh::natural_modes().

namespace subimpact {

/// The first `n` natural bending frequencies (rad/s) of the beam with its ends, rigid modes left
/// out, in the beam's own theory (docs/theory.md, "Beam"). Timoshenko's is taken to the first order
/// in r^2 and shear: r^2 (1 + E/(k G)) in place of r^2.
std::vector<double> flexural_frequencies(const Beam& beam, std::size_t n);

/// beta_1..beta_n of the same, for a given slenderness r = sqrt(I/A)/l.
std::vector<double> flexural_wave_numbers(double slenderness, const std::array<EndSupport, 2>& ends,
                                          std::size_t n);

/// A chain of equal cells with free ends (see CellMesh).
struct CellChain {
  std::size_t n_cells;
  double spacing;            ///< dx, m
  double mass_per_length;    ///< rho A, kg/m
  double rotary_inertia;     ///< J, kg m
  double bending_stiffness;  ///< E I, N m2
};

/// Its natural modes in closed form (docs/theory.md, "Cells"); work n^2 for n shapes. Rigid
/// translation and rotation come first. Shapes are not normalised. Mode k of the result has entries
/// for cells 0, 1, ..., n_kept - 1.
NaturalModes free_cell_modes(const CellChain& chain, bool symmetric_only, std::size_t n_kept);

/// A chain of equal cells that shear, with free ends (see TimoshenkoMesh).
struct ShearCellChain : CellChain {
  double shear_stiffness;  ///< k G A, N
  double gyration;         ///< r, m, the unit of rotations
};

/// Its natural modes from one equation in each frequency (docs/theory.md, "Cells that shear"); work
/// n^2 for n modes. Frequencies ascend, rigid translation and rotation first; shapes have the
/// unknowns of a TimoshenkoMesh, those of its first half where `symmetric_only`, and unit `mass`.
/// Empty if two waves have the same frequency: the matrix must then be decomposed.
std::optional<NaturalModes> shear_cell_modes(const ShearCellChain& chain, bool symmetric_only,
                                             const BandedMatrix& mass);

/// Gaps between the frequencies squared of two waves, relative to their size. Below `close_poles`
/// the mode between the waves loses digits to rounding and must be made orthogonal to the others;
/// below `apart_poles` it cannot be found.
constexpr double apart_poles = 1e-11, close_poles = 1e-5;

/// Takes from mode k what it has of the others, all of unit mass.
void make_orthogonal(NaturalModes& modes, std::size_t k, const BandedMatrix& mass);

/// Gives shapes, the rigid ones first, unit mass, and as frequencies their Rayleigh quotients,
/// from strains, so that the lowest are accurate in spite of the highest; modes below 1e-7 of the
/// highest frequency are rigid, the first of them the translation itself where the mesh has one.
void complete(NaturalModes& modes, const BeamMesh& mesh, double bending_stiffness);

/// A chain of equal Hermite elements (see HermiteMesh).
struct HermiteChain {
  std::size_t n_elements;    ///< of the whole chain
  double length;             ///< a of an element, m; also the unit of slopes
  double mass_per_length;    ///< rho A, kg/m
  double rotary_inertia;     ///< J, kg m
  double bending_stiffness;  ///< E I, N m2
  std::array<EndSupport, 2> ends;
  bool half;  ///< symmetric modes only, on the first half of the chain
};

/// Whether a chain with these ends has its modes in closed form.
constexpr bool has_closed_modes(std::array<EndSupport, 2> ends) {
  return ends[0] == ends[1] || ends[0] == EndSupport::pinned || ends[1] == EndSupport::pinned;
}

/// Its natural modes in closed form (docs/theory.md, "Hermite elements"); work n^2 for n shapes. At
/// a free end the waves continue into a further element, on which neither force nor couple acts.
///
/// Frequencies ascend, rigid modes first; shapes have the unknowns of a HermiteMesh and are not
/// normalised. Empty if one end is free and the other clamped, or if the number of modes found is
/// not that of the unknowns: the matrix must then be decomposed.
std::optional<NaturalModes> hermite_chain_modes(const HermiteChain& chain);

/// K of an elastic beam, N/m, in a band in which the mass fits too.
BandedMatrix elastic_stiffness(const BeamMesh& mesh, double bending_stiffness);

/// Whether a number (rad2/s2) exceeds the squares of all natural frequencies.
std::function<bool(double)> above_spectrum(const BeamMesh& mesh, double bending_stiffness);

/// The lowest natural modes of a mesh, elastic, and its static response to a force at the struck
/// point.
struct SlowMotion {
  std::vector<double> frequencies;          ///< omega, rad/s, ascending; exactly 0 for rigid modes
  std::vector<std::vector<double>> shapes;  ///< phi^T Mass phi = 1
  /// u, m/N: K u = S - sum (S phi) Mass phi over the rigid modes, whose inertia balances the force.
  std::vector<double> response;

  std::size_t size() const { return frequencies.size(); }
};

/// `n_modes` of them, or all if there are fewer. By subspace iteration with a banded factorisation
/// of K + s Mass, s a part of the first frequency squared, in about n_modes n operations per
/// unknown of the band; where the unknowns are modes, from these. `first_period`: of the beam in
/// bending, roughly, s. Nothing if K + s Mass is not positive definite.
std::optional<SlowMotion> slow_motion(const BeamMesh& mesh, double bending_stiffness,
                                      double first_period, std::size_t n_modes);

}  // namespace subimpact
