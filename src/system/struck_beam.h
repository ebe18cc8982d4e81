#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/mesh/modal_mesh.h"
#include "model/section/section_field.h"
#include "numerics/mass_solver.h"
#include "ode/second_order_ode.h"
#include "subimpact/model/mesh/beam_mesh.h"
#include "subimpact/model/scene.h"
#include "system/beam_jacobian.h"
#include "system/contact/contact_state.h"
#include "system/loads.h"

namespace subimpact {

struct StruckBeamParts {
  std::shared_ptr<const BeamMesh> mesh;
  SectionField sections;
  std::shared_ptr<const ContactLaw> contact_law;
  double striker_mass;      ///< kg; infinite: a stop
  double striker_velocity;  ///< v0, m/s, at the start
  double outer_stiffness;   ///< E h/2 of the outermost fibre, N/m, for sections that never yield
  BandedSolver mass_solver;
  double contact_damping = 0.0;  ///< chi, s/m
  BeamDamping damping = {};      ///< its ratio for natural modes only
  Loads loads = {};
  double velocity_scale = 0.0;          ///< m/s, of the strike; 0: striker_velocity
  std::optional<Tension> tension = {};  ///< of a beam whose ends are held along it; not in modes
  double restitution_velocity = 0.0;    ///< m/s, as of a Problem
  const Beam* on_supports = nullptr;    ///< that has supports that lift; null: none
};

/// Quantities integrated over time since the run began: energy (J) that velocity-dependent forces
/// have dissipated, and for changing loads the integral of (df/dt) q.
struct Losses {
  double contact = 0.0;
  double beam = 0.0;
  double of_change = 0.0;

  Losses operator+(const Losses& more) const {
    return {contact + more.contact, beam + more.beam, of_change + more.of_change};
  }
};

/// Curvatures (1/m) and their rates (1/(m s)) of all sections, one entry per section.
struct SectionMotion {
  std::vector<double> curvatures, rates;
  explicit SectionMotion(std::size_t n_sections) : curvatures(n_sections), rates(n_sections) {}
};

/// A beam at the end of a run, which another strike finds as it is (Problem::start).
struct EndState {
  State motion;  ///< m and m/s, of the mesh's unknowns and the striker
  ContactHistory contact;
  SectionField sections;
  std::optional<Tension> tension;
};

/// The equations of motion of the struck beam: smooth between events, with histories that only
/// `commit` advances.
///
/// State y = [w_1..w_n, w_m, v_1..v_n, v_m] (m, m/s): the mesh's unknowns, then the striker.
///
///     Mass w'' = -B^T W M(kappa, history) - K_s w - N G w + S F - sum_j a_j F_j + f(t),
///     m w_m'' = -F + m g,
///     F = F(lambda, history),   kappa = B w,   lambda = w_m - S.w,
///
/// with M (N m; sign convention of kappa), K_s the stiffness of shear and springs, the tension N
/// (Tension), the forces F_j of supports that lift (LiftingSupport; not in modes), and the loads f
/// (Loads). A striker of infinite mass is a stop: w_m'' = 0. With damping the forces depend on
/// velocities too (docs/theory/beam.md).
class StruckBeam final : public MechanicalSystem {
 public:
  explicit StruckBeam(StruckBeamParts parts);

  std::size_t n_positions() const override { return n_ + 1; }
  void acceleration(std::span<const double> positions, std::span<double> result) override;
  bool depends_on_velocity() const override { return depends_on_velocity_; }
  void acceleration_at(std::span<const double> y, std::span<double> result) override;
  void set_time(double t) override { time_ = t; }
  Scales scales() const override { return scales_; }

  /// Stiff part: the bending forces; the rest: the contact force.
  void force(std::span<const double> y, std::span<double> result) override;
  const SparsityPattern& pattern() const override { return jacobian().pattern(); }
  void mass_entries(std::span<double> values) const override { jacobian().mass_entries(values); }
  void stiffness_entries(std::span<const double> y, std::span<double> values) override;
  void damping_entries(std::span<const double> y, std::span<double> values) override;

