#pragma once

#include <memory>
#include <optional>

#include "subimpact/model/contact/contact_law.h"
#include "subimpact/model/mesh/beam_mesh.h"
#include "subimpact/model/scene.h"
#include "subimpact/model/section/fibres.h"
#include "subimpact/ode/integrator.h"
#include "subimpact/simulate/observer.h"
#include "subimpact/simulate/options.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// A strike assembled from parts. simulate(Case) assembles it from the keys of a case; a caller
/// with a mesh and laws but without a case sets the members. Several runs may share the parts, even
/// at the same time: no run changes them.
struct Problem {
  /// Dimensions, material and damping: E I, the yield stress and E h/2 of the sections, the first
  /// period, the validity of the contact law (an indentation up to the thickness); loads, start and
  /// motion at the start. Mass, ends, theory and springs are in the mesh.
  Beam beam;
  /// Mass, velocity and gap. The mesh holds the struck point, the contact law the nose.
  Striker striker;
  double gravity = 0.0;  ///< g, m/s2, along the strike, on striker and beam
  std::shared_ptr<const BeamMesh> mesh;
  std::shared_ptr<const ContactLaw> contact_law;
  /// chi, s/m: the contact force is F (1 + chi lambda'), with F of a law that never yields.
  double contact_damping = 0.0;
  /// m/s: contact_damping is that of touches as fast, and others have what leaves the same
  /// coefficient of restitution; 0: all touches have the same.
  double restitution_velocity = 0.0;
  std::optional<Fibres> section;  ///< empty: the solid rectangle
  bool may_yield = true;          ///< whether sections yield, at the yield stress of the beam
  bool check_contact_law = true;  ///< whether a run begins with broken_rule(*contact_law)
  bool check_mesh = true;         ///< whether it is refused for broken_rule(*mesh, beam)
  std::shared_ptr<const OwnIntegrator> integrator;  ///< of the method `own`
  /// Result::end_state of an earlier strike on the same beam, mesh and laws, which this one finds.
  /// Null: the beam is straight, at rest and has never yielded.
  std::shared_ptr<const EndState> start;
  bool is_one_of_several = false;  ///< whether another strike comes before or after this one
  /// Whether the beam of `start` has come to rest in its residual shape, or moves as it was left.
  /// The striker's nose lies on the dent; its velocity must exceed that of the struck point.
  bool at_rest = true;

  Bodies bodies() const { return {beam, striker, gravity}; }
};

struct RunParts;

/// A problem and its options, resolved for one run: every open setting has its value and the model
/// is built, but nothing has run.
class ResolvedRun {
 public:
  explicit ResolvedRun(std::unique_ptr<RunParts> parts);
  ResolvedRun(ResolvedRun&&) noexcept;
  ResolvedRun& operator=(ResolvedRun&&) noexcept;
  ~ResolvedRun();

  const ResolvedSettings& settings() const;
  RunParts& parts() { return *parts_; }  ///< for the floors above (see src/simulate/run_parts.h)

 private:
  std::unique_ptr<RunParts> parts_;
};

/// Throws InvalidCase for settings that contradict each other, a step beyond the stability limit
/// and missing parts.
ResolvedRun resolve(const Problem& problem, const Options& options);

/// Throws InvalidCase if a run with these settings takes more memory than the machine has free.
/// simulate() does so before it begins.
void check_memory(const ResolvedSettings& settings);

/// Runs a resolved problem from t = 0. Any failure is reported in the outcome, with all results up
/// to it. `progress`, if any, can end the run; `observer`, if any, is called at every accepted step
/// and event; `rows`, if any, receives the rows in place of the result. Thread-safe: runs in
/// several threads share only the parts of their problems, and each gives the same results, bit for
/// bit, as alone. Shared meshes and laws are called from all these runs, so their functions must be
/// pure; observers and progress functions are called in the thread of their own run.
Result simulate(ResolvedRun run, const Progress& progress = {}, Observer* observer = nullptr,
                RowSink* rows = nullptr);

/// resolve() and simulate() in one call. Throws what resolve() throws.
Result simulate(const Problem& problem, const Options& options, const Progress& progress = {},
                Observer* observer = nullptr, RowSink* rows = nullptr);

}  // namespace subimpact
