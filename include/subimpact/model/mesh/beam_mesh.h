#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "subimpact/model/scene.h"
#include "subimpact/numerics/banded_matrix.h"

namespace subimpact {

/// A few coefficients on the unknowns: a functional of the displacement, or a point load.
struct SparseFunctional {
  struct Term {
    std::size_t unknown;
    double coefficient;
  };
  std::vector<Term> terms;
  std::vector<double> dense;  ///< the same, one coefficient per unknown, where the terms are many

  /// Whether it is zero whatever the unknowns are.
  bool is_zero() const { return terms.empty() && dense.empty(); }
  double operator()(std::span<const double> unknowns) const {
    if (!dense.empty()) return of_all(unknowns);
    double sum = 0.0;
    for (const Term& term : terms) sum += term.coefficient * unknowns[term.unknown];
    return sum;
  }
  /// Adds `factor` times another functional of few terms; terms that cancel are removed.
  void add(double factor, const SparseFunctional& other);
  /// to += factor * coefficients coefficients^T, of few terms within the band of `to`.
  void add_square(double factor, BandedMatrix& to) const;
  /// forces += amount * coefficients: the generalised force of a point load `amount`.
  void add_to(std::span<double> forces, double amount) const {
    if (!dense.empty()) {
      for (std::size_t i = 0; i < dense.size(); ++i) forces[i] += amount * dense[i];
      return;
    }
    for (const Term& term : terms) forces[term.unknown] += amount * term.coefficient;
  }

 private:
  double of_all(std::span<const double> unknowns) const;
};

class BeamMesh;

/// All natural modes of a mesh, elastic: K phi = omega^2 Mass phi, phi^T Mass phi = 1.
struct NaturalModes {
  std::vector<double> frequencies;  ///< omega, rad/s, ascending; exactly 0 for rigid modes
  std::vector<double> shapes;       ///< mode k in entries k n .. k n + n - 1

  std::size_t size() const { return frequencies.size(); }
  std::span<const double> shape(std::size_t mode) const {
    return {shapes.data() + mode * size(), size()};
  }
  std::span<double> shape(std::size_t mode) { return {shapes.data() + mode * size(), size()}; }
};

/// Scales shapes so that phi^T Mass phi = 1.
void normalise(NaturalModes& modes, const BandedMatrix& mass);

/// Natural modes by dense decomposition, for any mesh, with corrections that remove the mixing of
/// low modes by rounding; where sections shear, frequencies grow too slowly for that to matter.
/// Frequencies are Rayleigh quotients of B phi and the shear energy, which keeps the lowest
/// accurate in spite of the highest; those below 1e-7 of the highest count as rigid.
NaturalModes dense_natural_modes(const BeamMesh& mesh, double bending_stiffness);

/// A beam discretised into finitely many unknowns.
///
/// With unknowns q (displacements, and slopes where a mesh has them), curvatures kappa = B q at the
/// sections (stress points) and their integration weights W (m), the beam obeys
///
///     Mass q'' = -B^T W M(kappa) - K_s q + S F,
/// with the bending moments M (sign convention of kappa), the functional S of the struck point and
/// the elastic stiffness K_s of shear and of springs to the ground, where the mesh has any. Bending
/// work is sum W M dkappa and contact work F d(S q), so the discretisation in space neither
/// produces nor loses energy. Where symmetry halves the unknowns, the mirrored half is folded into
/// Mass and W, so all forces, energies and momenta are those of the whole beam.
///
/// A user-defined mesh derives from this class, fills the protected members in its constructor and
/// is assigned to `Case::parts.mesh` or `Problem::mesh`; the built-in meshes use the same
/// interface. Requirements: Mass is positive definite, of half bandwidth up to 3; curvatures(),
/// bending_forces() and section_stencil() are one and the same B; the highest frequency is not
/// below that of the mesh (time steps follow from it). The functions are pure: runs in several
/// threads may share a mesh. broken_rule() finds what breaks these rules before a run; what it does
/// not find gains or loses energy, and the run ends as `inaccurate`. Fixed at present: one
/// generalised strain per section that may yield, the curvature, and one elastic bending stiffness
/// for all sections (the argument `bending_stiffness`).
class BeamMesh {
 public:
  /// Which part of the beam a mesh models.
  enum class Extent { whole, half };

