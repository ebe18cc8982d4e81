// Beams that are struck again: at rest in their residual shape, or as they move.

#include "case/problem.h"
#include "paper_run.h"
#include "print.h"
#include "runs.h"
#include "settings.h"
#include "subimpact/study/run_as_asked.h"

namespace subimpact {
namespace {

struct RestingBeam {
  const char* name;
  Settings settings = {};
};
void PrintTo(const RestingBeam& beam, std::ostream* out) { *out << beam.name; }

Case paper_strike(double end_time) {
  Case input = paper_run(SectionKind::exact, end_time, 301, Method::central_difference);
  input.output.interval.reset();
  return input;
}

// The shape at the instant at which the next strike begins.
std::vector<ShapeRow> shape_at_rest(Case input, const Result& before) {
  input.parts.start = before.end_state;
  input.at_rest = true;
  input.end_time = 2e-5;
  const Result next = completed(input);
  EXPECT_EQ(next.sub_impacts.front().start, 0.0);
  std::vector<ShapeRow> shape;
  std::ranges::copy_if(next.shapes, std::back_inserter(shape),
                       [](const ShapeRow& row) { return row.time == 0.0; });
  return shape;
}

class RestingBeams : public testing::TestWithParam<RestingBeam> {};

const RestingBeam free_of_moments[] = {
    {"exact_sections"},
    {"layers", {{"model.section", "layers"}}},
    {"pinned", {{"beam.ends", Names{"pinned", "pinned"}}}},
    {"cantilever", {{"beam.ends", Names{"clamped", "free"}}, {"striker.position", 0.8}}},
    {"fine_cells", {{"model.segments", 2001}}},
    {"hermite_elements",
     {{"model.mesh", "hermite"}, {"model.elements", 80}, {"solver.method", "erk"}}},
    {"with_shear", {{"beam.theory", "timoshenko"}, {"beam.poisson", 0.33}}},
};

INSTANTIATE_TEST_SUITE_P(, RestingBeams, testing::ValuesIn(free_of_moments), NamedAsPrinted{});

TEST_P(RestingBeams, HaveNoMomentsAndTheirPermanentSetWhereSupportsAllowIt) {
  const Case input = changed(paper_strike(4e-4), GetParam().settings);
  const Result first = simulate(input);
  ASSERT_GT(first.n_yielded_sections, 0U);
  const std::vector<ShapeRow> shape = shape_at_rest(input, first);
  ASSERT_EQ(shape.size(), first.envelope.size());
  const double yield_moment = input.scene.beam.yield_moment();
  const ShapeRow &left = shape.front(), &right = shape.back();
  double largest = 0.0, difference = 0.0, moment = 0.0;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const double share = (shape[i].position - left.position) / (right.position - left.position);
    const double chord = left.displacement + share * (right.displacement - left.displacement);
    const double set = first.envelope[i].permanent_set;
    largest = std::max(largest, std::abs(set));
    difference = std::max(difference, std::abs(shape[i].displacement - chord - set));
    if (input.scene.beam.ends[0] == EndSupport::clamped) {  // against the clamp, as measured
      const double from_clamp = first.envelope[i].set_from_supports;
      difference = std::max(difference, std::abs(shape[i].displacement - from_clamp));
    } else {
      EXPECT_EQ(first.envelope[i].set_from_supports, set);
    }
    moment = std::max(moment, std::abs(shape[i].moment));
  }
  EXPECT_GT(largest, 1e-4);
  EXPECT_LT(moment, 1e-8 * yield_moment);
  EXPECT_LT(difference, 2e-3 * largest);  // the integral of the set is of the order of the mesh
}

// Equal rotations of both ends: E I kappa = M - E I kappa_p, the integral of kappa is zero.
TEST(RestingBeam, BetweenClampsKeepsTheUniformMomentOfLeastEnergy) {
  Case input = paper_strike(1.5e-3);
  input.scene.beam.ends = {clamped, clamped};
  input.scene.striker.velocity = 8.0;
  const Result first = simulate(input);
  const std::vector<ShapeRow> shape = shape_at_rest(input, first);
  ASSERT_FALSE(shape.empty());
  const double rotation =
      std::accumulate(first.plastic_zones.begin(), first.plastic_zones.end(), 0.0,
                      [](double sum, const PlasticZone& zone) { return sum + zone.rotation; });
  const Beam& beam = input.scene.beam;
  const double moment = -beam.bending_stiffness() * rotation / beam.length;
  EXPECT_GT(std::abs(moment), 1e-4 * beam.yield_moment());
  for (const ShapeRow& row : shape) {
    EXPECT_NEAR(row.moment, moment, 1e-6 * std::abs(moment)) << row.position;
  }
}

TEST(RepeatedStrikes, OnAnElasticBeamAreAllAlike) {
  Case input = paper_strike(1e-3);
  input.model.section = SectionKind::elastic;
  input.scene.beam.yield_stress = HUGE_VAL;
  input.scene.contact.kind = ContactKind::hertz;
  input.scene.contact.stiffness = 5e9;
  input.strikes = 3;
  const Result result = run_as_asked(input, {}, {}).result;
  ASSERT_EQ(result.strikes.size(), 3U);
  for (const StrikeRow& row : result.strikes) {
    EXPECT_EQ(row.sub_impacts, result.strikes.front().sub_impacts);
    EXPECT_NEAR(row.striker_velocity, result.strikes.front().striker_velocity, 1e-12);
    EXPECT_EQ(row.dent, 0.0);
    EXPECT_EQ(row.permanent_set, 0.0);
  }
}

// Two rigid bodies: all of the energy E of the approach is recoverable or dissipated at the largest
// indentation, R(k) + D(k) - D(k - 1) = E, and e^2 = R(k)/E.
TEST(RepeatedStrikes, OfRigidBodiesFollowTheBalanceOfEachDent) {
  Case input = paper_strike(2e-3);
  input.model.mesh = MeshKind::rigid;
  input.solver.method = Method::nystrom;
  input.solver.rtol = 1e-11;
  input.strikes = 12;
  RunRequest request;
  request.error_bars = ErrorBars::off;
  const Result result = run_as_asked(input, {}, std::move(request)).result;
  ASSERT_EQ(result.strikes.size(), 12U);
  const auto law = contact_law_of(input);
  const double m = input.scene.striker.mass, beam = input.scene.beam.mass();
  const double v0 = input.scene.striker.velocity;
  const double energy = 0.5 * m * beam / (m + beam) * v0 * v0;
  double before = 0.0;
  for (const StrikeRow& row : result.strikes) {
    double low = before, high = 5e-3;
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      const double taken = law->recoverable_energy({middle}, middle) +
                           law->dissipated_energy({middle}) - law->dissipated_energy({before});
      (taken < energy ? low : high) = middle;
    }
    const double e = std::sqrt(law->recoverable_energy({low}, low) / energy);
    EXPECT_NEAR(row.restitution.value(), e, 1e-8) << row.strike;
    EXPECT_NEAR(row.dent, law->residual_indentation({low}), 1e-10) << row.strike;
    EXPECT_NEAR(row.contact_dissipated, (1.0 - e * e) * energy, 1e-7 * energy) << row.strike;
    before = low;
  }
  EXPECT_GT(result.strikes.back().restitution.value(),
            1.5 * result.strikes.front().restitution.value());
}

