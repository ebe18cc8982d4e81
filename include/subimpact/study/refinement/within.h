#pragma once

/// Event times within a wanted error, with mesh, method and tolerance chosen by the program.

#include <functional>
#include <string>

#include "subimpact/case/case_keys.h"
#include "subimpact/case/simulate.h"
#include "subimpact/study/judgement/judgement.h"

namespace subimpact {

/// Makes a run of `input` and adds those of `cases` to `beside`, all of which then judge it. `rows`
/// takes the rows of the run.
using JudgedRunMaker =
    std::function<void(const Case& input, const std::vector<CaseBeside>& cases, RowSink* rows,
                       Result& run, std::vector<RunBeside>& beside)>;

struct WithinOptions {
  Jobs jobs = 1;
  /// Called before each run, with its description.
  std::function<void(const std::string& what)> announce;
  /// Called with every run that ended, including those beside the judged ones.
  std::function<void(const Case& input, const Result& run)> finished;
  Progress progress;  ///< of the current run; false ends all, with the results so far
  /// Called before each run whose rows are kept; returns their destination. Rows of the previous
  /// run are to be discarded. Empty: rows stay in the result.
  std::function<RowSink*()> rows;
  JudgedRunMaker make;  ///< in place of simulate_beside() and judge(); see maker_of()
};
/// WithinOptions::make, or what it stands in place of.
JudgedRunMaker maker_of(const WithinOptions& options);

/// How long an evaluation of the right-hand side takes, per unknown, over one of central
/// differences on cells: powers of two, for methods that keep an error, damping, loads that vary
/// (whose work is integrated step by step), round sections that yield, and elements, of which
/// several sections each yield. Right to within a factor of two or so.
double evaluation_cost(const Case& input);

/// The cost of a run: evaluations of the right-hand side times their cost and the unknowns of the
/// beam, and ten more for each section that flows; with natural modes, the steps in them counted in
/// the same unit (1 to 3 ns).
double counted_work(const Case& input, const Result& result);

/// Without accuracy.event_times the tolerance is a tenth of the time scale of the shortest contacts
/// (ResolvedSettings::contact_time), and the work is limited to this: some 2 s of a processor.
constexpr double default_work_limit = 1e9;
/// The limit after a mesh on which more sub-impacts are certain than on the one before, while some
/// are not: some 5 s by the clock on two cores.
constexpr double work_limit_while_certainty_grows = 7e9;

/// If a beam bends elastically: elements (Hermite, or spectral with shear) in natural modes, by the
/// exponential method (fourth order in the mesh, almost no error in time). If sections yield: cells
/// by central differences. Settings that the case fixes are kept.
struct ChosenModel {
  Case input;
  std::string reason;  ///< in words
};
ChosenModel choose_model(const Case& input, const OpenChoices& open, bool yields);

/// Mesh and method of a case's first run, and in words how the search continues from there.
ChosenModel first_choice(const Case& input, const OpenChoices& open);

/// Counted work of all runs that run_as_asked() makes of a case, as far as it is known beforehand:
/// at least that of the first level; at most the limit of the search or, where that is more or
/// nothing is searched, that level. `open`: empty for a case that is run as it is given.
struct WorkRange {
  double least = 0.0;
  std::optional<double> most;  ///< none: the method chooses its steps
};
WorkRange work_expected(const Case& first, const std::optional<OpenChoices>& open);

/// A case with every choice made, and its run.
struct WithinRun {
  Case input;  ///< simulate_judged() with cases_beside(input) repeats the run, bit for bit
  Result result;
  std::vector<RunBeside> beside;  ///< those that judge it
};

/// Runs a case on finer and finer meshes, each together with the cases that judge it, until all
/// sub-impacts are certain, no others are possible, and all event times are within
/// accuracy.event_times. The next mesh follows from the stated errors and the order of the mesh,
/// and the counted work so far decides whether it is affordable. While sub-impacts are uncertain,
/// the last mesh is as fine as is affordable at once. Neither depends on measured time
/// or on the number of jobs. Runs that are not expected to be the last keep no rows.
/// Result::tolerance states whether this is met and, if not, why, and which key of the case
/// prevents it. Result::choice gives the reason for the choice. A stopped search returns the run on
/// the last finished mesh. Throws InvalidCase.
WithinRun simulate_within(const Case& input, const OpenChoices& open,
                          const WithinOptions& options = {});

}  // namespace subimpact
