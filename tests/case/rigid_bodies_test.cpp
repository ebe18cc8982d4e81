// Impacts of two rigid bodies, as a user would set them up: model.mesh = "rigid".

#include "rigid_case.h"
#include "runs.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/simulate/options.h"

namespace subimpact {
namespace {

Case rigid_case(ContactKind kind, double velocity) {
  Case input = rigid_case(kind, velocity, 2e-2);
  input.solver.rtol = 1e-10;
  input.output.interval = 0.0;
  return input;
}

TEST(RigidBodies, UnderAPowerLawPartAfterTheClosedFormsDurationWithRestitution1) {
  const struct {
    ContactKind kind;
    double exponent, duration_constant;
  } laws[] = {{ContactKind::hertz, 1.5, 2.943275184}, {ContactKind::linear, 1.0, std::numbers::pi}};
  for (const auto& [kind, n, constant] : laws) {
    for (const double v : {0.01, 1.0, 10.0}) {
      const Case input = rigid_case(kind, v);
      const Result result = simulate(input);
      ASSERT_EQ(result.sub_impacts.size(), 1u);
      const SubImpact& hit = result.sub_impacts[0];
      const double k = *input.scene.contact.stiffness;
      const double depth =
          std::pow((n + 1.0) * reduced_mass(input) * v * v / (2.0 * k), 1.0 / (n + 1.0));
      EXPECT_NEAR(hit.max_indentation, depth, 1e-8 * depth);
      EXPECT_NEAR(hit.peak_force, k * std::pow(depth, n), 1e-8 * hit.peak_force);
      EXPECT_NEAR(hit.end.value(), constant * depth / v, 2e-9 * hit.end.value());
      EXPECT_NEAR(result.beam_mean_velocity - result.striker_velocity, v, 1e-9 * v);
    }
  }
}

TEST(RigidBodies, WithAnElastoPlasticSurfaceLoseWhatTheClosedFormSays) {
  for (const double v : {0.05, 0.5, 3.0, 15.9}) {
    const Case input = rigid_case(ContactKind::foundation, v);
    const Result result = simulate(input);
    const double k = result.used.contact_stiffness, unit = result.used.yield_indentation;
    const double threshold = std::sqrt(0.8 * k * std::pow(unit, 2.5) / reduced_mass(input));
    const double e = (result.beam_mean_velocity - result.striker_velocity) / v;
    const double x = result.max_indentation / unit;
    EXPECT_EQ(x > 1.0, v > threshold);
    const double expected =
        x <= 1.0 ? 1.0
                 : std::sqrt(1.0 - std::pow(x - 1.0, 1.5) /
                                       (0.4 * (std::pow(x, 2.5) - std::pow(x - 1.0, 2.5))));
    EXPECT_NEAR(e, expected, 1e-8) << v;
  }
}

TEST(RigidBodies, StruckAnywhereHaveTheRestitutionOfTheirStruckPoints) {
  for (const double position : {0.5, 0.6, 0.85, 1.0}) {
    for (const double e : {0.4, 1.0}) {
      Case input = rigid_case(ContactKind::hertz, 1.0);
      input.scene.striker.position = position;
      input.scene.contact.restitution = e;
      input.scene.striker.mass = 0.01;  // it parts by the first contact
      const Result result = simulate(input);
      ASSERT_EQ(result.sub_impacts.size(), 1u) << position;
      ASSERT_TRUE(result.restitution) << position;
      EXPECT_NEAR(*result.restitution, e, 1e-8) << position;
    }
  }
}

// An impulse S at x turns it by S x/(m l^2/3 + J l); the end moves by x of that.
TEST(RigidBodies, AreWhatABeamOnOneHingeIsMeasuredAs) {
  for (const MeshKind mesh : {MeshKind::cells, MeshKind::hermite}) {
    Case input = rigid_case(ContactKind::hertz, 1.0);
    input.model.mesh = mesh;
    input.model.elements = 20;
    Beam& beam = input.scene.beam;
    beam.yield_stress = std::numeric_limits<double>::infinity();
    input.scene.striker.mass = 0.01;
    input.end_time = 2e-3;
    for (const double position : {0.4, 0.9}) {
      input.scene.striker.position = position;
      beam.ends = {EndSupport::pinned, EndSupport::free};
      const double lever = position * beam.length;
      const double inertia =
          beam.length * (beam.mass() * beam.length / 3.0 + beam.rotary_inertia());
      for (const bool mirrored : {false, true}) {
        const Result result = simulate(input);
        EXPECT_NEAR(result.parting.beam, result.impulse() * lever * lever / inertia,
                    (mesh == MeshKind::cells ? 1e-5 : 1e-8) * std::abs(result.parting.beam))
            << position << ' ' << mirrored << ' ' << static_cast<int>(mesh);
        beam.ends = {EndSupport::free, EndSupport::pinned};
        input.scene.striker.position = 1.0 - position;
      }
    }
  }
}

TEST(RigidBodies, HaveNoRestitutionWhileTheyTouchOrApproach) {
  Case input = rigid_case(ContactKind::linear, 1.0);
  const double end = simulate(input).sub_impacts.at(0).end.value();
  for (const double part : {0.2, 0.9, 1.1}) {
    input.end_time = part * end;
    EXPECT_EQ(simulate(input).restitution.has_value(), part > 1.0) << part;
  }
  input.scene.beam.ends = {EndSupport::pinned, EndSupport::pinned};  // it swings ahead, and back
  input.model.mesh = MeshKind::hermite;
  input.scene.striker.mass = 20.0;
  input.end_time = 2e-3;
  const Result longer = simulate(input);
  ASSERT_GE(longer.sub_impacts.size(), 2u);
  input.end_time = 0.5 * (*longer.sub_impacts[0].end + longer.sub_impacts[1].start);
  const Result result = simulate(input);
  EXPECT_GT(result.parting.striker, 0.0);
  EXPECT_FALSE(result.restitution);
}

// A light beam struck at its end, with nothing that yields.
Case elastic_end_strike() {
  Case input = rigid_case(ContactKind::foundation, 0.118);
  Beam& beam = input.scene.beam;
  beam.length = 0.1057;
  beam.width = 0.0426;
  beam.thickness = 0.00747;
  beam.density = 1115.0;
  beam.youngs_modulus = 2.176e11;
  beam.yield_stress = std::numeric_limits<double>::infinity();
  input.scene.striker = {
      .mass = 0.00064, .nose_radius = 0.1904, .velocity = 0.118, .position = 1.0};
  input.end_time = 7.8e-6;
  return input;
}

TEST(RigidBodies, KeepTheirEnergyTo1000TolerancesWithEveryTableOfDirk) {
  Case input = elastic_end_strike();
  for (const MethodTable& table : method_tables()) {
    if (table.method != Method::dirk) continue;
    for (const double rtol : {1e-4, 1e-6, 1e-8, 1e-10}) {
      input.solver.method = table.method;
      input.solver.table = table.name;
      input.solver.rtol = rtol;
      EXPECT_LT(simulate(input).max_energy_error, 1e3 * rtol) << table.name;
    }
  }
}

TEST(ARigidBeam, StruckOffMidSpanAnswersWithTheMassOfItsCentreOfPercussion) {
  // 1/m_eff = 1/M + c^2/Theta at the distance c from the centre.
  Case input = rigid_case(ContactKind::hertz, 2.0);
  input.scene.striker.position = 0.9;
  const Beam& beam = input.scene.beam;
  const double c = 0.4 * beam.length;
  const double inertia =
      beam.mass() * beam.length * beam.length / 12.0 + beam.rotary_inertia() * beam.length;
  const double effective = 1.0 / (1.0 / beam.mass() + c * c / inertia);
  const double m = input.scene.striker.mass;
  const Result result = simulate(input);
  // An elastic impact reverses the relative velocity: the impulse is twice the reduced mass' own.
  const double impulse = 2.0 * m * effective / (m + effective) * 2.0;
  EXPECT_NEAR(result.sub_impacts.at(0).impulse, impulse, 1e-9 * impulse);
  EXPECT_NEAR(result.beam_mean_velocity, impulse / beam.mass(), 1e-9);
  EXPECT_LT(result.max_energy_error, 1e-9);
}

}  // namespace
}  // namespace subimpact
