// Sections that begin to flow, turn back or close loops within a step, and what putting that right
// at the step's end is worth.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "order_table.h"
#include "paper_case.h"
#include "simulate/event_loop.h"
#include "simulate/run_parts.h"

namespace subimpact {
namespace {

// The paper's beam from 8 us, just before anything flows, over 52 us and some hundred turns, by
// fixed steps that are never cut. (What happens at the first touch, F ~ lambda^1.5, is left out: it
// has an order of its own.)
State state_after(double step, double kink_tolerance) {
  Case input = paper_case(SectionKind::exact, 8e-6);
  input.solver.method = Method::nystrom;
  input.solver.rtol = 1e-12;
  ResolvedRun run = resolve(input);
  StruckBeam& beam = run.parts().beam;
  RunObserver nobody;
  const auto first = run.parts().make_integrator();
  Audit audit(beam, beam.initial_state());
  EventLoop beginning(beam, *first, nobody, audit, run.parts().run.loop);
  beginning.start();
  while (!beginning.finished()) beginning.advance();
  EXPECT_EQ(beam.sections().n_yielded(), 0u);

  run.parts().given.solver.step = step;
  const auto fixed = run.parts().make_integrator();
  LoopOptions options = run.parts().run.loop;
  options.end_time = 52e-6;
  options.kink_tolerance = kink_tolerance;
  EventLoop loop(beam, *fixed, nobody, audit, options);
  loop.start_from(beginning.state());
  while (!loop.finished()) loop.advance();
  EXPECT_GT(beam.sections().n_yielded(), 20u);
  return loop.state();
}

double largest_difference(const State& a, const State& b) {
  double largest = 0.0;
  for (std::size_t i = a.size() / 2; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  return largest;
}

constexpr double never_cut = 1e3;
constexpr double only_at_ends = std::numeric_limits<double>::infinity();

OrderTable errors(const std::string& title, double kink_tolerance) {
  const State exact = state_after(5e-9, never_cut);
  OrderTable table(title);
  for (const double step : {2e-7, 1e-7, 5e-8}) {
    const State y = state_after(step, kink_tolerance);
    table.add(1e-6 / step, largest_difference(y, exact));
  }
  table.print();
  return table;
}

TEST(SectionKinks, PutRightAtStepEndsLeaveAMethodMostOfItsOrder) {
  errors("steps a us, kinks put right", never_cut).expect_overall_order_within(4.5, 7.5);
}

// Steps of 0.2 us are 1.4 radians of the beam's highest frequency.
TEST(SectionKinks, ArePutRightAsWellAsIsAsked) {
  const State exact = state_after(5e-9, never_cut);
  const double loose = largest_difference(state_after(2e-7, never_cut), exact);
  const double tight = largest_difference(state_after(2e-7, 1e-8), exact);
  std::printf("steps of 0.2 us: error %.2e m/s by the first term, %.2e to a tolerance of 1e-8\n",
              loose, tight);
  EXPECT_LT(tight, 0.1 * loose);
}

TEST(SectionKinks, HardlyEverCutAStep) {
  Case input = paper_case(SectionKind::exact, 0.5e-3);
  input.solver.method = Method::nystrom;
  input.solver.rtol = 1e-8;
  struct Counter : RunObserver {
    long turns = 0;
    void on_turn(const Transition&) override { ++turns; }
  } counter;
  ResolvedRun run = resolve(input);
  StruckBeam& beam = run.parts().beam;
  const auto integrator = run.parts().make_integrator();
  Audit audit(beam, beam.initial_state());
  EventLoop loop(beam, *integrator, counter, audit, run.parts().run.loop);
  loop.start();
  while (!loop.finished()) loop.advance();
  const WorkCounts work = integrator->work();
  std::printf("%ld steps, %ld turns, %ld partial steps for %ld events and all cuts\n", work.steps,
              counter.turns, work.partial_steps, loop.n_events());
  EXPECT_GT(counter.turns, 500);
  EXPECT_LT(work.partial_steps, counter.turns / 5);
}

State state_late(double rtol) {
  Case input = paper_case(SectionKind::exact, 0.9e-3);
  input.solver.method = Method::nystrom;
  input.solver.rtol = rtol;
  ResolvedRun run = resolve(input);
  StruckBeam& beam = run.parts().beam;
  RunObserver nobody;
  const auto integrator = run.parts().make_integrator();
  Audit audit(beam, beam.initial_state());
  EventLoop loop(beam, *integrator, nobody, audit, run.parts().run.loop);
  loop.start();
  while (!loop.finished()) loop.advance();
  return loop.state();
}

// A kink that moves the next one in its step, or undoes it: what is left out then does not shrink
// with the tolerance.
TEST(SectionKinks, OfOneStepAreFollowedInWhatTheyDoToEachOther) {
  const double off = largest_difference(state_late(1e-11), state_late(1e-12));
  std::printf("velocities at rtol 1e-11 and 1e-12 differ by %.2e m/s\n", off);
  EXPECT_LT(off, 1e-7);
}

TEST(SectionKinks, LeftAloneBringAnyMethodDownToSecondOrder) {
  errors("steps a us, memory advanced at step ends", only_at_ends)
      .expect_overall_order_within(1.0, 2.6);
}

}  // namespace
}  // namespace subimpact
