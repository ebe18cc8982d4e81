// Beams on supports, over whole runs.

#include "paper_case.h"

namespace subimpact {
namespace {

Case supported_case(SectionKind section, EndSupport first, EndSupport second) {
  Case input = paper_case(section, 0.6e-3, 101);
  input.scene.beam.ends = {first, second};
  input.output.interval = 1e-5;
  return input;
}

class Supports : public testing::TestWithParam<Ends> {};

INSTANTIATE_TEST_SUITE_P(, Supports,
                         testing::Values(Ends{pinned, pinned}, Ends{clamped, clamped},
                                         Ends{clamped, free_end}, Ends{pinned, clamped}),
                         NamedAsPrinted{});

TEST_P(Supports, KeepTheEnergyAndSayThatMomentumIsNotKept) {
  const auto [first, second] = GetParam();
  const Result result = completed(supported_case(SectionKind::exact, first, second));
  EXPECT_GE(result.sub_impacts.size(), 3u);
  EXPECT_LT(result.max_energy_error, 1e-8);
  EXPECT_FALSE(result.max_momentum_error.has_value());
  for (const HistoryRow& row : result.history) EXPECT_FALSE(row.momentum_error.has_value());
  EXPECT_EQ(result.used.half_model, first == second);
}

TEST_P(Supports, AreTheSameToOscillatorsAndToRungeKutta) {
  const auto [first, second] = GetParam();
  Case input = supported_case(SectionKind::elastic, first, second);
  const Result here = simulate(input);
  input.solver.method = Method::exponential;
  const Result there = simulate(input);
  expect_same_starts(here, there, 1e-4);
}

TEST(AFreeBeamSupports, NothingSoItsMomentumIsKept) {
  const Result result = simulate(supported_case(SectionKind::exact, free_end, free_end));
  ASSERT_TRUE(result.max_momentum_error.has_value());
  EXPECT_LT(*result.max_momentum_error, 1e-12);
}

TEST(SupportsAlike, LeaveTheHalfModelRight) {
  for (const EndSupport end : {pinned, clamped}) {
    Case input = supported_case(SectionKind::exact, end, end);
    input.solver.step = 1e-7;
    const Result half = simulate(input);
    input.model.symmetry = SymmetryUse::off;
    const Result whole = simulate(input);
    EXPECT_NE(half.used.half_model, whole.used.half_model);
    expect_same_starts(half, whole, 1e-6);
    EXPECT_NEAR(half.beam_mean_velocity, whole.beam_mean_velocity, 1e-8);
  }
}

// From a far support nothing has come back before the wave has gone there and back.
TEST(FarSupports, AreNotFeltBeforeTheirEchoArrives) {
  Case input = supported_case(SectionKind::elastic, free_end, free_end);
  input.end_time = 20e-6;
  const Result free_beam = simulate(input);
  input.scene.beam.ends = {clamped, clamped};
  const Result clamped_beam = simulate(input);
  EXPECT_NEAR(free_beam.striker_velocity, clamped_beam.striker_velocity, 1e-9);
}

TEST(ZonesOfASupportedBeam, AreJudgedByItsOwnFirstPeriod) {
  const Beam beam = paper_scene().beam;
  const ResolvedSettings used =
      resolve(supported_case(SectionKind::elastic, pinned, pinned)).settings();
  const double r = beam.radius_of_gyration();
  const double wave = M_PI / beam.length;
  const double omega =
      wave * wave *
      std::sqrt(beam.bending_stiffness() / beam.mass_per_length() / (1.0 + r * r * wave * wave));
  EXPECT_NEAR(used.first_period, 2.0 * M_PI / omega, 1e-12);
}

}  // namespace
}  // namespace subimpact
