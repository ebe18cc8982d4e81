#include "model/mesh/modes.h"

#include "paper_scene.h"
#include "testing.h"

namespace subimpact {
namespace {

constexpr double last_digit = 1e-10;

constexpr Ends pinned_pinned{pinned, pinned};
constexpr Ends clamped_clamped{clamped, clamped};
constexpr Ends clamped_pinned{clamped, pinned};
constexpr Ends clamped_free{clamped, free_end};
constexpr Ends pinned_free{pinned, free_end};

void expect_wave_numbers(double slenderness, const std::vector<double>& expected,
                         const Ends& ends = free_ends) {
  const std::vector<double> found = flexural_wave_numbers(slenderness, ends, expected.size());
  SCOPED_TRACE(slenderness);
  expect_near(found, expected, last_digit);
}

TEST(FreeFreeBeam, HasTheWaveNumbersOfEulerAndBernoulli) {
  expect_wave_numbers(0.0,
                      {4.7300407449, 7.8532046241, 10.9956078380, 14.1371654913, 17.2787596574});
}

TEST(FreeFreeBeam, HasTheWaveNumbersOfRayleigh) {
  const Beam beam = paper_beam();  // whose slenderness shows in the last digits here
  EXPECT_NEAR(beam.radius_of_gyration() / beam.length, 0.003044240, 0.5e-9);
  EXPECT_NEAR(beam.mass(), 0.2260549, 0.5e-7);
  expect_wave_numbers(beam.radius_of_gyration() / beam.length,
                      {4.7294986445, 7.8512239742, 10.9908523965, 14.1278561451, 17.2626944721});
  expect_wave_numbers(0.05,
                      {4.5937950806, 7.3924333414, 9.9896525818, 12.3640608084, 14.5370373882});
}

TEST(FreeFreeBeam, OfEulerAndBernoulliHasCosineTimesHyperbolicCosineOne) {
  for (const double beta : flexural_wave_numbers(0.0, free_ends, 12)) {
    EXPECT_NEAR(std::cos(beta) - 1.0 / std::cosh(beta), 0.0, 1e-12);
  }
}

TEST(FreeFreeBeam, HighModesOfASlenderBeamLieHalfAWaveApart) {
  const std::vector<double> betas = flexural_wave_numbers(0.0, free_ends, 40);
  for (std::size_t i = 10; i < betas.size(); ++i) {
    EXPECT_NEAR(betas[i], (static_cast<double>(i) + 1.5) * std::numbers::pi, 1e-11);
  }
}

TEST(FreeFreeBeam, OfThePaperHasItsFrequencies) {
  const std::vector<double> rayleigh{80.167140, 220.922990, 432.941214, 715.350208, 1068.029744};
  const std::vector<double> slender{80.185519, 221.034470, 433.315938, 716.293258, 1070.018551};
  Beam beam = paper_beam();
  const double turn = 2.0 * std::numbers::pi;
  const std::vector<double> found = flexural_frequencies(beam, 5);
  beam.theory = BeamTheory::euler_bernoulli;
  const std::vector<double> found_slender = flexural_frequencies(beam, 5);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(found[i] / turn, rayleigh[i], 0.6e-6);
    EXPECT_NEAR(found_slender[i] / turn, slender[i], 0.6e-6);
  }
}

TEST(SupportedBeam, HasTheWaveNumbersOfEulerAndBernoulli) {
  expect_wave_numbers(0.0, {4.7300407449, 7.8532046241, 10.9956078380}, clamped_clamped);
  expect_wave_numbers(0.0, {3.9266023120, 7.0685827456, 10.2101761228}, clamped_pinned);
  expect_wave_numbers(0.0, {3.9266023120, 7.0685827456, 10.2101761228}, pinned_free);
  expect_wave_numbers(0.0, {1.8751040687, 4.6940911330, 7.8547574382}, clamped_free);
}

TEST(SupportedBeam, DoesNotDependOnTheSideItIsLookedAtFrom) {
  for (const Ends& ends : {clamped_pinned, clamped_free, pinned_free}) {
    expect_near(flexural_wave_numbers(0.03, ends, 8),
                flexural_wave_numbers(0.03, {ends[1], ends[0]}, 8), last_digit);
  }
}

TEST(PinnedPinnedBeam, OfRayleighHasSinesForModes) {
  for (const double r : {0.0, 0.003, 0.05}) {
    const std::vector<double> found = flexural_wave_numbers(r, pinned_pinned, 6);
    for (std::size_t k = 1; k <= found.size(); ++k) {
      const double wave = static_cast<double>(k) * std::numbers::pi;
      EXPECT_NEAR(found[k - 1], wave / std::pow(1.0 + r * r * wave * wave, 0.25), last_digit);
    }
  }
}

TEST(ClampedClampedBeam, OfRayleighSatisfiesItsFrequencyEquationsInHalves) {
  for (const double r : {0.003, 0.05}) {
    const std::vector<double> found = flexural_wave_numbers(r, clamped_clamped, 6);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double b4 = std::pow(found[i], 4);
      const double inertia = b4 * r * r;
      const double a = std::sqrt(0.5 * (inertia + std::sqrt(inertia * inertia + 4.0 * b4)));
      const double b = found[i] * found[i] / a;
      const double sine = std::sin(0.5 * a);
      const double cosine = std::tanh(0.5 * b) * std::cos(0.5 * a);
      const bool symmetric = i % 2 == 0;
      EXPECT_NEAR(symmetric ? a * sine + b * cosine : b * sine - a * cosine, 0.0, 1e-8)
          << "r = " << r << ", mode " << i + 1;
    }
  }
}

}  // namespace
}  // namespace subimpact
