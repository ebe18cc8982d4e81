#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "subimpact/simulate/records.h"

namespace subimpact {

/// A sub-impact of one run and the one of another run that corresponds to it; one of them may be
/// missing.
struct MatchedPair {
  std::optional<std::size_t> first, second;  ///< indices into the two lists
};

/// Pairs the sub-impacts of two runs of one scene, in order of time. Two correspond if each
/// overlaps the other more than it overlaps any other one, and their starts or ends are closer than
/// half of the longer duration.
std::vector<MatchedPair> match_sub_impacts(const std::vector<SubImpact>& first,
                                           const std::vector<SubImpact>& second);

/// How many leading sub-impacts of the two lists correspond one to one.
std::size_t n_leading_matches(const std::vector<MatchedPair>& pairs);

/// The first sub-impact that only one of two runs has.
struct UnmatchedSubImpact {
  double start = 0.0;       ///< s
  double duration = 0.0;    ///< s
  std::string description;  ///< in words; the first run is called the reference
};

/// Nothing if all correspond.
std::optional<UnmatchedSubImpact> first_unmatched(const std::vector<MatchedPair>& pairs,
                                                  const std::vector<SubImpact>& reference,
                                                  const std::vector<SubImpact>& run);

}  // namespace subimpact
