#include "io/records/answer_record.h"

namespace subimpact {

// clang-format off
static std::span<const Named<AnswerKey>> names_of(AnswerKey) {
  using enum AnswerKey;
  static constexpr Named<AnswerKey> names[] = {
      {sub_impacts, "sub_impacts", ""}, {joined, "joined", ""}, {largest_force, "largest_force", ""},
      {first_parting, "first_parting", ""}, {contact_end, "contact_end", ""}, {rests_since, "rests_since", ""},
      {striker_velocity, "striker_velocity", ""}, {restitution, "restitution", ""}, {impulse, "impulse", ""},
      {zones, "zones", ""}, {indentation, "indentation", ""}, {dent, "dent", ""},
      {contact_pressure, "contact_pressure", ""}, {permanent_set, "permanent_set", ""}, {yield_share, "yield_share", ""},
      {supports, "supports", ""}, {energy, "energy", ""}};
  return names;
}

static std::span<const Named<WhyNot>> names_of(WhyNot) {
  using enum WhyNot;
  static constexpr Named<WhyNot> names[] = {
      {no_contact, "no_contact", ""}, {in_contact, "in_contact", ""}, {approaching, "approaching", ""},
      {met_at_rest, "met_at_rest", ""}, {none_uncertain, "none_uncertain", ""}, {does_not_rest, "does_not_rest", ""},
      {fixed, "fixed", ""}, {stays_elastic, "stays_elastic", ""}, {yields, "yields", ""},
      {no_yield_stress, "no_yield_stress", ""}, {no_moduli, "no_moduli", ""}, {not_computed, "not_computed", ""},
      {no_supports, "no_supports", ""}};
  return names;
}

static std::span<const Named<BodyPart>> names_of(BodyPart) {
  using enum BodyPart;
  static constexpr Named<BodyPart> names[] = {
      {shear, "shear", ""}, {shear_coefficient, "shear_coefficient", ""}, {poisson, "poisson", ""}, {bending, "bending", ""},
      {contact_law, "contact_law", ""}, {nose, "nose", ""}, {gravity, "gravity", ""}, {width, "width", ""},
      {finite_rotations, "finite_rotations", ""}, {stretching, "stretching", ""}, {hinge_length, "hinge_length", ""},
      {thin_openings, "thin_openings", ""}};
  return names;
}

static std::span<const Named<StrikeVerdict::Certainty>> names_of(StrikeVerdict::Certainty) {
  using enum StrikeVerdict::Certainty;
  static constexpr Named<StrikeVerdict::Certainty> names[] = {
      {not_known, "not_known", ""}, {none, "none", ""}, {some, "some", ""}, {all, "all", ""}};
  return names;
}

static std::span<const Named<StrikeVerdict::Contact>> names_of(StrikeVerdict::Contact) {
  using enum StrikeVerdict::Contact;
  static constexpr Named<StrikeVerdict::Contact> names[] = {
      {none, "none", ""}, {over, "over", ""}, {may_not_be_over, "may_not_be_over", ""}, {not_over, "not_over", ""}, {rests, "rests", ""}};
  return names;
}

static std::span<const Named<StrikeVerdict::Beam>> names_of(StrikeVerdict::Beam) {
  using enum StrikeVerdict::Beam;
  static constexpr Named<StrikeVerdict::Beam> names[] = {
      {rigid, "rigid", ""}, {elastic, "elastic", ""}, {bent, "bent", ""}, {not_computed, "not_computed", ""}};
  return names;
}

const Record<StrikeVerdict>& verdict_record() {
  static const Record<StrikeVerdict> record = {
      {"certainty", "of the sub-impacts: all, some, none, not_known", &StrikeVerdict::certainty},
      {"contact", "none, over, may_not_be_over, not_over, rests", &StrikeVerdict::contact},
      {"beam", "rigid, elastic, bent; not_computed: it has yielded", &StrikeVerdict::beam},
      {"text", "one sentence", &StrikeVerdict::text}};
  return record;
}

const Record<Answer>& answer_record() {
  using Part = Answer::Part;
  using Item = Answer::Item;
  static const Record<Total> total = {{"value", "", &Total::value}, {"error", "", &Total::error}};
  static const Record<Part> part = {
      {"key", "what the model leaves out", &Part::kind},
      {"label", "the same in words", &Part::label},
      {"change", "that it makes; null: not known", &Part::change},
      {"text", "the same in the unit of the answer's text", &Part::text},
      {"remedy", "what can be done about it", &Part::remedy, Form::empty_is_null}};
  static const Record<Item> item = {
      {"number", "of the zone, from 1", &Item::number},
      {"sub_impacts", "", &Item::sub_impacts, total},
      {"start_s", "", &Item::start, total},
      {"end_s", "", &Item::end, total},
      {"impulse_Ns", "", &Item::impulse, total},
      {"start_body_error_s", "null: not known", &Item::start_body_error},
      {"end_body_error_s", "null: not known", &Item::end_body_error},
      {"text", "in words", &Item::text}};
  static const Record<Answer> record = {
      {"key", "largest_force, ...", &Answer::key},
      {"label", "the same in words", &Answer::label},
      {"value", "null: it is not there", &Answer::value},
      {"unit", "of value and errors", [](const Answer& answer) { return std::string(answer.unit); }},
      {"error", "of the computation; null: not known", &Answer::error},
      {"body_error", "how far the body may be from the model's exact solution, the sum of the parts; null: not known", &Answer::body_error},
      {"parts", "of body_error, the largest first", &Answer::parts, part},
      {"known", "whether it is there", [](const Answer& answer) { return answer.value.has_value(); }},
      {"why", "why it is not", &Answer::why},
      {"certain", "whether that event is certain; null: no event, or not judged", &Answer::certain},
      {"time_s", "when", &Answer::time},
      {"position_m", "where along the beam", &Answer::position},
      {"from", "of an event that is not certain: it lies between this and value", &Answer::from},
      {"text", "value with unit and place, as the screen has it", &Answer::text},
      {"error_text", "error, in the unit of text", &Answer::error_text},
      {"body_text", "body_error, in the unit of text", &Answer::body_text},
      {"total_text", "both errors together, in the unit of text", &Answer::total_text, Form::empty_is_null},
      {"note", "what else is to be said", &Answer::note, Form::empty_is_null},
      {"items", "of zones: each zone", &Answer::items, item}};
  return record;
}
// clang-format on

}  // namespace subimpact
