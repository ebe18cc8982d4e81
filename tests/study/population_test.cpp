#include "subimpact/study/population.h"
#include "elastic_case.h"
#include "refusal.h"
#include "subimpact/study/sensitivity/predictability.h"
#include "testing.h"

namespace subimpact {
namespace {

const Case base = elastic_case(1e-3);

Population two_axes() {
  Population population;
  population.axes = {{{"striker.mass"}, {{0.1}, {0.2}, {0.4}}},
                     {{"beam.width", "beam.thickness"}, {{0.01, 0.02}, {0.02, 0.01}}}};
  return population;
}

double value_of(const Population& population, std::size_t number, const std::string& key) {
  for (const auto& [name, value] : population.settings(base, number)) {
    if (name == key) return std::get<double>(value);
  }
  return NAN;
}

std::string refused_key(const Population& population) {
  return refusal_of([&] { check(population, base); }).key;
}

TEST(Population, IsEveryCombinationTheLastAxisFastest) {
  const Population population = two_axes();
  ASSERT_EQ(population.size(), 6u);
  EXPECT_EQ(population.keys(),
            (std::vector<std::string>{"striker.mass", "beam.width", "beam.thickness"}));
  EXPECT_EQ(value_of(population, 3, "striker.mass"), 0.2);
  EXPECT_EQ(value_of(population, 3, "beam.width"), 0.02);
  EXPECT_EQ(value_of(population, 3, "beam.thickness"), 0.01);
  EXPECT_EQ(refused_key(population), "");
}

TEST(Population, WithoutAxesIsTheBaseCase) {
  EXPECT_EQ(Population().size(), 1u);
  EXPECT_TRUE(Population().settings(base, 0).empty());
}

TEST(Population, HasTheSameSamplesAtEveryCombination) {
  Population population = two_axes();
  population.scatter = {{"striker.velocity", 0.01}, {"striker.mass", 0.1}};
  population.n_samples = 5;
  ASSERT_EQ(population.size(), 30u);
  for (std::size_t sample = 0; sample < 5; ++sample) {
    const double velocity = value_of(population, sample, "striker.velocity");
    EXPECT_NE(velocity, base.scene.striker.velocity);
    EXPECT_EQ(value_of(population, 5 + sample, "striker.velocity"), velocity);
    // About the value of the axis.
    EXPECT_DOUBLE_EQ(value_of(population, 10 + sample, "striker.mass"),
                     2.0 * value_of(population, sample, "striker.mass"));
  }
}

TEST(Population, ScattersByTheDeviationAskedForAndNotBeyondTheRangeOfAKey) {
  Population population;
  population.scatter = {{"striker.velocity", 0.05}, {"striker.position", 0.5}};
  population.n_samples = 10000;
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < population.n_samples; ++i) {
    const double shift =
        std::log(value_of(population, i, "striker.velocity") / base.scene.striker.velocity);
    sum += shift;
    squares += shift * shift;
    EXPECT_LE(value_of(population, i, "striker.position"), 1.0);
  }
  EXPECT_NEAR(sum / 1e4, 0.0, 4.0 * 0.05 / 100.0);
  EXPECT_NEAR(std::sqrt(squares / 1e4), 0.05, 0.05 * 0.03);
}

TEST(Population, IsAnotherOneWithAnotherSeed) {
  Population population;
  population.scatter = {{"striker.velocity", 0.05}};
  const double first = value_of(population, 0, "striker.velocity");
  population.seed = 2;
  EXPECT_NE(value_of(population, 0, "striker.velocity"), first);
}

TEST(Population, TakesTheScatterOfACaseWhereNumbersAreThere) {
  Case input = base;
  input.scene.beam.yield_stress = std::numeric_limits<double>::infinity();
  input.scatter = {{"striker.velocity", 0.01},
                   {"beam.width", 0.0},
                   {"beam.yield_stress", 0.02},
                   {"striker.gap", 0.1}};
  using Scatter = std::map<std::string, double>;
  EXPECT_EQ(scatter_of(input, {}), (Scatter{{"striker.velocity", 0.01}}));
  EXPECT_EQ(scatter_of(input, {{{"beam.yield_stress"}, {{1e8}, {2e8}}}}),
            (Scatter{{"beam.yield_stress", 0.02}, {"striker.velocity", 0.01}}));
}

TEST(Population, RefusesWhatIsNoPlanByItsKey) {
  Population population = two_axes();
  population.axes[0].keys = {"striker.mas"};
  EXPECT_EQ(refused_key(population), "striker.mas");
  population = two_axes();
  population.axes[0].points[1][0] = -1.0;
  EXPECT_EQ(refused_key(population), "striker.mass");
  population = two_axes();
  population.axes[1].points[1].pop_back();
  EXPECT_EQ(refused_key(population), "beam.width");
  population = two_axes();
  population.axes[0].keys = {"beam.width"};
  EXPECT_EQ(refused_key(population), "beam.width");
  population = two_axes();
  population.axes[0].points.clear();
  EXPECT_EQ(refused_key(population), "striker.mass");
  for (const auto& [key, deviation] :
       {std::pair("striker.velocity", 0.0), std::pair("beam.theory", 0.1)}) {
    population = two_axes();
    population.scatter = {{key, deviation}};
    EXPECT_EQ(refused_key(population), key);
  }
}

Case small_strike(double end_time) { return elastic_case(end_time, 101, Method::exponential); }

Sensitivity study_of(const Case& input) {
  return sensitivity(input, {{"striker.velocity", "beam.thickness"}, 2, {}, {}});
}

Result predicted(const Sensitivity& study, const Scatter& scatter) {
  Result result = study.base;
  set_predictability(result, study, scatter);
  return result;
}

TEST(Deviation, IsTheRootOfTheSumOfSquaresOverTheKeysThatScatter) {
  const std::vector<std::string> keys = {"a", "b", "c"};
  const std::vector<std::optional<Derivative>> by_key = {Derivative{3.0, 0.0},
                                                         Derivative{-4.0, 0.0}, std::nullopt};
  EXPECT_DOUBLE_EQ(*deviation_of(by_key, keys, {{"a", 0.1}, {"b", 0.1}}), 0.5);
  EXPECT_DOUBLE_EQ(*deviation_of(by_key, keys, {{"b", 0.1}, {"c", 0.0}}), 0.4);
  EXPECT_FALSE(deviation_of(by_key, keys, {{"c", 0.1}}));
}

TEST(Predictability, OfLittleScatterReachesTheEndWithDeviationsInProportion) {
  const Sensitivity study = study_of(small_strike(1e-3));
  ASSERT_GE(study.base.sub_impacts.size(), 5u);
  const Result once = predicted(study, {{"striker.velocity", 1e-6}});
  const Result twice = predicted(study, {{"striker.velocity", 2e-6}});
  EXPECT_FALSE(once.predictability->first_unpredictable) << once.predictability->reason;
  for (std::size_t i = 0; i < once.sub_impacts.size(); ++i) {
    if (!once.sub_impacts[i].end) continue;
    EXPECT_NEAR(*twice.sub_impacts[i].end_scatter, 2.0 * *once.sub_impacts[i].end_scatter, 1e-18);
  }
}

TEST(Predictability, EndsSoonerTheMoreTheNumbersScatter) {
  const Sensitivity study = study_of(small_strike(2e-3));
  double last = 1.0;
  for (const double deviation : {1e-6, 1e-3, 1e-2, 0.1, 0.5}) {
    const Result result =
        predicted(study, {{"striker.velocity", deviation}, {"beam.thickness", deviation}});
    EXPECT_LE(result.predictability->horizon, last) << deviation;
    last = result.predictability->horizon;
  }
  EXPECT_LT(last, 1e-3);
}

TEST(Predictability, OfAZonesImpulseIsThatOfTheStrikersVelocity) {
  const Sensitivity study = study_of(small_strike(1e-3));
  const Result result = predicted(study, {{"beam.thickness", 1e-3}});
  ASSERT_EQ(result.predictability->zones.size(), 1u);
  EXPECT_NEAR(*result.predictability->zones[0].impulse_scatter,
              study.input.scene.striker.mass * *result.predictability->striker_velocity_scatter,
              1e-15);
}

// Grazing contacts have derivatives that would scatter the striker's velocity beyond what its
// energy allows.
TEST(Predictability, KnowsNoDeviationThatIsMoreThanPossible) {
  Sensitivity study = study_of(small_strike(2e-3));
  for (SensitivityRow& row : study.rows) {
    for (auto& derivative : row.by_key) {
      if (derivative) derivative->value *= 100.0;
    }
  }
  const Scatter scatter = {{"striker.velocity", 0.5}, {"beam.thickness", 0.5}};
  const Striker& striker = study.input.scene.striker;
  const std::size_t last = study.base.sub_impacts.size() - 1;
  const SensitivityRow* row = study.find(EventQuantity::striker_velocity, last);
  ASSERT_NE(row, nullptr);
  EXPECT_GT(deviation_of(row->by_key, study.keys, scatter).value(), striker.velocity);
  const Result result = predicted(study, scatter);
  EXPECT_FALSE(result.predictability->striker_velocity_scatter);
  for (const Predictability::Zone& zone : result.predictability->zones) {
    EXPECT_LE(zone.impulse_scatter.value_or(0.0), striker.mass * striker.velocity);
  }
  for (const SubImpact& s : result.sub_impacts) EXPECT_LE(s.end_scatter.value_or(0.0), 1e-3);
}

TEST(Predictability, IsNotLookedForWithoutScatterThatHasAnEffect) {
  Case input = small_strike(1e-4);
  Result result = simulate(input);
  add_predictability(result, input);
  EXPECT_FALSE(result.predictability);
  input.scatter = {{"striker.gap", 0.1}, {"beam.length", 0.0}};
  add_predictability(result, input);
  EXPECT_FALSE(result.predictability);
  input.scatter["beam.length"] = 0.01;
  add_predictability(result, input);
  EXPECT_TRUE(result.predictability);
}

TEST(RunsOfAPopulation, HaveTheStandardDeviationsOfTheDerivatives) {
  const Sensitivity study = study_of(small_strike(3e-4));
  const Scatter scatter = {{"striker.velocity", 1e-3}, {"beam.thickness", 1e-3}};
  const Result result = predicted(study, scatter);
  const Population population{{}, scatter, 400, 1};
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < population.size(); ++i) {
    Case input = study.input;
    input.solver.rtol = 1e-9;
    for (const auto& [name, value] : population.settings(study.input, i)) {
      assign(input, *find_case_key(name), value);
    }
    const double later = *simulate(input).sub_impacts.at(0).end - *result.sub_impacts[0].end;
    sum += later;
    squares += later * later;
  }
  const double n = static_cast<double>(population.size());
  const double deviation = std::sqrt((squares - sum * sum / n) / (n - 1.0));
  // 400 samples leave 3.5 % of a standard deviation open.
  EXPECT_NEAR(deviation / *result.sub_impacts[0].end_scatter, 1.0, 0.1);
}

}  // namespace
}  // namespace subimpact
