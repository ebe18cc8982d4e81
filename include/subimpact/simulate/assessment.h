#pragma once

/// What other runs of the same case, or of cases near it, show of a run, and what a strike tells.
/// Studies fill the assessment (study/judgement/judgement.h, study/run_as_asked.h); it is empty
/// without them. Answers, each with both of its errors, and a verdict are made by study/answers.h;
/// make_answers() (report/text.h) adds their words; screen, files, pages and Python show these and
/// nothing else.

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// Whether a sub-impact is certain, and the errors of its numbers.
struct SubImpactAssessment {
  std::optional<bool> certain;        ///< exists, alone, in this place
  std::optional<double> probability;  ///< that it exists so; 1 where certain
  std::optional<Reason> doubt;        ///< why it is not certain
  std::optional<double> start_error;  ///< s, error estimate of start
  std::optional<double> end_error;    ///< s, error estimate of end
  /// s, errors of the body of start and end (BodyErrors): the sum of its parts; none: not known.
  std::optional<double> start_body_error, end_body_error;
  std::optional<double> peak_force_error;            ///< N
  std::optional<double> impulse_error;               ///< N s
  std::optional<double> max_indentation_error;       ///< m
  std::optional<double> residual_indentation_error;  ///< m
  std::optional<double> striker_velocity_error;      ///< m/s
  std::optional<double> opening_error;               ///< m
};

/// A number of the run as a whole, and its estimated error; none: not known.
struct Total {
  double value = 0.0;
  std::optional<double> error;
};

// clang-format off
/// A number of the run as a whole.
enum class RunTotal {
  sub_impacts, zones, striker_velocity, beam_mean_velocity, restitution, impulse, peak_force,
  max_indentation, residual_indentation, max_displacement, max_moment, max_strain, reaction_along,
  reaction_against, permanent_set, hinge_rotation, striker_energy_share, dissipated
};
// clang-format on
/// Its name in summary.json, with its unit.
std::string_view to_string(RunTotal name);

struct NamedTotal {
  RunTotal name;
  Total total;
};

struct ZoneTotals {
  Total start, end;   ///< s
  Total impulse;      ///< N s
  Total sub_impacts;  ///< their number
};

/// A source of errors.
enum class ErrorSource { mesh, mesh_and_time, time };

/// The judgement of a run by the runs beside it: which sub-impacts are certain, and errors.
struct ErrorEstimate {
  std::string refined_run;  ///< the runs compared with, in words
  /// The first sub-impact (from 0) that is not certain, or that follows a flight which may hold
  /// another one; none if all are certain and no others are possible.
  std::optional<std::size_t> first_unresolved;
  std::optional<Reason> reason;  ///< why it is not certain
  double largest_error = 0.0;    ///< s, of the times of the certain sub-impacts

  /// A flight between two sub-impacts, or after the last, that may hold another sub-impact.
  struct UncertainFlight {
    std::size_t after = 0;  ///< sub-impact, from 0
    Reason reason;
  };
  std::vector<UncertainFlight> uncertain_flights;  ///< in order
  /// The flight after a sub-impact (from 0), if it may hold another one; else null.
  const UncertainFlight* doubt_after(std::size_t i) const {
    const auto at = std::ranges::lower_bound(uncertain_flights, i, {}, &UncertainFlight::after);
    return at != uncertain_flights.end() && at->after == i ? &*at : nullptr;
  }
  /// On a mesh that the case fixes, errors of sub-impacts are those of the integration in time;
  /// this member states what finer meshes would change.
  struct FinerMeshes {
    std::string mesh;                           ///< the finer mesh, in words
    std::size_t n_there = 0;                    ///< sub-impacts on that mesh
    std::size_t n_same = 0;                     ///< sub-impacts that it confirms
    std::optional<double> change_of_first_end;  ///< s, of the end of the first sub-impact
    std::optional<Reason> doubt;                ///< why the mesh is too coarse
  };
  std::optional<FinerMeshes> finer_meshes;
  /// Where many sub-impacts are not certain: what is left of them if contacts parted by less than
  /// an opening are joined.
  struct Joined {
    double opening = 0.0;  ///< m
    std::size_t n = 0, n_certain = 0;
  };
  std::optional<Joined> joined;
  std::vector<NamedTotal> totals;
  std::vector<ZoneTotals> zones;
};

