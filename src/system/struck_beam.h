#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/section_field.h"
#include "numerics/mass_solver.h"
#include "numerics/trajectory_root.h"
#include "ode/second_order_ode.h"
#include "subimpact/model/beam_mesh.h"
#include "subimpact/model/contact_law.h"
#include "subimpact/system/energies.h"
#include "subimpact/system/events.h"
#include "system/beam_jacobian.h"
#include "system/section_influence.h"
#include "system/section_kinks.h"

namespace subimpact {

/// An event that may happen next.
struct Guard {
  EventKind kind;
  double sense = 1.0;  ///< of the indentation's motion before contact_unloads
};

/// A guard found to have been crossed within a step.
struct Crossing {
  Guard guard;
  double after = 0.0;   ///< time at which the guard still holds
  double before = 0.0;  ///< time by which it has been crossed
  double guess = 0.0;   ///< estimate of the instant
  /// The guard holds at both ends of the step and comes close to being crossed in between, near
  /// `guess`: whether it is has to be seen on the trajectory.
  bool in_doubt = false;
};

/// Guards left out of a search, because they have been dealt with in the step.
using GuardList = std::vector<Guard>;

/// One step as the integrator took it.
struct StepEnds {
  double t0, t1;
  const State& y0;
  const State& y1;
  bool eventless = false;  ///< nothing happened in it, whatever its ends may suggest
  /// States within it are those of the step's end followed backwards, see
  /// Integrator::state_before_end.
  bool from_end = false;
  double length() const { return t1 - t0; }
};

/// What a struck beam is made of.
struct StruckBeamParts {
  std::shared_ptr<const BeamMesh> mesh;
  SectionField sections;
  std::shared_ptr<const ContactLaw> contact_law;
  double striker_mass;      ///< kg
  double striker_velocity;  ///< v0, m/s
  double outer_stiffness;   ///< E h/2 of the outermost fibre, N/m, for sections that never yield
  std::unique_ptr<MassSolver> mass_solver;
};

/// The struck beam as a hybrid system: smooth motion within a mode, events between modes, memory
/// changed only by `commit` and `apply`.
///
/// State y = [w_1..w_n, w_m, v_1..v_n, v_m] (m, m/s): the mesh's unknowns, then the striker.
///
///     Mass w'' = -B^T W (-M(kappa, history)) + S F,   m w_m'' = -F,   F = F(lambda, history),
///     lambda = w_m - S.w.
///
/// The contact force is evaluated in one of two ways. `smooth`: the branch in force is continued
/// beyond its range, so that the right-hand side has no kink inside a step, and whoever integrates
/// locates the end of the branch. `switching`: the branch follows the indentation, as in schemes
/// that do not locate events.
class StruckBeam final : public MechanicalSystem {
 public:
  enum class Evaluation { smooth, switching };

  explicit StruckBeam(StruckBeamParts parts);
  /// With the striker and the contact law of a scene.
  StruckBeam(const Scene& scene, std::shared_ptr<const BeamMesh> mesh, SectionField sections,
             std::unique_ptr<MassSolver> mass_solver);

  std::size_t n_positions() const override { return n_ + 1; }
  void acceleration(std::span<const double> positions, std::span<double> result) override;
  Scales scales() const override { return scales_; }

  /// Stiff part: the bending forces; the rest: the contact force.
  void force(std::span<const double> positions, Part part, std::span<double> result) override;
  const SparsityPattern& pattern() const override { return jacobian().pattern(); }
  void mass_entries(std::span<double> values) const override { jacobian().mass_entries(values); }
  void stiffness_entries(std::span<const double> positions, Part part,
                         std::span<double> values) override;

  const BeamMesh& mesh() const { return *mesh_; }
  const SectionField& sections() const { return sections_; }
  const ContactLaw& contact_law() const { return *contact_law_; }
  const MassSolver& mass_solver() const { return *mass_solver_; }
  /// Evaluations of the acceleration: of the forces, each with a mass solve.
  long n_accelerations() const { return n_accelerations_; }
  /// Evaluations of the bending forces alone or with the contact force, without a mass solve.
  long n_forces() const { return n_forces_; }
  /// Mass solves beside those of the accelerations: for what sections did within steps.
  long n_further_solves() const { return n_further_solves_; }

