// Beams whose ends cannot approach each other: closed forms of statics and free vibration,
// accounts, agreement of methods and models, refusals.

#include "numerics/bracketed_root.h"
#include "paper_case.h"
#include "settings.h"
#include "simulate/run_parts.h"

namespace subimpact {
namespace {

Case held_case(EndSupport end, SectionKind section = SectionKind::elastic) {
  Case input = paper_case(section, 0.6e-3);
  input.scene.beam.ends = {end, end};
  input.scene.beam.axial = AxialEnds::held;
  return input;
}

// --- statics -------------------------------------------------------------------------------------

// A beam under the force F at the middle, with the tension N and without rotary effects:
//     w' = F/(2 N) [1 - s cosh(k (x - c))/cosh(k (l/2 - c))],   s = kGA/(kGA + N), k^2 = s N/(E I),
// c = 0 of a pinned beam, l/4 of a clamped one, from the support to the middle; s = 1 without
// shear.
struct UnderForce {
  const Beam& beam;
  double force;

  double share(double tension) const {
    return beam.shears() ? beam.shear_stiffness() / (beam.shear_stiffness() + tension) : 1.0;
  }
  // Integrals of w' and w'^2 over half the beam, m.
  std::pair<double, double> integrals(double tension) const {
    const double s = share(tension), k = std::sqrt(s * tension / beam.bending_stiffness());
    const double half = 0.5 * beam.length, slope = 0.5 * force / tension;
    const double reach = beam.ends[0] == pinned ? half : 0.5 * half;
    const double linear = half / reach * std::tanh(k * reach) / k;
    const double square = half / reach * (0.5 * reach + std::sinh(2.0 * k * reach) / (4.0 * k)) /
                          std::pow(std::cosh(k * reach), 2);
    return {slope * (half - s * linear),
            slope * slope * (half - 2.0 * s * linear + s * s * square)};
  }
  double tension() const {
    const auto excess = [&](double tension) {
      return beam.youngs_modulus * beam.area() / beam.length * integrals(tension).second - tension;
    };
    return root_in(excess, 1e-3, 1e6);
  }
  double deflection() const { return integrals(tension()).first; }
};

Case pushed(Case input, double force) {
  input.scene.beam.yield_stress = std::numeric_limits<double>::infinity();
  input.scene.beam.forces = {{0.5, {{0.0, force}}}};
  input.scene.beam.start = BeamStart::equilibrium;
  return input;
}

double struck_displacement_at_start(const Case& input) {
  ResolvedRun run = resolve(input);
  const StruckBeam& beam = run.parts().beam;
  const State y = beam.initial_state();
  return beam.mesh().struck_point()(beam.beam_positions(y));
}

class AHeldBeam : public testing::TestWithParam<EndSupport> {};

INSTANTIATE_TEST_SUITE_P(, AHeldBeam, testing::Values(pinned, clamped), NamedAsPrinted{});

TEST_P(AHeldBeam, UnderAForceDeflectsAsItsTensionLets) {
  for (const Settings& mesh :
       {Settings{{"model.segments", std::int64_t{501}}},
        Settings{{"model.mesh", std::string("hermite")}, {"model.elements", std::int64_t{60}}},
        Settings{{"beam.theory", std::string("timoshenko")}, {"beam.poisson", 0.33}},
        Settings{{"beam.theory", std::string("timoshenko")},
                 {"beam.poisson", 0.33},
                 {"model.mesh", std::string("spectral")},
                 {"model.elements", std::int64_t{20}}}}) {
    for (const SymmetryUse symmetry : {SymmetryUse::automatic, SymmetryUse::off}) {
      double before = 0.0;
      for (const double force : {1.0, 1e3, 8e3}) {
        Case input = pushed(changed(held_case(GetParam()), mesh), force);
        input.model.symmetry = symmetry;
        const double w = struck_displacement_at_start(input);
        const double exact = UnderForce{input.scene.beam, force}.deflection();
        EXPECT_NEAR(w, exact, 1e-3 * exact) << force << " N, " << resolve(input).settings().mesh;
        if (before > 0.0) {
          EXPECT_LT(w, 0.8 * before * force) << "the tension matters";
        }
        before = w / force;
      }
    }
  }
}

TEST_P(AHeldBeam, AtRestHasTheReactionsThatBalanceItsLoad) {
  for (const SymmetryUse symmetry : {SymmetryUse::automatic, SymmetryUse::off}) {
    Case input = pushed(held_case(GetParam()), 2e3);
    input.model.symmetry = symmetry;
    input.end_time = 1e-6;
    input.output.interval = 1e-6;
    const HistoryRow first = completed(input).history.front();
    EXPECT_NEAR(*first.first_reaction, -1e3, 1e-4);
    EXPECT_NEAR(*first.last_reaction, -1e3, 1e-4);
  }
}

// --- free vibration ------------------------------------------------------------------------------

// A sine stays one: its amplitude a obeys a'' = -w0^2 (a + a^3/(4 r^2)), r the radius of gyration.
double exact_period(const Beam& beam, double amplitude) {
  const double r = beam.radius_of_gyration(), wave = M_PI / beam.length;
  const double slow = wave * wave *
                      std::sqrt(beam.bending_stiffness() /
                                (beam.mass_per_length() + beam.rotary_inertia() * wave * wave));
  const double ratio = std::pow(amplitude / (2.0 * r), 2);
  return 4.0 * std::comp_ellint_1(std::sqrt(0.5 * ratio / (1.0 + ratio))) /
         (slow * std::sqrt(1.0 + ratio));
}

// Twice the time until the middle rests on the other side.
double period_found(const Case& input, double amplitude) {
  ResolvedRun run = resolve(input);
  RunParts& parts = run.parts();
  parts.beam.contact().set(ContactBranch::separated, {});
  const BeamMesh& mesh = parts.beam.mesh();
  const NaturalModes modes = mesh.natural_modes(input.scene.beam.bending_stiffness());
  const std::size_t n = mesh.n_unknowns();
  State y(2 * (n + 1), 0.0);
  const double scale = amplitude / mesh.struck_point()(modes.shape(0));
  for (std::size_t i = 0; i < n; ++i) y[i] = scale * modes.shape(0)[i];
  y[n] = -1.0;  // the striker, far away
  const auto integrator = parts.make_integrator();
  integrator->restart(0.0, y);
  const auto rate = [&](const State& at) {
    return mesh.struck_point()(parts.beam.beam_velocities(at));
  };
  double before = 0.0, time = 0.0;
  for (int k = 0; k < 2000000; ++k) {
    integrator->step();
    if (before < 0.0 && rate(integrator->state()) >= 0.0) {
      const double share = before / (before - rate(integrator->state()));
      return 2.0 * (time + share * (integrator->time() - time));
    }
    before = rate(integrator->state());
    time = integrator->time();
  }
  return 0.0;
}

TEST(APinnedBeamHeld, SwingsInTheTimeOfWoinowskyKriegersEllipticIntegral) {
  Case input = held_case(pinned);
  const double r = input.scene.beam.radius_of_gyration();
  const double slow = exact_period(input.scene.beam, 0.0);
  for (const Method method : {Method::central_difference, Method::nystrom}) {
    input.solver.method = method;
    for (const double amplitude : {0.1 * r, r, 3.0 * r, 10.0 * r}) {
      const double exact = exact_period(input.scene.beam, amplitude);
      EXPECT_NEAR(period_found(input, amplitude), exact, 1e-3 * exact)
          << amplitude / r << ' ' << to_string(method);
    }
  }
  EXPECT_LT(exact_period(input.scene.beam, 3.0 * r), 0.7 * slow);
}

// --- strikes -------------------------------------------------------------------------------------

Case strike(EndSupport end, SectionKind section = SectionKind::elastic) {
  Case input = held_case(end, section);
  input.model.segments = 101;
  input.end_time = 1.2e-3;
  return input;
}

// A thin strip: its tension yields long before the end, and is pressed back afterwards.
TEST_P(AHeldBeam, AccountsForTheWorkOfATensionThatYields) {
  for (const Method method : {Method::erk, Method::nystrom, Method::central_difference}) {
    Case input = strike(GetParam(), SectionKind::exact);
    input.scene.beam.thickness = 1.5e-3;
    input.scene.striker.mass = 0.05;
    input.scene.beam.yield_stress = 60e6;
    input.end_time = 8e-3;
    input.solver.method = method;
    input.output.interval = 1e-5;
    const Result result = completed(input);
    const double tolerance = method == Method::central_difference ? 1e-3 : 1e-6;
    EXPECT_LT(result.max_energy_error, tolerance) << to_string(method);
    // The same without the tension loses far less.
    input.scene.beam.axial = AxialEnds::free;
    EXPECT_GT(result.history.back().bending_plastic,
              1.2 * completed(input).history.back().bending_plastic);
  }
}

TEST(AHeldBeamThatYielded, KeepsItsPlasticElongationWhereItIsStruckAgain) {
  Case input = strike(clamped, SectionKind::exact);
  input.end_time = 0.5e-3;
  const Result first = completed(input);
  input.parts.start = first.end_state;
  input.at_rest = false;
  input.scene.striker.velocity *= 3.0;
  const Result second = completed(input);
  EXPECT_LT(second.max_energy_error, 1e-7);
  EXPECT_GT(first.final_energies.bending_plastic, 0.0);
}

TEST_P(AHeldBeam, IsProvenToBeLeftOnlyWhereItIs) {
  Case input = strike(GetParam());
  input.scene.striker.mass = 0.01;
  input.end_time = 20e-3;
  const Result long_run = completed(input);
  input.stop = StopRule::no_more_contact;
  const Result proven = completed(input);
  ASSERT_TRUE(proven.no_more_contact);
  EXPECT_LT(*proven.no_more_contact, 0.9 * input.end_time);
  EXPECT_EQ(proven.sub_impacts.size(), long_run.sub_impacts.size());
}

// --- refusals ------------------------------------------------------------------------------------

TEST(HeldEnds, AreRefusedWhereNoTensionCanBe) {
  Case input = held_case(pinned);
  input.scene.beam.ends = {clamped, free_end};
  expect_refused(input, "beam.axial", "held", "x = length", "pinned", "clamped");
  input = held_case(pinned);
  input.solver.method = Method::exponential;
  expect_refused(input, "solver.method", "exponential", "beam.axial", "nystrom", "erk");
  input.solver.method = Method::erk;
  input.scene.beam.damping.ratio = 0.01;
  expect_refused(input, "beam.damping.ratio", "beam.axial", "beam.damping.mass");
}

TEST(HeldEnds, AreRefusedAtRestAfterAStrikeThatYields) {
  Case input = strike(pinned, SectionKind::exact);
  input.strikes = 2;
  expect_refused(input, "strike.rest", "beam.axial", "false");
  input.strikes = 1;
  input.end_time = 0.3e-3;
  input.parts.start = completed(input).end_state;
  input.at_rest = true;
  const auto [key, message] = refusal_of([&] { simulate(input); });
  EXPECT_EQ(key, "strike.rest");
  expect_in(message, "beam.axial");
}

}  // namespace
}  // namespace subimpact
