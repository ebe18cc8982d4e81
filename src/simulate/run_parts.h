#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ode/integrator.h"
#include "simulate/event_loop.h"
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

  /// Before the run: puts the beam into natural modes, if there are so many that resolve() left
  /// them out, so that settings are known at once whatever a run will take.
  void complete();

  /// The integrator of the options as they stand now.
  std::unique_ptr<Integrator> make_integrator();

  Problem problem;
  Options given;
  StruckBeam beam;
  ResolvedSettings settings;
  std::vector<std::string> warnings;  ///< for the result, before those of the run
  /// Those that follow from the result, after those of the run; may be empty.
  std::function<std::vector<std::string>(const Result&)> warnings_of_result;
  double setup_seconds = 0.0;
};

LoopOptions loop_options(const RunParts& parts);

/// Runs the parts with an integrator: the lower half of simulate(ResolvedRun). Result::given and
/// Result::used stay empty; messages of failures name no remedy.
Result simulate(RunParts& parts, Integrator& integrator, const Progress& progress = {},
                Observer* observer = nullptr, RowSink* rows = nullptr);

/// Bytes that a process may still take: what the machine has free (Linux: MemAvailable), and less
/// where a limit of the process (ulimit -v), of its control group or of one above is lower. Pages
/// of files, which the system drops when memory is short, count as free. `root`: where the files
/// of the system lie, for tests.
double available_memory(const std::filesystem::path& root = "/");

}  // namespace subimpact
