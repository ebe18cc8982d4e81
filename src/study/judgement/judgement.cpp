#include "subimpact/study/judgement/judgement.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "numerics/units.h"
#include "study/judgement/judge.h"
#include "study/judgement/mesh_resolution.h"
#include "study/judgement/totals.h"

namespace subimpact {
namespace {

constexpr double loosest_rtol = 1e-2;
constexpr double alike = 0.025;          // velocities at the end, over that of the strike
constexpr double joined_opening = 1e-6;  // m

using UncertainFlight = ErrorEstimate::UncertainFlight;

std::string descriptions_of(std::span<const RunBeside> beside) {
  std::vector<std::string> all;
  for (const RunBeside& run : beside) all.push_back(run.of.description);
  return fmt::format("{}", fmt::join(all, ", "));
}

// Whether it is proven for this run and for those beside it that no contact follows the last one,
// and they end alike.
bool is_over(const Case& input, const Result& run, std::span<const RunBeside> beside,
             const ErrorEstimate& estimate) {
  const double tolerated = alike * input.scene.bodies().velocity_scale();
  return run.no_more_contact && !estimate.doubt_after(run.sub_impacts.size() - 1) &&
         !(run.sub_impacts.empty() && estimate.first_unresolved) &&
         std::ranges::all_of(beside, [&](const RunBeside& other) {
           const double difference = other.result.striker_velocity - run.striker_velocity;
           return !other.of.of_existence ||
                  (other.result.no_more_contact && std::abs(difference) < tolerated);
         });
}

// Why the mesh does not show sub-impacts, whatever runs agree on: of the first that it does not.
std::optional<Reason> first_mesh_doubt(const Case& input, const Result& run) {
  std::optional<Reason> doubt = mesh_doubt(input, run.used);
  for (std::size_t i = 0; i < run.sub_impacts.size() && !doubt; ++i) {
    doubt = unresolved_contact(input, run, i);
    if (doubt) doubt->sub_impact = i;
  }
  return doubt;
}

// What is judged of a run.
Result judged_part_of(const Result& run) {
  Result part;
  part.outcome = run.outcome;
  part.sub_impacts = run.sub_impacts;
  part.near_misses = run.near_misses;
  part.closest_approach = run.closest_approach;
  part.used = run.used;
  return part;
}

// The same with its contacts joined, not yet judged.
Result joined_part_of(const OutputOptions& output, const Result& run) {
  Result joined = judged_part_of(run);
  join_sub_impacts(joined.sub_impacts, joined_opening);
  assign_zones(joined.sub_impacts, output.zone_gap * run.used.first_period,
               output.subzone_gap * run.used.first_period);
  for (SubImpact& s : joined.sub_impacts) static_cast<SubImpactAssessment&>(s) = {};
  return joined;
}

// How many sub-impacts of a judged run would be certain if those parted by little were joined; none
// if all are certain or contacts are joined already.
std::optional<ErrorEstimate::Joined> judge_joined(Case input, const Result& run,
                                                  std::span<const RunBeside> beside) {
  const bool all_certain =
      std::ranges::count(run.sub_impacts, std::optional(false), &SubImpact::certain) == 0;
  if (std::exchange(input.output.opening, joined_opening) > 0.0 || all_certain) return std::nullopt;
  Result here = joined_part_of(input.output, run);
  std::vector<RunBeside> others;
  for (const RunBeside& other : beside) {
    others.push_back({other.of, joined_part_of(other.of.input.output, other.result)});
  }
  judge(input, here, others);
  return ErrorEstimate::Joined{joined_opening, here.sub_impacts.size(), *here.n_certain()};
}

// What another mesh shows about a run whose rows do not include the error of the mesh.
ErrorEstimate::FinerMeshes finer_meshes(const Case& input, const Result& run,
                                        const RunBeside& other) {
  Result here = judged_part_of(run);
  ErrorEstimate none;
  judge_rows(input, here, {&other, 1}, none);
  const auto n_same =
      std::ranges::count(here.sub_impacts, std::optional(true), &SubImpact::certain);
  const std::vector<SubImpact>& there = other.result.sub_impacts;
  const Outcome& until = other.result.outcome;
  ErrorEstimate::FinerMeshes found{
      until.completed() ? other.of.description
                        : fmt::format("{}, up to {} where their run stopped,", other.of.description,
                                      instant_text(until.time)),
      there.size(), static_cast<std::size_t>(n_same), std::nullopt, first_mesh_doubt(input, run)};
  if (!here.sub_impacts.empty() && !there.empty() && here.sub_impacts[0].end && there[0].end) {
    const double change = *there[0].end - *here.sub_impacts[0].end;
    const bool is_finer = mesh_count(other.of.input) > mesh_count(input);
    found.change_of_first_end = is_finer ? change : -other.of.gain * change;
  }
  return found;
}

// Why the steps do not show sub-impacts: runs so loose share what they miss.
std::optional<Reason> tolerance_doubt(const SolverOptions& solver) {
  const bool has_tolerance = !solver.step && solver.method != Method::central_difference;
  if (!has_tolerance || solver.rtol <= loosest_rtol) return {};
  return Reason{Reason::Kind::loose_tolerance, {}, solver.rtol};
}

// Sub-impacts that mesh or steps do not show, whatever runs agree on. `about_mesh`: runs beside
// have other meshes.
void doubt_unresolved(const Case& input, bool about_mesh, Result& run) {
  const std::optional<Reason> of_steps = tolerance_doubt(input.solver);
  const std::optional<Reason> of_mesh =
      about_mesh ? mesh_doubt(input, run.used) : std::optional<Reason>();
  for (std::size_t i = 0; i < run.sub_impacts.size(); ++i) {
    SubImpact& s = run.sub_impacts[i];
    std::optional<Reason> doubt = of_steps ? of_steps : of_mesh;
    if (!doubt && about_mesh) doubt = unresolved_contact(input, run, i);
    if (!doubt) continue;
    s.certain = false;
    s.doubt = doubt;
    s.probability = std::min(*s.probability, 0.5);
  }
}

void find_first_unresolved(const Result& run, std::span<const RunBeside> beside,
                           ErrorEstimate& estimate) {
  for (const auto& [of, other] : beside) {
    if (!run.sub_impacts.empty() || other.sub_impacts.empty() || !of.of_existence) continue;
    estimate.first_unresolved = 0;
    estimate.reason = Reason{Reason::Kind::one_beside, of.description};
  }
  for (std::size_t i = 0; i < run.sub_impacts.size() && !estimate.first_unresolved; ++i) {
    if (!*run.sub_impacts[i].certain) {
      estimate.first_unresolved = i;
      estimate.reason = run.sub_impacts[i].doubt;
      return;
    }
    const UncertainFlight* flight = estimate.doubt_after(i);
    if (!flight) continue;
    estimate.first_unresolved = i + 1;
    estimate.reason = flight->reason;
  }
}

}  // namespace

void judge(const Case& input, Result& run, std::span<const RunBeside> beside) {
  if (beside.empty()) return;
  ErrorEstimate estimate;
  estimate.refined_run = descriptions_of(beside);
  const auto others =
      std::ranges::find(beside, false, [](auto& other) { return other.of.of_rows; });
  judge_rows(input, run, {beside.begin(), others}, estimate, set_support_errors(run, beside));
  if (others != beside.end()) estimate.finer_meshes = finer_meshes(input, run, *others);
  doubt_unresolved(input, of_mesh(beside), run);
  find_first_unresolved(run, beside, estimate);
  run.contact_over = is_over(input, run, beside, estimate);
  for (const SubImpact& s : run.sub_impacts) {
    if (!*s.certain) continue;
    estimate.largest_error =
        std::max({estimate.largest_error, s.start_error.value_or(0.0), s.end_error.value_or(0.0)});
  }
  set_totals(input, run, beside, estimate);
  estimate.joined = judge_joined(input, run, beside);
  run.error_estimate = std::move(estimate);
}

}  // namespace subimpact
