#include "subimpact/study/answers.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "case/problem.h"
#include "model/contact/contact_laws.h"
#include "study/judgement/totals.h"
#include "study/model/coarse_strike.h"

namespace subimpact {
namespace {

using enum WhyNot;

// Where errors of the body come from.
constexpr std::pair<AnswerKey, std::optional<double> StrikeFigures::*> figures[] = {
    {AnswerKey::largest_force, &StrikeFigures::peak_force},
    {AnswerKey::first_parting, &StrikeFigures::parting},
    {AnswerKey::contact_end, &StrikeFigures::contact_end},
    {AnswerKey::rests_since, &StrikeFigures::rests_since},
    {AnswerKey::striker_velocity, &StrikeFigures::striker_velocity},
    {AnswerKey::restitution, &StrikeFigures::restitution},
    {AnswerKey::impulse, &StrikeFigures::impulse},
    {AnswerKey::indentation, &StrikeFigures::max_indentation},
    {AnswerKey::dent, &StrikeFigures::dent},
    {AnswerKey::permanent_set, &StrikeFigures::permanent_set}};

// The error of the body of an answer, and its parts, from Result::body_errors.
void add_body_error(const BodyErrors& errors, Answer& answer) {
  for (std::size_t z = 0; z < answer.items.size() && z < errors.error.zones.size(); ++z) {
    answer.items[z].start_body_error = errors.error.zones[z].start;
    answer.items[z].end_body_error = errors.error.zones[z].end;
  }
  const auto found =
      std::ranges::find(figures, answer.key, [](const auto& row) { return row.first; });
  if (found == std::end(figures) || !(errors.value.*found->second)) return;
  const auto figure = found->second;
  answer.body_error = errors.error.*figure;
  for (const auto& [kind, change] : errors.parts) {
    if (change.*figure != 0.0) answer.parts.push_back({kind, change.*figure});
  }
  const auto size = [](const Answer::Part& part) { return -part.change.value_or(HUGE_VAL); };
  std::ranges::stable_sort(answer.parts, {}, size);
}

// Strain of the outer fibre at which a section first yields.
double first_yield_strain(const Case& input, const Result& result) {
  const double n = input.model.layers;
  const bool has_layers = descriptor_of(input.model.section).has_layers;
  const double share = input.parts.section ? input.parts.section->first_yield()
                       : has_layers        ? n / (n - 1.0)
                                           : 1.0;
  return 0.5 * input.scene.beam.height() * result.used.yield_curvature * share;
}

class Answers {
 public:
  Answers(const Case& input, const Result& result) : input_(input), result_(result) {}

  // In the order of the keys.
  std::vector<Answer> all() {
    add_counts();
    Answer& force = add(AnswerKey::largest_force, "N", value_if(is_touched_, result_.max_force),
                        no_contact, RunTotal::peak_force);
    if (is_touched_) {
      const auto hit = std::ranges::max_element(hits_, {}, &SubImpact::peak_force);
      force.time = hit->peak_time;
      force.certain = hit->certain;
    }
    add_times();
    add_velocities();
    add(AnswerKey::impulse, "N s", value_if(is_touched_, result_.impulse()), no_contact,
        RunTotal::impulse);
    add_zones();
    add(AnswerKey::indentation, "m", value_if(is_touched_, result_.max_indentation), no_contact,
        RunTotal::max_indentation);
    const double dent = is_touched_ ? hits_.back().residual_indentation : 0.0;
    add(AnswerKey::dent, "m", value_if(dent > 0.0, dent), is_touched_ ? stays_elastic : no_contact,
        RunTotal::residual_indentation);
    add_pressure();
    add_bending();
    add_supports();
    const Energies& end = result_.final_energies;
    add(AnswerKey::energy, "J", value_if(end.taken_up() > 0.0, end.dissipated()), not_computed,
        RunTotal::dissipated);
    for (Answer& answer : all_) {
      if (answer.value && result_.body_errors) add_body_error(*result_.body_errors, answer);
    }
    return std::move(all_);
  }

 private:
  static std::optional<double> value_if(bool is_there, double value) {
    return is_there ? std::optional(value) : std::nullopt;
  }

  // `otherwise`: why there is no value.
  Answer& add(AnswerKey key, std::string_view unit, std::optional<double> value, WhyNot otherwise,
              std::optional<RunTotal> total = {}) {
    if (value && !std::isfinite(*value)) {  // of a run that failed
      value.reset();
      otherwise = not_computed;
    }
    Answer& answer = all_.emplace_back(Answer{key, unit, value});
    if (!value) answer.why = otherwise;
    if (value && total) answer.error = error_of_total(result_, *total);
    return answer;
  }