  virtual ~BeamMesh() = default;

  std::size_t n_unknowns() const { return mass_.size(); }
  std::size_t n_sections() const { return weights_.size(); }

  const BandedMatrix& mass() const { return mass_; }                        ///< kg
  std::span<const double> section_weights() const { return weights_; }      ///< W, m
  std::span<const double> section_positions() const { return positions_; }  ///< x, m
  const SparseFunctional& struck_point() const { return struck_point_; }    ///< S
  const SparseFunctional& first_end() const { return first_end_; }          ///< w(0)
  std::size_t nearest_section(double x) const;  ///< the first of those nearest to x (m)
  /// Index of the section at (or nearest to) the struck point.
  std::size_t struck_section() const { return struck_section_; }
  /// Unknowns of a rigid translation by 1 m; empty where a support prevents it.
  std::span<const double> translation() const { return translation_; }
  /// Momentum of the beam for 1 m/s of each unknown, kg.
  std::span<const double> momentum_functional() const { return momentum_functional_; }
  /// Moment of momentum of the beam about x = 0 for 1 m/s of each unknown, kg m: the integral of
  /// rho A x w_t + J phi_t, with the rotation phi of sections. Empty where a mesh does not give it,
  /// and on one half of a beam.
  std::span<const double> moment_functional() const { return moment_functional_; }
  /// Force (N) and moment about x = 0 (N m) of springs and bedding on the ground for 1 m of each
  /// unknown; empty where is_sprung() does not hold.
  std::span<const double> ground_force() const { return ground_force_; }
  std::span<const double> ground_moment() const { return ground_moment_; }
  double beam_mass() const { return beam_mass_; }  ///< kg, of the whole beam
  /// Whether springs or a bedding hold the beam (SprungMesh).
  virtual bool is_sprung() const { return false; }
  /// Whether only one half is stored.
  bool symmetric() const { return symmetric_; }

  /// kappa = B q, 1/m.
  virtual void curvatures(std::span<const double> unknowns, std::span<double> kappa) const = 0;
  /// forces = -B^T W moments, N; `moments` = M, N m, with the sign convention of kappa.
  virtual void bending_forces(std::span<const double> moments, std::span<double> forces) const = 0;
  /// One row of B: coefficients (1/m2) of consecutive unknowns, beginning with `first`.
  struct SectionStencil {
    std::size_t first;
    std::span<const double> coefficients;
  };
  /// By default the row that add_stencil() has stored.
  virtual SectionStencil section_stencil(std::size_t section) const;

  /// Whether K_s is not zero: sections shear, or springs hold the beam.
  virtual bool shears() const { return shear_stiffness_.size() > 0; }
  /// forces -= K_s q, N; nothing where sections do not shear.
  virtual void add_shear_forces(std::span<const double> unknowns, std::span<double> forces) const;
  /// forces = -B^T W moments - K_s q, N: what bending_forces() and add_shear_forces() give, whose
  /// separate callers an override must agree with. `forces` must not overlap the others.
  virtual void internal_forces(std::span<const double> unknowns, std::span<const double> moments,
                               std::span<double> forces) const;
  /// q^T K_s q/2, J.
  virtual double shear_energy(std::span<const double> unknowns) const;

