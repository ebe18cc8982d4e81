#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings.h"
#include "case/keys/units.h"
#include "case/shifted_case.h"
#include "finished.h"
#include "overseer.h"
#include "report/text/uncertain.h"
#include "simulate/settings/methods.h"
#include "study/method_choice.h"
#include "study/refinement/refinement.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"
#include "subimpact/report/text.h"
#include "subimpact/study/judgement/event_errors.h"
#include "subimpact/study/judgement/judgement.h"
#include "subimpact/study/run_as_asked.h"

namespace subimpact::python {
namespace {

// What a study of a case returns; KeyboardInterrupt after Ctrl-C.
template <class Study>
auto overseen(const LoadedCase& loaded, Study study) {
  Overseer overseer(py::none(), std::nullopt);
  auto found = [&] {
    const py::gil_scoped_release released;
    return with_places(loaded, [&] { return study([&](auto...) { return overseer.goes_on(); }); });
  }();
  overseer.finish();
  if (!overseer.interrupted()) return found;
  PyErr_SetNone(PyExc_KeyboardInterrupt);
  throw py::error_already_set();
}

std::string as_chosen(const LoadedCase& loaded, Jobs jobs) {
  return overseen(loaded, [&](auto goes_on) {
    return case_file_text(case_as_chosen(loaded.value, loaded.given, jobs, goes_on));
  });
}

using Names = std::vector<std::string>;

auto compared(const LoadedCase& loaded, const Names& methods) {
  return overseen(loaded, [&](auto goes_on) {
    const Comparison comparison = compare(loaded.value, methods, {}, goes_on);
    return std::pair(comparison_csv(comparison), matches_csv(comparison));
  });
}

std::string work_precision_of(const LoadedCase& loaded, const Names& methods, double seconds) {
  return overseen(loaded, [&](auto goes_on) {
    WorkPrecisionOptions options;
    options.methods = methods;
    options.point_seconds = seconds;
    options.progress = goes_on;
    return work_precision_csv({work_precision(loaded.value, options)});
  });
}

std::string outcomes_of(const LoadedCase& loaded, const Names& methods, double seconds, Jobs jobs) {
  return overseen(loaded, [&](auto goes_on) {
    return outcomes_csv(outcome_map(loaded.value, methods, seconds, jobs, goes_on));
  });
}

// At rtol 1e-13 or less. The method is nystrom, or erk for a damped strike, in place of erk, which
// takes several times as long so near to rounding, and where events would be interpolated within
// fixed steps, whose phase makes times jump.
Case for_derivatives(const Case& input) {
  constexpr double tightest = 1e-13;
  Case base = input;
  const Method possible = possible_method(input, Method::nystrom);
  const bool is_dear = input.solver.method == Method::erk && possible != Method::erk;
  if (is_dear || events_of(input) == EventHandling::interpolated) {
    base.solver = {};
    base.solver.method = possible;
  }
  base.solver.rtol = std::min(input.solver.rtol, tightest);
  base.accuracy.event_times.reset();
  base.output.keep_no_rows();
  if (const auto step = resolve(base).settings().step) base.solver.step = step;
  return base;
}

// Nothing where the scene does not allow the mesh.
std::optional<Case> resized(const Case& input, double ratio) {
  const std::optional<Case> other = on_other_mesh(input, ratio);
  return other && can_run(*other) ? other : std::nullopt;
}

// The case on a mesh, coarser if need be but at least an eighth as fine, on which so many runs take
// no more than a bound of counted work. Makes a run a quarter as fine to know it.
Case affordable(const Case& input, double n_runs) {
  constexpr double most_work = 3e9, tried = 0.25, coarsest = 0.125;
  const std::optional<Case> coarse = resized(input, tried);
  if (!coarse) return input;
  NoRows none;
  const double all = n_runs * counted_work(*coarse, simulate(*coarse, {}, nullptr, &none));
  const double ratio = tried * std::pow(most_work / all, 1.0 / usual_growth);
  return ratio >= 1.0 ? input : resized(input, std::max(ratio, coarsest)).value_or(*coarse);
}

// Starts and ends of a table of sub-impacts; without an end where it is NaN.
std::vector<SubImpact> times_of(const py::array& table) {
  const auto starts = table["start_s"].cast<std::vector<double>>();
  const auto ends = table["end_s"].cast<std::vector<double>>();
  std::vector<SubImpact> all(starts.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].start = starts[i];
    if (!std::isnan(ends[i])) all[i].end = ends[i];
  }
  return all;
}

// Pairs of indices; none where the other run has no counterpart.
auto matched(const py::array& first, const py::array& second) {
  std::vector<std::pair<std::optional<std::size_t>, std::optional<std::size_t>>> pairs;
  for (const auto& pair : match_sub_impacts(times_of(first), times_of(second))) {
    pairs.emplace_back(pair.first, pair.second);
  }
  return pairs;
}

auto counterparts_of(const py::array& base, const py::array& other) {
  const std::vector<SubImpact> there = times_of(other);
  const Counterparts found = counterparts(times_of(base), there);
  std::vector<std::optional<std::size_t>> of;
  for (const SubImpact* one : found.of) {
    of.push_back(one != nullptr ? std::optional(static_cast<std::size_t>(one - there.data()))
                                : std::nullopt);
  }
  return std::pair(of, found.follows_new_one);
}

// The margins in another run of the near misses of a run, as far as both have the same sub-impacts;
// NaN of the others.
std::vector<double> matched_margins(const Finished& run, const Finished& other) {
  const std::size_t n =
      n_leading_matches(match_sub_impacts(run.result.sub_impacts, other.result.sub_impacts));
  std::vector<double> margins(run.result.near_misses.size(),
                              std::numeric_limits<double>::quiet_NaN());
  const auto matches = match_near_misses(run.result, other.result, n);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i]) margins[i] = other.result.near_misses[*matches[i]].margin;
  }
  return margins;
}

