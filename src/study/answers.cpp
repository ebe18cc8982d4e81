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

// Where the error of the body comes from.
std::optional<double> StrikeFigures::*figure_of(AnswerKey key) {
  switch (key) {
    case AnswerKey::largest_force:
      return &StrikeFigures::peak_force;
    case AnswerKey::first_parting:
      return &StrikeFigures::parting;
    case AnswerKey::striker_velocity:
      return &StrikeFigures::striker_velocity;
    case AnswerKey::permanent_set:
      return &StrikeFigures::permanent_set;
    default:
      return nullptr;
  }
}

// The kinds of parts that ModelErrors names.
BodyPart kind_of(const ModelErrors::Part& part) {
  static const std::pair<std::string_view, BodyPart> kinds[] = {
      {"shear", BodyPart::shear},
      {"shear coefficient", BodyPart::shear_coefficient},
      {"width", BodyPart::width},
      {"finite rotations", BodyPart::finite_rotations},
      {"stretching", BodyPart::stretching},
      {"hinge length", BodyPart::hinge_length},
      {"thin openings", BodyPart::thin_openings}};
  for (const auto& [name, kind] : kinds) {
    if (part.name == name) return kind;
  }
  return BodyPart::contact_law;
}

// The error of the body of an answer, and its parts, from Result::model_errors.
void add_body_error(const Result& result, Answer& answer) {
  const auto figure = figure_of(answer.key);
  if (!result.model_errors || figure == nullptr || !(result.model_errors->value.*figure)) return;
  bool is_known = true;
  double sum = 0.0;
  for (const ModelErrors::Part& part : result.model_errors->parts) {
    const std::optional<double>& change = part.change.*figure;
    const BodyPart kind = kind_of(part);
    if (!change && kind == BodyPart::hinge_length) continue;  // is in no sum but that of the set
    is_known = is_known && change;
    sum += change.value_or(0.0);
    answer.parts.push_back({kind, change});
  }
  if (is_known) answer.body_error = sum;
  const auto size = [](const Answer::Part& part) { return -part.change.value_or(0.0); };
  std::ranges::stable_sort(answer.parts, {}, size);
}

