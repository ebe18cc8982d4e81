#include "subimpact/study/match.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace subimpact {
namespace {

double end_of(const SubImpact& s) {
  return s.end.value_or(std::numeric_limits<double>::infinity());
}

double overlap(const SubImpact& a, const SubImpact& b) {
  return std::min(end_of(a), end_of(b)) - std::max(a.start, b.start);
}

bool close(const SubImpact& a, const SubImpact& b) {
  if (!a.end || !b.end)
    return std::abs(a.start - b.start) < 0.5 * std::max(end_of(a) - a.start, 0.0);
  const double longer = std::max(*a.end - a.start, *b.end - b.start);
  return std::min(std::abs(a.start - b.start), std::abs(*a.end - *b.end)) < 0.5 * longer;
}

// The entry of `others` that overlaps `here` most, if any does.
std::optional<std::size_t> best_partner(const SubImpact& here,
                                        const std::vector<SubImpact>& others) {
  std::optional<std::size_t> best;
  double most = 0.0;
  auto first = std::partition_point(others.begin(), others.end(), [&](const SubImpact& other) {
    return end_of(other) <= here.start;
  });
  for (; first != others.end() && first->start < end_of(here); ++first) {
    if (overlap(here, *first) > most) {
      most = overlap(here, *first);
      best = static_cast<std::size_t>(first - others.begin());
    }
  }
  return best;
}

}  // namespace

std::vector<MatchedPair> match_sub_impacts(const std::vector<SubImpact>& first,
                                           const std::vector<SubImpact>& second) {
  std::vector<MatchedPair> pairs;
  std::size_t next = 0;  // of second
  for (std::size_t i = 0; i < first.size(); ++i) {
    const std::optional<std::size_t> partner = best_partner(first[i], second);
    const bool mutual = partner && *partner >= next && close(first[i], second[*partner]) &&
                        best_partner(second[*partner], first) == i;
    if (mutual) {
      for (; next < *partner; ++next) pairs.push_back({std::nullopt, next});
      pairs.push_back({i, next++});
    } else {
      // What ends before it comes before it.
      while (next < second.size() && end_of(second[next]) <= first[i].start) {
        pairs.push_back({std::nullopt, next++});
      }
      pairs.push_back({i, std::nullopt});
    }
  }
  for (; next < second.size(); ++next) pairs.push_back({std::nullopt, next});
  return pairs;
}

std::size_t n_leading_matches(const std::vector<MatchedPair>& pairs) {
  const auto unmatched = std::find_if(pairs.begin(), pairs.end(), [](const MatchedPair& pair) {
    return !pair.first || !pair.second;
  });
  return static_cast<std::size_t>(unmatched - pairs.begin());
}

std::optional<UnmatchedSubImpact> first_unmatched(const std::vector<MatchedPair>& pairs,
                                                  const std::vector<SubImpact>& reference,
                                                  const std::vector<SubImpact>& run) {
  const std::size_t n = n_leading_matches(pairs);
  if (n == pairs.size()) return std::nullopt;
  const MatchedPair& unmatched = pairs[n];
  const SubImpact& sub_impact =
      unmatched.first ? reference[*unmatched.first] : run[*unmatched.second];
  const double duration = sub_impact.end.value_or(sub_impact.start) - sub_impact.start;
  return UnmatchedSubImpact{
      sub_impact.start, duration,
      fmt::format("at {:.3f} us {} a sub-impact of {:.3f} us that {}", 1e6 * sub_impact.start,
                  unmatched.first ? "the reference has" : "it has", 1e6 * duration,
                  unmatched.first ? "is missing or merged here" : "the reference does not have")};
}

}  // namespace subimpact
