#pragma once

/// A case: the scene, how it is modelled, and the options of its run. Each member is a key of the
/// case file; case_keys() (see case_keys.h) lists them with units, defaults and ranges.

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "subimpact/model/contact/contact_law.h"
#include "subimpact/model/mesh/beam_mesh.h"
#include "subimpact/model/scene.h"
#include "subimpact/model/section/fibres.h"
#include "subimpact/ode/integrator.h"
#include "subimpact/simulate/options.h"

namespace subimpact {

struct EndState;

enum class SectionKind {
  elastic,  ///< never yields
  layers,   ///< `layers` elastic-perfectly plastic layers over the thickness
  exact     ///< infinitely many layers, in closed form
};

enum class MeshKind {
  cells,     ///< equal cells
  hermite,   ///< cubic Hermite elements
  spectral,  ///< elements of degree 4, of a beam that shears
  rigid      ///< the beam as a rigid body
};

/// Length of N equal cells of a beam of length l, and their rotary inertia at free ends.
enum class CellSpacing {
  cells,  ///< l/N: the cells fill the beam
  whole,  ///< l/N, with the rotary inertia of the outer half cells, which `cells` leaves out
  points  ///< l/(N - 1): their centres span the beam, from end to end
};

/// Whether a scene that is symmetric about mid-span is modelled by one half.
enum class SymmetryUse { automatic, off };

struct ModelOptions {
  MeshKind mesh = MeshKind::cells;
  int segments = 501;  ///< cells
  CellSpacing spacing = CellSpacing::cells;
  int elements = 200;  ///< Hermite elements
  SectionKind section = SectionKind::exact;
  int layers = 40;
  SymmetryUse symmetry = SymmetryUse::automatic;
};

/// User-defined parts that replace those named by keys of the case. No case file can contain them.
struct CaseParts {
  /// Null: the mesh of model.mesh. Otherwise the keys of meshes and supports have no effect.
  std::shared_ptr<const BeamMesh> mesh;
  /// Null: the law of scene.contact, whose keys otherwise have no effect.
  std::shared_ptr<const ContactLaw> contact_law;
  /// Empty: the section of model.section; otherwise that key only decides whether it may yield.
  std::optional<Fibres> section;
  std::shared_ptr<const OwnIntegrator> integrator;  ///< of the method `own`
  std::shared_ptr<const EndState> start;            ///< Problem::start
};

/// A case: the options of its run, and what they apply to.
struct Case : Options {
  std::string title;
  /// Why theory and contact law are what they are, if they were chosen (study/model.h); no key.
  std::string model_choice;
  bool theory_is_chosen = false;  ///< by the program, with the shear that matters; no key
  /// Of beam.poisson and scene.gravity, the keys that the case file omits: parts of body errors.
  std::set<std::string> assumed;
  Scene scene;
  ModelOptions model;
  /// Relative standard deviations of numbers of the scene, by key: "striker.velocity". They do not
  /// change the run; see subimpact.scatter() in Python.
  std::map<std::string, double> scatter;
  bool at_rest = true;  ///< Problem::at_rest
  int strikes = 1;      ///< that the beam receives (study/run_as_asked.h)
  CaseParts parts;      ///< none: the built-in ones
};

}  // namespace subimpact
