#include "system/no_more_contact.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "numerics/lanes.h"

namespace subimpact {

namespace {

// Added to the mass for factorisation, in units of the first frequency squared: the stiffness of a
// beam that may move rigidly is singular.
constexpr double shift = 0.1;
// Each iteration takes nine tenths of an error off, or more.
constexpr int n_iterations = 16;
// What these and rounding leave of the bound.
constexpr double rounding = 1e-5;

using Vector = std::vector<double>;

// Motions without elastic forces, normalised by the mass, and the shape u.
struct Statics {
  std::vector<Vector> rigid;
  Vector reaction;
};

Statics statics_in_modes(const BeamMesh& mesh, double stiffness) {
  const NaturalModes modes = mesh.natural_modes(stiffness);
  Statics found{{}, Vector(modes.size(), 0.0)};
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const std::span<const double> phi = modes.shape(k);
    const double frequency = modes.frequencies[k];
    if (frequency == 0.0) {
      found.rigid.emplace_back(phi.begin(), phi.end());
      continue;
    }
    const double amount = mesh.struck_point()(phi) / (frequency * frequency);
    for (std::size_t i = 0; i < phi.size(); ++i) found.reaction[i] += amount * phi[i];
  }
  return found;
}

// The same by a banded factorisation of K + s Mass.
class BandedStatics {
 public:
  BandedStatics(const BeamMesh& mesh, double stiffness, double first_frequency)
      : mesh_(mesh),
        n_(mesh.n_unknowns()),
        shift_(shift * first_frequency * first_frequency),
        stiffness_(n_, std::max(mesh.stiffness_bandwidth(), mesh.mass().half_bandwidth())),
        work_(n_) {
    mesh.add_stiffness(Vector(mesh.n_sections(), stiffness), stiffness_);
    BandedMatrix shifted = stiffness_;
    const std::size_t width = mesh.mass().half_bandwidth();
    for (std::size_t j = 0; j < n_; ++j) {
      for (std::size_t i = j; i <= std::min(j + width, n_ - 1); ++i) {
        shifted.at(i, j) += shift_ * mesh.mass().at(i, j);
      }
    }
    factor_ = shifted.cholesky_factor();
  }

  // Nothing if the stiffness has negative values.
  std::optional<Statics> find() {
    if (!factor_) return std::nullopt;
    Statics found;
    while (found.rigid.size() < 2 && add_rigid_motion(found.rigid)) {
    }
    Vector load(n_, 0.0);
    mesh_.struck_point().add_to(load, 1.0);
    balance(found.rigid, load);
    found.reaction = Vector(n_, 0.0);
    for (int i = 0; i < n_iterations; ++i) {
      stiffness_.multiply(found.reaction, work_);
      for (std::size_t k = 0; k < n_; ++k) work_[k] = load[k] - work_[k];
      balance(found.rigid, work_);
      factor_->solve_as_factor(work_);
      for (std::size_t k = 0; k < n_; ++k) found.reaction[k] += work_[k];
    }
    return found;
  }

 private:
  // By inverse iteration from any vector, free of the motions found before.
  bool add_rigid_motion(std::vector<Vector>& rigid) {
    Vector v(n_);
    for (std::size_t k = 0; k < n_; ++k) v[k] = std::cos(static_cast<double>(k * k));
    double growth = 0.0;
    for (int i = 0; i < n_iterations; ++i) {
      mesh_.mass().multiply(v, work_);
      balance(rigid, work_);
      factor_->solve_as_factor(work_);
      growth = std::sqrt(mesh_.mass().quadratic_form(work_) / mesh_.mass().quadratic_form(v));
      const double norm = std::sqrt(mesh_.mass().quadratic_form(work_));
      for (std::size_t k = 0; k < n_; ++k) v[k] = work_[k] / norm;
    }
    if (growth * shift_ < 0.5) return false;
    rigid.push_back(std::move(v));
    return true;
  }
  // Takes from forces what moves the beam rigidly.
  void balance(const std::vector<Vector>& rigid, Vector& forces) const {
    Vector inertia(n_);
    for (const Vector& phi : rigid) {
      const double share = dot(phi.data(), forces.data(), n_);
      mesh_.mass().multiply(phi, inertia);
      for (std::size_t k = 0; k < n_; ++k) forces[k] -= share * inertia[k];
    }
  }