  /// At t = 0: beam at rest, nose just touching, contact begun.
  State initial_state() const;

  // --- contact -----------------------------------------------------------------------------------
  void set_contact_evaluation(Evaluation how) { contact_evaluation_ = how; }
  /// Puts the contact into a state of its own, to start from one that is not at rest.
  void set_contact(ContactBranch branch, ContactHistory history) {
    contact_branch_ = branch;
    contact_history_ = history;
  }
  ContactBranch contact_branch() const { return contact_branch_; }
  ContactHistory contact_history() const { return contact_history_; }
  bool in_contact() const { return contact_branch_ != ContactBranch::separated; }
  double indentation(const State& y) const;
  double indentation_rate(const State& y) const;
  double residual_indentation() const {
    return contact_law_->residual_indentation(contact_history_);
  }
  double contact_force(const State& y) const { return contact_force_at(indentation(y)); }
  double contact_force_at(double indentation) const { return force(indentation); }

  // --- events ------------------------------------------------------------------------------------
  /// The earliest end of the contact's branch within a step that began at the last committed state,
  /// if any; also when the branch may be left and regained within the step (`in_doubt`). Earliest
  /// by estimate; those in `without` are left out.
  bool find_crossing(const StepEnds& step, const GuardList& without, Crossing& earliest);
  /// Whether a branch left and regained within one step is looked for; off only to show what is
  /// then missed.
  void set_pair_detection(bool on) { pair_detection_ = on; }
  /// By how much a guard must be crossed within a step that ends at y, and held again at its end,
  /// to count (m): less is below the rounding of the displacements.
  double negligible_excursion(const State& y) const;
  /// A guard's value and rate at a state; costs an acceleration for contact_unloads.
  GuardValue evaluate(const Guard& guard, const State& y);
  /// Takes an event as having happened at y: switches the contact's branch. Call after commit(y).
  void apply(const Guard& guard, const State& y);
  // --- sections ----------------------------------------------------------------------------------
  /// `tolerance`: how well what sections do within a step is put right at its end (root mean square
  /// of velocities, m/s).
  void set_section_evaluation(Evaluation how,
                              double tolerance = std::numeric_limits<double>::infinity()) {
    section_evaluation_ = how;
    kink_tolerance_ = tolerance;
  }
  /// Finds the sections that left their smooth pieces within a step that began at the last
  /// committed state, and the beam's answer to that: with A = Mass^-1 B^T W (dM/dkappa) B and
  /// a_k = Mass^-1 (-B^T W) amount_k,
  ///
  ///     change of w' = a_0 + A a_2 + A^2 a_4 + ..,   change of w = a_1 + A a_3 + A^2 a_5 + ..,
  ///
  /// expansions in the time since the first kink, taken as far as the tolerance asks. Returns the
  /// step's end if that is far enough, else an earlier time at which to end the step. The a_k come
  /// without mass solves (SectionInfluence); each further pair of terms costs two.
  double find_section_kinks(const StepEnds& step);
  /// What the last search found.
  const std::vector<SectionKink>& section_kinks() const { return kinks_.kinks(); }
  /// Adds to y, the end of the step searched last, what the kinks found would have done.
  void add_kinks(State& y) const;
  /// The same, and takes the sections that turned as having done so.
  void put_right(State& y);

  /// Looks at a state y that the method gives for a time t within the step: calls look(y) with y
  /// and the sections that turned put right as if the step ended there, and all else as it was.
  template <class Look>
  void look_within(const StepEnds& step, double t, State& y, Look look) {
    find_section_kinks({step.t0, t, step.y0, y, step.eventless});
    std::vector<SectionField::Memory> before;
    for (const SectionKink& kink : section_kinks()) {
      if (kink.turn) before.push_back(sections_.memory(kink.section));
    }
    put_right(y);
    look(y);
    for (const SectionField::Memory& memory : before) sections_.restore(memory);
    find_section_kinks(step);
  }

