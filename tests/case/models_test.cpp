// What models of a scene have and where they end.

#include "paper_case.h"
#include "rigid_case.h"

namespace subimpact {
namespace {

TEST(APadThickerThanTheBeam, IsASpringThatGivesWayAsFarAsItMust) {
  Case input = rigid_case(ContactKind::linear, 2.0, 0.1);
  input.scene.contact.stiffness = 2e3;
  const Result result = simulate(input);
  ASSERT_TRUE(result.outcome.completed()) << result.outcome.message;
  const double depth = 2.0 * std::sqrt(reduced_mass(input) / 2e3);
  EXPECT_GT(depth, input.scene.beam.height());
  EXPECT_NEAR(result.max_indentation, depth, 1e-6 * depth);
}

// From a far support nothing has come back before the wave has gone there and back.
TEST(FarSupports, AreNotFeltBeforeTheirEchoArrives) {
  Case input = paper_case(SectionKind::elastic, 20e-6, 101);
  const Result free_beam = simulate(input);
  input.scene.beam.ends = {clamped, clamped};
  const Result clamped_beam = simulate(input);
  EXPECT_NEAR(free_beam.striker_velocity, clamped_beam.striker_velocity, 1e-9);
}

TEST(ZonesOfASupportedBeam, AreJudgedByItsOwnFirstPeriod) {
  Case input = paper_case(SectionKind::elastic, 0.6e-3, 101);
  input.scene.beam.ends = {pinned, pinned};
  const Beam& beam = input.scene.beam;
  const ResolvedSettings used = resolve(input).settings();
  const double r = beam.radius_of_gyration();
  const double wave = M_PI / beam.length;
  const double omega =
      wave * wave *
      std::sqrt(beam.bending_stiffness() / beam.mass_per_length() / (1.0 + r * r * wave * wave));
  EXPECT_NEAR(used.first_period, 2.0 * M_PI / omega, 1e-12);
}

}  // namespace
}  // namespace subimpact
