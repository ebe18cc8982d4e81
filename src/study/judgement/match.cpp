#include "subimpact/study/judgement/event_errors.h"

#include "study/judgement/totals.h"

namespace subimpact {
namespace {

double end_of(const SubImpact& s) { return s.end.value_or(HUGE_VAL); }

double overlap(const SubImpact& a, const SubImpact& b) {
  return std::min(end_of(a), end_of(b)) - std::max(a.start, b.start);
}

bool close(const SubImpact& a, const SubImpact& b) {
  if (!a.end || !b.end)
    return std::abs(a.start - b.start) < 0.5 * std::max(end_of(a) - a.start, 0.0);
  const double longer = std::max(*a.end - a.start, *b.end - b.start);
  return std::min(std::abs(a.start - b.start), std::abs(*a.end - *b.end)) < 0.5 * longer;
}

const SubImpact* best_partner(const SubImpact& here, const std::vector<SubImpact>& others) {
  return most_overlapping(here.start, end_of(here), others, end_of);
}

bool is_match(const MatchedPair& pair) { return pair.first && pair.second; }

std::optional<std::size_t> nearest(const Result& run, const NearMiss& here, const Result& other) {
  std::optional<std::size_t> best;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < other.near_misses.size(); ++i) {
    const NearMiss& there = other.near_misses[i];
    const bool correspond =
        here.kind == there.kind && first_in_doubt(run, here) == first_in_doubt(other, there);
    if (!correspond || !(std::abs(there.time - here.time) < least)) continue;
    least = std::abs(there.time - here.time);
    best = i;
  }
  return best;
}

}  // namespace

std::vector<MatchedPair> match_sub_impacts(const std::vector<SubImpact>& first,
                                           const std::vector<SubImpact>& second) {
  std::vector<MatchedPair> pairs;
  std::size_t next = 0;  // of second
  for (std::size_t i = 0; i < first.size(); ++i) {
    const SubImpact* partner = best_partner(first[i], second);
    const bool mutual = partner && partner >= second.data() + next && close(first[i], *partner) &&
                        best_partner(*partner, first) == &first[i];
    if (mutual) {
      for (; &second[next] != partner; ++next) pairs.push_back({std::nullopt, next});
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
  return static_cast<std::size_t>(std::ranges::find_if_not(pairs, is_match) - pairs.begin());
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
    if (is_match(pair)) found.of[*pair.first] = &other[*pair.second];
  }
  const auto none = pairs.end();
  auto last_match = none, next_match = std::ranges::find_if(pairs, is_match);
  for (const MatchedPair& here : pairs) {
    if (is_match(here)) {
      last_match = next_match;
      next_match = std::find_if(next_match + 1, none, is_match);
      continue;
    }
    const SubImpact& alone = here.first ? base[*here.first] : other[*here.second];
    bool is_part = false;  // of a contact that the other run has whole
    for (const auto beside : {last_match, next_match}) {
      if (beside == none) continue;
      const SubImpact& whole = here.first ? other[*beside->second] : base[*beside->first];
      if (!(overlap(alone, whole) > 0.0)) continue;
      found.of[*beside->first] = nullptr;
      is_part = true;
    }
    if (here.first || is_part || next_match == none) continue;
    found.follows_new_one[*next_match->first] = true;
  }
  return found;
}

std::size_t first_in_doubt(const Result& run, const NearMiss& near_miss) {
  const auto after =
      std::ranges::upper_bound(run.sub_impacts, near_miss.time, {}, &SubImpact::start);
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
