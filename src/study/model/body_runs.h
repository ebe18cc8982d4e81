#pragma once

#include <cmath>
#include <optional>
#include <vector>

#include "study/refinement/refinement.h"

namespace subimpact {

/// The scene with one thing put in that its model leaves out or its case leaves open.
struct BodyVariant {
  BodyPart kind = BodyPart::shear;
  std::vector<Case> cases = {};  ///< the largest change counts; none: not known
  /// What they are compared with, on coarse cells, where the method of the run does not take them.
  std::optional<Case> base = {};
};

/// Those that a run can show. `yields`: whether sections of the run do.
std::vector<BodyVariant> body_variants(const Case& input, bool yields);

/// A bound on the force (N) of any contact of the run: the contact law loaded for the first time
/// by all energy that striker, beam, gravity and loads can put into it, as by a striker on an
/// anvil. Momentum is not used: a light beam gives less. Infinite for a law with damping.
double largest_possible_force(const Case& input, const Result& result);

/// The scene with the nose, or a plane, of steel (210 GPa, 0.3) where the case leaves it open,
/// which the program takes as rigid; nothing where their moduli are given or the law does not use
/// them.
std::optional<Case> with_steel_contact(const Case& input);

/// Coarse runs beside a run, with one thing changed: how long they are, and on which meshes.
class BodyRuns {
 public:
  /// Runs on one mesh up to a time.
  struct Horizon {
    double end = 0.0;    ///< s
    double ratio = 1.0;  ///< of the mesh over that of the run
    double work = 0.0;   ///< counted, of one of them
    std::optional<Result> base = {};
  };

  /// Makes the base runs. `parting`: of the run (s), if it has one; `n_runs`: up to each horizon.
  /// Everything outlives this.
  BodyRuns(const Case& input, const Result& result, const std::optional<double>& parting,
           double n_runs, const Progress& progress);

  /// The last one is the whole run; the first may end early.
  const std::vector<Horizon>& horizons() const { return horizons_; }
  /// What is decided by this time (s) does not depend on the end of the run.
  double until() const { return until_; }
  bool is_stopped() const { return is_stopped_; }

  /// On the mesh and by the method of the run, but for a beam that these do not suit. Of as many
  /// strikes as the beam receives, the last one. Nothing where such a run failed or lost energy.
  std::optional<Result> on_mesh(const Case& input, const Horizon& horizon);
  /// On coarse cells.
  std::optional<Result> on_cells(const Case& input, const Horizon& horizon);

 private:
  void choose_horizons(const std::optional<double>& parting, double n_runs);
  std::optional<Case> case_on_mesh(const Case& of, const Horizon& horizon) const;
  std::optional<Case> case_on_cells(const Case& of, const Horizon& horizon) const;
  std::optional<Result> run_of(std::optional<Case> next);

  const Case& input_;
  const Result& result_;
  const Progress& progress_;
  std::optional<Refinement> refinement_;  // none: a rigid beam
  double first_ = 0.0;                    // cells or elements of the coarsest mesh worth a run
  std::vector<Horizon> horizons_;
  double until_ = HUGE_VAL;
  bool is_stopped_ = false;
};

}  // namespace subimpact
