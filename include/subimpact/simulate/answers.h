#pragma once

/// What a strike tells: answers, each with both of its errors, and a verdict. study/answers.h makes
/// them, words_of_answers() (report/text.h) adds their words; screen, files, pages and Python show
/// these records and nothing else.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "subimpact/simulate/assessment.h"

namespace subimpact {

enum class AnswerKey {
  sub_impacts,       ///< their number
  joined,            ///< their number if contacts parted by little are joined
  largest_force,     ///< N
  first_parting,     ///< s: end of the first contact parted by more than 1 um
  contact_end,       ///< s: end of the last contact
  rests_since,       ///< s: start of a contact without end
  striker_velocity,  ///< m/s, at the end
  restitution,
  impulse,           ///< N s, of all sub-impacts
  zones,             ///< their number; Answer::items has each
  indentation,       ///< m, largest
  dent,              ///< m, that stays
  contact_pressure,  ///< Pa, at the largest force
  permanent_set,     ///< m, largest, against the supports
  yield_share,       ///< largest strain of a beam that stays elastic, over that of first yield
  supports,          ///< N, the force of a support that is largest in magnitude
  energy,            ///< J, dissipated
};

/// Why an answer is not there.
enum class WhyNot {
  no_contact,       ///< the bodies never touched
  in_contact,       ///< they touch each other at the end
  approaching,      ///< they approach each other at the end
  met_at_rest,      ///< without relative velocity
  none_uncertain,   ///< few or no sub-impacts are uncertain
  does_not_rest,    ///< loads do not hold the bodies together
  fixed,            ///< the body does not move
  stays_elastic,    ///< nothing has yielded
  yields,           ///< sections have yielded
  no_yield_stress,  ///< nothing can yield
  no_moduli,        ///< the law does not have those of the surfaces
  not_computed,     ///< the run was told not to
  no_supports,      ///< all ends are free
};

/// What a model leaves out, or a case leaves open.
enum class BodyPart {
  shear,              ///< of a beam without it
  shear_coefficient,  ///< of a beam with it
  poisson,            ///< of the beam, where the case has none
  bending,            ///< of a beam modelled as rigid
  contact_law,
  nose,     ///< its moduli, where the case has none
  gravity,  ///< where the case has none
  width,    ///< a hinge held sideways
  finite_rotations,
  stretching,  ///< of a beam held at both ends
  hinge_length,
  thin_openings
};

struct Answer {
  struct Part {
    BodyPart kind;
    std::optional<double> change;  ///< magnitude; none: not known
    /// Words: "contact law", the change in the unit of the answer's text, what to do about it.
    std::string label = {}, text = {}, remedy = {};
  };
  /// One of a list: a zone.
  struct Item {
    int number = 0;                          ///< from 1
    Total sub_impacts, start, end, impulse;  ///< s, N s
    bool has_end = true;                     ///< false: still in contact at the end
    int n_subzones = 1;
    std::optional<double> start_body_error, end_body_error;  ///< s; none: not known
    std::string text;                                        ///< words
  };
  AnswerKey key;
  std::string_view unit = {};             ///< SI: "N"; empty: a number
  std::optional<double> value = {};       ///< none: `why` says why not
  std::optional<double> error = {};       ///< of the computation; none: not known
  std::optional<double> body_error = {};  ///< sum of the parts; none: not known
  std::vector<Part> parts = {};           ///< of the body's error, the largest first
  std::optional<WhyNot> why = {};
  std::optional<bool> certain = {};     ///< of an event: whether it is; none: not judged
  std::optional<double> time = {};      ///< s, when
  std::optional<double> position = {};  ///< m from the beam's first end, where
  std::optional<double> from = {};      ///< the value lies between this one and `value`
  std::vector<Item> items = {};
  // Words; errors are in the unit of the text.
  std::string label = {}, text = {}, error_text = {}, body_text = {}, total_text = {}, note = {};
};

/// First words on a run.
struct StrikeVerdict {
  enum class Certainty { not_known, none, some, all };  ///< of the sub-impacts
  enum class Contact { none, over, may_not_be_over, not_over, rests };
  enum class Beam { rigid, elastic, bent, not_computed };
  Certainty certainty = Certainty::not_known;
  Contact contact = Contact::none;
  Beam beam = Beam::rigid;
  std::string text;
};

}  // namespace subimpact
