#include "subimpact/study/run_as_asked.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/meshes.h"
#include "study/refinement/refinement.h"
#include "subimpact/study/model.h"

namespace subimpact {
namespace {

constexpr double least_change_by_shear = 5e-3;  // of the end of the first contact
constexpr double times_more_accurate = 5.0;
constexpr double times_longer = 2.0;

double seconds_of_work(double work, const Case& input, const Result& result) {
  return work * result.work.wall_seconds / counted_work(input, result);
}

// Runs on the way to smaller errors, whose last mesh takes most of the time.
Advice smaller_errors(const Case& input, const Result& result) {
  const double error = result.error_estimate->largest_error;
  const double within = error > 0.0 ? error / times_more_accurate
                                    : default_share_of_contact * result.used.contact_time;
  const auto& refinement = descriptor_of(input.model.mesh).refinement;
  const double order = refinement ? refinement->order(input) : 1.0;
  const double growth = std::pow(times_more_accurate, usual_growth / order);
  const double rounded = std::stod(fmt::format("{:.1g}", 1e6 * within));
  return {{{"--within", fmt::format("{:g}us", rounded)}},
          std::min(result.work.all_seconds * (1.0 + growth),
                   seconds_of_work(input.accuracy.work_limit, input, result)),
          "makes more of them certain, and the errors smaller",
          "finer"};
}

// Frees what the case fixes of mesh and method.
Advice chosen_mesh(const Case& input, const GivenKeys& given, const Result& result) {
  Advice advice{{},
                seconds_of_work(default_work_limit, input, result),
                "leaves mesh and method to the program: errors then hold for all meshes",
                "free-mesh"};
  for (const auto& keys : {given.in_file, given.in_settings}) {
    for (const std::string& key : keys) {
      const bool is_physics =
          key == "model.section" || key == "model.layers" || key == "model.symmetry";
      const bool fixes = key.starts_with("model.") || key.starts_with("solver.");
      if (fixes && !is_physics) advice.options.emplace_back("--set", key + "=default");
    }
  }
  return advice;
}

}  // namespace

// Whether shear, which the run leaves out, moves the end of its first contact notably.
static bool lacks_shear(const Result& result) {
  if (!result.body_errors || !result.body_errors->value.parting) return false;
  const double least = least_change_by_shear * *result.body_errors->value.parting;
  return std::ranges::any_of(result.body_errors->parts, [&](const BodyErrors::Part& part) {
    return part.kind == BodyPart::shear && part.change.parting.value_or(least) >= least;
  });
}

std::vector<Advice> advice(const Case& input, const GivenKeys& given, const Result& result) {
  std::vector<Advice> all;
  if (!result.outcome.completed() || result.turns_too_far()) return all;
  if (lacks_shear(result)) {
    all.push_back({{{"--set", "beam.theory=timoshenko"}},
                   result.work.all_seconds,
                   "includes the shear that is left out here",
                   "with-shear"});
    if (!input.scene.beam.poisson) {
      const double nu = input.scene.beam_poisson().value_or(usual_poisson);
      all.back().options.emplace_back("--set", fmt::format("beam.poisson={:.4g}", nu));
    }
  }
  const auto& estimate = result.error_estimate;
  const bool is_confirmed = !estimate || !estimate->finer_meshes ||
                            estimate->finer_meshes->n_same == result.sub_impacts.size();
  if (estimate && (!result.all_certain() || !is_confirmed)) {
    const bool is_stopped_by_work = result.tolerance && result.tolerance->obstacle &&
                                    result.tolerance->obstacle->kind == Reason::Kind::work_limit;
    if (result.choice.empty()) {
      all.push_back(chosen_mesh(input, given, result));
      if (all.back().options.empty()) all.pop_back();
    } else if (!result.tolerance && result.certainty_grew.value_or(!result.rests_since)) {
      all.push_back(smaller_errors(input, result));
    } else if (is_stopped_by_work && result.certainty_grew.value_or(true)) {
      all.push_back({{{"--within", fmt::format("{:g}us", 1e6 * result.tolerance->asked)},
                      {"--set", fmt::format("accuracy.work_limit={:.3g}",
                                            times_more_accurate * input.accuracy.work_limit)}},
                     times_more_accurate * result.work.all_seconds,
                     "continues on finer meshes",
                     "finer"});
    }
  }
  const bool may_have_more = estimate && estimate->doubt_after(result.sub_impacts.size() - 1);
  if (!result.contact_over && !result.rests_since && !(may_have_more && result.no_more_contact)) {
    all.push_back({{{"--set", fmt::format("time.end={:.4g}", times_longer * input.end_time)}},
                   times_longer * result.work.all_seconds,
                   "may show whether contact is over",
                   "longer"});
  }
  return all;
}

}  // namespace subimpact
