#include "model/flexural_frequencies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "paper_scene.h"

namespace subimpact {
namespace {

constexpr double last_digit = 1e-10;

void expect_wave_numbers(double slenderness, const std::vector<double>& expected) {
  const std::vector<double> found = free_free_wave_numbers(slenderness, expected.size());
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i], expected[i], last_digit) << "r = " << slenderness << ", mode " << i + 1;
  }
}

TEST(FreeFreeBeam, HasTheWaveNumbersOfEulerAndBernoulli) {
  expect_wave_numbers(0.0,
                      {4.7300407449, 7.8532046241, 10.9956078380, 14.1371654913, 17.2787596574});
}

TEST(FreeFreeBeam, HasTheWaveNumbersOfRayleigh) {
  const Beam beam =
      paper_beam();  // r = 0.003044240, whose further digits show in the last ones here
  expect_wave_numbers(beam.radius_of_gyration() / beam.length,
                      {4.7294986445, 7.8512239742, 10.9908523965, 14.1278561451, 17.2626944721});
  expect_wave_numbers(0.05,
                      {4.5937950806, 7.3924333414, 9.9896525818, 12.3640608084, 14.5370373882});
}

TEST(FreeFreeBeam, OfEulerAndBernoulliHasCosineTimesHyperbolicCosineOne) {
  for (const double beta : free_free_wave_numbers(0.0, 12)) {
    EXPECT_NEAR(std::cos(beta) - 1.0 / std::cosh(beta), 0.0, 1e-12);
  }
}

TEST(FreeFreeBeam, HighModesOfASlenderBeamLieHalfAWaveApart) {
  const std::vector<double> betas = free_free_wave_numbers(0.0, 40);
  for (std::size_t i = 10; i < betas.size(); ++i) {
    EXPECT_NEAR(betas[i], (static_cast<double>(i) + 1.5) * std::numbers::pi, 1e-11);
  }
}

TEST(FreeFreeBeam, OfThePaperHasItsFrequencies) {
  const std::vector<double> rayleigh{80.167140, 220.922990, 432.941214, 715.350208, 1068.029744};
  const std::vector<double> slender{80.185519, 221.034470, 433.315938, 716.293258, 1070.018551};
  Beam beam = paper_beam();
  const double turn = 2.0 * std::numbers::pi;
  const std::vector<double> found = free_free_frequencies(beam, 5);
  beam.theory = BeamTheory::euler_bernoulli;
  const std::vector<double> found_slender = free_free_frequencies(beam, 5);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(found[i] / turn, rayleigh[i], 0.6e-6);
    EXPECT_NEAR(found_slender[i] / turn, slender[i], 0.6e-6);
  }
}

TEST(FreeFreeBeam, OfThePaperHasTheSlendernessOfTheTables) {
  const Beam beam = paper_beam();
  EXPECT_NEAR(beam.radius_of_gyration() / beam.length, 0.003044240, 0.5e-9);
  EXPECT_NEAR(beam.mass(), 0.2260549, 0.5e-7);
}

}  // namespace
}  // namespace subimpact
