#include "elastic_case.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/case/simulate.h"
#include "subimpact/study/run_as_asked.h"
#include "subimpact/study/studies.h"
#include "testing.h"

namespace subimpact {
namespace {

TEST(ComparedMethods, AllFindTheSameSubImpactsOfAnElasticBeam) {
  const Comparison comparison =
      compare(elastic_case(0.6e-3),
              {"central-difference", "erk", "erk:dormand-prince", "erk:dormand-prince+library",
               "erk+library", "nystrom", "exponential", "adams", "bdf", "bdf+library"});
  ASSERT_EQ(comparison.runs.size(), 10u);
  EXPECT_EQ(comparison.reference.sub_impacts.size(), 8u);
  for (const ComparedRun& run : comparison.runs) {
    EXPECT_EQ(run.errors.n_corresponding, 8u) << run.setting.method << ": " << run.message;
    EXPECT_EQ(run.message, "every sub-impact corresponds");
    const bool accurate = run.setting.method.rfind("erk", 0) == 0 ||
                          run.setting.method == "nystrom" || run.setting.method == "exponential";
    EXPECT_LT(1e6 * run.errors.ends, accurate ? 1e-3 : 0.5) << run.setting.method;
    EXPECT_GT(run.result.work.steps, 0) << run.setting.method;
  }
}

TEST(ATreatmentOfEvents, IsNamedAfterAPlusSign) {
  Case input = elastic_case(1e-5);
  input.solver.events = EventHandling::library;
  const Comparison comparison = compare(input, {"erk", "erk:verner+interpolated", "adams+located",
                                                "nystrom", "nystrom+interpolated"});
  const auto used = [&](std::size_t i) { return comparison.runs[i].result.used.events; };
  EXPECT_EQ(used(0), EventHandling::library);
  EXPECT_EQ(used(1), EventHandling::interpolated);
  EXPECT_EQ(comparison.runs[1].result.used.table, "verner");
  EXPECT_EQ(used(2), EventHandling::located);
  EXPECT_EQ(used(3), EventHandling::located);  // it has no root-finding
  EXPECT_EQ(used(4), EventHandling::interpolated);
  EXPECT_EQ(comparison.reference.result.used.events, EventHandling::located);
  EXPECT_THROW(compare(input, {"nystrom+library"}), InvalidCase);
  EXPECT_THROW(compare(input, {"erk+librari"}), InvalidCase);
}

TEST(ASettingGiven, HoldsForEveryMethodThatHasItOrIsRefusedByName) {
  Case input = elastic_case(1e-5, 51);
  input.solver.step = 1e-7;
  for (const ComparedRun& run : compare(input, {"nystrom", "erk:zonneveld", "dirk"}).runs) {
    EXPECT_EQ(run.result.used.step, 1e-7) << run.setting.method;
    EXPECT_EQ(run.setting.text(), "step 0.1 us");
  }
  expect_in(message_of<InvalidCase>([&] {
              compare(input, {"erk", "adams"});
            }),
            "solver.step is 1e-07 s, but adams chooses step and order together");
  input.solver.step.reset();
  input.solver.max_order = 3;
  const Comparison orders = compare(input, {"adams", "bdf", "erk"});
  EXPECT_EQ(orders.runs[0].result.used.max_order, 3);
  EXPECT_EQ(orders.runs[1].result.used.max_order, 3);
  EXPECT_EQ(orders.runs[2].result.used.max_order, std::nullopt);
  expect_in(message_of<InvalidCase>([&] {
              compare(input, {"erk", "nystrom"});
            }),
            "solver.max_order is 3, but no method of the comparison");
}

TEST(AFailedMethod, HasNoErrorsButAReasonAndAMiscountSaysOverHowMany) {
  Case input = elastic_case(0.25e-3);
  input.solver.rtol = 1e-4;
  const Comparison failed = compare(input, {"bdf"});
  EXPECT_EQ(failed.runs[0].verdict, Verdict::unstable);
  EXPECT_FALSE(failed.runs[0].has_errors());
  expect_in(failed.runs[0].message, "grows without bound");
  const Comparison miscounted = compare(elastic_case(8e-3), {"central-difference"});
  EXPECT_EQ(miscounted.runs[0].verdict, Verdict::wrong_count);
  expect_in(miscounted.runs[0].message, " instead of 26; the first ", " correspond within ");
}

TEST(DampedBeams, AreComparedWithTwoMethodsThatTakeDamping) {
  const auto reference_of = [](const std::function<void(Case&)>& damp) {
    Case input = elastic_case(0.3e-3, 101);
    damp(input);
    const bool may_yield = input.model.section == SectionKind::exact;
    const Comparison comparison = compare(input, {"erk:verner"});
    EXPECT_EQ(comparison.runs[0].verdict, Verdict::right) << comparison.runs[0].message;
    // Sections are not located within the steps of a damped beam.
    EXPECT_LT(comparison.reference.error, may_yield ? 1e-7 : 1e-12);
    return comparison.reference.description;
  };
  expect_in(reference_of([](Case& c) { c.scene.beam.damping.ratio = 0.02; }), "and exponential");
  expect_in(reference_of([](Case& c) { c.scene.beam.damping.mass = 100.0; }), "and exponential");
  expect_in(reference_of([](Case& c) {
              c.scene.beam.damping.stiffness = 1e-9;
              c.model.section = SectionKind::exact;
            }),
            "erk at", "erk:fehlberg-78");
}

TEST(TheReferencesOwnRun, IsComparedWithItsOtherOneAndSaysSo) {
  Case input = elastic_case(0.3e-3);
  input.solver.rtol = 1e-11;
  const Comparison comparison = compare(input, {"exponential", "nystrom"});
  for (const ComparedRun& run : comparison.runs) EXPECT_GT(run.errors.maximum, 0.0);
  EXPECT_EQ(comparison.runs[0].message, "every sub-impact corresponds");
  EXPECT_EQ(comparison.runs[1].message, "the reference's own run, beside its other one");
}

TEST(AnInterruptedComparison, HasTheMethodsThatHadEnded) {
  std::string running;
  const auto note = [&](const std::string& name) { running = name; };
  const Case input = elastic_case(1e-4);
  const Comparison cut_short = compare(input, {"erk", "nystrom", "exponential"}, note,
                                       [&](double) { return running != "nystrom"; });
  EXPECT_TRUE(cut_short.interrupted);
  ASSERT_EQ(cut_short.runs.size(), 1u);
  EXPECT_EQ(cut_short.runs.front().setting.method, "erk");
  const Comparison whole = compare(input, {"erk"}, note, [](double) { return true; });
  EXPECT_FALSE(whole.interrupted);
  EXPECT_EQ(cut_short.runs.front().errors.ends, whole.runs.front().errors.ends);
  const Comparison none = compare(input, {"erk"}, note, [](double) { return false; });
  EXPECT_TRUE(none.interrupted);
  EXPECT_TRUE(none.runs.empty());
}

TEST(AComparison, WithAReferenceThatFailedIsNotMade) {
  Case input = elastic_case(1e-3);        // in which the striker goes through the beam
  input.scene.beam.yield_stress = 150.0;  // MPa were meant
  input.model.section = SectionKind::exact;
  input.model.segments = 21;
  expect_in(message_of<std::runtime_error>([&] { compare(input, {"erk"}); }), "the reference");
}

TEST(AnUnknownMethodOrTable, IsRefusedBeforeAnythingRuns) {
  EXPECT_THROW(compare(elastic_case(1e-5), {"erk", "leapfrog"}), InvalidCase);
  EXPECT_THROW(compare(elastic_case(1e-5), {"erk:dprkn8"}), InvalidCase);
}

Case strike(BeamTheory theory) {
  Case input = paper_run(SectionKind::elastic, 0.5e-3, 501, Method::nystrom);
  input.scene.striker.velocity = 0.1;
  input.scene.beam.theory = theory;
  input.scene.beam.poisson = 0.33;
  input.scene.beam.shear_coefficient = 5.0 / 6.0;
  return input;
}

const std::string names[] = {"rayleigh", "timoshenko"};

// The converged times are 403.89 us by Rayleigh's theory and 424.18 us by Timoshenko's.
TEST(CompareModels, FindsWhatShearAddsToTheFirstContact) {
  const Case cases[] = {strike(BeamTheory::rayleigh), strike(BeamTheory::timoshenko)};
  const auto runs = compare_models(cases, names, 2);
  ASSERT_EQ(runs.size(), 2u);
  const double added =
      1e6 * (*runs[1].result.sub_impacts.at(0).end - *runs[0].result.sub_impacts.at(0).end);
  EXPECT_NEAR(added, 424.18 - 403.89, 0.5);
  EXPECT_EQ(n_leading_matches(runs[1].pairs), 2u);
}

TEST(CompareModels, ByContactLawsDropTheConstantsThatALawDoesNotUse) {
  Case input = strike(BeamTheory::rayleigh);
  input.scene.beam.shear_coefficient.reset();
  input.scene.contact = {ContactKind::sphere, {}, 2.1e11, 0.3, {}};
  input.scene.contact.yield_pressure = 3e8;
  const Case foundation = with_contact_law(input, "foundation");
  EXPECT_FALSE(foundation.scene.contact.striker_modulus);
  EXPECT_FALSE(foundation.scene.contact.yield_pressure);
  const Case hertz = with_contact_law(input, "hertz");
  EXPECT_TRUE(hertz.scene.contact.striker_modulus);
  EXPECT_FALSE(hertz.scene.contact.yield_pressure);
  for (const Case& one : {input, foundation, hertz}) EXPECT_NO_THROW(check(one));
  EXPECT_THROW(with_contact_law(input, "spere"), InvalidCase);
}

TEST(CompareModels, ByContactLawsKeepWhatALawMeasuresFromTheMidPlane) {
  Case input = strike(BeamTheory::timoshenko);
  Contact& contact = input.scene.contact;
  contact.kind = ContactKind::sphere;
  contact.pressure_by_depth = true;
  contact.indentation = IndentationFrom::mid_plane;
  const Case line = with_contact_law(input, "line"), plain = with_contact_law(input, "foundation");
  EXPECT_TRUE(line.scene.contact.pressure_by_depth);
  EXPECT_FALSE(plain.scene.contact.pressure_by_depth);
  input.scene.contact.pressure_by_depth = false;
  input.scene.contact.indentation = IndentationFrom::half_space;
  for (const Case& one : {line, plain, with_contact_law(input, "line")}) {
    EXPECT_NO_THROW(check(one));
  }
}

}  // namespace
}  // namespace subimpact
