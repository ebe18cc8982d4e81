#include "model/section/section_field.h"

#include "paper_scene.h"
#include "random_walk.h"
#include "testing.h"

namespace subimpact {
namespace {

const Beam beam = paper_beam();

// Curvatures of all sections at every step of a random history: section i walks with its own reach,
// so that some never yield, some a little and some a lot.
std::vector<std::vector<double>> histories(std::size_t n_sections, std::size_t n_steps) {
  std::vector<std::vector<double>> steps(n_steps, std::vector<double>(n_sections));
  for (std::size_t i = 0; i < n_sections; ++i) {
    const double size = 0.2 + 6.0 * static_cast<double>(i) / static_cast<double>(n_sections);
    const auto seed = static_cast<unsigned>(i);
    const std::vector<double> walk = nested_walk(seed, n_steps, -size, size, size);
    for (std::size_t k = 0; k < n_steps; ++k) steps[k][i] = walk[k] * beam.yield_curvature();
  }
  return steps;
}

class SectionFieldOfBothLaws : public testing::TestWithParam<bool> {
 protected:
  SectionLaw law() const { return {beam, GetParam() ? Fibres::continuous() : Fibres::layered(40)}; }
};

INSTANTIATE_TEST_SUITE_P(Laws, SectionFieldOfBothLaws, testing::Bool(),
                         [](const auto& info) { return info.param ? "exact" : "layers"; });

TEST_P(SectionFieldOfBothLaws, IsTheLawOfEverySectionOnItsOwn) {
  for (const std::size_t n : {1u, 15u, 16u, 17u, 37u, 61u}) {
    SectionField field(n, law());
    std::vector<SectionHistory> alone(n);
    std::vector<double> moments(n);
    const std::vector<double> weights(n, 2.5e-3);
    for (const std::vector<double>& curvatures : histories(n, 500)) {
      field.moments(curvatures, moments);
      for (std::size_t i = 0; i < n; ++i) {
        ASSERT_NEAR(moments[i], law().moment(alone[i], curvatures[i]), 1e-13 * beam.yield_moment());
        law().commit(alone[i], curvatures[i]);
      }
      field.commit(curvatures);
      double elastic = 0.0, work = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        elastic += weights[i] * law().elastic_energy(alone[i], curvatures[i]);
        work += weights[i] * law().work(alone[i], curvatures[i]);
      }
      const BendingEnergies energies = field.energies(curvatures, weights);
      ASSERT_NEAR(energies.elastic, elastic, 1e-12 * work);
      ASSERT_NEAR(energies.plastic, work - elastic, 1e-12 * work);
    }
  }
}

TEST_P(SectionFieldOfBothLaws, CommitsTheSectionsListedByItsMomentsAsItCommitsAllCurvatures) {
  const std::size_t n = 61;
  SectionField by_list(n, law());
  SectionField by_curvatures(n, law());
  std::vector<double> moments(n);
  std::vector<SectionField::Outside> outside;
  for (const std::vector<double>& curvatures : histories(n, 200)) {
    by_list.moments(curvatures, moments, &outside);
    ASSERT_EQ(by_list.commit(outside), by_curvatures.commit(curvatures));
    ASSERT_EQ(by_list.n_yielded(), by_curvatures.n_yielded());
    for (std::size_t i = 0; i < n; ++i) {
      ASSERT_EQ(by_list.window_low()[i], by_curvatures.window_low()[i]);
      ASSERT_EQ(by_list.window_high()[i], by_curvatures.window_high()[i]);
      ASSERT_EQ(by_list.history(i).work, by_curvatures.history(i).work);
    }
  }
}

TEST_P(SectionFieldOfBothLaws, CountsTheSectionsThatHaveYieldedAndNoOthers) {
  const std::size_t n = 40;
  SectionField field(n, law());
  const double first_yield = law().window({}).high;
  std::vector<double> curvatures(n, 0.999 * first_yield);
  EXPECT_EQ(field.commit(curvatures), 0u);
  EXPECT_EQ(field.n_yielded(), 0u);
  curvatures[7] = 1.001 * first_yield;
  curvatures[39] = -3.0 * first_yield;
  EXPECT_EQ(field.commit(curvatures), 2u);
  for (double& curvature : curvatures) curvature *= 1.0 - 1e-12;
  EXPECT_EQ(field.commit(curvatures), 0u);  // reached already, to rounding
  EXPECT_EQ(field.n_yielded(), 2u);
  for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(field.has_yielded(i), i == 7 || i == 39) << i;
  curvatures[7] = 2.0 * first_yield;
  EXPECT_EQ(field.commit(curvatures), 1u);
  EXPECT_EQ(field.n_yielded(), 2u);
}

TEST_P(SectionFieldOfBothLaws, AskingForMomentsLeavesNoTrace) {
  const std::size_t n = 33;
  SectionField field(n, law());
  std::vector<double> before(n), after(n), ignored(n);
  const std::vector<double> weights(n, 1.0);
  const auto steps = histories(n, 60);
  for (std::size_t k = 0; k + 1 < steps.size(); ++k) {
    field.commit(steps[k]);
    field.moments(steps[k], before);
    field.moments(steps[k + 1], ignored);
    field.energies(steps[k + 1], weights);
    field.moments(steps[k], after);
    ASSERT_EQ(before, after);
  }
}

TEST(SectionField, OfAnElasticBeamIsLinearWithoutMemory) {
  const std::size_t n = 21;
  SectionField field(n, 7.0);
  EXPECT_FALSE(field.can_yield());
  const std::vector<double> curvatures = random_numbers(2, n, 1e6);
  std::vector<double> moments(n);
  field.moments(curvatures, moments);
  for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(moments[i], 7.0 * curvatures[i]);
  EXPECT_EQ(field.commit(curvatures), 0u);
  EXPECT_EQ(field.n_yielded(), 0u);
  const std::vector<double> weights(n, 0.1);
  double elastic = 0.0;
  for (const double k : curvatures) elastic += 0.1 * 3.5 * k * k;
  EXPECT_NEAR(field.energies(curvatures, weights).elastic, elastic, 1e-14 * elastic);
  EXPECT_EQ(field.energies(curvatures, weights).plastic, 0.0);
  EXPECT_EQ(field.outer_stress(3, 0.5, 10.0), -5.0);
}

}  // namespace
}  // namespace subimpact
