#include "subimpact/study/studies.h"

#include <algorithm>

#include "case/problem.h"
#include "simulate/settings/refuse.h"
#include "study/method_choice.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/study/judgement/judgement.h"

namespace subimpact {

constexpr double reference_tolerance = 1e-11;

Comparison compare(const Case& input, const std::vector<std::string>& methods,
                   const std::function<void(const std::string&)>& announce,
                   const Progress& progress) {
  // Refused before anything is run.
  std::vector<ComparedRun> runs;
  for (const std::string& name : methods) {
    ComparedRun& run = runs.emplace_back();
    run.input = with_method(input, name);
    const ResolvedSettings used = resolve(run.input).settings();
    run.setting = {name, used.step.has_value(), used.step.value_or(run.input.solver.rtol)};
  }
  const std::optional<int>& order = input.solver.max_order;
  const auto takes_it = [&](const ComparedRun& run) { return run.input.solver.max_order == order; };
  if (order && std::ranges::none_of(runs, takes_it)) {
    refuse("solver.max_order", "is {}, but no method of the comparison has it: adams, bdf", *order);
  }
  Comparison comparison;
  const Progress watched = [&](double time) {
    if (progress && !progress(time)) comparison.interrupted = true;
    return !comparison.interrupted;
  };
  if (announce) announce("reference");
  comparison.reference = run_reference(input, reference_tolerance, watched);
  const Reference& reference = comparison.reference;
  for (ComparedRun& run : runs) {
    if (announce) announce(run.setting.method);
    if (!watched(0.0)) break;  // runs of few steps do not look
    run.result = run_trial(run, reference, watched);
    if (comparison.interrupted) break;
    run.pairs = match_sub_impacts(reference.sub_impacts, run.result.sub_impacts);
    if (run.message.empty()) run.message = "every sub-impact corresponds";
    comparison.runs.push_back(std::move(run));
  }
  return comparison;
}

Case with_contact_law(const Case& input, const std::string& name) {
  Case other = input;
  assign(other, *find_case_key("contact.law"), name);
  Contact& contact = other.scene.contact;
  const ContactConstants& way =
      constants_given(other, built_in_contact_law(other.scene.contact.kind));
  for (const auto& [key, constant] :
       {std::pair("contact.stiffness", &contact.stiffness),
        std::pair("contact.striker_modulus", &contact.striker_modulus),
        std::pair("contact.striker_poisson", &contact.striker_poisson),
        std::pair("contact.beam_poisson", &contact.beam_poisson),
        std::pair("contact.yield_pressure", &contact.yield_pressure)}) {
    if (!uses_key(way, key)) constant->reset();
  }
  if (!uses_key(way, "contact.yield_pressure")) contact.pressure_by_depth = false;
  if (contact.kind == ContactKind::line) contact.indentation.reset();
  return other;
}

std::vector<ModelRun> compare_models(std::span<const Case> cases,
                                     std::span<const std::string> names, Jobs jobs,
                                     const std::function<void(std::size_t)>& announce,
                                     const Progress& progress) {
  for (const Case& input : cases) resolve(input);
  std::vector<ModelRun> runs;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (announce) announce(i);
    Case input = cases[i];
    input.output.keep_no_rows();
    ModelRun run{names[i], simulate_judged(input, cases_beside(input), jobs, progress), {}};
    if (run.result.outcome.kind == OutcomeKind::stopped) break;
    const Result& first = runs.empty() ? run.result : runs.front().result;
    run.pairs = match_sub_impacts(first.sub_impacts, run.result.sub_impacts);
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace subimpact
