#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "subimpact/case/case_keys.h"
#include "subimpact/case/simulate.h"
#include "subimpact/study/refinement/within.h"

namespace subimpact {

/// Where the error estimates of event times come from.
enum class ErrorBars {
  off,  ///< there are none
  all   ///< coarser meshes (cases_beside), also beside one that the case fixes
};

struct RunRequest : WithinOptions {
  /// Empty: if the case fixes nothing, mesh and method are chosen (study/within.h), with errors
  /// from coarser meshes; otherwise cases_beside_on_given_mesh(). Must be empty if the case has
  /// accuracy.event_times.
  std::optional<ErrorBars> error_bars;
  /// The case, if it is already resolved; used by a run without error bars.
  std::optional<ResolvedRun> resolved;
  bool body_errors = true;  ///< whether those are estimated (study/model/body_errors.h)
};

/// The choices that the program makes: those that the case leaves open, if the case has
/// accuracy.event_times, or if it fixes nothing and `error_bars` is empty; otherwise none. Throws
/// InvalidCase (accuracy.event_times) if the case has both.
std::optional<OpenChoices> choices_left(const Case& input, const GivenKeys& given,
                                        const std::optional<ErrorBars>& error_bars);

/// Runs a case as `subimpact run` does, with error estimates and errors of the body, unless
/// error bars are off or `body_errors` is false; simulate(Case) is one run on the mesh of the
/// case. `given`: the keys that the caller has chosen; the program chooses mesh and method if no
/// such key is among them. Throws InvalidCase. With repeat.strikes = N the beam is struck N times,
/// on the mesh of the first strike, as are those of the runs that show the errors, and comes to
/// rest before each strike unless strike.rest is false. The result is that of the last strike, with
/// a row of each in Result::strikes, and with errors of the body.
WithinRun run_as_asked(const Case& input, const GivenKeys& given = {}, RunRequest request = {});

/// The first of the runs that run_as_asked() makes of a case, by default; without a reason where
/// the case fixes mesh or method.
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
