// What is forecast of the runs that run_as_asked() makes, beside what it then does.

#include "subimpact/study/forecast.h"

#include <random>

#include "elastic_case.h"
#include "paper_run.h"
#include "simulate/settings/methods.h"
#include "study/parallel.h"
#include "subimpact/study/judgement/judgement.h"
#include "subimpact/study/other_mesh.h"
#include "subimpact/study/refinement/within.h"
#include "testing.h"

namespace subimpact {
namespace {

using Runs = std::vector<std::string>;

std::string words(const std::string& mesh, const std::string& method) {
  return mesh + " by " + method;
}

Runs runs_made(const Case& input, std::vector<double>* work = nullptr) {
  Runs runs;
  RunRequest request;
  request.finished = [&](const Case& run, const Result& result) {
    runs.push_back(words(mesh_words(run), descriptor_of(run.solver.method).name));
    if (work) work->push_back(counted_work(run, result));
  };
  run_as_asked(input, {}, std::move(request));
  return runs;
}

Runs runs_forecast(const ForecastCost& cost) {
  Runs runs;
  for (const ForecastRun& run : cost.runs) runs.push_back(words(run.mesh, run.method));
  return runs;
}

Case coarse(Case input) {
  input.output.keep_no_rows();
  return input;
}

TEST(AForecast, OfLevelsThatAreCheapHasTheRunsThatAreMade) {
  const Case input = coarse(elastic_case(0.5e-3));
  const RunForecast found = forecast(input, {}, 1);
  EXPECT_EQ(runs_forecast(found.expected), runs_made(input));
  EXPECT_TRUE(std::ranges::all_of(found.expected.runs, &ForecastRun::is_made));
}

TEST(AForecast, HasTheMeshesOfLevelsThatItDoesNotMakeUpToTheLimitOfWork) {
  Case input = coarse(paper_run(SectionKind::exact, 1e-3));
  input.accuracy.event_times = 1e-9;
  input.accuracy.work_limit = 1e9;
  const RunForecast found = forecast(input, {}, 1);
  EXPECT_FALSE(found.expected.runs.at(12).is_made);  // of the fourth level
  EXPECT_EQ(found.expected.runs.back().level, 5);
  std::vector<double> work;
  const Runs made = runs_made(input, &work);
  ASSERT_EQ(runs_forecast(found.expected), made);
  for (std::size_t i = 0; i < made.size(); ++i) {
    EXPECT_LT(std::abs(std::log(found.expected.runs[i].work / work[i])), std::log(1.5)) << made[i];
  }
  EXPECT_LE(found.least.runs.size(), made.size());
  EXPECT_LT(found.least.processor_seconds, found.most.processor_seconds);
}

TEST(AForecast, EndsWithALevelThatItDoesNotMakeWhereErrorsFallBelowTheTolerance) {
  Case input = coarse(paper_run(SectionKind::exact, 1e-3));
  input.accuracy.event_times = 0.1e-6;
  const RunForecast found = forecast(input, {}, 1);
  EXPECT_FALSE(found.expected.runs.at(12).is_made);  // of the fourth level
  EXPECT_EQ(runs_forecast(found.expected), runs_made(input));
}

TEST(AForecast, FollowsTheChangeToElementsWhereNoSectionYields) {
  Case input = coarse(paper_run(SectionKind::exact, 0.3e-3));
  input.scene.beam.yield_stress = 3e9;
  EXPECT_EQ(runs_forecast(forecast(input, {}, 1).expected), runs_made(input));
}

TEST(AForecast, OfAFixedMeshAndMethodHasASingleLevel) {
  const Case input = coarse(paper_run(SectionKind::exact, 0.1e-3, 101, Method::central_difference));
  const GivenKeys given{{"model.segments", "solver.method"}, {}};
  const RunForecast found = forecast(input, given, 1);
  EXPECT_EQ(found.expected.runs.size(), 1 + cases_beside_on_given_mesh(input).size());
  for (const ForecastRun& run : found.expected.runs) EXPECT_EQ(run.level, 1);
  EXPECT_EQ(runs_forecast(found.least), runs_forecast(found.most));
}

TEST(AForecast, DoesNotMakeARunThatTakesLong) {
  Case input = coarse(paper_run(SectionKind::elastic, 0.5, 2001, Method::central_difference));
  const GivenKeys given{{"model.segments", "solver.method"}, {}};
  const RunForecast found = forecast(input, given, 2);
  EXPECT_TRUE(std::ranges::none_of(found.expected.runs, &ForecastRun::is_made));
  // Steps of 1000 unknowns, by two processors.
  const double steps = input.end_time / *resolve(input).settings().step;
  EXPECT_NEAR(found.expected.runs[0].work, 1001.0 * steps, 0.01 * 1001.0 * steps);
  input.model.section = SectionKind::exact;  // sections that flow are counted besides
  EXPECT_GT(forecast(input, given, 2).expected.runs[0].work, 1.01 * 1001.0 * steps);
  EXPECT_GT(found.expected.processor_seconds, 1.0);
  EXPECT_LT(found.expected.wall_seconds, found.expected.processor_seconds);
}

TEST(AForecast, OfMoreJobsHasMoreMemoryAndTheSameRuns) {
  const Case input = coarse(elastic_case(0.5e-3));
  const RunForecast one = forecast(input, {}, 1), four = forecast(input, {}, 4);
  EXPECT_GT(four.memory, one.memory);
  EXPECT_EQ(runs_forecast(one.expected), runs_forecast(four.expected));
}

TEST(WallTime, IsTheSumOfTheRunsForOneJobAndFallsWithMore) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> seconds(0.1, 3.0);
  for (int i = 0; i < 100; ++i) {
    std::vector<double> runs(4);
    for (double& run : runs) run = seconds(random);
    double before = wall_seconds(runs, 1);
    EXPECT_DOUBLE_EQ(before, runs[0] + runs[1] + runs[2] + runs[3]);
    for (Jobs jobs = 2; jobs <= 4; ++jobs) {
      const double now = wall_seconds(runs, jobs);
      EXPECT_LT(now, before + 1e-12);
      before = now;
    }
    EXPECT_DOUBLE_EQ(before, *std::ranges::max_element(runs));
  }
}

}  // namespace
}  // namespace subimpact