TEST(RepeatedStrikes, OnAYieldingBeamHaveTheErrorsOfRunsThatWereStruckAsOften) {
  Case input = paper_strike(1.5e-3);
  input.scene.beam.ends = {pinned, pinned};
  input.scene.striker.velocity = 4.0;
  input.strikes = 3;
  const Result result = run_as_asked(input, {}, {}).result;
  ASSERT_EQ(result.strikes.size(), 3U);
  EXPECT_TRUE(result.outcome.completed());
  for (const StrikeRow& row : result.strikes) {
    ASSERT_TRUE(row.peak_force_error);
    const double taken =
        row.striker_energy + row.vibration + row.bending_dissipated + row.contact_dissipated;
    const double locked = taken - result.used.initial_energy;  // in the sections before the strike
    EXPECT_GT(locked, -1e-3 * result.used.initial_energy);
    EXPECT_LT(locked, 0.05 * result.used.initial_energy);
  }
  EXPECT_GT(result.strikes[2].dent, result.strikes[0].dent);
}

TEST(RepeatedStrikes, OnAMovingBeamMeetItWhereItIs) {
  Case input = paper_strike(4e-4);
  const Result first = simulate(input);
  input.parts.start = first.end_state;
  input.at_rest = false;
  input.scene.striker.velocity = 40.0;
  const Result next = completed(input);
  EXPECT_EQ(next.sub_impacts.front().start, 0.0);
  EXPECT_LT(*next.max_momentum_error, 1e-9);
  EXPECT_EQ(next.final_energies.beam_damping, 0.0);
}

TEST(RepeatedStrikes, RefuseWhatTheBeamCannotTake) {
  Case input = paper_strike(4e-4);
  Case twice = input;
  twice.strikes = 2;  // before the first one
  expect_refused(changed(twice, {{"scene.gravity", 9.81}}), "scene.gravity");
  input.parts.start = simulate(input).end_state;
  const Case coarser = changed(input, {{"model.segments", 201}});
  EXPECT_EQ(refusal_of([&] { simulate(coarser); }).key, "model.mesh");
  expect_refused(changed(input, {{"scene.gravity", 9.81}}), "scene.gravity");
  input.at_rest = false;
  const Case slow = changed(input, {{"striker.velocity", 0.1}});
  EXPECT_EQ(refusal_of([&] { simulate(slow); }).key, "striker.velocity");
  expect_refused(changed(slow, {{"striker.gap", 1e-3}}), "striker.gap");
}

}  // namespace
}  // namespace subimpact
