// The integral of the contact force over steps.

#include "simulate/quadratures.h"

#include "lumped.h"
#include "simulate/audit.h"
#include "testing.h"

namespace subimpact {
namespace {

IndentationStep indentation_step(const StruckBeam& beam, const StepEnds& step) {
  return {step.t0,
          step.t1,
          beam.indentation(step.y0),
          beam.indentation_rate(step.y0),
          beam.indentation(step.y1),
          beam.indentation_rate(step.y1)};
}

TEST(TheForceIntegral, OfAStepWithoutLengthIsZero) {
  StruckBeam beam = TwoBodies{}.make();
  const auto integrator = Way{}.make(beam);
  beam.contact().set(ContactBranch::elastic, {0.0});
  State y = beam.initial_state();
  y[1] = 1e-4;  // pressed in
  integrator->restart(0.0, y);
  SectionCorrector corrector(beam, std::numeric_limits<double>::infinity());
  ForceQuadrature force(1e-12);
  const StepEnds empty{0.0, 0.0, y, y};
  const StepEnds whole{0.0, 1e-6, y, y};
  const double impulse = beam.contact_force(y) * 1e-6;
  EXPECT_GT(impulse, 0.0);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(force.over(ObservedStep(empty, indentation_step(beam, empty), *integrator, corrector),
                         beam),
              0.0);
  }
  force.forget_neighbour();
  integrator->step();
  EXPECT_NEAR(
      force.over(ObservedStep(whole, indentation_step(beam, whole), *integrator, corrector), beam),
      impulse, 0.1 * impulse);
}

/// How many of n runs are ended by the audit, with strikers of `first` kg and more by `spacing`.
int n_stopped(int n, double first, double spacing) {
  int stopped = 0;
  for (int k = 0; k < n; ++k) {
    Scene scene;
    scene.beam.length = scene.beam.width = scene.beam.thickness = scene.beam.density = 1.0;
    scene.striker = {
        .mass = first + spacing * k, .nose_radius = 0.5, .velocity = 1.0, .position = 0.5};
    scene.contact.kind = ContactKind::linear;
    scene.contact.stiffness = 4e6;
    StruckBeam beam =
        struck_beam_of(scene, std::make_unique<LumpedMesh>(1.0), SectionField(1, 2e6));
    try {
      run_two_bodies(beam, {"dprkn12", 1e-14, {}, EventHandling::located}, 8e-3, {},
                     {.energy = 1e-6});
    } catch (const RunStopped&) {
      ++stopped;
    }
  }
  return stopped;
}

// Its error estimate compares two steps. Steps of a tenth of a radian and more, as methods of high
// order take them, must not make it vanish by chance: the audit would then end a run that is right.
TEST(TheForceIntegral, EqualsTheImpulseOnLongStepsWhateverTheirPhase) {
  EXPECT_EQ(n_stopped(4000, 2.0, 0.004), 0);
  EXPECT_EQ(n_stopped(300, 3.2, 1e-4), 0);  // the first estimate of a contact vanishes at 3.221 kg
}

}  // namespace
}  // namespace subimpact