  const BeamMesh& mesh() const { return *mesh_; }
  const SectionField& sections() const { return sections_; }
  std::span<const LiftingSupport> supports() const { return supports_; }
  /// The contacts of the beam: that of the striker (0) and those of its supports that lift.
  std::size_t n_contacts() const { return 1 + supports_.size(); }
  const ContactState& contact(std::size_t i = 0) const {
    return i == 0 ? contact_ : supports_[i - 1].contact;
  }
  ContactState& contact(std::size_t i = 0) { return i == 0 ? contact_ : supports_[i - 1].contact; }
  /// F_j of each copy of support j (from 0) at y, N.
  double support_force(std::size_t j, std::span<const double> y) const {
    return supports_[j].contact.force(indentation(y, j + 1), indentation_rate(y, j + 1));
  }
  /// Puts the supports on the branch on which they lie at y, at the start; one that touches without
  /// force or motion on that of the first motion, under loads or else under a growing contact
  /// force.
  void settle_on_supports(const State& y);
  /// Impulses (N s) since the last call, one per support.
  void add_support_impulses(std::span<const double> impulses, double sign = 1.0) {
    for (std::size_t i = 0; i < supports_.size(); ++i) supports_[i].impulse += sign * impulses[i];
  }
  const BandedSolver& mass_solver() const { return mass_solver_; }
  double striker_mass() const { return striker_mass_; }  ///< kg; infinite: a stop
  bool has_stop() const { return std::isinf(striker_mass_); }
  const Loads& loads() const { return loads_; }
  /// Acceleration of the striker without the contact force, m/s2.
  double striker_load() const { return has_stop() ? 0.0 : loads_.gravity(); }
  /// Whether anything has to be integrated over time (Losses).
  bool has_losses() const { return depends_on_velocity_ || loads_.varies() || !supports_.empty(); }
  /// Potential energy (J) of the loads in the state y at time t.
  double load_potential(const State& y, double t) const;
  /// The work of loads since the start, J.
  double work_of_loads(const State& y, double t) const {
    return loads_.is_empty() ? 0.0 : load_potential(y, t) - losses_.of_change - potential_before_;
  }
  /// At the corner t of a load, in the state y, or before the start: goes on to the next piece.
  void begin_loads(const State& y, double t);
  /// Null where ends may approach each other.
  const Tension* tension() const { return tension_ ? &*tension_ : nullptr; }
  double outer_stiffness() const { return outer_stiffness_; }  ///< E h/2, N/m
  /// Highest frequency (rad/s) of the beam on its supports without contact: a bound.
  double highest_frequency() const { return highest_frequency_; }
  /// Stiffness of each mode of an elastic beam in natural modes; else empty.
  std::span<const double> modal_stiffness() const { return modal_stiffness_; }
  /// Damping force over velocity and mass of each of these modes, 1/s.
  std::span<const double> modal_damping() const { return modal_damping_; }

  /// The state at the start: zero displacements and a beam at rest, unless set by set_start() or
  /// begin_strike(). Accounts of energies and momenta begin with it.
  State initial_state() const;
  void set_start(State start);
  /// (K + N G)^-1 f of the loads f at the start of their piece, with the stiffness K of an elastic
  /// beam: its displacements at rest under them. Nothing if K is not positive definite.
  std::optional<std::vector<double>> equilibrium() const;
  /// The accepted state y with the histories that hold at it, for another strike.
  std::shared_ptr<const EndState> end_state(const State& y) const;
  /// Another strike on the beam as an earlier one of the same mesh and laws has left it, with the
  /// striker's nose on the dent. `at_rest`: in its residual shape, a free beam with zero mean
  /// displacement and rotation; `first_frequency` (rad/s, roughly): of the beam. What was
  /// dissipated before does not count. Throws std::invalid_argument for the end of a beam of
  /// another size, std::domain_error where nothing is struck, or a beam at rest would yield.
  void begin_strike(const EndState& end, bool at_rest, double first_frequency);
  /// Energy dissipated before the present strike: parts of Energies.
  struct Spent {
    double bending = 0.0, contact = 0.0;  ///< J
  };
  const Spent& spent() const { return spent_; }
  /// The state at a time (s) before the first touch, while the striker approaches.
  State state_before_touch(double time) const;
  std::span<const double> beam_positions(std::span<const double> y) const { return y.first(n_); }
  std::span<const double> beam_velocities(std::span<const double> y) const {
    return y.subspan(n_ + 1, n_);
  }
  /// lambda, m, and its rate, m/s.
  double indentation(std::span<const double> y, std::size_t contact = 0) const {
    return contact == 0 ? y[n_] - mesh_->struck_point()(beam_positions(y))
                        : supports_[contact - 1].indentation(beam_positions(y));
  }
  double indentation_rate(std::span<const double> y, std::size_t contact = 0) const {
    return contact == 0 ? y.back() - mesh_->struck_point()(beam_velocities(y))
                        : supports_[contact - 1].approach(beam_velocities(y));
  }
  double contact_force(std::span<const double> y) const {
    return contact_.is_damped() ? contact_.force(indentation(y), indentation_rate(y))
                                : contact_.force(indentation(y));
  }
  const BeamDamping& damping() const { return damping_; }
  /// v^T C v, W: dissipation by the damping of the beam at velocities v.
  double damping_power(std::span<const double> velocities);
  /// Losses so far, advanced by the run (LossQuadrature); zero without damping.
  const Losses& losses() const { return losses_; }
  void set_losses(const Losses& losses) { losses_ = losses; }
  void add_losses(const Losses& more) { losses_ = losses_ + more; }
  /// Rounding of the indentation at y, m.
  double displacement_rounding(std::span<const double> y, std::size_t contact = 0) const;
  /// m: what a contact must pass zero by to begin or end; 0 of the striker's.
  double dead_length(std::span<const double> y, std::size_t contact) const {
    return contact == 0
               ? 0.0
               : std::max(supports_[contact - 1].dead_length, displacement_rounding(y, contact));
  }
  void read_motion(const State& y, SectionMotion& motion) const;

