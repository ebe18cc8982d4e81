#include "study/counterparts.h"

#include <cstddef>
#include <iterator>
#include <limits>

#include "subimpact/study/match.h"

namespace subimpact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool overlap(const SubImpact& a, const SubImpact& b) {
  return a.start < b.end.value_or(infinity) && b.start < a.end.value_or(infinity);
}

// The nearest entry of a list of pairs, from `from` in steps of `step`, that both runs have.
const MatchedPair* nearest_match(const std::vector<MatchedPair>& pairs, std::size_t from,
                                 std::ptrdiff_t step) {
  for (auto i = static_cast<std::ptrdiff_t>(from); i >= 0 && i < std::ssize(pairs); i += step) {
    const MatchedPair& pair = pairs[static_cast<std::size_t>(i)];
    if (pair.first && pair.second) return &pair;
  }
  return nullptr;
}

}  // namespace

Counterparts counterparts(const std::vector<SubImpact>& base, const std::vector<SubImpact>& other) {
  const std::vector<MatchedPair> pairs = match_sub_impacts(base, other);
  Counterparts found{std::vector<const SubImpact*>(base.size(), nullptr),
                     std::vector<bool>(base.size(), false)};
  for (const MatchedPair& pair : pairs) {
    if (pair.first && pair.second) found.of[*pair.first] = &other[*pair.second];
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const MatchedPair& here = pairs[i];
    if (here.first && here.second) continue;
    const SubImpact& alone = here.first ? base[*here.first] : other[*here.second];
    bool is_part = false;  // of a contact that the other run has whole
    for (const std::ptrdiff_t step : {-1, 1}) {
      const MatchedPair* beside = nearest_match(pairs, i, step);
      if (beside == nullptr) continue;
      if (!overlap(alone, here.first ? other[*beside->second] : base[*beside->first])) continue;
      found.of[*beside->first] = nullptr;
      is_part = true;
    }
    if (here.first || is_part) continue;
    if (const MatchedPair* next = nearest_match(pairs, i, 1)) {
      found.follows_new_one[*next->first] = true;
    }
  }
  return found;
}

}  // namespace subimpact
