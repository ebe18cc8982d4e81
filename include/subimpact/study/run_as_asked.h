#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "subimpact/case/case_keys.h"
#include "subimpact/case/simulate.h"
#include "subimpact/study/within.h"

namespace subimpact {

/// Where the error estimates of event times come from.
enum class ErrorBars {
  off,   ///< there are none
  time,  ///< another run in time (cases_beside_in_time)
  all    ///< other runs in time, mesh and layers (cases_beside_by_part)
};

struct RunRequest : WithinOptions {
  /// Empty: what a case that fixes nothing leaves open is chosen (study/within.h), with errors from
  /// coarser meshes; where it fixes something, cases_beside_on_given_mesh(). Must be empty if the
  /// case has accuracy.event_times.
  std::optional<ErrorBars> error_bars;
  /// The case resolved already; taken by a run without error bars.
  std::optional<ResolvedRun> resolved;
};

/// Whether mesh, method and tolerance that the case leaves open are chosen by the program: if it
/// has accuracy.event_times, or fixes nothing and no error bars are asked for. Throws InvalidCase
/// (accuracy.event_times) if both are asked for.
std::optional<OpenChoices> choices_left(const Case& input, const GivenKeys& given,
                                        const std::optional<ErrorBars>& error_bars);

/// Poisson's ratio of a beam for which the case has none.
inline constexpr double usual_poisson = 0.3;

/// What shear would do to the first contact of a run whose theory leaves it out, from two further
/// runs up to there, with and without shear, on the same coarse cells, undamped (usual_poisson
/// unless given). Contacts that shear merges make it large. Nothing where the theory has shear, on
/// a rigid beam and on a mesh of the user's own, and where no first contact ended.
std::optional<NeglectedShear> neglected_shear(const Case& input, const Result& result);

/// Runs a case as `subimpact run` does, with error estimates and what neglected shear would change,
/// unless error bars are off; simulate(Case) is one run on the mesh that the case has. `given`: the
/// keys that the caller has chosen; mesh and method are the program's where they are none of these.
/// Throws InvalidCase.
///
/// A run from an earlier state (CaseParts::start) has the errors that the runs beside the earlier
/// one show when they go on from theirs, so those of the whole; without them none are stated.
///
/// With repeat.strikes = N the beam is struck N times, on the mesh of the first strike, and has
/// come to rest before each strike unless strike.rest is false. The result is that of the last
/// strike, with a row of each in Result::strikes.
WithinRun run_as_asked(const Case& input, const GivenKeys& given = {}, RunRequest request = {});

/// The first of the runs that run_as_asked() makes of a case, by default; without a reason where
/// the case fixes mesh or method.
ChosenModel first_run(const Case& input, const GivenKeys& given);

/// The case with the mesh, method and tolerance that run_as_asked() would choose where they are
/// left open, for studies that stay on one mesh. Takes the runs of that choice. Throws InvalidCase.
Case case_as_chosen(const Case& input, const GivenKeys& given, Jobs jobs = 1,
                    const Progress& progress = {});

/// A further run that answers what this one leaves open.
struct Advice {
  /// Options of `subimpact run` and their values: {"--within", "1us"}, {"--set", "time.end=0.016"}.
  std::vector<std::pair<std::string, std::string>> options;
  double seconds = 0.0;  ///< expected, by the time and the counted work of this run
  std::string gain;      ///< "shows whether contact is over"
};

/// Whether shear moves the end of the first contact by half a per cent or more.
bool is_notable(const NeglectedShear& shear);

/// The most useful first. `input` and `given`: the case as it was run, and the keys that the user
/// gave. Whether a case takes the options is not checked.
std::vector<Advice> advice(const Case& input, const GivenKeys& given, const Result& result);

}  // namespace subimpact