  const BeamMesh& mesh_;
  std::size_t n_;
  double shift_;
  BandedMatrix stiffness_;
  std::optional<BandedMatrix> factor_;
  Vector work_;
};

std::optional<Statics> statics_of(const BeamMesh& mesh, double stiffness, double first_period) {
  if (!mesh.modal_stiffness().empty() || mesh.n_sections() == 0) {
    return statics_in_modes(mesh, stiffness);
  }
  return BandedStatics(mesh, stiffness, 2.0 * M_PI / first_period).find();
}

}  // namespace

NoMoreContact::NoMoreContact(const StruckBeam& beam, const Beam& material, double first_period)
    : n_(beam.mesh().n_unknowns()),
      rigid_motion_decays_(beam.damping().mass > 0.0),
      accounts_(beam),
      curvatures_(beam.mesh().n_sections()),
      moments_(beam.mesh().n_sections()) {
  const BeamMesh& mesh = beam.mesh();
  const SectionField& sections = beam.sections();
  const std::optional<Statics> statics = statics_of(mesh, sections.stiffness(), first_period);
  can_prove_ = statics.has_value();
  if (!can_prove_) return;
  for (const Vector& phi : statics->rigid) {
    rigid_.emplace_back(n_);
    mesh.mass().multiply(phi, rigid_.back());
    rigid_share_.push_back(mesh.struck_point()(phi));
  }
  compliance_ = mesh.struck_point()(statics->reaction);
  if (!sections.can_yield()) return;
  mesh.curvatures(statics->reaction, curvatures_);
  double largest = 0.0;
  for (std::size_t i = 0; i < curvatures_.size(); ++i) {
    largest = std::max(largest, std::abs(curvatures_[i]));
    bar_.push_back(mesh.section_weights()[i] * curvatures_[i]);
  }
  plastic_compliance_ = largest * material.youngs_modulus * 0.5 * material.thickness /
                        material.yield_stress * sections.law().fibres().extent();
}

bool NoMoreContact::is_proven(const StruckBeam& beam, const State& y) {
  if (!can_prove_ || beam.contact().is_closed()) return false;
  const std::span<const double> w{y.data(), n_};
  const std::span<const double> v{y.data() + n_ + 1, n_};
  const Energies energies = accounts_.energies(y);
  double energy = energies.beam_kinetic + energies.bending_elastic;
  double rigid = 0.0;
  double rigid_rate = 0.0;
  for (std::size_t k = 0; k < rigid_.size(); ++k) {
    const double rate = dot(rigid_[k].data(), v.data(), n_);
    rigid += rigid_share_[k] * dot(rigid_[k].data(), w.data(), n_);
    rigid_rate += rigid_share_[k] * rate;
    energy -= 0.5 * rate * rate;
  }
  energy = std::max(energy, 0.0);
  if (!(y.back() <= rigid_rate)) return false;
  if (rigid_motion_decays_ && y.back() > 0.0) return false;

  double plastic = 0.0;
  if (!bar_.empty()) {
    const SectionField& sections = beam.sections();
    beam.mesh().curvatures(w, curvatures_);
    sections.moments(curvatures_, moments_);
    for (std::size_t i = 0; i < bar_.size(); ++i) {
      plastic += bar_[i] * (sections.stiffness() * curvatures_[i] - moments_[i]);
    }
  }
  const double a = plastic_compliance_;
  const double bound = 2.0 * a * a * energy > compliance_ ? a * energy + compliance_ / (2.0 * a)
                                                          : std::sqrt(2.0 * compliance_ * energy);
  return y[n_] - rigid - plastic + (1.0 + rounding) * bound < beam.contact().residual_indentation();
}

}  // namespace subimpact
