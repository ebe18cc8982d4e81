#pragma once

/// A case: the scene, how it is modelled, how it is integrated, and what is kept of it. Each member
/// is a key of the case file; case_keys() (see case_keys.h) lists them with units, defaults and
/// ranges.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "subimpact/model/contact_law.h"
#include "subimpact/model/fibres.h"
#include "subimpact/model/scene.h"
#include "subimpact/simulate/options.h"

namespace subimpact {

/// Bending law of the sections.
enum class SectionKind {
  elastic,  ///< never yields
  layers,   ///< `layers` elastic-perfectly plastic layers over the thickness
  exact     ///< infinitely many layers, in closed form
};

enum class MeshKind {
  cells,    ///< equal cells
  hermite,  ///< cubic Hermite elements
  rigid     ///< the beam as a rigid body
};

/// Whether a scene that is symmetric about mid-span is modelled by one half.
enum class SymmetryUse { automatic, off };

/// Whether a Hermite mesh has hinges where a beam that yields bends most.
enum class HingeUse {
  automatic,  ///< at the strike and at clamped ends, where the beam may yield
  off
};

struct ModelOptions {
  MeshKind mesh = MeshKind::cells;
  int segments = 501;            ///< cells
  int elements = 200;            ///< Hermite elements
  int sections_per_element = 2;  ///< of Hermite elements
  HingeUse hinges = HingeUse::automatic;
  double strike_refinement = 1.0;  ///< far elements' length over that of those at the strike
  double refined_length = 0.05;    ///< either side of the strike, as a fraction of the length
  SectionKind section = SectionKind::exact;
  int layers = 40;
  SymmetryUse symmetry = SymmetryUse::automatic;
};

enum class Method { central_difference, erk, nystrom, dirk, imex, adams, bdf, exponential };

/// Who solves with the mass matrix.
enum class MassSolverKind { banded, klu };

enum class VectorOperationsKind { project, library };

struct SolverOptions {
  Method method = Method::erk;
  double rtol = 1e-8;          ///< relative to the scene's own scales of displacement and velocity
  std::optional<double> step;  ///< s; empty: 0.9 of critical (central-difference), else adaptive
  std::optional<double> max_step;    ///< s; adaptive methods
  std::optional<std::string> table;  ///< coefficients of a Runge-Kutta method; its first if empty
  MassSolverKind mass_solver = MassSolverKind::banded;
  std::optional<EventHandling>
      events;  ///< empty: interpolated for central-difference, else located
  std::optional<ReversalHandling> reversals;  ///< empty: located, by adams and bdf step_end
  bool pair_detection = true;    ///< look for contacts that open and close again within one step
  std::optional<int> max_order;  ///< adams and bdf; empty: default of the method
  VectorOperationsKind vector_operations = VectorOperationsKind::project;
  bool beyond_critical = false;  ///< lets a fixed step exceed the stability limit, to see it fail
};

/// What results must come up to.
struct AccuracyOptions {
  /// Largest error of the energy, relative to the initial energy, of a run that counts as
  /// completed; empty: follows from method and rtol, 1e-3 at most.
  std::optional<double> energy;
};

/// When a run ends.
enum class StopRule {
  end_time,        ///< at the end time
  no_more_contact  ///< sooner, once it is proven that no contact can follow
};

struct OutputOptions {
  double interval = 1e-6;        ///< s between history rows; 0: none
  double zone_gap = 0.1;         ///< in first flexural periods
  double subzone_gap = 0.02;     ///< in first flexural periods
  std::vector<double> sections;  ///< sections whose bending is kept, as fractions of the length

  /// For companion runs, of which only the sub-impacts matter.
  void keep_no_rows() {
    interval = 0.0;
    sections.clear();
  }
};

/// Laws of a caller's own, in place of those that keys of the case name. No case file can hold
/// them.
struct CaseParts {
  /// Null: the law of scene.contact, whose keys play no part otherwise.
  std::shared_ptr<const ContactLaw> contact_law;
  /// Empty: the section of model.section, which otherwise only says whether it may yield.
  std::optional<Fibres> section;
};

struct Case {
  std::string title;
  Scene scene;
  ModelOptions model;
  double end_time = 0.0;  ///< s
  StopRule stop = StopRule::end_time;
  SolverOptions solver;
  AccuracyOptions accuracy;
  OutputOptions output;
  CaseParts parts;  ///< none: the built-in laws
};

}  // namespace subimpact