  /// Takes y as reached: advances the memory of contact and sections. Returns whether any section
  /// flowed.
  bool commit(const State& y);
  /// For schemes that do not locate events: lets the branch follow the indentation at y.
  void follow_branch(const State& y);

  // --- accounts ----------------------------------------------------------------------------------
  Energies energies(const State& y);
  double momentum(const State& y) const;       ///< kg m/s, of beam and striker
  double beam_momentum(const State& y) const;  ///< kg m/s
  /// Whether nothing but the striker acts on the beam.
  bool conserves_momentum() const { return !mesh_->translation().empty(); }
  double striker_mass() const { return striker_mass_; }
  struct Displacements {
    double struck, striker, first_end;  ///< m
  };
  Displacements displacements(const State& y) const;
  /// If a section flows at the step's end: when, within the step, the first of them left its
  /// window.
  std::optional<double> first_flow(const StepEnds& step);
  /// Curvatures (1/m) and moments -M (N m) of all sections; valid until the next evaluation.
  struct Bending {
    std::span<const double> curvatures, moments;
  };
  Bending bending(const State& y);
  double back_stress(const State& y);  ///< outer fibre at the struck section, far side, Pa

 private:
  std::span<const double> beam_positions(const State& y) const { return {y.data(), n_}; }
  std::span<const double> beam_velocities(const State& y) const { return {y.data() + n_ + 1, n_}; }
  double force(double indentation) const;
  double force_slope(double indentation) const;
  GuardValue contact_guard(EventKind kind, double indentation, double rate) const;

  std::shared_ptr<const BeamMesh> mesh_;
  SectionField sections_;
  std::shared_ptr<const ContactLaw> contact_law_;
  std::unique_ptr<MassSolver> mass_solver_;
  std::size_t n_;
  double striker_mass_;
  double striker_velocity_;
  double outer_stiffness_;  // E h/2
  // Of an elastic beam in natural modes, else empty: stiffnesses, and what a mode's acceleration is
  // made of.
  std::span<const double> modal_stiffness_;
  std::vector<double> modal_frequencies_squared_, modal_loads_;
  double highest_frequency_;  // rad/s
  Scales scales_;

  Evaluation contact_evaluation_ = Evaluation::smooth;
  bool pair_detection_ = true;
  ContactBranch contact_branch_ = ContactBranch::separated;
  ContactHistory contact_history_;

  Evaluation section_evaluation_ = Evaluation::switching;
  // forces = -B^T W (-M).
  void bend(std::span<const double> unknowns, std::span<double> forces);
  BeamJacobian& jacobian() const;
  mutable std::unique_ptr<BeamJacobian> jacobian_;  // made when an implicit method first asks
  long n_accelerations_ = 0;
  long n_forces_ = 0;
  long n_further_solves_ = 0;
  AlignedVector curvatures_, moments_;  // of the last evaluation
  std::vector<double> trial_;           // accelerations
  void read_motion(const State& y, SectionMotion& at) const;
  void read_moments(const State& y, SectionMotion& at);
  // Tangents of the smooth pieces, taken at `curvatures`, times changes of curvature.
  void linear_moments(std::span<const double> changes, std::span<const double> curvatures,
                      std::span<double> moments) const;
  // Sum of A^k a_(2k + order), k = 0..last.
  void answer_to_kinks(std::size_t order, std::size_t last, std::vector<double>& answer);
  // A bound of what the k-th term adds to velocities, root mean square, m/s.
  double bound_of_term(std::size_t k);
  SectionMotion start_, end_;  // of the step being looked at; start_ is that of the last commit
  std::unique_ptr<SectionInfluence> influence_;
  SectionKinks kinks_;
  double kink_tolerance_ = std::numeric_limits<double>::infinity();
  std::vector<double> velocity_change_, position_change_;
};

}  // namespace subimpact
