#pragma once

/// Event times within a wanted error: mesh, method and tolerance chosen by the program.

#include <functional>
#include <string>

#include "subimpact/case/case_keys.h"
#include "subimpact/case/simulate.h"
#include "subimpact/study/judgement.h"

namespace subimpact {

/// What a case leaves to the program.
struct OpenChoices {
  bool mesh = true;       ///< model.mesh
  bool size = true;       ///< model.segments or model.elements
  bool method = true;     ///< solver.method
  bool tolerance = true;  ///< solver.rtol, or solver.step

  bool all() const { return mesh && size && method && tolerance; }
};

/// What the keys that a user gave leave open. Keys of one mesh or method fix that mesh or method.
OpenChoices open_choices(const GivenKeys& given);

/// Makes a run of `input` and adds those of `cases` to `beside`, all of which then judge it. `rows`
/// takes the rows of the run.
using JudgedRunMaker =
    std::function<void(const Case& input, const std::vector<CaseBeside>& cases, RowSink* rows,
                       Result& run, std::vector<RunBeside>& beside)>;

struct WithinOptions {
  Jobs jobs = 1;
  /// Called before each run, with its description.
  std::function<void(const std::string& what)> announce;
  /// Called with every run that ended, those beside the judged ones too.
  std::function<void(const Case& input, const Result& run)> finished;
  Progress progress;  ///< of the run in hand; returning false ends all with what there is
  /// Called before each run whose rows are kept: where they go. Those of the run before are to be
  /// discarded. Empty: rows stay in the result.
  std::function<RowSink*()> rows;
  JudgedRunMaker make;  ///< in place of simulate_beside() and judge(); see maker_of()
};
/// WithinOptions::make, or what it stands in place of.
JudgedRunMaker maker_of(const WithinOptions& options);

/// What a run cost: evaluations of the right-hand side times unknowns of the beam, and its modes
/// and the steps in them in the same unit.
double counted_work(const Result& result);

/// Without accuracy.event_times the tolerance is a tenth of the time scale of the shortest contacts
/// (ResolvedSettings::contact_time), and this is the limit of the work: some three seconds on two
/// cores.
constexpr double default_work_limit = 3e9;

/// Where a beam bends elastically: elements (Hermite, or spectral where it shears) in natural
/// modes, by the exponential method (fourth order in the mesh, next to no error in time). Where
/// sections yield: cells by central differences, the cheapest known at any error above 1e-3 us.
/// What the case fixes stays.
struct ChosenModel {
  Case input;
  std::string reason;  ///< in words
};
ChosenModel choose_model(const Case& input, const OpenChoices& open, bool yields);

/// The mesh and method that a case's first run would have, and in words how it goes on from there.
ChosenModel first_choice(const Case& input, const OpenChoices& open);

/// A case with every choice made, and its run.
struct WithinRun {
  Case input;  ///< simulate_judged() with cases_beside(input) repeats the run, bit for bit
  Result result;
};

/// Runs a case on finer and finer meshes, each beside the cases that judge it, until all
/// sub-impacts are certain, no others are possible, and all event times are within
/// accuracy.event_times. The next mesh follows from the stated errors and the order of the mesh;
/// from the counted work of the runs so far follows whether it is affordable. Neither depends on
/// measured time or on the number of jobs. Runs that are not expected to be the last keep no rows.
///
/// Result::tolerance states whether this is met; if not, why, and which key of the case stands in
/// the way. Result::choice gives the reason of the choice. A search that is stopped returns the
/// last mesh that was finished. Throws InvalidCase.
WithinRun simulate_within(const Case& input, const OpenChoices& open,
                          const WithinOptions& options = {});

}  // namespace subimpact
