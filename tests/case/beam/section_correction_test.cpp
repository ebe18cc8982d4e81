// Sections that begin to flow, reverse or close loops within a step of a whole run, and what the
// correction of the step's end is worth. (One section alone: tests/system/section_*_test.cpp.)

#include "paper_case.h"
#include "simulate/loop/event_loop.h"
#include "simulate/run_parts.h"

namespace subimpact {
namespace {

double largest_difference(const State& a, const State& b) {
  double largest = 0.0;
  for (std::size_t i = a.size() / 2; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

// The state at the end, and what the integrator did.
std::pair<State, WorkCounts> followed(double end_time, double rtol, RunObserver& observer) {
  Case input = paper_case(SectionKind::exact, end_time, 501, Method::nystrom);
  input.solver.rtol = rtol;
  ResolvedRun run = resolve(input);
  StruckBeam& beam = run.parts().beam;
  const auto integrator = run.parts().make_integrator();
  Audit audit(beam, beam.initial_state());
  EventLoop loop(beam, *integrator, observer, audit, loop_options(run.parts()));
  loop.start();
  while (!loop.finished()) loop.advance();
  return {loop.state(), integrator->work()};
}

TEST(SectionEvents, HardlyEverCutAStep) {
  struct Counter : RunObserver {
    long reversals = 0;
    void on_reversal(const Transition&) override { ++reversals; }
  } counter;
  const WorkCounts work = followed(0.5e-3, 1e-8, counter).second;
  EXPECT_GT(counter.reversals, 500);
  EXPECT_LT(work.partial_steps, counter.reversals / 5);
}

// An event that moves the next one in its step, or undoes it: an error that would not shrink with
// the tolerance.
TEST(SectionEvents, OfOneStepAreCoupled) {
  RunObserver nobody;
  EXPECT_LT(largest_difference(followed(0.9e-3, 1e-11, nobody).first,
                               followed(0.9e-3, 1e-12, nobody).first),
            1e-7);
}

// Without rotary inertia high frequencies couple the events of a step most. Where corrections are
// as tight as the method only, ends of contact differ by 5e-12 s.
TEST(SectionEvents, AreCorrectedFarMoreTightlyThanTheMethodAtTightTolerances) {
  Case input = paper_case(SectionKind::exact, 0.6e-3, 101, Method::nystrom);
  input.scene.beam.theory = BeamTheory::euler_bernoulli;
  input.solver.rtol = 1e-12;
  const Result result = simulate(input);
  input.solver.rtol = 1e-14;
  const Result tighter = simulate(input);
  EXPECT_GT(result.sub_impacts.size(), 2u);
  expect_same_ends(result, tighter, 5e-7);
}

// At both velocities the contact begins at 5682.34 us in a step whose end lies before it by 0.01 nm
// until sections are corrected, and behind it afterwards. An event that was not looked for again
// ended the run as inaccurate.
TEST(SectionEvents, ThatMoveTheEndOfAStepPastAnEventLeaveItLocated) {
  Case input = paper_case(SectionKind::exact, 5.7e-3, 501, Method::exponential);
  input.solver.rtol = 1e-8;
  for (const double velocity : {15.982326781361104, 15.982295069666772}) {
    input.scene.striker.velocity = velocity;
    const Result result = completed(input);
    EXPECT_GT(result.sub_impacts.back().start, 5.682e-3);
  }
}

}  // namespace
}  // namespace subimpact
