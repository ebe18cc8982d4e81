#include "study/judgement/joined_contacts.h"

#include <algorithm>

namespace subimpact {
namespace {

constexpr double opening = 1e-6;  // m

// What judge() needs of a run, its contacts joined.
Result joined_contacts_of(const Case& input, const Result& run) {
  Result joined;
  joined.outcome = run.outcome;
  joined.sub_impacts = run.sub_impacts;
  joined.near_misses = run.near_misses;
  joined.closest_approach = run.closest_approach;
  joined.used = run.used;
  join_sub_impacts(joined.sub_impacts, opening);
  const OutputOptions& output = input.output;
  assign_zones(joined.sub_impacts, output.zone_gap * run.used.first_period,
               output.subzone_gap * run.used.first_period);
  for (SubImpact& s : joined.sub_impacts) static_cast<SubImpactAssessment&>(s) = {};
  return joined;
}

}  // namespace

std::optional<ErrorEstimate::Joined> judge_joined(const Case& input, const Result& run,
                                                  std::span<const RunBeside> beside) {
  const bool all_certain =
      std::ranges::count(run.sub_impacts, std::optional(false), &SubImpact::certain) == 0;
  if (input.output.opening > 0.0 || all_certain) return std::nullopt;
  Case joined = input;
  joined.output.opening = opening;
  Result here = joined_contacts_of(input, run);
  std::vector<RunBeside> others;
  for (const RunBeside& other : beside) {
    others.push_back({other.of, joined_contacts_of(other.of.input, other.result)});
  }
  judge(joined, here, others);
  return ErrorEstimate::Joined{opening, here.sub_impacts.size(), *here.n_certain()};
}

}  // namespace subimpact
