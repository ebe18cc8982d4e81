#pragma once

#include <cmath>
#include <limits>
#include <utility>

#include "integrate/sundials/vector.h"
#include "ode/integrator.h"

namespace subimpact {

/// An integrator out of two solvers of one one-step method: one goes forward, the other retakes
/// part of the last step, from its start, with a single step of the required length. So a state
/// inside a step has the method's own order.
///
/// Solver(ode, options, context, more...) is made twice, the second time with `as_partial` options;
/// it offers reset(t, y), step(y) -> time reached, set_fixed_step(h), time() and
/// add_counts(WorkCounts&).
template <class Solver>
class OneStepIntegrator final : public Integrator {
 public:
  template <class Ode, class... More>
  OneStepIntegrator(Ode& ode, const IntegratorOptions& options, const More&... more)
      : context_(make_context()),
        main_(ode, options, context_.get(), more...),
        partial_(ode, as_partial(options), context_.get(), more...) {}

  void restart(double t, const State& y) override {
    main_.reset(t, y);
    stand_at(t, y);
  }

  void step() override {
    std::swap(y0_, y1_);
    t0_ = t1_;
    try {
      t1_ = main_.step(y1_);
      // The library goes on even where a step no longer moves the time; the bound is nystrom's.
      if (!main_.root() &&
          !(t1_ - t0_ > 16.0 * std::numeric_limits<double>::epsilon() * std::abs(t0_))) {
        throw IntegrationFailure(t0_, "ARKODE", "step size too small",
                                 "the step has shrunk to the rounding of the time");
      }
    } catch (...) {
      undo_step();
      throw;
    }
    ++steps_;
  }

  void state_at(double t, State& y) override {
    if (t == t0_) {  // to the library a fixed step of zero means an adaptive one
      y = y0_;
      return;
    }
    y.resize(y0_.size());
    partial_.set_fixed_step(t - t0_);
    partial_.reset(t0_, y0_);
    partial_.step(y);
    ++partial_steps_;
  }

  std::optional<Root> root() const override { return main_.root(); }

  WorkCounts work() const override {
    WorkCounts counts;
    main_.add_counts(counts);
    partial_.add_counts(counts);
    counts.steps = steps_;
    counts.partial_steps = partial_steps_;
    return counts;
  }

 private:
  static IntegratorOptions as_partial(IntegratorOptions options) {
    options.fixed_step = options.fixed_step.value_or(1.0);  // set anew before every use
    options.max_step.reset();
    options.event_functions.reset();
    return options;
  }

  ContextPointer context_;
  Solver main_;
  Solver partial_;
  long steps_ = 0;
  long partial_steps_ = 0;
};

}  // namespace subimpact