  void add_counts() {
    const auto& estimate = result_.error_estimate;
    Answer& count = add(AnswerKey::sub_impacts, "", static_cast<double>(hits_.size()), no_contact,
                        RunTotal::sub_impacts);
    if (estimate) count.certain = result_.all_certain();
    if (!estimate || !estimate->joined) {
      add(AnswerKey::joined, "", std::nullopt, none_uncertain);
      return;
    }
    const auto& [opening, n, n_certain] = *estimate->joined;
    Answer& joined = add(AnswerKey::joined, "", static_cast<double>(n), none_uncertain);
    joined.error = static_cast<double>(n - n_certain);
    joined.certain = n == n_certain;
  }

  void add_zones() {
    const std::vector<ZoneSummary> zones = summarise_zones(hits_);
    const auto& estimate = result_.error_estimate;
    const bool has_totals = estimate && estimate->zones.size() == zones.size();
    Answer& answer =
        add(AnswerKey::zones, "", static_cast<double>(zones.size()), no_contact, RunTotal::zones);
    for (std::size_t k = 0; k < zones.size(); ++k) {
      const ZoneSummary& zone = zones[k];
      const ZoneTotals plain = {{zone.start, {}},
                                {zone.end.value_or(result_.outcome.time), {}},
                                {zone.impulse, {}},
                                {static_cast<double>(zone.n_sub_impacts), {}}};
      const auto& [start, end, impulse, count] = has_totals ? estimate->zones[k] : plain;
      answer.items.push_back(
          {zone.zone, zone.n_subzones, zone.end.has_value(), count, start, end, impulse});
    }
  }

  void add_pressure() {
    const auto at = [&](double force) {
      const auto found = contact_pressure(input_.scene, force);
      return found ? std::optional(found->at_force) : std::nullopt;
    };
    const bool is_there = is_touched_ && !input_.parts.contact_law;
    Answer& answer =
        add(AnswerKey::contact_pressure, "Pa", is_there ? at(result_.max_force) : std::nullopt,
            is_touched_ ? no_moduli : no_contact);
    const std::optional<double> error = error_of_total(result_, RunTotal::peak_force);
    if (answer.value && error) {
      answer.error = std::abs(at(result_.max_force + *error).value_or(0.0) - *answer.value);
    }
  }

  // An end or a start of one of the last contacts; where it is not certain, it lies between the end
  // of the last one that is and this one.
  void add_last(AnswerKey key, const std::optional<double>& time,
                const std::optional<double>& error, WhyNot otherwise) {
    Answer& answer = add(key, "s", time, otherwise);
    if (!result_.error_estimate || !time) return;
    answer.certain = hits_.back().certain.value_or(false) && !doubt_after_last(result_);
    if (*answer.certain) return void(answer.error = error);
    answer.from = 0.0;
    for (const SubImpact& s : hits_) {
      if (!s.certain.value_or(false)) break;
      if (s.end && *s.end < *time) answer.from = *s.end - s.end_error.value_or(0.0);
    }
    if (doubt_after_last(result_)) answer.value = result_.outcome.time;
  }

  void add_times() {
    const std::optional<double> time = figures_of(result_).parting;
    Answer& parting =
        add(AnswerKey::first_parting, "s", time, is_touched_ ? in_contact : no_contact);
    if (time) {
      const SubImpact& hit = *std::ranges::find(hits_, time, &SubImpact::end);
      parting.certain = hit.certain;
      if (hit.certain.value_or(false)) parting.error = hit.end_error;
    }
    const SubImpact last = is_touched_ ? hits_.back() : SubImpact{};
    add_last(AnswerKey::contact_end, last.end, last.end_error,
             is_touched_ ? in_contact : no_contact);
    add_last(AnswerKey::rests_since, result_.rests_since, last.start_error, does_not_rest);
  }

  void add_velocities() {
    add(AnswerKey::striker_velocity, "m/s",
        value_if(!input_.scene.striker.fixed, result_.striker_velocity), fixed,
        RunTotal::striker_velocity)
        .time = result_.outcome.time;
    const bool at_rest = result_.first_touch.striker <= result_.first_touch.beam;
    const WhyNot why = !is_touched_       ? no_contact
                       : at_rest          ? met_at_rest
                       : hits_.back().end ? approaching
                                          : in_contact;
    add(AnswerKey::restitution, "", result_.restitution, why, RunTotal::restitution).time =
        result_.parting.time;
  }

