#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace subimpact {

/// Why something about a run is not certain, or was not reached: a kind and the numbers of its
/// sentence, in SI units; those that a kind does not have are 0.
struct Reason {
  // clang-format off
  enum class Kind {
    in_words,  ///< `what` is the sentence
    // A sub-impact, or the flight after one, in the run beside that `what` describes.
    missing_beside, split_beside, one_beside, another_beside, stopped_beside,
    // Lengths (m or s) below their errors; joined: openings too near to `limit`.
    indentation, opening_before, opening_after, joined_before, joined_after, joined_within,
    duration, separation_before, separation_after, nearly_opens, nearly_closes,
    // What mesh or steps do not show.
    heavy_part, near_end, unended_contact, short_contact, short_separation, yielding_elements,
    loose_tolerance,
    // Why event times are not within a tolerance, and why no finer mesh is run.
    error_of_times, no_run_beside, fixed_key, work_limit, default_work_limit, finest_mesh, memory,
    failed_run, stopped_search
  };
  // clang-format on
  Kind kind = Kind::in_words;
  std::string what = {};  ///< a run beside, a key or a message from elsewhere
  double value = 0.0, error = 0.0, limit = 0.0;
  double time = 0.0;                           ///< s
  std::optional<std::size_t> sub_impact = {};  ///< from 0: named by the sentence
  bool operator==(const Reason&) const = default;
};

/// The sentence, without a full stop; empty without a reason.
std::string words_of(const Reason& reason);
std::string words_of(const std::optional<Reason>& reason);

}  // namespace subimpact
