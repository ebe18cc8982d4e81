// Contacts damped as Hunt and Crossley's: F = K lambda^n (1 + chi lambda').

#include "numerics/bracketed_root.h"
#include "paper_case.h"
#include "rigid_case.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

Case rigid_case(ContactKind kind, double damping) {
  Case input = rigid_case(kind, 2.0, 1e-3);
  input.scene.beam.yield_stress = std::numeric_limits<double>::infinity();
  input.scene.contact.damping = damping;
  input.output.interval = 0.0;
  input.solver.rtol = 1e-12;
  return input;
}

// chi v_0 - ln(1 + chi v_0) = -chi v_1 - ln(1 - chi v_1), e = v_1/v_0, for x = chi v_0.
double restitution(double x) {
  const auto defect = [x](double e) { return -x * e - std::log1p(-x * e) - (x - std::log1p(x)); };
  return root_in(defect, 0.0, std::min(1.0, (1.0 - 1e-15) / x));
}

class ADampedContactByAMethod : public testing::TestWithParam<Method> {};

INSTANTIATE_TEST_SUITE_P(, ADampedContactByAMethod,
                         testing::Values(Method::erk, Method::dirk, Method::adams, Method::bdf),
                         [](const auto& info) { return std::string(to_string(info.param)); });

TEST_P(ADampedContactByAMethod, OfTwoRigidBodiesHasTheClosedFormsRestitution) {
  for (const ContactKind kind : {ContactKind::hertz, ContactKind::linear}) {
    for (const double x : {0.02, 0.4, 6.0}) {
      Case input = rigid_case(kind, 0.0);
      input.scene.contact.damping = x / input.scene.striker.velocity;
      input.solver.method = GetParam();
      input.end_time = 5e-3;
      const bool is_low = GetParam() == Method::dirk;
      input.solver.rtol = is_low ? 1e-11 : 1e-12;
      const Result result = completed(input);
      ASSERT_EQ(result.sub_impacts.size(), 1u);
      const double expected = restitution(x), v = input.scene.striker.velocity;
      EXPECT_NEAR((result.beam_mean_velocity - result.striker_velocity) / v, expected,
                  1e-8 * expected)
          << x;
      const double lost = 0.5 * reduced_mass(input) * v * v * (1.0 - expected * expected);
      EXPECT_NEAR(result.contact_damping_loss, lost, 1e-7 * lost) << x;
      EXPECT_LT(result.max_energy_error, 1e-8) << x;
      EXPECT_LT(result.max_impulse_error, 1e-7) << x;
    }
  }
}

TEST(ADampedContact, LosesWhatAGivenCoefficientOfRestitutionSays) {
  for (const ContactKind kind : {ContactKind::hertz, ContactKind::linear}) {
    for (const double e : {0.1, 0.3, 0.7, 0.95, 0.9998, 0.99995}) {
      Case input = rigid_case(kind, 0.0);
      input.scene.contact.restitution = e;
      input.solver.method = Method::erk;
      input.solver.rtol = 1e-12;
      input.end_time = 5e-3;
      const Result result = completed(input);
      const double found =
          (result.beam_mean_velocity - result.striker_velocity) / input.scene.striker.velocity;
      EXPECT_NEAR(found, e, 1e-8) << e;
    }
  }
}

TEST(ADampedContact, HasTheGivenRestitutionAtEveryTouch) {
  for (const ContactKind kind : {ContactKind::linear, ContactKind::hertz}) {
    for (const double e : {0.7, 0.8, 0.95}) {
      Case input = rigid_case(kind, 0.0);
      input.scene.beam.fixed = true;
      input.scene.gravity = 9.81;
      input.scene.striker.mass = 0.0415;
      input.scene.striker.velocity = std::sqrt(2.0 * 9.81);
      input.scene.contact.stiffness = kind == ContactKind::hertz ? 1e7 : 1e5;
      input.scene.contact.restitution = e;
      input.solver.method = Method::erk;
      input.end_time = 4.0;
      const Result result = completed(input);
      const double weight = 9.81 * input.scene.striker.mass;
      double before = input.scene.striker.velocity;
      int n_hard = 0;
      for (const SubImpact& s : result.sub_impacts) {
        if (!(s.peak_force > 100.0 * weight)) break;
        EXPECT_NEAR(-s.striker_velocity / before, e, 0.02 * e) << n_hard;
        before = -s.striker_velocity;
        ++n_hard;
      }
      EXPECT_GE(n_hard, 3);
    }
  }
}

// A beam that vibrates under a contact which recovers slowly.
Case vibrating_case(double damping) {
  Case input = rigid_case(ContactKind::hertz, damping);
  input.model.mesh = MeshKind::cells;
  input.model.segments = 101;
  input.solver.rtol = 1e-9;
  input.end_time = 0.6e-3;
  input.scene.striker.velocity = 8.0;
  return input;
}

TEST(ADampedContactOfABeam, EndsWhereItWouldPullAndMayBeginAgainBeforeTheSurfaceHasRecovered) {
  const Result result = completed(vibrating_case(3.0));
  int indented_ends = 0;
  for (const Transition& event : result.transitions) {
    if (event.kind == EventKind::contact_ends && event.value > 1e-9) ++indented_ends;
  }
  EXPECT_GE(indented_ends, 1);
  for (const SubImpact& s : result.sub_impacts) EXPECT_GT(s.peak_force, 0.0);
}

TEST(ADampedContact, IsRefusedByMethodsWhichNeedForcesOfPositionsAndTheyNameThoseThatTakeIt) {
  for (const Method method : {Method::nystrom, Method::exponential, Method::central_difference}) {
    Case input = vibrating_case(0.3);
    input.solver.method = method;
    expect_refused(input, "contact.damping", "erk, dirk, adams, bdf");
  }
}

TEST(ADampedContact, IsRefusedOnTheFoundationAndWithEventsThatAreNotLocated) {
  Case input = paper_case(SectionKind::elastic, 1e-4);
  input.scene.contact.damping = 0.1;
  expect_in(refusal_of(input).message, "\"hertz\" or \"linear\"");
  for (const EventHandling events : {EventHandling::interpolated, EventHandling::library}) {
    Case other = vibrating_case(0.3);
    other.solver.events = events;
    expect_in(refusal_of(other).message, "needs located events");
  }
}

}  // namespace
}  // namespace subimpact