  /// Value and rate of an event function at y; for contact_unloads at the cost of an acceleration.
  EventValue evaluate(const EventFunction& function, const State& y);

  void set_section_evaluation(Evaluation how) { section_evaluation_ = how; }
  Evaluation section_evaluation() const { return section_evaluation_; }
  /// Accepts y: advances the histories of contact and sections. Returns whether any section flowed.
  bool commit(const State& y);
  /// commit() for the state whose acceleration() was computed last.
  bool commit_evaluated(const State& y);
  /// Commits the curvature (1/m) at which a section reversed on the way to the next state.
  void commit_reversal(std::size_t section, double curvature) {
    sections_.commit_reversal(section, curvature);
  }
  /// The sections at the last state committed while their evaluation was smooth.
  const SectionMotion& committed_motion() const { return committed_; }

  /// Evaluations of the acceleration: of the forces, each with a mass solve.
  long n_accelerations() const { return n_accelerations_; }
  /// Evaluations of the bending forces alone or with the contact force, without a mass solve.
  long n_forces() const { return n_forces_; }
  /// Sections that flowed, summed over the states that were committed.
  long n_flows() const { return n_flows_; }

 private:
  bool count_flows(std::size_t n) {
    n_flows_ += static_cast<long>(n);
    return n > 0;
  }
  // forces = -B^T W M - K_s w - N G w.
  void bend(std::span<const double> unknowns, std::span<double> forces);
  // Adds the forces of the beam's damping, all or those of beta.
  void add_stiffness_damping(std::span<const double> velocities, std::span<double> forces);
  void add_damping(std::span<const double> velocities, std::span<double> forces);
  // Accelerations under a contact force (N); `velocities`: empty without damping.
  void respond(std::span<const double> unknowns, std::span<const double> velocities, double contact,
               std::span<double> result);
  void use_modes();
  void come_to_rest(std::span<double> w, double first_frequency);
  // With a given tension; and where the beam lies on these supports.
  std::optional<std::vector<double>> equilibrium(double tension) const;
  std::optional<std::vector<double>> equilibrium(double tension,
                                                 const std::vector<bool>& lies_on) const;
  // Adds the forces of supports that lift; `velocities`: empty without damping.
  void add_support_forces(std::span<const double> unknowns, std::span<const double> velocities,
                          std::span<double> forces) const;
  BeamJacobian& jacobian() const;

  std::shared_ptr<const BeamMesh> mesh_;
  SectionField sections_;
  ContactState contact_;
  std::vector<LiftingSupport> supports_;
  BandedSolver mass_solver_;
  std::size_t n_;
  double striker_mass_;
  double striker_velocity_;
  double outer_stiffness_;
  Loads loads_;
  std::optional<Tension> tension_;
  double time_ = 0.0;              // of the next evaluation
  double potential_before_ = 0.0;  // of the loads at the start, and what corners have changed
  BeamDamping damping_;
  bool depends_on_velocity_;
  Losses losses_;
  // For an elastic beam in natural modes, else empty: stiffnesses, and factors of accelerations.
  std::span<const double> modal_stiffness_;
  std::vector<double> modal_frequencies_squared_, modal_loads_;
  std::vector<double> modal_damping_;  // 2 zeta omega of each mode, with that of alpha and beta
  std::vector<double> damping_forces_;
  double highest_frequency_;
  Scales scales_;
  Evaluation section_evaluation_ = Evaluation::switching;
  mutable std::unique_ptr<BeamJacobian> jacobian_;  // made when an implicit method first needs it
  long n_accelerations_ = 0;
  long n_forces_ = 0;
  long n_flows_ = 0;
  AlignedVector curvatures_, moments_;          // work space
  std::vector<SectionField::Outside> outside_;  // at the last evaluation
  std::vector<double> trial_;                   // accelerations
  SectionMotion committed_;
  State start_;  // none: straight and at rest
  Spent spent_;
};

}  // namespace subimpact
