#include "io/records/run_record.h"

namespace subimpact {

// The name of an enumerator, of names in their order.
static std::string_view nth(std::initializer_list<const char*> names, auto value) {
  return names.begin()[static_cast<std::size_t>(value)];
}

// clang-format off
static std::string_view to_string(AnswerKey value) {
  return nth({"sub_impacts", "joined", "largest_force", "first_parting", "contact_end", "rests_since", "striker_velocity",
              "restitution", "impulse", "zones", "indentation", "dent", "contact_pressure", "permanent_set", "yield_share",
              "supports", "energy"}, value);
}
static std::string_view to_string(WhyNot value) {
  return nth({"no_contact", "in_contact", "approaching", "met_at_rest", "none_uncertain", "does_not_rest", "fixed",
              "stays_elastic", "yields", "no_yield_stress", "no_moduli", "not_computed", "no_supports",
              "turns_too_far"}, value);
}
constexpr BodyPartWords body_parts[] = {
    {BodyPart::shear, "shear", "shear", "beam.theory = \"timoshenko\" models it"},
    {BodyPart::shear_coefficient, "shear_coefficient", "shear coefficient", "give beam.shear_coefficient where it is known better than to 2 %"},
    {BodyPart::poisson, "poisson", "Poisson's ratio", "give beam.poisson or beam.material"},
    {BodyPart::bending, "bending", "bending", "model a beam that bends"},
    {BodyPart::contact_law, "contact_law", "contact law", "give the measured curve: contact.law = \"curve\""},
    {BodyPart::nose, "nose", "nose", "give contact.striker_modulus and contact.striker_poisson"},
    {BodyPart::gravity, "gravity", "gravity", "scene.gravity = 9.81, or 0 for a level strike"},
    {BodyPart::width, "width", "width of the hinge", "measure the permanent set once"},
    {BodyPart::finite_rotations, "finite_rotations", "finite rotations", "strike more softly, or compare with a 3-D solid"},
    {BodyPart::stretching, "stretching", "stretching of beam", "beam.axial = \"held\" or \"free\", as the supports are"},
    {BodyPart::support, "support", "support stiffness", "measure it, and give beam.springs with one_sided = true for ends that rest"},
    {BodyPart::hinge_length, "hinge_length", "length of the hinge", "no theory of beams knows it"},
    {BodyPart::thin_openings, "thin_openings", "thin openings", "count gaps so thin as closed: --opening 10um"}};
std::span<const BodyPartWords> names_of(BodyPart) { return body_parts; }

static std::string_view to_string(StrikeVerdict::Certainty value) {
  return nth({"not_known", "none", "some", "all"}, value);
}
static std::string_view to_string(StrikeVerdict::Contact value) {
  return nth({"none", "over", "may_not_be_over", "not_over", "rests"}, value);
}
static std::string_view to_string(StrikeVerdict::Beam value) {
  return nth({"rigid", "elastic", "bent", "not_computed", "turned_too_far"}, value);
}

const Record<StrikeVerdict>& verdict_record() {
  static const Record<StrikeVerdict> record = {
      {"certainty", "of the sub-impacts: all, some, none, not_known", &StrikeVerdict::certainty},
      {"contact", "none, over, may_not_be_over, not_over, rests", &StrikeVerdict::contact},
      {"beam", "rigid, elastic, bent; not_computed: it has yielded; turned_too_far: by more than 0.5 rad, the numbers are no results", &StrikeVerdict::beam},
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
      {"text", "in words", &Item::text},
      {"begin_text", "when it begins, and how many sub-impacts it has", &Item::begin_text},
      {"error_text", "error of that time", &Item::error_text},
      {"body_text", "error of the body of that time", &Item::body_text}};
  static const Record<Answer> record = {
      {"key", "largest_force, ...", &Answer::key},
      {"label", "the same in words", &Answer::label},
      {"value", "null: it is not there", &Answer::value},
      {"unit", "of value and errors", [](const Answer& answer) { return std::string(answer.unit); }},
      {"error", "of the computation; null: not known", &Answer::error},
      {"body_error", "how far the body may be from the model's exact solution, the sum of the parts; null: not known", &Answer::body_error},
      {"parts", "of body_error: those that are not known, then the largest", &Answer::parts, part},
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
const Record<BodyErrors>& body_record() {
  static const Record<ZoneFigures> zones = {
      {"start_s", "", &ZoneFigures::start},
      {"end_s", "", &ZoneFigures::end},
      {"impulse_Ns", "", &ZoneFigures::impulse}};

  static const Record<StrikeFigures> figures = {
      {"parting_s", "", &StrikeFigures::parting},
      {"peak_force_N", "", &StrikeFigures::peak_force},
      {"striker_velocity_m_per_s", "", &StrikeFigures::striker_velocity},
      {"permanent_set_m", "", &StrikeFigures::permanent_set},
      {"impulse_Ns", "", &StrikeFigures::impulse},
      {"restitution", "", &StrikeFigures::restitution},
      {"residual_indentation_m", "", &StrikeFigures::dent},
      {"max_indentation_m", "", &StrikeFigures::max_indentation},
      {"contact_end_s", "", &StrikeFigures::contact_end},
      {"rests_since_s", "", &StrikeFigures::rests_since},
      {"zones", "", &StrikeFigures::zones, zones}};
  static const Record<BodyErrors::Part> part = {
      {"key", "what the model leaves out, or the case leaves open", &BodyErrors::Part::kind},
      {"change", "of these numbers, 0 where it has none; null: not known", [](auto& of) -> auto& { return of.change; }, figures}};
  static const Record<BodyErrors> record = {
      {"value", "of the run: parting_s, end of the first contact parted by more than 1 um; contact_end_s, of the last; others as elsewhere", [](auto& errors) -> auto& { return errors.value; }, figures},
      {"at_least", "the sum of the parts that are known", [](auto& errors) -> auto& { return errors.at_least; }, figures},
      {"error", "how far the real beam may be from them: the sum of the parts; null: one is not known", [](auto& errors) -> auto& { return errors.error; }, figures},
      {"parts", "", &BodyErrors::parts, part}};
  return record;
}
// clang-format on

}  // namespace subimpact