  void add_bending() {
    const auto largest = [&](auto size) {
      return std::ranges::max_element(result_.envelope, {}, size);
    };
    const bool has_yielded = result_.n_yielded_sections > 0;
    const double first_yield = first_yield_strain(input_, result_);
    const WhyNot why = !result_.used.bends()       ? fixed
                       : result_.turns_too_far()   ? turns_too_far
                       : has_yielded               ? not_computed
                       : !(first_yield < HUGE_VAL) ? no_yield_stress
                                                   : stays_elastic;
    const bool has_fields = result_.used.bends() && !result_.envelope.empty();
    const auto most_set =
        largest([](const EnvelopeRow& row) { return std::abs(row.set_from_supports); });
    const bool has_set =
        has_fields && has_yielded && !result_.plastic_zones.empty() && why != turns_too_far;
    Answer& set = add(AnswerKey::permanent_set, "m",
                      has_set ? std::optional(std::abs(most_set->set_from_supports)) : std::nullopt,
                      why, RunTotal::permanent_set);
    if (has_set) set.position = most_set->position;
    const auto most = largest([](const EnvelopeRow& row) { return row.strain.magnitude(); });
    const bool has_share = has_fields && why == stays_elastic;
    Answer& share =
        add(AnswerKey::yield_share, "",
            has_share ? std::optional(most->strain.magnitude() / first_yield) : std::nullopt,
            has_yielded            ? yields
            : why == stays_elastic ? not_computed
                                   : why,
            RunTotal::max_strain);
    if (share.error) *share.error /= first_yield;
    if (has_share) share.position = most->position;
  }

  void add_supports() {
    EnvelopeRow::Extreme largest;
    double position = 0.0;
    for (const std::size_t end : {0, 1}) {
      if (!result_.reactions[end]) continue;
      for (const auto& extreme :
           {result_.reactions[end]->largest, result_.reactions[end]->smallest}) {
        if (std::abs(extreme.value) <= std::abs(largest.value)) continue;
        largest = extreme;
        position = end == 0 ? 0.0 : input_.scene.beam.length;
      }
    }
    Answer& answer =
        add(AnswerKey::supports, "N", value_if(largest.value != 0.0, largest.value),
            input_.scene.beam.is_free() ? no_supports : not_computed,
            largest.value > 0.0 ? RunTotal::reaction_along : RunTotal::reaction_against);
    if (largest.value == 0.0) return;
    answer.time = largest.time;
    answer.position = position;
  }

  const Case& input_;
  const Result& result_;
  const std::vector<SubImpact>& hits_ = result_.sub_impacts;
  const bool is_touched_ = !hits_.empty();
  std::vector<Answer> all_;
};

}  // namespace

std::vector<Answer> answers_of(const Case& input, const Result& result) {
  return Answers(input, result).all();
}

StrikeVerdict verdict_of(const Result& result) {
  using enum StrikeVerdict::Contact;
  StrikeVerdict verdict;
  const std::size_t n = result.sub_impacts.size();
  if (const auto n_certain = result.n_certain()) {
    verdict.certainty = result.all_certain() ? StrikeVerdict::Certainty::all
                        : *n_certain == 0    ? StrikeVerdict::Certainty::none
                                             : StrikeVerdict::Certainty::some;
  }
  verdict.contact = n == 0                           ? none
                    : result.rests_since             ? rests
                    : !result.sub_impacts.back().end ? not_over
                    : result.contact_over            ? over
                                                     : may_not_be_over;
  const bool has_yielded = result.n_yielded_sections > 0;
  verdict.beam = result.turns_too_far()         ? StrikeVerdict::Beam::turned_too_far
                 : !result.used.bends()         ? StrikeVerdict::Beam::rigid
                 : !has_yielded                 ? StrikeVerdict::Beam::elastic
                 : result.plastic_zones.empty() ? StrikeVerdict::Beam::not_computed
                                                : StrikeVerdict::Beam::bent;
  return verdict;
}

const Answer& answer_of(const std::vector<Answer>& answers, AnswerKey key) {
  const auto found = std::ranges::find(answers, key, &Answer::key);
  if (found == answers.end()) throw std::out_of_range("no answer of this key");
  return *found;
}

std::optional<double> error_of_total(const Result& result, RunTotal name) {
  if (!result.error_estimate) return std::nullopt;
  const auto& totals = result.error_estimate->totals;
  const auto found = std::ranges::find(totals, name, &NamedTotal::name);
  return found == totals.end() ? std::nullopt : found->total.error;
}

const ErrorEstimate::UncertainFlight* doubt_after_last(const Result& result) {
  if (!result.error_estimate || result.sub_impacts.empty()) return nullptr;
  return result.error_estimate->doubt_after(result.sub_impacts.size() - 1);
}

}  // namespace subimpact
