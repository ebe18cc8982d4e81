// Answers as records, and as the screen shows them.

#include <array>
#include <numeric>
#include <sstream>

#include <nlohmann/json.hpp>

#include "case_with.h"
#include "sample_result.h"
#include "subimpact/io/results.h"
#include "testing.h"
#include "text/summary_lines.h"

namespace subimpact {
namespace {

using enum AnswerKey;

Case paper_case() { return paper_case_with({}); }

Answer answer_of_sample(AnswerKey key, std::size_t n_certain = 3) {
  return answer_to(paper_case(), sample_result_with_errors(n_certain), key);
}

void expect_numbers(const Answer& answer, const char* text, const char* error, const char* body) {
  EXPECT_EQ(answer.text, text) << answer.label;
  EXPECT_EQ(answer.error_text, error) << answer.label;
  EXPECT_EQ(answer.body_text, body) << answer.label;
}

// The sample with errors of the body: 2000 N of the contact law and 500 N of the width.
Result result_with_body_errors() {
  Result result = sample_result_with_errors(3);
  BodyErrors& errors = result.body_errors.emplace();
  errors.value.peak_force = result.max_force;
  errors.value.parting = 333.3e-6;
  errors.parts = {{BodyPart::width, {1e-6, 500.0}}, {BodyPart::contact_law, {2e-6, 2000.0}}};
  errors.error = {3e-6, 2500.0};
  return result;
}

TEST(Answers, AreOneOfEachKeyInTheOrderOfTheScreenWhateverTheRun) {
  Result untouched = sample_result();
  untouched.sub_impacts.clear();
  for (const Result& result : {sample_result(), sample_result_with_errors(2), untouched}) {
    const std::vector<Answer> answers = answered(paper_case(), result).answers;
    ASSERT_EQ(answers.size(), static_cast<std::size_t>(energy) + 1);
    for (std::size_t i = 0; i < answers.size(); ++i) {
      EXPECT_EQ(answers[i].key, static_cast<AnswerKey>(i));
      EXPECT_NE(answers[i].value.has_value(), answers[i].why.has_value()) << answers[i].label;
      EXPECT_EQ(answers[i].value.has_value(), !answers[i].text.empty()) << answers[i].label;
    }
  }
}

TEST(Answers, HaveTheDigitsOfTheirErrorsOfTheComputation) {
  expect_numbers(answer_of_sample(largest_force), "8.7963 kN at 0.0 us", "0.0005", "not known");
  expect_numbers(answer_of_sample(dent), "0.1540 mm", "0.0009", "not known");
  expect_numbers(answer_of_sample(restitution), "0.20302", "0.00008", "not known");
  expect_numbers(answer_of_sample(impulse), "0.3000 N s", "0.0011", "not known");
  expect_numbers(answer_of_sample(first_parting), "333.333 us", "0.017", "not known");
}

TEST(Answers, WithoutErrorEstimateSayThatErrorsAreNotKnown) {
  const Answer answer = answer_to(paper_case(), sample_result(), largest_force);
  expect_numbers(answer, "8.79631 kN at 0.0 us", "not known", "not known");
  EXPECT_FALSE(answer.error || answer.body_error || answer.certain);
}

TEST(Answers, WhoseErrorExceedsThemAreALimit) {
  Result result = sample_result_with_errors(3);
  for (auto& [name, total] : result.error_estimate->totals) {
    if (name == RunTotal::peak_force) total.error = 12e3;
  }
  expect_numbers(answer_to(paper_case(), result, largest_force), "at most 30 kN at 0.0 us", "12",
                 "not known");
}

TEST(Answers, HaveTheSumOfThePartsAsErrorOfTheBody) {
  const Answer answer = answer_to(paper_case(), result_with_body_errors(), largest_force);
  expect_numbers(answer, "8.7963 kN at 0.0 us", "0.0005", "2.5");
  EXPECT_DOUBLE_EQ(answer.body_error.value(), 2500.0);
  ASSERT_EQ(answer.parts.size(), 2u);
  EXPECT_EQ(answer.parts[0].kind, BodyPart::contact_law);
  EXPECT_EQ(answer.parts[0].text, "2.0");
  EXPECT_EQ(answer.parts[1].kind, BodyPart::width);
}

TEST(Answers, WithAPartThatIsNotKnownHaveNoErrorOfTheBodyButALeastOne) {
  Result result = result_with_body_errors();
  result.body_errors->parts[0].change.peak_force.reset();
  result.body_errors->error.peak_force.reset();
  const Answer answer = answer_to(paper_case(), result, largest_force);
  EXPECT_EQ(answer.body_text, "at least 2.0");
  EXPECT_FALSE(answer.body_error);
  EXPECT_EQ(answer.parts.front().kind, BodyPart::width);
  const std::string summary = summary_of(paper_case(), result);
  expect_in(summary, "(+- not known)");
  expect_in(line_of(summary, "largest force"), "at least 2.0", "width of the hinge");
  expect_in(line_of(summary, "width of the hinge"), "not known how much");
}

TEST(Answers, ThatAreNotThereSayWhyAndTakeNoRow) {
  Result result = sample_result_with_errors(3);
  result.restitution.reset();
  EXPECT_EQ(answer_to(paper_case(), result, restitution).why, WhyNot::in_contact);
  EXPECT_EQ(answer_to(paper_case(), result, contact_end).why, WhyNot::in_contact);
  EXPECT_EQ(line_of(summary_of(paper_case(), result), "restitution"), "");
  expect_in(line_of(summary_of(paper_case(), result, true), "restitution"),
            "none: striker and beam are in contact at the end");
  result.sub_impacts.back().end = 6e-3;
  EXPECT_EQ(answer_to(paper_case(), result, restitution).why, WhyNot::approaching);
  result.sub_impacts.clear();
  EXPECT_EQ(answer_to(paper_case(), result, largest_force).why, WhyNot::no_contact);
}

TEST(Answers, OnAnEndThatIsNotCertainAreAnInterval) {
  Result result = sample_result_with_errors(2);
  result.sub_impacts.back().end = 6e-3;
  const Answer answer = answer_to(paper_case(), result, contact_end);
  EXPECT_EQ(answer.certain, false);
  EXPECT_NEAR(answer.from.value(), 0.6e-3, 1e-6);
  EXPECT_EQ(answer.text, "between 599.7 and 6000 us");
}

TEST(Answers, OnRestHaveTheErrorOfItsStart) {
  Result result = sample_result_with_errors(3);
  result.rests_since = result.sub_impacts.back().start;
  expect_numbers(answer_to(paper_case(), result, rests_since), "5000.0 us", "0.3", "not known");
}

TEST(Answers, OnTimesHaveNoPowersOfTenWhateverTheLengthOfTheRun) {
  for (const auto& [later, rest, text] :
       {std::tuple{15.62e-3, 20.62e-3, "20.6200 ms"}, std::tuple{1.3, 1.305, "1.3050000 s"}}) {
    Result result = sample_result_with_errors(3);
    result.sub_impacts.back().start += later;
    result.outcome.time += later;
    result.rests_since = rest;
    EXPECT_EQ(answer_to(paper_case(), result, rests_since).text, text);
    expect_not_in(summary_of(paper_case(), result), "e+0");
  }
}

TEST(Answers, ListZonesWithTheirErrors) {
  const Answer answer = answer_of_sample(zones);
  ASSERT_EQ(answer.items.size(), 2u);
  EXPECT_EQ(answer.items[0].text,
            "2 sub-impacts in 2 sub-zones, 0 to 600.0 +- 0.3 us, 0.2000 +- 0.0006 N s");
  expect_in(answer.items[1].text, "1 sub-impact, 5000.0 +- 0.3 us to the end of the run");
  EXPECT_EQ(answer.items[1].begin_text, "from 5000.0 us: 1 sub-impact");
  EXPECT_EQ(answer.items[1].error_text, "0.3");
  EXPECT_EQ(answer.items[1].body_text, "not known");
  EXPECT_EQ(answer.items[0].body_text, "0");
  expect_in(answer_of_sample(zones, 1).items[0].text, "2 +- 1 sub-impacts in 2 sub-zones");
  Result result = sample_result_with_errors(3);
  result.error_estimate->zones.clear();
  expect_in(answer_to(paper_case(), result, zones).items[0].text, "0.0 to 600.0 us");
}

TEST(Answers, CountTheSubImpactsThatAreCertain) {
  expect_numbers(answer_of_sample(sub_impacts), "3 in 2 zones, all certain", "0", "not known");
  expect_in(answer_of_sample(sub_impacts).note,
            "2 parted by more than 1 um, 2 by more than 10 um; all times to 0.3 us up to 8 ms");
  expect_numbers(answer_of_sample(sub_impacts, 2), "3 in 2 zones, 2 certain", "1", "not known");
  EXPECT_EQ(answer_to(paper_case(), sample_result_with_an_uncertain_flight(2), sub_impacts).text,
            "3 in 2 zones, 3 certain, which may not be all");
  Result both = sample_result_with_errors(2);
  both.error_estimate->uncertain_flights = {{0, Reason{}}};
  both.error_estimate->totals.front().total.error = 2.0;
  expect_in(answer_to(paper_case(), both, sub_impacts).text, "2 certain, 1 more possible");
}

TEST(Answers, SayWhatJoiningLeavesOfTheSubImpacts) {
  Case input = paper_case();
  Result result = sample_result_with_errors(1);
  result.sub_impacts[0].opening = 0.5e-6;
  result.sub_impacts[1].opening = 5e-6;
  EXPECT_EQ(answer_to(input, result, joined).why, WhyNot::none_uncertain);
  result.error_estimate->joined = {1e-6, 2, 1};
  const Answer answer = answer_to(input, result, joined);
  EXPECT_EQ(answer.label, "joined at 1 um");
  expect_numbers(answer, "2, 1 certain", "1", "not known");
  expect_in(answer.note, "--opening 1um");
  input.output.opening = 2e-6;
  expect_in(answer_to(input, result, sub_impacts).note,
            "contacts parted by less than 2 um joined, 0 parted by more than 10 um");
}

TEST(Answers, OnABeamThatStaysElasticAreTheShareOfFirstYield) {
  Result result = sample_result();
  result.used.yield_curvature = 0.5;
  result.used.n_sections = 9;
  EnvelopeRow row;
  row.position = 0.1;
  row.strain.include(0.25 * 0.5 * paper_case().scene.beam.thickness, 1e-3);
  result.envelope = {row};
  Case input = paper_case();
  input.model.section = SectionKind::exact;
  EXPECT_EQ(answer_to(input, result, permanent_set).why, WhyNot::stays_elastic);
  EXPECT_EQ(answer_to(input, result, yield_share).text, "0.500000 at 0.1 m");
  expect_in(answered(input, result).verdict.text, "the beam stays elastic");
}

// A strike whose energies have a remainder in every rounding.
Result result_with_energies() {
  Result result = sample_result_with_errors(3);
  result.used.initial_energy = 25.0;
  result.final_energies = {3.3333, 5.5555, 4.4444, 9.6666, 0.0, 1.5002, 0.5};
  result.contact_damping_loss = 0.25;
  return result;
}

TEST(Answers, HaveEnergiesThatAddUpToTheInitialOneAsTheyArePrinted) {
  Result result = result_with_energies();
  for (const double error : {0.0, 0.003, 0.04, 0.5}) {
    result.error_estimate->totals.push_back({RunTotal::dissipated, {0.0, error}});
    const Answer answer = answer_to(paper_case(), result, energy);
    EXPECT_NEAR(answer.value.value(), 11.6668, 1e-9);
    std::istringstream line(answer.note);
    double sum = 0.0, initial = 0.0;
    line >> initial;
    for (std::string word; line >> word;) {
      double share = 0.0;
      if (std::istringstream(word) >> share) sum += share;
    }
    EXPECT_NEAR(sum, 25.0, 1e-9) << line.str();
    EXPECT_NEAR(initial, 25.0, 1e-9) << line.str();
    expect_in(line.str(), "damping of the contact", "damping of the beam");
    result.error_estimate->totals.pop_back();
  }
}

TEST(Answers, PlaceTheLargestForceInTimeAndInItsSubImpact) {
  Result result = sample_result_with_errors(3);
  result.sub_impacts[1].peak_force = result.max_force = 9000.0;
  result.sub_impacts[1].peak_time = 543.2198e-6;
  const Answer answer = answer_to(paper_case(), result, largest_force);
  expect_in(answer.text, "kN at 543.2 us");
  EXPECT_EQ(answer.note, "in sub-impact 2");
}

TEST(Answers, StandInTheSummaryFileAsOnTheScreen) {
  const Result result = answered(paper_case(), result_with_body_errors());
  const auto summary = nlohmann::json::parse(summary_json(paper_case(), result));
  const auto& force = summary.at("answers").at(static_cast<std::size_t>(largest_force));
  EXPECT_EQ(force.at("key"), "largest_force");
  EXPECT_EQ(force.at("body_error"), 2500.0);
  EXPECT_EQ(force.at("parts").at(0).at("key"), "contact_law");
  EXPECT_EQ(force.at("unit"), "N");
  EXPECT_EQ(force.at("why"), nullptr);
  EXPECT_EQ(summary.at("verdict").at("certainty"), "all");
  EXPECT_EQ(summary.at("verdict").at("contact"), "not_over");
  const std::string screen = summary_of(paper_case(), result);
  for (const auto& answer : summary.at("answers")) {
    const std::string line = line_of(screen, answer.at("label"));
    if (line.empty()) continue;
    expect_in(line, answer.at("text").get<std::string>(),
              answer.at("error_text").get<std::string>(),
              answer.at("body_text").get<std::string>());
  }
  expect_in(unwrapped(screen), summary.at("verdict").at("text").get<std::string>());
}

TEST(TheVerdict, HasTheTotalErrorAndWhatIsNotSure) {
  expect_in(answered(paper_case(), result_with_body_errors()).verdict.text,
            "3 sub-impacts in 8 ms, all certain; up to 8.8 +- 2.5 kN; ", "still in contact.");
  Result result = sample_result_with_errors(2);
  result.sub_impacts.back().end = 6e-3;
  expect_in(answered(paper_case(), result).verdict.text, "2 certain", "8.80 kN (+- not known)",
            "may not be over.");
  result.contact_over = true;
  expect_in(answered(paper_case(), result).verdict.text, "contact is over.");
  result.rests_since = 5e-3;
  expect_in(answered(paper_case(), result).verdict.text, "rest on each other");
  result.rests_since.reset();
  result.sub_impacts.clear();
  expect_in(answered(paper_case(), result).verdict.text, "No contact in 8 ms");
}

TEST(TheVerdict, CallsNoResultWhatTurnsFurtherThanTheModelHoldsAndPrintsNoPermanentSet) {
  Result result = sample_result_with_errors(3);
  result.used.n_sections = 11;
  result.n_yielded_sections = 3;
  result.plastic_zones = {{.from = 0.1, .to = 0.2, .rotation = 0.4}};
  result.envelope.resize(3);
  result.envelope[1].set_from_supports = 0.4;
  result.largest_rotation = 0.49;
  EXPECT_EQ(answer_to(paper_case(), result, permanent_set).value, 0.4);
  result.largest_rotation = 11.9;
  const Result turned = answered(paper_case(), result);
  EXPECT_EQ(answer_of(turned.answers, permanent_set).why, WhyNot::turns_too_far);
  EXPECT_EQ(turned.verdict.beam, StrikeVerdict::Beam::turned_too_far);
  expect_in(turned.verdict.text, "Not a result: rotations of 12 rad");
  expect_not_in(summary_of(paper_case(), result, true), "400.0 mm");
}

TEST(TheScreen, NamesEachPartThatMattersOnceWithWhatToDo) {
  const std::string summary = summary_of(paper_case(), result_with_body_errors());
  expect_in(line_of(summary, "largest force"), "contact law");
  EXPECT_EQ(count_in(summary, "contact.law = \"curve\""), 1u);
  expect_in(line_of(summary, "contact law"), "give the measured curve");
  expect_in(line_of(summary, "width of the hinge"), "measure the permanent set once");
  expect_not_in(summary, "contact law 2.0");
  expect_in(summary_of(paper_case(), result_with_body_errors(), true),
            "largest force: contact law 2.0, width of the hinge 0.50");
}

TEST(TheScreen, HasTheFirstDoubtAndErrorsThatARunBesideLeftOpen) {
  expect_in(line_of(summary_of(paper_case(), sample_result_with_errors(2)), "not certain"),
            "sub-impact 3: they part");
  EXPECT_EQ(line_of(summary_of(paper_case(), sample_result_with_errors(3)), "not certain"), "");
  Result result = sample_result_with_errors(3);
  result.error_estimate->totals.clear();
  expect_in(line_of(summary_of(paper_case(), result), "errors"), "a run beside did not complete");
  expect_in(line_of(summary_of(paper_case(), result), "largest force"), "8.80 kN", "not known");
}

}  // namespace
}  // namespace subimpact
