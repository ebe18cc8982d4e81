// Scenes with gravity, loads, springs, stops and beams that move at the start: closed forms of
// rigid bodies and of elastic beams, accounts, agreement of methods, refusals.

#include "case/problem.h"
#include "paper_case.h"
#include "settings.h"
#include "simulate/run_parts.h"

namespace subimpact {
namespace {

Case elastic_case() {
  Case input = paper_run(SectionKind::elastic, 0.0, 501, Method::nystrom);
  input.scene.beam.yield_stress = std::numeric_limits<double>::infinity();
  input.scene.contact.kind = ContactKind::linear;
  input.scene.contact.stiffness = 2e6;
  input.scene.striker.nose_radius.reset();
  input.solver.rtol = 1e-12;
  return input;
}

Case rigid_case() {
  Case input = elastic_case();
  input.model.mesh = MeshKind::rigid;
  return input;
}

class ASceneByAMethod : public testing::TestWithParam<Method> {
 protected:
  Case with_method(Case input) const {
    input.solver.method = GetParam();
    const bool is_low = GetParam() == Method::dirk;
    input.solver.rtol = is_low ? 1e-11 : 1e-13;
    return input;
  }
};

INSTANTIATE_TEST_SUITE_P(, ASceneByAMethod,
                         testing::Values(Method::erk, Method::nystrom, Method::exponential,
                                         Method::dirk, Method::adams, Method::bdf),
                         NamedAsPrinted{});

TEST_P(ASceneByAMethod, DropsAMassOnAPlaneAgainAndAgain) {
  Case input = with_method(rigid_case());
  input.scene.beam.fixed = true;
  input.scene.gravity = 9.81;
  input.scene.striker.velocity = 0.3;
  input.scene.striker.gap = 2e-3;
  input.end_time = 0.16;
  const Result result = completed(input);
  ASSERT_EQ(result.sub_impacts.size(), 3u);
  const double g = input.scene.gravity;
  const double v1 = std::sqrt(0.3 * 0.3 + 2.0 * g * 2e-3);
  const double first = (v1 - 0.3) / g;
  const double w = std::sqrt(2e6 / input.scene.striker.mass);
  const double lasts = 2.0 * (M_PI - std::atan(v1 * w / g)) / w;
  const double deepest = g / (w * w) + std::hypot(g / (w * w), v1 / w);
  for (std::size_t n = 0; n < 3; ++n) {
    const SubImpact& contact = result.sub_impacts[n];
    if (n < 2) {
      EXPECT_NEAR(*contact.opening, v1 * v1 / (2.0 * g), 1e-9) << n;
    }
    const double start = first + static_cast<double>(n) * (lasts + 2.0 * v1 / g);
    EXPECT_NEAR(contact.start, start, 1e-9 * start) << n;
    EXPECT_NEAR(*contact.end - contact.start, lasts, 1e-9 * start) << n;
    EXPECT_NEAR(contact.max_indentation, deepest, 1e-8 * deepest) << n;
    EXPECT_NEAR(contact.impulse, input.scene.striker.mass * (2.0 * v1 + g * lasts), 1e-8) << n;
    EXPECT_NEAR(contact.striker_velocity, -v1, 1e-8) << n;
  }
  EXPECT_NEAR(*result.restitution, 1.0, 1e-8);
  EXPECT_LT(result.max_energy_error, 1e-8);
}

TEST_P(ASceneByAMethod, LetsGravityOnTwoFreeBodiesDropOutOfTheirContact) {
  Case input = with_method(rigid_case());
  input.scene.gravity = 50.0;
  input.scene.striker.velocity = 0.5;
  input.scene.striker.gap = 1e-3;
  input.end_time = 5e-3;
  const Result result = completed(input);
  ASSERT_EQ(result.sub_impacts.size(), 1u);
  const double m = input.scene.striker.mass, beam = input.scene.beam.mass();
  const double lasts = M_PI / std::sqrt(2e6 * (1.0 / m + 1.0 / beam));
  EXPECT_NEAR(result.sub_impacts[0].start, 2e-3, 1e-11);
  EXPECT_NEAR(*result.sub_impacts[0].end, 2e-3 + lasts, 1e-11);
  EXPECT_NEAR(*result.restitution, 1.0, 1e-9);
  ASSERT_TRUE(result.max_momentum_error);
  EXPECT_LT(*result.max_momentum_error, 1e-11);
  EXPECT_TRUE(result.no_more_contact);
}

TEST(AScene, OfARigidBeamOnOneSpringHasAFrequencyAndAModeWithout) {
  for (int i = 0; i <= 40; ++i) {
    Case input = rigid_case();
    input.scene.beam.springs = {{i / 40.0, 4043.34}};
    input.scene.striker.position = 1.0;
    const auto modes = problem_of(input).mesh->natural_modes(1.0);
    ASSERT_EQ(modes.size(), 2u);
    EXPECT_EQ(modes.frequencies[0], 0.0) << i;
    EXPECT_GT(modes.frequencies[1], 0.0) << i;
  }
}

TEST_P(ASceneByAMethod, ThrowsABeamOnASpringAgainstAStop) {
  Case input = with_method(rigid_case());
  const double spring = 4e4, v = 2.0, gap = 3e-3, k = 2e6;
  input.scene.striker = {};
  input.scene.striker.fixed = true;
  input.scene.striker.gap = gap;
  input.scene.beam.velocity = -v;
  input.scene.beam.springs = {{0.5, spring}};
  const double mass = input.scene.beam.mass();
  const double slow = std::sqrt(spring / mass), fast = std::sqrt((spring + k) / mass);
  const double touch = std::asin(gap * slow / v) / slow;
  const double v1 = std::sqrt(v * v - slow * slow * gap * gap);
  const double lasts = 2.0 / fast * std::atan(v1 / (fast * gap * spring / (k + spring)));
  // From the stop to the other side and back.
  const double away = (M_PI + 2.0 * std::asin(gap * slow / v)) / slow;
  input.end_time = touch + lasts + away + 0.5 * lasts;
  const Result result = completed(input);
  ASSERT_EQ(result.sub_impacts.size(), 2u);
  EXPECT_NEAR(result.sub_impacts[0].start, touch, 1e-9 * touch);
  EXPECT_NEAR(*result.sub_impacts[0].end, touch + lasts, 1e-9 * (touch + lasts));
  const double second = touch + lasts + away;
  EXPECT_NEAR(result.sub_impacts[1].start, second, 1e-9 * second);
  EXPECT_LT(result.max_energy_error, 1e-9);
  EXPECT_NEAR(*result.restitution, 1.0, 1e-8);
}

TEST_P(ASceneByAMethod, AccountsForALoadThatRisesAndIsTakenAway) {
  Case input = with_method(rigid_case());
  input.scene.striker.velocity = 1e-3;
  input.scene.striker.gap = 1.0;
  const double t1 = 1e-3, force = 30.0;
  input.scene.beam.forces = {{0.5, {{0.0, 0.0}, {t1, force}, {t1, 0.0}}}};
  input.end_time = 3e-3;
  const Result result = completed(input);
  EXPECT_TRUE(result.sub_impacts.empty());
  EXPECT_FALSE(result.restitution);
  const double v = 0.5 * force * t1 / input.scene.beam.mass();
  EXPECT_NEAR(result.beam_mean_velocity, v, 1e-10 * v);
  EXPECT_NEAR(result.final_energies.work, 0.5 * input.scene.beam.mass() * v * v, 1e-10);
  EXPECT_LT(result.max_energy_error, 1e-9);
  EXPECT_LT(*result.max_momentum_error, 1e-11);
}

class ASceneOnAMesh : public testing::TestWithParam<MeshKind> {
 protected:
  Case on_mesh(Case input) const {
    input.model.mesh = GetParam();
    input.model.segments = 101;
    input.model.elements = 20;
    if (GetParam() == MeshKind::spectral) {
      input.scene.beam.theory = BeamTheory::timoshenko;
      input.scene.beam.poisson = 0.3;
    }
    return input;
  }
};

INSTANTIATE_TEST_SUITE_P(, ASceneOnAMesh,
                         testing::Values(MeshKind::cells, MeshKind::hermite, MeshKind::spectral),
                         NamedAsPrinted{});

TEST_P(ASceneOnAMesh, HasTheFrequenciesOfABeddedBeam) {
  Case input = on_mesh(elastic_case());
  Beam& beam = input.scene.beam;
  if (GetParam() == MeshKind::spectral) return;  // no closed form with shear here
  beam.ends = {pinned, pinned};
  beam.foundation = 5e6;
  const Problem problem = problem_of(input);
  const NaturalModes modes = problem.mesh->natural_modes(beam.bending_stiffness());
  const double size = beam.length / (GetParam() == MeshKind::cells ? 101.0 : 20.0);
  for (int n = 1; n <= 3; ++n) {  // of the half model: 1, 3, 5
    const double b = (2 * n - 1) * M_PI / beam.length;
    const double squared = (beam.bending_stiffness() * std::pow(b, 4) + beam.foundation) /
                           (beam.mass_per_length() + beam.rotary_inertia() * b * b);
    // Orders 2 and 4.
    const double tolerance =
        GetParam() == MeshKind::cells ? 0.1 * std::pow(b * size, 2) : 1e-3 * std::pow(b * size, 4);
    EXPECT_NEAR(modes.frequencies[static_cast<std::size_t>(n - 1)], std::sqrt(squared),
                tolerance * std::sqrt(squared));
  }
}

TEST_P(ASceneOnAMesh, StartsFromTheEquilibriumOfItsWeight) {
  Case input = on_mesh(elastic_case());
  Beam& beam = input.scene.beam;
  beam.ends = {pinned, pinned};
  beam.start = BeamStart::equilibrium;
  input.scene.gravity = 9.81;
  input.scene.striker.gap = 1e-3;
  input.scene.striker.velocity = 0.5;
  input.output.interval = 1e-4;
  input.end_time = 3e-3;
  const double q = beam.mass_per_length() * input.scene.gravity;
  double expected = 5.0 * q * std::pow(beam.length, 4) / (384.0 * beam.bending_stiffness());
  if (beam.shears()) expected += q * beam.length * beam.length / (8.0 * beam.shear_stiffness());
  const double tolerance = GetParam() == MeshKind::cells ? 1e-3 : 1e-9;
  for (const Method method : {Method::nystrom, Method::exponential}) {
    input.solver.method = method;
    const Result result = completed(input);
    ASSERT_FALSE(result.sub_impacts.empty());
    int n_before = 0;
    for (const HistoryRow& row : result.history) {
      if (row.time >= result.sub_impacts[0].start) break;
      ++n_before;
      EXPECT_NEAR(row.struck_displacement, expected, tolerance * expected) << row.time;
      EXPECT_NEAR(*row.first_reaction, -0.5 * q * beam.length, 2e-2 * q * beam.length);
    }
    EXPECT_GE(n_before, 10);
    const double touch = (std::sqrt(0.25 + 2.0 * 9.81 * 1e-3) - 0.5) / 9.81;
    EXPECT_NEAR(result.sub_impacts[0].start, touch, 1e-9 * touch);
  }
}

TEST_P(ASceneOnAMesh, TurnsAsARigidBodyUntilItMeetsAStop) {
  Case input = on_mesh(elastic_case());
  Beam& beam = input.scene.beam;
  beam.ends = {pinned, free_end};
  beam.angular_velocity = -3.0;
  input.scene.striker = {};
  input.scene.striker.fixed = true;
  input.scene.striker.position = 0.8;
  input.scene.striker.gap = 2e-3;
  input.end_time = 6e-3;
  const double touch = 2e-3 / (3.0 * 0.8 * beam.length);
  std::vector<double> ends;
  for (const Method method : {Method::nystrom, Method::erk, Method::exponential}) {
    input.solver.method = method;
    const Result result = completed(input);
    ASSERT_FALSE(result.sub_impacts.empty());
    EXPECT_NEAR(result.sub_impacts[0].start, touch, 1e-9 * touch);
    ends.push_back(*result.sub_impacts[0].end);
    EXPECT_NEAR(ends.back(), ends.front(), 1e-10);
    EXPECT_LT(result.max_energy_error, 1e-8);
  }
}

TEST(AScene, OfAFreeBeamOnAStopBalancesItsImpulseAndItsForce) {
  Case input = elastic_case();
  input.model.mesh = MeshKind::hermite;
  input.model.elements = 30;
  input.scene.striker = {};
  input.scene.striker.fixed = true;
  input.scene.beam.velocity = -2.0;
  input.scene.gravity = -9.81;
  input.end_time = 4e-3;
  const Result result = completed(input);
  EXPECT_LT(result.max_impulse_error, 1e-9);
  EXPECT_GT(result.impulse(), 0.5 * input.scene.beam.mass() * 2.0);
  EXPECT_FALSE(result.max_momentum_error);
}

TEST(AScene, ProvesNoMoreContactUnderGravityOnlyWhereItMayBe) {
  Case input = elastic_case();
  input.model.mesh = MeshKind::hermite;
  input.model.elements = 20;
  input.scene.striker.velocity = 2.0;
  input.scene.striker.mass = 0.01;
  input.end_time = 2e-2;
  input.scene.gravity = 9.81;
  EXPECT_TRUE(simulate(input).no_more_contact) << "a free beam falls as the striker does";
  input.scene.beam.ends = {clamped, clamped};
  EXPECT_FALSE(simulate(input).no_more_contact) << "the striker falls back on a held beam";
  input.scene.gravity = -9.81;
  EXPECT_TRUE(simulate(input).no_more_contact) << "the striker falls away from a held beam";
  input.scene.beam.forces = {{0.5, {{0.0, 0.0}, {1.0, 1.0}}}};
  EXPECT_FALSE(simulate(input).no_more_contact) << "the load still changes";
}

TEST(AScene, SaysHowFarTheGapHasFallenWhereTheNextTouchIsStillToCome) {
  Case input = rigid_case();
  input.scene.beam.fixed = true;
  input.scene.gravity = 9.81;
  input.scene.striker.velocity = 0.3;
  const double touch = 2.0 * 0.3 / 9.81;  // after a flight from the first parting, about
  for (const double share : {0.3, 0.8}) {
    input.end_time = share * touch;
    const Result result = completed(input);
    ASSERT_EQ(result.sub_impacts.size(), 1u);
    EXPECT_EQ(result.closest_approach.has_value(), share > 0.5) << "the gap grows at first";
    if (!result.closest_approach) continue;
    const double t = input.end_time - *result.sub_impacts[0].end;
    EXPECT_NEAR(result.closest_approach->gap, 0.3 * t - 0.5 * 9.81 * t * t, 1e-7);
    EXPECT_EQ(result.closest_approach->time, input.end_time);
  }
}

TEST(AScene, SaysThatABodyAtRestOnAnotherIsAContactWithoutEnd) {
  Case input = rigid_case();
  input.scene.beam.fixed = true;
  input.scene.gravity = 9.81;
  input.scene.striker.velocity = 1e-4;
  input.scene.contact.damping = 100.0;
  input.solver.method = Method::erk;
  input.end_time = 0.1;
  EXPECT_TRUE(simulate(input).rests_since);
}

TEST(AScene, ThatCannotBeIsRefusedWithItsReason) {
  const KeyValue equilibrium = "equilibrium";
  const std::tuple<const char*, const char*, Settings> refused[] = {
      {"striker.mass", "stop", {{"striker.fixed", true}}},
      {"striker.velocity", "drop_height", {{"striker.drop_height", 1.0}}},
      {"beam.fixed", "rigid", {{"beam.fixed", true}}},
      {"beam.velocity",
       "clamped",
       {{"beam.velocity", -1.0}, {"beam.ends", Names{"clamped", "free"}}}},
      {"beam.velocity",
       "pinned end",
       {{"beam.velocity", -1.0}, {"beam.ends", Names{"free", "pinned"}}}},
      {"beam.start", "nothing holds", {{"scene.gravity", 9.81}, {"beam.start", equilibrium}}},
      {"beam.start", "no load", {{"beam.start", equilibrium}}},
      {"beam.start",
       "yield curvature",
       {{"beam.ends", Names{"pinned", "pinned"}},
        {"beam.yield_stress", 1e6},
        {"model.section", "exact"},
        {"beam.load", 1e3},
        {"beam.start", equilibrium}}},
      {"beam.velocity", "do not approach", {{"beam.velocity", 1000.0}}},
  };
  for (const auto& [key, words, settings] : refused) {
    SCOPED_TRACE(words);
    Case input = elastic_case();
    input.end_time = 1e-3;
    expect_refused(changed(input, settings), key, words);
  }
}

}  // namespace
}  // namespace subimpact
