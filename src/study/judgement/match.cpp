#include "subimpact/study/judgement/event_errors.h"

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
      // Sub-impacts that end before this one come before it.
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

std::vector<LengthBeside> lengths_beside(const std::vector<SubImpact>& all, std::size_t number) {
  using Kind = Reason::Kind;
  const SubImpact& here = all[number];
  std::vector<LengthBeside> list;
  if (here.end) list.push_back({Kind::duration, *here.end - here.start});
  if (number > 0 && all[number - 1].end) {
    list.push_back({Kind::separation_before, here.start - *all[number - 1].end});
  }
  if (number + 1 < all.size() && here.end) {
    list.push_back({Kind::separation_after, all[number + 1].start - *here.end});
  }
  return list;
}

Counterparts counterparts(const std::vector<SubImpact>& base, const std::vector<SubImpact>& other) {
  const std::vector<MatchedPair> pairs = match_sub_impacts(base, other);
  Counterparts found{std::vector<const SubImpact*>(base.size(), nullptr),
                     std::vector<bool>(base.size(), false)};
  for (const MatchedPair& pair : pairs) {
    if (pair.first && pair.second) found.of[*pair.first] = &other[*pair.second];
  }
  // The next pair that both runs have, from each on.
  std::vector<const MatchedPair*> next_match(pairs.size() + 1, nullptr);
  for (std::size_t i = pairs.size(); i-- > 0;) {
    next_match[i] = pairs[i].first && pairs[i].second ? &pairs[i] : next_match[i + 1];
  }
  const MatchedPair* last_match = nullptr;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const MatchedPair& here = pairs[i];
    if (here.first && here.second) {
      last_match = &here;
      continue;
    }
    const SubImpact& alone = here.first ? base[*here.first] : other[*here.second];
    bool is_part = false;  // of a contact that the other run has whole
    for (const MatchedPair* beside : {last_match, next_match[i]}) {
      if (beside == nullptr) continue;
      const SubImpact& whole = here.first ? other[*beside->second] : base[*beside->first];
      if (!(overlap(alone, whole) > 0.0)) continue;
      found.of[*beside->first] = nullptr;
      is_part = true;
    }
    if (here.first || is_part) continue;
    if (const MatchedPair* next = next_match[i]) {
      found.follows_new_one[*next->first] = true;
    }
  }
  return found;
}

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