Answer unknown(AnswerKey key, std::string_view unit, WhyNot why) {
  Answer answer{key, unit};
  answer.why = why;
  return answer;
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

double magnitude(const EnvelopeRow::Range& range) {
  return std::max(range.largest.value, -range.smallest.value);
}

class Answers {
 public:
  Answers(const Case& input, const Result& result) : input_(input), result_(result) {}

  std::vector<Answer> all() {
    add_counts();
    add_contact();
    add_times();
    add_velocities();
    add_bending();
    add_supports();
    add_energy();
    std::ranges::stable_sort(all_, {}, &Answer::key);
    for (Answer& answer : all_) {
      if (answer.value) add_body_error(result_, answer);
    }
    return std::move(all_);
  }

 private:
  const std::vector<SubImpact>& hits() const { return result_.sub_impacts; }

  Answer& add(AnswerKey key, std::string_view unit, double value, std::optional<RunTotal> total) {
    Answer& answer = all_.emplace_back(Answer{key, unit, value});
    if (total) answer.error = error_of_total(result_, *total);
    return answer;
  }
  void add_unknown(AnswerKey key, std::string_view unit, WhyNot why) {
    all_.push_back(unknown(key, unit, why));
  }

  void add_counts() {
    const auto n = static_cast<double>(hits().size());
    Answer& count = add(AnswerKey::sub_impacts, "", n, RunTotal::sub_impacts);
    if (result_.error_estimate) count.certain = result_.all_certain();
    if (result_.error_estimate && result_.error_estimate->joined) {
      const auto& [opening, n_joined, n_certain] = *result_.error_estimate->joined;
      Answer& joined = add(AnswerKey::joined, "", static_cast<double>(n_joined), std::nullopt);
      joined.error = static_cast<double>(n_joined - n_certain);
      joined.certain = n_joined == n_certain;
    } else {
      add_unknown(AnswerKey::joined, "", none_uncertain);
    }
    add_zones();
  }

  void add_zones() {
    const std::vector<ZoneSummary> zones = summarise_zones(hits());
    const auto& estimate = result_.error_estimate;
    const bool has_totals = estimate && estimate->zones.size() == zones.size();
    Answer& answer = add(AnswerKey::zones, "", static_cast<double>(zones.size()), RunTotal::zones);
    for (std::size_t k = 0; k < zones.size(); ++k) {
      const ZoneSummary& zone = zones[k];
      Answer::Item item;
      item.number = zone.zone;
      item.n_subzones = zone.n_subzones;
      item.has_end = zone.end.has_value();
      const Total count{static_cast<double>(zone.n_sub_impacts), {}};
      const double end = zone.end.value_or(result_.outcome.time);
      const ZoneTotals totals =
          has_totals ? estimate->zones[k]
                     : ZoneTotals{{zone.start, {}}, {end, {}}, {zone.impulse, {}}, count};
      item.start = totals.start;
      item.end = totals.end;
      item.impulse = totals.impulse;
      item.sub_impacts = totals.sub_impacts;
      answer.items.push_back(item);
    }
  }

  void add_contact() {
    if (hits().empty()) {
      add_unknown(AnswerKey::largest_force, "N", no_contact);
      add_unknown(AnswerKey::impulse, "N s", no_contact);
      add_unknown(AnswerKey::indentation, "m", no_contact);
      add_unknown(AnswerKey::dent, "m", no_contact);
      add_unknown(AnswerKey::contact_pressure, "Pa", no_contact);
      return;
    }
    Answer& force = add(AnswerKey::largest_force, "N", result_.max_force, RunTotal::peak_force);
    const auto hit = std::ranges::max_element(hits(), {}, &SubImpact::peak_force);
    force.time = hit->peak_time;
    force.certain = hit->certain;
    add(AnswerKey::impulse, "N s", result_.impulse(), RunTotal::impulse);
    add(AnswerKey::indentation, "m", result_.max_indentation, RunTotal::max_indentation);
    const double residual = hits().back().residual_indentation;
    if (residual > 0.0) {
      add(AnswerKey::dent, "m", residual, RunTotal::residual_indentation);
    } else {
      add_unknown(AnswerKey::dent, "m", stays_elastic);
    }
    add_pressure();
  }

  void add_pressure() {
    const double force = result_.max_force;
    const auto at = [&](double f) { return contact_pressure(input_.scene, f); };
    if (input_.parts.contact_law || !at(force)) {
      return add_unknown(AnswerKey::contact_pressure, "Pa", no_moduli);
    }
    Answer& answer = add(AnswerKey::contact_pressure, "Pa", at(force)->at_force, std::nullopt);
    const std::optional<double> error = error_of_total(result_, RunTotal::peak_force);
    if (const auto more = at(force + error.value_or(0.0)); error && more) {
      answer.error = std::abs(more->at_force - *answer.value);
    }
  }

  // Of an end or a start of one of the last contacts; where it is not certain, the time lies
  // between the end of the last one that is and this one.
  void add_time_of_last(AnswerKey key, double time, const std::optional<double>& error) {
    Answer& answer = add(key, "s", time, std::nullopt);
    if (!result_.error_estimate) return;
    answer.certain = hits().back().certain.value_or(false) && !doubt_after_last(result_);
    if (*answer.certain) {
      answer.error = error;
      return;
    }
    answer.from = 0.0;
    for (const SubImpact& s : hits()) {
      if (!s.certain.value_or(false)) break;
      if (s.end && *s.end < time) answer.from = *s.end - s.end_error.value_or(0.0);
    }
    if (doubt_after_last(result_)) answer.value = result_.outcome.time;
  }

  void add_times() {
    const StrikeFigures figures = figures_of(result_);
    if (figures.parting) {
      Answer& parting = add(AnswerKey::first_parting, "s", *figures.parting, std::nullopt);
      const auto hit = std::ranges::find(hits(), figures.parting, &SubImpact::end);
      parting.certain = hit->certain;
      if (hit->certain.value_or(false)) parting.error = hit->end_error;
    } else {
      add_unknown(AnswerKey::first_parting, "s", hits().empty() ? no_contact : in_contact);
    }
    if (!hits().empty() && hits().back().end) {
      add_time_of_last(AnswerKey::contact_end, *hits().back().end, hits().back().end_error);
    } else {
      add_unknown(AnswerKey::contact_end, "s", hits().empty() ? no_contact : in_contact);
    }
    if (result_.rests_since) {
      add_time_of_last(AnswerKey::rests_since, *result_.rests_since, hits().back().start_error);
    } else {
      add_unknown(AnswerKey::rests_since, "s", does_not_rest);
    }
  }

  void add_velocities() {
    if (input_.scene.striker.fixed) {
      add_unknown(AnswerKey::striker_velocity, "m/s", fixed);
    } else {
      add(AnswerKey::striker_velocity, "m/s", result_.striker_velocity, RunTotal::striker_velocity)
          .time = result_.outcome.time;
    }
    const bool met_at_rest_only = result_.first_touch.striker <= result_.first_touch.beam;
    if (result_.restitution) {
      add(AnswerKey::restitution, "", *result_.restitution, RunTotal::restitution).time =
          result_.parting.time;
    } else {
      add_unknown(AnswerKey::restitution, "",
                  hits().empty()      ? no_contact
                  : met_at_rest_only  ? met_at_rest
                  : hits().back().end ? approaching
                                      : in_contact);
    }
  }

  void add_bending() {
    const auto add_both = [&](WhyNot of_set, WhyNot of_share) {
      add_unknown(AnswerKey::permanent_set, "m", of_set);
      add_unknown(AnswerKey::yield_share, "", of_share);
    };
    const bool has_yielded = result_.n_yielded_sections > 0;
    if (!result_.used.bends()) return add_both(fixed, fixed);
    if (has_yielded && result_.plastic_zones.empty()) return add_both(not_computed, yields);
    if (has_yielded) {
      const EnvelopeRow& most = *std::ranges::max_element(
          result_.envelope, {},
          [](const EnvelopeRow& row) { return std::abs(row.set_from_supports); });
      add(AnswerKey::permanent_set, "m", std::abs(most.set_from_supports), RunTotal::permanent_set)
          .position = most.position;
      return add_unknown(AnswerKey::yield_share, "", yields);
    }
    const double first_yield = first_yield_strain(input_, result_);
    if (!(first_yield < HUGE_VAL)) return add_both(no_yield_stress, no_yield_stress);
    if (result_.envelope.empty()) return add_both(stays_elastic, not_computed);
    add_unknown(AnswerKey::permanent_set, "m", stays_elastic);
    const EnvelopeRow& most = *std::ranges::max_element(
        result_.envelope, {}, [](const EnvelopeRow& row) { return magnitude(row.strain); });
    Answer& share =
        add(AnswerKey::yield_share, "", magnitude(most.strain) / first_yield, RunTotal::max_strain);
    if (share.error) *share.error /= first_yield;
    share.position = most.position;
  }

  void add_supports() {
    const EnvelopeRow::Extreme* largest = nullptr;
    for (const std::size_t end : {0, 1}) {
      if (!result_.reactions[end]) continue;
      for (const auto* extreme :
           {&result_.reactions[end]->largest, &result_.reactions[end]->smallest}) {
        if (largest != nullptr && std::abs(extreme->value) <= std::abs(largest->value)) continue;
        largest = extreme;
        position_of_reaction_ = end == 0 ? 0.0 : input_.scene.beam.length;
      }
    }
    if (largest == nullptr) {
      return add_unknown(AnswerKey::supports, "N",
                         input_.scene.beam.is_free() ? no_supports : not_computed);
    }
    Answer& answer =
        add(AnswerKey::supports, "N", largest->value,
            largest->value > 0.0 ? RunTotal::reaction_along : RunTotal::reaction_against);
    answer.time = largest->time;
    answer.position = position_of_reaction_;
  }

  void add_energy() {
    const Energies& end = result_.final_energies;
    add(AnswerKey::energy, "J", end.bending_plastic + end.contact_plastic + end.beam_damping,
        RunTotal::dissipated);
  }

  const Case& input_;
  const Result& result_;
  std::vector<Answer> all_;
  double position_of_reaction_ = 0.0;
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
  verdict.beam = !result.used.bends()           ? StrikeVerdict::Beam::rigid
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
