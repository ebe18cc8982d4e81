// What a caller's observer is shown of a run.

#include "subimpact/simulate/observer.h"

#include "paper_run.h"
#include "same_results.h"
#include "subimpact/case/simulate.h"

namespace subimpact {
namespace {

Case paper_case(Method method) {
  Case input = paper_run(SectionKind::exact, 1e-3, 101, method);
  input.output.interval = 1e-5;
  return input;
}

struct Notes final : Observer {
  void on_step(const RunView& end) override {
    EXPECT_GE(end.time(), last_time);
    last_time = end.time();
    ++steps;
    const Energies energies = end.energies();
    if (energy == 0.0) energy = energies.total();
    EXPECT_NEAR(energies.total(), energy, 1e-3 * energy);
    EXPECT_NEAR(end.striker().displacement - end.struck_point().displacement, end.indentation(),
                1e-15);
    if (!end.in_contact()) {
      EXPECT_EQ(end.contact_force(), 0.0);
      EXPECT_LE(end.indentation(), end.residual_indentation() + 1e-12);
    }
    striker_velocity = end.striker().velocity;
  }
  void before_event(const Transition& event, const RunView& at) override {
    EXPECT_EQ(at.time(), event.time);
    EXPECT_EQ(at.indentation(), event.value);
    EXPECT_EQ(at.in_contact(), event.kind != EventKind::contact_begins);
    before.push_back(event);
  }
  void after_event(const Transition& event, const RunView& at) override {
    EXPECT_EQ(before.back().time, event.time);
    EXPECT_EQ(at.in_contact(), event.kind != EventKind::contact_ends);
    ++n_after;
  }
  void on_reversal(const Transition& reversal) override {
    EXPECT_EQ(reversal.kind, EventKind::section_reverses);
    ++reversals;
  }

  long steps = 0;
  std::size_t reversals = 0, n_after = 0;
  std::vector<Transition> before;
  double energy = 0.0, last_time = 0.0, striker_velocity = 0.0;
};

TEST(AnObserver, SeesEveryStepAndBothSidesOfEveryEvent) {
  for (const Method method : {Method::erk, Method::nystrom, Method::central_difference}) {
    const Case input = paper_case(method);
    Notes notes;
    const Result result = simulate(input, notes);
    EXPECT_EQ(notes.steps, result.work.steps);
    EXPECT_EQ(notes.last_time, input.end_time);
    EXPECT_EQ(notes.striker_velocity, result.striker_velocity);
    EXPECT_EQ(notes.n_after, notes.before.size());
    EXPECT_EQ(notes.before.size() + notes.reversals, result.transitions.size());
    std::size_t i = 0;
    for (const Transition& event : result.transitions) {
      if (event.kind == EventKind::section_reverses) continue;
      EXPECT_EQ(event.time, notes.before[i].time);
      EXPECT_EQ(event.kind, notes.before[i].kind);
      ++i;
    }
  }
}

TEST(AnObserver, ChangesNothing) {
  for (const Method method : {Method::erk, Method::nystrom, Method::central_difference}) {
    const Case input = paper_case(method);
    Notes notes;
    expect_same(simulate(input), simulate(input, notes));
  }
}

TEST(AnObserver, MayLeaveTheRunByAnException) {
  struct Thrower final : Observer {
    void on_step(const RunView& now) override {
      if (now.time() > 1e-4) throw std::runtime_error("enough");
    }
  } thrower;
  EXPECT_THROW(simulate(paper_case(Method::erk), thrower), std::runtime_error);
}

}  // namespace
}  // namespace subimpact
