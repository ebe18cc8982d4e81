// Wishes for event times: what the program chooses, and whether the wish is met.

#include "elastic_case.h"
#include "runs.h"
#include "same_results.h"
#include "subimpact/study/judgement/event_errors.h"
#include "subimpact/study/judgement/judgement.h"
#include "subimpact/study/run_as_asked.h"

namespace subimpact {
namespace {

Case wishing(double wish, SectionKind section, double end_time, int segments = 501,
             Method method = Method::erk) {
  Case input = paper_run(section, end_time, segments, method);
  input.accuracy.event_times = wish;
  return input;
}

GivenKeys given(std::set<std::string> keys) { return {std::move(keys), {}}; }

TEST(OpenChoices, ASizeFixesItsMeshAndAToleranceItsMethod) {
  const OpenChoices sized = open_choices(given({"model.segments"}));
  EXPECT_FALSE(sized.size || sized.mesh);
  EXPECT_TRUE(sized.method && sized.tolerance);
  const OpenChoices meshed = open_choices(given({"model.mesh"}));
  EXPECT_TRUE(meshed.size && !meshed.mesh);
  const OpenChoices tolerant = open_choices(given({"solver.rtol"}));
  EXPECT_FALSE(tolerant.tolerance || tolerant.method);
  const OpenChoices timed = open_choices(given({"solver.method"}));
  EXPECT_TRUE(timed.tolerance && !timed.method);
}

TEST(AChoice, IsModesWhereTheBeamIsElasticAndCentralDifferencesWhereItYields) {
  const ChosenModel elastic = choose_model(paper_run(SectionKind::elastic, 1e-3), {}, false);
  EXPECT_EQ(elastic.input.model.mesh, MeshKind::hermite);
  EXPECT_EQ(elastic.input.solver.method, Method::exponential);
  const ChosenModel yielding = choose_model(paper_run(SectionKind::exact, 1e-3), {}, true);
  EXPECT_EQ(yielding.input.model.mesh, MeshKind::cells);
  EXPECT_EQ(yielding.input.solver.method, Method::central_difference);
}

// Steps of central differences would be those of the contact, for the whole run.
TEST(AChoice, TakesAMethodWithStepsOfItsOwnWhereContactsAreFarShorterThanPeriodsOfTheMesh) {
  Case input = paper_run(SectionKind::exact, 1e-4);
  input.scene.striker.mass = 1e-6;
  input.scene.striker.nose_radius.reset();
  input.scene.contact.kind = ContactKind::linear;
  input.scene.contact.stiffness = 1e14;
  EXPECT_EQ(choose_model(input, {}, true).input.solver.method, Method::nystrom);
  input.scene.beam.damping.stiffness = 1e-9;
  EXPECT_EQ(choose_model(input, {}, true).input.solver.method, Method::erk);
  input.scene.striker.mass = 0.2;
  EXPECT_EQ(choose_model(input, {}, true).input.solver.method, Method::erk);
  input.scene.beam.damping = {};
  input.scene.contact.stiffness = 1e8;
  EXPECT_EQ(choose_model(input, {}, true).input.solver.method, Method::central_difference);
}

// A soft tap: no section yields, and the search would go over to natural modes.
TEST(ASearch, StaysOnCellsWhereContactBesideModesWouldTakeTooLong) {
  Case input = wishing(1e-4, SectionKind::exact, 3e-4);
  input.scene.striker.velocity = 0.05;
  EXPECT_EQ(simulate_within(input, {}).input.model.mesh, MeshKind::hermite);
  input.accuracy.work_limit = 5e5;
  const WithinRun run = simulate_within(input, {});
  EXPECT_EQ(run.input.model.mesh, MeshKind::cells);
  EXPECT_TRUE(run.result.tolerance->met);
}

TEST(AChoice, LeavesWhatTheCaseFixes) {
  Case input = paper_run(SectionKind::elastic, 1e-3, 501, Method::erk);
  input.model.mesh = MeshKind::cells;
  OpenChoices open;
  open.method = open.mesh = false;
  const ChosenModel chosen = choose_model(input, open, false);
  EXPECT_EQ(chosen.input.model.mesh, MeshKind::cells);
  EXPECT_EQ(chosen.input.solver.method, Method::erk);
}

// The limit of fine meshes, from ten times as many elements as the wish needs.
TEST(AWish, IsMetByEveryEventOfAnElasticStrike) {
  Case finest = paper_run(SectionKind::elastic, 2e-3, 501, Method::exponential);
  finest.model.mesh = MeshKind::hermite;
  finest.model.elements = 1600;
  finest.solver.rtol = 1e-11;
  const Result limit = simulate(finest);
  for (const double wish : {1e-5, 1e-6, 1e-7}) {
    const WithinRun run = simulate_within(wishing(wish, SectionKind::elastic, 2e-3), {});
    ASSERT_TRUE(run.result.tolerance);
    EXPECT_TRUE(run.result.tolerance->met) << words_of(run.result.tolerance->reason);
    EXPECT_LE(run.result.tolerance->reached, wish);
    expect_same_starts(run.result, limit, 1e6 * wish);
    expect_same_ends(run.result, limit, 1e6 * wish);
    EXPECT_LT(mesh_count(run.input), 1600);
  }
}

// The first separation of the paper's beam that yields: 201.476 +- 0.006 us, from 1600 graded
// elements and 8007 cells.
TEST(AWish, FindsTheOpeningThatCoarseMeshesMiss) {
  const WithinRun run = simulate_within(wishing(0.3e-6, SectionKind::exact, 0.3e-3), {});
  EXPECT_TRUE(run.result.tolerance->met) << words_of(run.result.tolerance->reason);
  ASSERT_GE(run.result.sub_impacts.size(), 3u);
  EXPECT_NEAR(*run.result.sub_impacts[0].end, 201.476e-6, 0.3e-6);
  EXPECT_NEAR(run.result.sub_impacts[1].start, 203.297e-6, 0.3e-6);
}

TEST(AWish, ChoosesTheSameWhateverTheNumberOfJobs) {
  Case input = wishing(1e-6, SectionKind::exact, 1e-3);
  input.accuracy.work_limit = 3e7;
  const WithinRun alone = simulate_within(input, {});
  WithinOptions two;
  two.jobs = 2;
  const WithinRun beside = simulate_within(input, {}, two);
  EXPECT_EQ(mesh_count(alone.input), mesh_count(beside.input));
  expect_same(alone.result, beside.result);
  for (std::size_t i = 0; i < alone.result.sub_impacts.size(); ++i) {
    EXPECT_EQ(alone.result.sub_impacts[i].certain, beside.result.sub_impacts[i].certain) << i;
    EXPECT_EQ(alone.result.sub_impacts[i].end_error, beside.result.sub_impacts[i].end_error) << i;
  }
}

// A search whose runs are made up: each takes work in proportion to the square of its cells, and
// calls `n_certain` of four sub-impacts certain. Returns the work of all runs.
double work_of_search(const std::function<std::size_t(int cells)>& n_certain) {
  double work = 0.0;
  WithinOptions options;
  options.make = [&](const Case& input, const std::vector<CaseBeside>& cases, RowSink*, Result& run,
                     std::vector<RunBeside>& beside) {
    const auto made = [&](const Case& of) {
      Result result;
      result.outcome = {OutcomeKind::completed, of.end_time, "", {}};
      result.n_yielded_sections = 1;
      result.used.n_unknowns = static_cast<std::size_t>(of.model.segments);
      result.work.right_hand_sides = result.work.steps = 100L * of.model.segments;
      result.sub_impacts.resize(4);
      work += counted_work(of, result);
      return result;
    };
    run = made(input);
    for (const CaseBeside& other : cases) beside.push_back({other, made(other.input)});
    run.error_estimate.emplace();
    const std::size_t n = n_certain(input.model.segments);
    for (std::size_t i = 0; i < 4; ++i) run.sub_impacts[i].certain = i < n;
    if (n < 4) run.error_estimate->first_unresolved = n;
  };
  simulate_within(paper_run(SectionKind::exact, 1e-3), {}, options);
  return work;
}

TEST(ASearch, SpendsMoreWorkOnlyWhileItMakesMoreSubImpactsCertain) {
  const double growing = work_of_search([](int cells) { return cells < 400 ? 1 : 2; });
  EXPECT_GT(growing, 0.8 * work_limit_while_certainty_grows);
  EXPECT_LT(growing, 1.05 * work_limit_while_certainty_grows);
  const double constant = work_of_search([](int) { return 1; });
  EXPECT_GT(constant, 0.8 * default_work_limit);
  EXPECT_LT(constant, 1.05 * default_work_limit);
  EXPECT_LT(work_of_search([](int) { return 4; }), 0.1 * default_work_limit);
}

TEST(AWish, LeavesACaseThatRepeatsTheRunBitForBit) {
  const WithinRun run = simulate_within(wishing(2e-6, SectionKind::exact, 0.25e-3), {});
  expect_same(simulate(run.input), run.result);
}

TEST(AWish, ThatAFixedMeshCannotMeetNamesTheKeyInTheWay) {
  const Case input = wishing(1e-9, SectionKind::elastic, 1e-3, 101);
  OpenChoices open;
  open.mesh = open.size = false;
  const WithinRun run = simulate_within(input, open);
  EXPECT_TRUE(run.result.outcome.completed());
  ASSERT_TRUE(run.result.tolerance);
  EXPECT_FALSE(run.result.tolerance->met);
  EXPECT_EQ(run.result.tolerance->key, "model.segments");
  EXPECT_EQ(run.input.model.segments, 101);
}

TEST(AWish, ThatAFixedStepCannotMeetNamesThatKey) {
  Case input = wishing(1e-9, SectionKind::elastic, 0.4e-3, 501, Method::central_difference);
  input.solver.step = 1e-7;
  OpenChoices open;
  open.method = open.tolerance = false;
  const WithinRun run = simulate_within(input, open);
  EXPECT_FALSE(run.result.tolerance->met);
  EXPECT_EQ(run.result.tolerance->key, "solver.step") << words_of(run.result.tolerance->reason);
  EXPECT_EQ(run.input.solver.step, 1e-7);
}

TEST(AWish, StopsAtTheLimitOfWork) {
  Case input = wishing(1e-10, SectionKind::exact, 1e-3);
  input.accuracy.work_limit = 3e6;
  double work = 0.0;
  WithinOptions options;
  options.finished = [&](const Case& run, const Result& result) {
    work += counted_work(run, result);
  };
  const WithinRun run = simulate_within(input, {}, options);
  EXPECT_FALSE(run.result.tolerance->met);
  EXPECT_EQ(run.result.tolerance->key, "accuracy.work_limit");
  EXPECT_LE(work, 2.0 * 3e6);  // the limit holds for predicted work
}

TEST(AWish, BeginsOnACoarserMeshWhereTheUsualFirstOneIsAboveTheLimitAndRunsItOnce) {
  Case input = wishing(1e-10, SectionKind::exact, 1e-3);
  input.output.interval = 1e-5;
  const int usual = first_choice(input, {}).input.model.segments;
  input.accuracy.work_limit = 5e5;
  std::map<int, int> runs;  // by mesh
  double work = 0.0;
  WithinOptions options;
  options.finished = [&](const Case& run, const Result& result) {
    ++runs[run.model.segments];
    Result known_before = result;
    known_before.work.section_flows = 0;
    work += counted_work(run, known_before);
  };
  const WithinRun run = simulate_within(input, {}, options);
  EXPECT_LT(run.input.model.segments, usual);
  EXPECT_EQ(run.input.model.segments, first_choice(input, {}).input.model.segments);
  EXPECT_EQ(run.result.tolerance->key, "accuracy.work_limit");
  EXPECT_LE(work, 2.0 * 5e5);
  EXPECT_FALSE(run.result.history.empty());
  for (const auto& [segments, n] : runs) EXPECT_EQ(n, 1) << segments << " cells";
}

TEST(AWish, BeginsWhereMatricesOfModesAreAffordable) {
  Case input = elastic_case(1e-3, 501, Method::exponential);
  input.scene.beam.ends = {EndSupport::clamped, EndSupport::free};  // no modes in closed form
  input.scene.beam.theory = BeamTheory::timoshenko;
  input.scene.beam.poisson = 0.3;
  input.scene.striker.position = 0.998;
  input.accuracy.work_limit = 1e9;
  input.accuracy.event_times = 1e-6;
  const Case first = first_choice(input, {}).input;
  EXPECT_GT(resolve(first).settings().decomposition, 1e7);
  EXPECT_LT(resolve(first).settings().decomposition, 1e9);
}

TEST(AWish, RunsTheBestCaseOnceMoreForItsRowsAndNotThoseBesideIt) {
  Case input = wishing(1e-5, SectionKind::elastic, 0.3e-3);  // met by the first level, without rows
  input.output.interval = 1e-6;
  input.output.shapes = 1e-5;
  std::map<std::pair<int, double>, int> runs;  // by mesh and tolerance
  WithinOptions options;
  options.finished = [&](const Case& run, const Result&) {
    ++runs[{run.model.elements, run.solver.rtol}];
  };
  const WithinRun run = simulate_within(input, {}, options);
  EXPECT_EQ(run.result.history.front().time, 0.0);
  for (const auto& [of, n] : runs) {
    const bool best = of == std::pair(run.input.model.elements, run.input.solver.rtol);
    EXPECT_EQ(n, best ? 2 : 1) << of.first << " elements, rtol " << of.second;
  }
  ASSERT_TRUE(run.result.error_estimate);
  const auto moment =
      std::ranges::find(run.result.error_estimate->totals, RunTotal::max_moment, &NamedTotal::name);
  ASSERT_NE(moment, run.result.error_estimate->totals.end());
  EXPECT_GT(moment->total.error.value_or(0.0), 0.0);
  EXPECT_LT(*moment->total.error, 0.05 * moment->total.value);
}

TEST(CasesBeside, AreCoarserInMeshAndTime) {
  Case input = paper_run(SectionKind::exact, 1e-3, 401, Method::central_difference);
  const std::vector<CaseBeside> cases = cases_beside(input);
  ASSERT_EQ(cases.size(), 3u);
  EXPECT_EQ(cases[0].input.model.segments, 341);
  EXPECT_EQ(cases[1].input.model.segments, 281);
  EXPECT_EQ(cases[2].input.model.segments, 201);
  EXPECT_TRUE(cases[1].of_existence);
  EXPECT_FALSE(cases[2].of_existence);
  EXPECT_EQ(cases[1].source, ErrorSource::mesh_and_time);
  EXPECT_GT(*resolve(cases[1].input).settings().step, 1.05 * *resolve(input).settings().step);
  input.solver.method = Method::erk;
  input.solver.rtol = 1e-7;
  EXPECT_NEAR(cases_beside(input).at(1).input.solver.rtol, 1e-6, 1e-12);
}

TEST(CasesBeside, OfAMeshThatResolvesContactsTwiceAreOneNearAndOneFar) {
  const Case fine = paper_run(SectionKind::exact, 1e-3, 2001, Method::central_difference);
  const std::vector<CaseBeside> cases = cases_beside(fine);
  ASSERT_EQ(cases.size(), 2u);
  EXPECT_EQ(cases[0].input.model.segments, 1701);
  EXPECT_EQ(cases[1].input.model.segments, 1001);
  EXPECT_TRUE(cases[0].of_existence);
  EXPECT_FALSE(cases[1].of_existence);
  Case elastic = fine;
  elastic.model.section = SectionKind::elastic;
  elastic.model.mesh = MeshKind::hermite;
  elastic.model.elements = 2000;
  elastic.solver.method = Method::exponential;
  EXPECT_EQ(cases_beside(elastic).size(), 3u);
}

TEST(CasesBeside, OfARigidBeamAreCoarserInTimeAlone) {
  Case input = paper_run(SectionKind::exact, 1e-3);
  input.model.mesh = MeshKind::rigid;
  const std::vector<CaseBeside> cases = cases_beside(input);
  ASSERT_EQ(cases.size(), 1u);
  EXPECT_EQ(cases[0].source, ErrorSource::time);
}

TEST(ASearch, ThatIsStoppedReturnsTheLastMeshThatWasFinished) {
  const Case input = wishing(1e-9, SectionKind::exact, 0.5e-3);
  WithinOptions options;
  int n_meshes = 0;
  options.announce = [&](const std::string&) { ++n_meshes; };
  options.progress = [&](double) { return n_meshes < 2; };
  const WithinRun run = simulate_within(input, {}, options);
  EXPECT_EQ(run.result.outcome.kind, OutcomeKind::stopped);
  EXPECT_TRUE(run.result.n_certain().has_value());
  EXPECT_NEAR(run.result.outcome.time, 0.5e-3, 1e-9);
}

}  // namespace
}  // namespace subimpact