std::optional<std::pair<std::string, std::string>> rounded(double value, double error,
                                                           int most_decimals) {
  const std::optional<Rounding> rounding = rounding_of(error, most_decimals);
  if (!rounding) return std::nullopt;
  return std::pair(with_decimals(value, rounding->decimals), rounding->error);
}

std::optional<std::string> why_no_derivative(const LoadedCase& loaded, const std::string& key) {
  return why_not_shifted(loaded.value, key_of(key));
}

// A value of an axis, in the unit of its key. A stiffness has the unit of its law, which a sweep
// may change: its unit is refused.
py::object in_si(const std::string& name, py::handle value) {
  const CaseKey& key = key_of(name);
  KeyValue converted = key_value(key, value);
  if (key.unit.find(" or ") == std::string::npos) converted = in_unit_of(key, std::move(converted));
  if (const auto problem = problem_with(key, converted)) {
    throw InvalidCase(key.name, key.name + ' ' + *problem);
  }
  return to_python(converted);
}

}  // namespace

void bind_studies(py::module_& module) {
  module.def("shifted_keys", [](const LoadedCase& loaded) { return shifted_keys(loaded.value); });
  module.def("why_not_shifted", &why_no_derivative);
  module.def("as_chosen", &as_chosen);
  module.def("for_derivatives", [](const LoadedCase& loaded) {
    return with_places(loaded, [&] { return case_file_text(for_derivatives(loaded.value)); });
  });
  module.def("affordable", [](const LoadedCase& loaded, double n_runs) {
    return with_places(loaded, [&] { return case_file_text(affordable(loaded.value, n_runs)); });
  });
  module.def("matched", &matched);
  module.def("counterparts", &counterparts_of);
  module.def("matched_margins", &matched_margins);
  module.def("first_in_doubt", [](const Finished& run, std::size_t near_miss) {
    return first_in_doubt(run.result, run.result.near_misses.at(near_miss));
  });
  module.def("moving_mass",
             [](const Finished& run) { return run.input.scene.bodies().moving_mass(); });
  module.def("velocity_scale",
             [](const Finished& run) { return run.input.scene.bodies().velocity_scale(); });
  module.def("rounded", &rounded);
  module.def("in_si", &in_si);
  module.def("compare", &compared);
  module.def("work_precision", &work_precision_of);
  module.def("stability", &outcomes_of);
  module.def("parsed_setting", [](const std::string& text) {
    const Override setting = parse_override(text);
    return std::tuple(setting.key, setting.value, setting.origin);
  });
}

}  // namespace subimpact::python
