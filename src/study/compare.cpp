#include "subimpact/study/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "case/counted.h"
#include "case/problem.h"
#include "study/method_choice.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/study/judgement.h"

namespace subimpact {
namespace {

constexpr double reference_tolerance = 1e-11;

// Nothing can be compared with a reference that failed.
void require_completed(const Result& reference) {
  const Outcome& outcome = reference.outcome;
  if (outcome.completed() || outcome.kind == OutcomeKind::stopped) return;
  throw std::runtime_error(fmt::format(
      "the reference of the comparison (nystrom at rtol {:.0e}) ended {} at {:.6g} us: {}",
      reference_tolerance, to_string(outcome.kind), 1e6 * outcome.time, outcome.message));
}

// Of a number that may be 0 in both runs.
double relative_difference(double here, double there, double unit) {
  return here == there ? 0.0 : std::abs(here - there) / unit;
}

std::string remark_on(const ComparedRun& run, const Result& reference) {
  const std::size_t here = run.result.sub_impacts.size();
  const std::size_t there = reference.sub_impacts.size();
  if (!run.result.outcome.completed()) return run.result.outcome.message;
  if (run.n_corresponding == there && here == there) return "every sub-impact corresponds";
  std::string text = fmt::format("{} instead of {}; {}", counted(here, "sub-impact"), there,
                                 leading_words(run.n_corresponding));
  const auto unmatched = first_unmatched(run.pairs, reference.sub_impacts, run.result.sub_impacts);
  if (unmatched) text += "; " + unmatched->description;
  return text;
}

void set_beside(ComparedRun& run, const Result& reference) {
  const auto& there = reference.sub_impacts;
  const auto& here = run.result.sub_impacts;
  run.pairs = match_sub_impacts(there, here);
  run.n_corresponding = n_leading_matches(run.pairs);
  double largest_impulse = 0.0;
  for (const SubImpact& s : there) largest_impulse = std::max(largest_impulse, s.impulse);
  for (std::size_t i = 0; i < run.n_corresponding; ++i) {
    run.max_start_difference =
        std::max(run.max_start_difference, std::abs(here[i].start - there[i].start));
    if (here[i].end && there[i].end) {
      run.max_end_difference =
          std::max(run.max_end_difference, std::abs(*here[i].end - *there[i].end));
    }
    run.max_peak_difference =
        std::max(run.max_peak_difference,
                 relative_difference(here[i].peak_force, there[i].peak_force, there[i].peak_force));
    run.max_impulse_difference =
        std::max(run.max_impulse_difference,
                 relative_difference(here[i].impulse, there[i].impulse, largest_impulse));
  }
  run.remark = remark_on(run, reference);
}

}  // namespace

Comparison compare(const Case& input, const std::vector<std::string>& methods,
                   const std::function<void(const std::string&)>& announce,
                   const Progress& progress) {
  // Refused before anything is run.
  std::vector<ComparedRun> runs;
  for (const std::string& name : methods) {
    ComparedRun run;
    run.name = name;
    run.input = with_method(input, name);
    resolve(run.input);
    runs.push_back(std::move(run));
  }
  Comparison comparison;
  comparison.reference_input = with_method(input, "nystrom");
  comparison.reference_input.solver.step.reset();
  comparison.reference_input.solver.rtol = reference_tolerance;
  const Progress watched = [&](double time) {
    if (progress && !progress(time)) comparison.interrupted = true;
    return !comparison.interrupted;
  };
  if (announce) announce("reference");
  comparison.reference = simulate_judged(
      comparison.reference_input, cases_beside_in_time(comparison.reference_input), 1, watched);
  require_completed(comparison.reference);
  for (ComparedRun& run : runs) {
    if (announce) announce(run.name);
    if (!watched(0.0)) break;  // runs of few steps do not look
    run.result = simulate(run.input, watched);
    if (comparison.interrupted) break;
    set_beside(run, comparison.reference);
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