  /// Curvature of one section, 1/m.
  virtual double curvature(std::size_t section, std::span<const double> unknowns) const;
  /// Curvature of one section as coefficients on the unknowns.
  virtual SparseFunctional curvature_functional(std::size_t section) const;
  /// Displacement w of the axis at x (m, from 0 to the end of the part modelled) and rotation of
  /// the section there (rad; the slope w' where sections do not shear), as coefficients on the
  /// unknowns; where the rotation jumps, the mean of both sides, or at an end the inner one.
  /// Nothing on a mesh without these functions: a run then has no shapes.
  virtual std::optional<SparseFunctional> displacement_at(double /*x*/) const { return {}; }
  virtual std::optional<SparseFunctional> rotation_at(double /*x*/) const { return {}; }
  /// The slope w' of the axis at a point, and the length (m) of beam that it stands for.
  struct Slope {
    double weight;
    SparseFunctional value;  ///< rad
  };
  /// Points that give the integral of w'^2 over the beam as a sum; none on a mesh without them: its
  /// beam cannot stretch.
  virtual std::vector<Slope> slopes() const { return {}; }
  /// That integral as a quadratic form q^T G q, G in 1/m, in the band of add_stiffness(); of size
  /// zero without slopes.
  BandedMatrix slope_form() const;
  /// Half bandwidth of B^T B and K_s.
  std::size_t stiffness_bandwidth() const;
  /// result += B^T W diag(tangents) B + K_s, N/m; `tangents` = dM/dkappa of the sections, N m2. The
  /// half bandwidth of `result` must be stiffness_bandwidth() or more.
  void add_stiffness(std::span<const double> tangents, BandedMatrix& result) const;
  /// A close upper bound of the highest natural frequency, rad/s, for a bending stiffness (N m2).
  virtual double highest_frequency(double bending_stiffness) const = 0;
  /// All natural modes while nothing flows, for a bending stiffness (N m2); normalised by the mass.
  virtual NaturalModes natural_modes(double bending_stiffness) const {
    return dense_natural_modes(*this, bending_stiffness);
  }
  /// Whether natural_modes() needs no matrix decomposition, and a sixth of the memory.
  virtual bool has_closed_modes() const { return false; }
  /// What natural_modes() then takes, as a number of entries of right-hand sides, roughly.
  virtual double closed_modes_work() const {
    return 2.0 * static_cast<double>(n_unknowns()) * static_cast<double>(n_unknowns());
  }

  /// Whether explicit methods should integrate an elastic beam in its modes, because the modes are
  /// cheap and the band is wide; the motion is the same.
  virtual bool prefers_modes() const { return false; }
  /// Stiffnesses (N/m) of the unknowns if these are natural modes; otherwise empty.
  virtual std::span<const double> modal_stiffness() const { return {}; }
  /// "501 cells, one half by symmetry", for people.
  virtual std::string description() const = 0;

 protected:
  BeamMesh(std::size_t n_unknowns, std::size_t half_bandwidth, bool symmetric)
      : mass_(n_unknowns, half_bandwidth), symmetric_(symmetric) {}

  /// "501 cells, one half by symmetry".
  std::string described(std::size_t n, const char* parts) const;
  /// 2 where the mirrored half is folded in.
  double copies() const { return symmetric_ ? 2.0 : 1.0; }
  /// Stores the row of B of the next section; to be called section by section.
  void add_stencil(std::size_t first, std::span<const double> coefficients);

  BandedMatrix mass_;
  BandedMatrix shear_stiffness_{0, 0};  ///< K_s, N/m; of size zero where it is zero
  std::vector<double> weights_;
  std::vector<double> positions_;
  SparseFunctional struck_point_;
  SparseFunctional first_end_;
  std::size_t struck_section_ = 0;
  std::vector<double> translation_;
  std::vector<double> momentum_functional_;
  std::vector<double> moment_functional_;
  std::vector<double> ground_force_, ground_moment_;
  double beam_mass_ = 0.0;
  bool symmetric_;

 private:
  struct StoredStencil {
    std::size_t first, begin, size;
  };
  std::vector<StoredStencil> stencils_;
  std::vector<double> stencil_coefficients_;  // of all, one after another
};

/// The first rule of BeamMesh that a mesh of this beam breaks, in one sentence with number and
/// place; nothing if it keeps all that can be seen without a run. A case with a mesh of the user's
/// own is refused for it.
std::optional<std::string> broken_rule(const BeamMesh& mesh, const Beam& beam);

}  // namespace subimpact