/// Numbers of a zone; none: not there, or not known.
struct ZoneFigures {
  std::optional<double> start, end;    ///< s
  std::optional<double> impulse = {};  ///< N s
};

/// Numbers of a strike that an engineer asks for; none: not there, or not known.
struct StrikeFigures {
  std::optional<double> parting = {};     ///< s: end of the first contact parted by more than 1 um
  std::optional<double> peak_force = {};  ///< N
  std::optional<double> striker_velocity = {};  ///< m/s, at the end
  std::optional<double> permanent_set = {};     ///< m, largest against the supports
  std::optional<double> impulse = {};           ///< N s, of all sub-impacts
  std::optional<double> restitution = {};
  std::optional<double> dent = {};             ///< m, residual indentation
  std::optional<double> max_indentation = {};  ///< m
  std::optional<double> contact_end = {};      ///< s, end of the last sub-impact
  std::optional<double> rests_since = {};      ///< s, as Result::rests_since
  std::vector<ZoneFigures> zones = {};
};
inline constexpr std::optional<double> StrikeFigures::*strike_figures[] = {
    &StrikeFigures::parting,
    &StrikeFigures::peak_force,
    &StrikeFigures::striker_velocity,
    &StrikeFigures::permanent_set,
    &StrikeFigures::impulse,
    &StrikeFigures::restitution,
    &StrikeFigures::dent,
    &StrikeFigures::max_indentation,
    &StrikeFigures::contact_end,
    &StrikeFigures::rests_since};
inline constexpr std::optional<double> ZoneFigures::*zone_figures[] = {
    &ZoneFigures::start, &ZoneFigures::end, &ZoneFigures::impulse};

/// What a model leaves out, or a case leaves open (study/model.h).
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
  support,     ///< stiffness of that on which an end rests
  hinge_length,
  thin_openings
};

/// Errors of the body: how far the real beam may be from the exact solution of the model.
struct BodyErrors {
  struct Part {
    BodyPart kind = BodyPart::shear;
    StrikeFigures change = {};  ///< magnitudes, 0 where it has none; none: not known
  };
  StrikeFigures value;      ///< of the run
  StrikeFigures at_least;   ///< the sum of the parts that are known
  StrikeFigures error;      ///< the sum of all parts; none where one is not known
  std::vector<Part> parts;  ///< that apply to the case
};

/// The outcome of a tolerance on the event times (starts and ends of sub-impacts).
struct ToleranceOutcome {
  double asked = 0.0;    ///< s, tolerance on the error of event times
  bool met = false;      ///< whether every event time of the run is certain and within it
  double reached = 0.0;  ///< s, largest error of the event times before the horizon; inf: not known
  double horizon = 0.0;  ///< s, up to which event times are certain and within it
  std::optional<Reason> reason;    ///< why the horizon comes before the end
  std::optional<Reason> obstacle;  ///< why no finer mesh was run, if it was not met
  std::string key;                 ///< of the case, that prevents it and could be freed; or empty
};

/// The assessment of a whole run.
struct Assessment {
  std::optional<ErrorEstimate> error_estimate;  ///< with error bars
  std::optional<BodyErrors> body_errors;        ///< where they were estimated
  std::optional<ToleranceOutcome> tolerance;    ///< of runs with a tolerance on event times
  /// Whether the last of the meshes that the program tried made more sub-impacts certain than the
  /// one before; none: there was one mesh.
  std::optional<bool> certainty_grew;
  /// Why mesh and method were chosen, if the program chose them; otherwise empty.
  std::string choice;

  /// Whether it is certain that there are these sub-impacts and no others.
  bool all_certain() const { return error_estimate && !error_estimate->first_unresolved; }
};

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
    /// Words: the whole item; "from 5.1 ms: 2 sub-impacts"; both errors of its start.
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
