#pragma once

/// Runs as `subimpact run` makes them: with mesh, method and tolerance chosen by the program where
/// the case leaves them open, so that event times are within a wanted error.

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "subimpact/case/case_keys.h"
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
/// accuracy.event_times, or the next mesh would take too much counted work
/// (docs/theory/errors.md, "Refinement"). Meshes do not depend on measured time or on the number of
/// jobs. Result::tolerance states whether this is met and, if not, why, and which key of the case
/// prevents it; Result::choice gives the reason for the choice. A stopped search returns the run on
/// the last finished mesh. Throws InvalidCase.
WithinRun simulate_within(const Case& input, const OpenChoices& open,
                          const WithinOptions& options = {});

/// Where the error estimates of event times come from.
enum class ErrorBars {
  off,  ///< there are none
  all   ///< coarser meshes (cases_beside), also beside one that the case fixes
};

struct RunRequest : WithinOptions {
  /// Empty: if the case fixes nothing, mesh and method are chosen (simulate_within()), with errors
  /// from coarser meshes; otherwise cases_beside_on_given_mesh(). Must be empty if the case has
  /// accuracy.event_times.
  std::optional<ErrorBars> error_bars;
  bool body_errors = true;  ///< whether those are estimated (study/model.h)
};

/// The choices that the program makes: those that the case leaves open, if the case has
/// accuracy.event_times, or if it fixes nothing and `error_bars` is empty; otherwise none. Throws
/// InvalidCase (accuracy.event_times) if the case has both.
std::optional<OpenChoices> choices_left(const Case& input, const GivenKeys& given,
                                        const std::optional<ErrorBars>& error_bars);

/// Runs a case as `subimpact run` does, with error estimates and errors of the body, unless
/// error bars are off or `body_errors` is false; simulate(Case) is one run on the mesh of the
/// case. `given`: the keys that the caller has chosen; the program chooses mesh and method if no
/// such key is among them. Throws InvalidCase. With repeat.strikes = N all strikes are on the mesh
/// of the first one; the result is that of the last, with a row of each in Result::strikes.
WithinRun run_as_asked(const Case& input, const GivenKeys& given = {}, RunRequest request = {});

/// The first of the runs that run_as_asked() makes by default; no reason where the case fixes mesh
/// or method.
ChosenModel first_run(const Case& input, const GivenKeys& given);

/// The case with the mesh, method and tolerance that run_as_asked() would choose where they are
/// left open, for studies that stay on one mesh. Makes the runs needed for the choice. Throws
/// InvalidCase.
Case case_as_chosen(const Case& input, const GivenKeys& given, Jobs jobs = 1,
                    const Progress& progress = {});

/// A further run that settles a question left open by this one.
struct Advice {
  /// Options of `subimpact run` and their values: {"--within", "1us"}, {"--set", "time.end=0.016"}.
  std::vector<std::pair<std::string, std::string>> options;
  double seconds = 0.0;  ///< expected, from time and counted work of this run
  std::string gain;      ///< "may show whether contact is over"
  std::string name;      ///< "longer": of what this run has
};

/// Useful further runs, the most useful first. `input` and `given`: the case as it was run, and the
/// keys that the user gave. The options are not checked against the case.
std::vector<Advice> advice(const Case& input, const GivenKeys& given, const Result& result);

}  // namespace subimpact
