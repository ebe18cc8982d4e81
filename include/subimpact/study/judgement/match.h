#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "subimpact/simulate/result.h"

namespace subimpact {

/// A sub-impact of one run and the one of another run that corresponds to it; one may be missing.
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

/// A time compared with which errors of a sub-impact must be small.
struct LengthBeside {
  Reason::Kind kind;  ///< duration, separation_before or separation_after
  double length;      ///< s
};

/// The duration of a sub-impact (if it has ended) and the separations before and after it.
std::vector<LengthBeside> lengths_beside(const std::vector<SubImpact>& all, std::size_t number);

/// The sub-impacts of another run that correspond to those of a base run, one to one.
struct Counterparts {
  /// By number in the base run; null where contacts have merged, split or vanished. They point into
  /// the list of the other run.
  std::vector<const SubImpact*> of;
  /// By number in the base run: whether the other run has a new contact before it.
  std::vector<bool> follows_new_one;
};

Counterparts counterparts(const std::vector<SubImpact>& base, const std::vector<SubImpact>& other);

/// The sub-impact (from 0) from which on a run is uncertain if its near miss may have been an
/// event: the one that nearly opens, or the one after the separation that nearly closes.
std::size_t first_in_doubt(const Result& run, const NearMiss& near_miss);

/// For each near miss of a run the index of the corresponding near miss of another run, or none: of
/// the same kind, in the same contact or separation, each the nearest in time to the other. Only
/// contacts and separations up to the separation after the first `n_matched` sub-impacts are
/// searched. The list ends with the last near miss among these.
std::vector<std::optional<std::size_t>> match_near_misses(const Result& run, const Result& other,
                                                          std::size_t n_matched);

}  // namespace subimpact
