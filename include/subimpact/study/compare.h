#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "subimpact/case/simulate.h"
#include "subimpact/study/judgement/event_errors.h"
#include "subimpact/study/judgement/judgement.h"

namespace subimpact {

/// One method's run, compared with the reference run; Setting::method is the name as given.
struct ComparedRun : Trial {
  Result result;
  std::vector<MatchedPair> pairs;  ///< reference (first) against this run (second)
};

struct Comparison {
  Reference reference;  ///< with error bars
  std::vector<ComparedRun> runs;
  bool interrupted = false;  ///< `runs` are those that had ended; none: the reference had not
};

/// Runs a scene by several methods ("central-difference", "erk", or with a table "erk:verner"),
/// each with the case's step if one is given, else with its tolerance or the default step, and
/// compares them with run_reference() at rtol = 1e-11. History rows are left out. `progress`, if
/// any, can end the comparison. Throws InvalidCase, also for unknown methods, a step or an order
/// that a method does not have, and a reference that fails.
Comparison compare(const Case& input, const std::vector<std::string>& methods,
                   const std::function<void(const std::string& name)>& announce = {},
                   const Progress& progress = {});

/// The run of one model of a scene, with its own error bars, compared with that of the first model.
struct ModelRun {
  std::string name;  ///< of the beam theory or contact law by which the models differ
  Result result;
  std::vector<MatchedPair> pairs;  ///< the first model's (first) against this run (second)
};

/// The case with the contact law of that name ("sphere"), without the contact constants that this
/// law does not use. Throws InvalidCase for an unknown name.
Case with_contact_law(const Case& input, const std::string& name);

/// Runs a scene by several models: cases that differ only in beam theory or contact law, and their
/// names. `announce` is called with the index of each run that begins; `progress`, if any, can end
/// the comparison: the runs are then those that had ended. Throws InvalidCase before anything is
/// run.
std::vector<ModelRun> compare_models(std::span<const Case> cases,
                                     std::span<const std::string> names, Jobs jobs,
                                     const std::function<void(std::size_t)>& announce = {},
                                     const Progress& progress = {});

}  // namespace subimpact
