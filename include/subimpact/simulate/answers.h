#pragma once

/// What a strike tells: answers, each with both of its errors, and a verdict. study/answers.h makes
/// the records, make_answers() (report/text.h) adds their words; screen, files, pages and Python
/// show these and nothing else.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "subimpact/simulate/assessment.h"

namespace subimpact {

// clang-format off
/// Numbers: sub_impacts, joined (if contacts parted by little count as one), zones (Answer::items
/// has each). N: largest_force, supports (the one of largest magnitude). s: first_parting (end of
/// the first contact parted by more than 1 um), contact_end (of the last), rests_since (start of a
/// contact without end). m/s: striker_velocity, at the end. m: indentation (largest), dent,
/// permanent_set (largest, against the supports). Pa: contact_pressure, at the largest force. J:
/// energy, dissipated. Ratios: restitution, yield_share (largest strain of a beam that stays
/// elastic, over that of first yield).
enum class AnswerKey {
  sub_impacts, joined, largest_force, first_parting, contact_end, rests_since, striker_velocity,
  restitution, impulse, zones, indentation, dent, contact_pressure, permanent_set, yield_share,
  supports, energy
};

/// Why an answer is not there.
enum class WhyNot {
  no_contact, in_contact, approaching, met_at_rest,  // of the bodies, at the end
  none_uncertain,                                    // there is nothing to join
  does_not_rest, fixed, stays_elastic, yields, no_yield_stress, no_moduli, not_computed, no_supports,
  turns_too_far                                      // Result::turns_too_far()
};

// clang-format on

struct Answer {
  struct Part {
    BodyPart kind;
    std::optional<double> change;  ///< magnitude; none: not known
    /// Words: "contact law", the change in the unit of the answer's text, what to do about it.
    std::string label = {}, text = {}, remedy = {};
  };
  /// One of a list: a zone, from 1. Its end is that of the run where it has none.
  struct Item {
    int number = 0, n_subzones = 1;
    bool has_end = true;
    Total sub_impacts, start, end, impulse;                            ///< s, N s
    std::optional<double> start_body_error = {}, end_body_error = {};  ///< s; none: not known
    /// Words: all of it; "from 5.1 ms: 2 sub-impacts", and the errors of that time.
    std::string text = {}, begin_text = {}, error_text = {}, body_text = {};
  };
  AnswerKey key;
  std::string_view unit = {};             ///< SI: "N"; empty: a number
  std::optional<double> value = {};       ///< none: `why` says why not
  std::optional<double> error = {};       ///< of the computation; none: not known
  std::optional<double> body_error = {};  ///< sum of the parts; none: not known
  std::vector<Part> parts = {};  ///< of the body's error: those not known, then the largest
  std::optional<WhyNot> why = {};
  std::optional<bool> certain = {};     ///< of an event: whether it is; none: not judged
  std::optional<double> time = {};      ///< s, when
  std::optional<double> position = {};  ///< m from the beam's first end, where
  std::optional<double> from = {};      ///< of an uncertain event: it lies between this and `value`
  std::vector<Item> items = {};
  /// Words; errors are in the unit of the text.
  std::string label = {}, text = {}, error_text = {}, body_text = {}, total_text = {}, note = {};
};

/// First words on a run.
struct StrikeVerdict {
  enum class Certainty { not_known, none, some, all };  ///< of the sub-impacts
  enum class Contact { none, over, may_not_be_over, not_over, rests };
  enum class Beam { rigid, elastic, bent, not_computed, turned_too_far };
  Certainty certainty = Certainty::not_known;
  Contact contact = Contact::none;
  Beam beam = Beam::rigid;
  std::string text;
};

}  // namespace subimpact
