#include "study/near_miss_match.h"

#include <algorithm>
#include <cmath>

namespace subimpact {
namespace {

bool correspond(const Result& run, const NearMiss& a, const Result& other, const NearMiss& b) {
  return a.kind == b.kind && first_in_doubt(run, a) == first_in_doubt(other, b);
}

std::optional<std::size_t> nearest(const Result& run, const NearMiss& here, const Result& other) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < other.near_misses.size(); ++i) {
    const NearMiss& there = other.near_misses[i];
    if (!correspond(run, here, other, there)) continue;
    const auto distance = [&](std::size_t k) {
      return std::abs(other.near_misses[k].time - here.time);
    };
    if (!best || distance(i) < distance(*best)) best = i;
  }
  return best;
}

}  // namespace

std::size_t first_in_doubt(const Result& run, const NearMiss& near_miss) {
  const auto after = std::upper_bound(
      run.sub_impacts.begin(), run.sub_impacts.end(), near_miss.time,
      [](double time, const SubImpact& sub_impact) { return time < sub_impact.start; });
  const auto begun = static_cast<std::size_t>(after - run.sub_impacts.begin());
  return near_miss.kind == NearMissKind::opening && begun > 0 ? begun - 1 : begun;
}

std::vector<std::optional<std::size_t>> match_near_misses(const Result& run, const Result& other,
                                                          std::size_t n_matched) {
  std::vector<std::optional<std::size_t>> partners;
  for (std::size_t i = 0; i < run.near_misses.size(); ++i) {
    const NearMiss& here = run.near_misses[i];
    const std::size_t doubted = first_in_doubt(run, here);
    const bool opening = here.kind == NearMissKind::opening;
    if (doubted > n_matched || (opening && doubted == n_matched)) break;
    std::optional<std::size_t> there = nearest(run, here, other);
    if (there && nearest(other, other.near_misses[*there], run) != i) there.reset();
    partners.push_back(there);
  }
  return partners;
}

}  // namespace subimpact
