#pragma once

/// Cost of a wanted total error, due to mesh and time integration together.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "subimpact/study/event_errors.h"
#include "subimpact/study/within.h"

namespace subimpact {

/// One run of a sequence of meshes, compared with the reference; the method is as in case files.
struct PlanPoint : Trial {
  std::string mesh;      ///< "501 cells", "200 elements, 4 times as fine at the strike"
  double counted = 0.0;  ///< counted_work() of the run
  bool within = false;  ///< right, and with the reference's error within the wanted one and half of
                        ///< what it times
  /// Whether this and all finer runs of its sequence are within, so that it is not right by chance.
  bool admitted = false;
};

struct Plan {
  Case asked;           ///< as the caller passed it
  double wanted = 0.0;  ///< s
  /// The run that represents the limit of fine meshes: its sub-impacts before the horizon, up to
  /// which runs are judged.
  Reference reference;
  std::vector<PlanPoint> points;  ///< sequence by sequence, each from coarse to fine
  std::optional<std::size_t>
      cheapest;  ///< index into points, by counted work; empty: none admitted
  bool interrupted = false;
};

struct PlanOptions {
  Jobs jobs = 1;  ///< the two runs of the reference may run in parallel
  /// Called before each run, with its description and the time at which it ends (s).
  std::function<void(const std::string& what, double end_time)> announce;
  Progress progress;  ///< of the current run; false ends the plan with the results so far
};

/// The cheapest mesh and method for a wanted error (s) of event times. The reference is the run of
/// simulate_within() for a fifth of that error. Sequences of meshes (cells, elements, elements
/// finer at the strike, each with the methods that are fast on it) are run up to the reference's
/// horizon, finer by the square root of two from run to run, until three in a row are within the
/// wanted error (two where the reference is the finest of the sequence), or until the next one
/// would cost more than the cheapest that is admitted. Meshes between the cheapest and the next
/// coarser one are tried last. The case's own mesh and method have no effect. Throws InvalidCase,
/// also if the reference has no certain event.
Plan plan(const Case& input, double wanted, const PlanOptions& options = {});

}  // namespace subimpact
