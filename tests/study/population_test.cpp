#include "subimpact/study/population.h"

#include "elastic_case.h"
#include "refusal.h"
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

}  // namespace
}  // namespace subimpact
