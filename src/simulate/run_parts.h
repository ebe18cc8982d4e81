#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ode/integrator.h"
#include "simulate/loop/event_loop.h"
#include "subimpact/simulate/simulate.h"
#include "system/struck_beam.h"

namespace subimpact {

enum class Coordinates {
  chosen,  ///< natural modes for an elastic beam where the method needs them or they are cheaper
  of_mesh  ///< the mesh's own
};

StruckBeam make_struck_beam(const Problem& problem, const Options& options,
                            Coordinates coordinates = Coordinates::chosen);

struct RunParts {
  RunParts(const Problem& problem, const Options& options, StruckBeam struck_beam);

  /// Before the run: puts the beam into natural modes if resolve() left them out because there are
  /// many, so that settings are known quickly whatever a run costs.
  void complete();

  /// The integrator of the options as they stand now.
  std::unique_ptr<Integrator> make_integrator();

  Problem problem;
  Options given;
  StruckBeam beam;
  ResolvedSettings settings;
  std::vector<std::string> warnings;  ///< for the result, before those of the run
  /// Warnings that follow from the result, after those of the run; may be empty.
  std::function<std::vector<std::string>(const Result&)> warnings_of_result;
  double setup_seconds = 0.0;
};

LoopOptions loop_options(const RunParts& parts);

/// Runs the parts with an integrator: the lower half of simulate(ResolvedRun). Result::given and
/// Result::used stay empty; messages of failures name no remedy.
Result simulate(RunParts& parts, Integrator& integrator, const Progress& progress = {},
                Observer* observer = nullptr, RowSink* rows = nullptr);

/// Throws InvalidCase where bodies, supports and loads of a problem allow no start: a motion that
/// the supports do not allow, no equilibrium, bodies that do not approach each other.
void check_start(const Problem& problem);

/// Puts a beam and its striker where the problem starts, if that is not the first touch of a beam
/// at rest: a rigid motion v = Mass^-1 (functionals of momentum and moment of momentum),
/// displacements K^-1 f(0) in equilibrium. Throws InvalidCase where a section would yield.
void set_start(const Problem& problem, StruckBeam& beam);

/// Refuses (InvalidCase) several strikes on a beam with loads, a stop or a motion of its own, and a
/// gap before a beam that moves.
void check_next_strike(const Problem& problem);
/// Puts the beam into the state that Problem::start describes. Throws InvalidCase.
void begin_next_strike(RunParts& parts);

/// Bytes that a process may still take: what the machine has free (Linux: MemAvailable), and less
/// where a limit of the process (ulimit -v), of its control group or of one above is lower. Pages
/// of files, which the system drops when memory is short, count as free. `root`: where the files
/// of the system lie, for tests.
double available_memory(const std::filesystem::path& root = "/");

// Settings of the method as a run uses them. All throw InvalidCase, by the key, for what the method
// cannot take; `used` is what has been resolved before.

/// The given table, or the first one of the method; none for a method without tables.
std::optional<std::string> table_used(const Options& options);

/// None for a method without orders.
std::optional<int> max_order_used(const Options& options);

/// Section events are found on paths of an undamped strike alone.
ReversalHandling reversals_used(const Problem& problem, const Options& options, bool can_yield);

/// The fixed step, s; none where the method chooses its steps. Needs the critical step and the
/// contact's time scale in `used`.
std::optional<double> step_used(const Options& options, const ResolvedSettings& used);

/// Events, reversals and steps. Needs those of `used`.
void check_method(const Options& options, const ResolvedSettings& used, bool can_yield);

void check_contact_damping(const Problem& problem, const Options& options,
                           const ResolvedSettings& used);

void check_beam_damping(const BeamDamping& damping, const Options& options, bool can_yield);

/// Refuses what integrates natural modes where a beam stretches or may lift off supports.
void check_modes(const Beam& beam, const Options& options);

/// Whether an elastic beam without tension on this mesh is integrated in its natural modes, which a
/// damping ratio needs. Explicit methods see the same motion in both, but a step in modes needs no
/// mass solve.
bool in_modes(const Options& options, const BeamMesh& mesh, const BeamDamping& damping);

/// Whether resolve() has left a beam in the unknowns of its mesh that is to run in modes.
bool modes_are_left_out(const Options& options, const StruckBeam& beam);

/// The work of finding the modes that a run needs, in entries of right-hand sides.
double decomposition_of(const Options& options, const StruckBeam& beam);

/// Upper bound (bytes) of the memory of a run; history goes to the disk.
double memory_of(const Options& options, const StruckBeam& beam);

}  // namespace subimpact
