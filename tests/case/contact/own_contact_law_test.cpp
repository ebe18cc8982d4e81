// Contact laws that a caller brings, through the public door.

#include "built_in_law.h"
#include "paper_run.h"
#include "print.h"
#include "runs.h"
#include "same_results.h"
#include "simulate/run_parts.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

Case paper_case() {
  Case input = paper_run(SectionKind::exact, 1.5e-3, 101);
  input.output.interval = 2e-5;
  return input;
}

/// The law `foundation` behind a class of the caller's. It calls the same compiled formulas:
/// written out here, a compiler may fuse their products and sums in another way.
class OwnFoundation final : public ContactLaw {
 public:
  explicit OwnFoundation(const Scene& scene) : law_(law_of(scene)) {}

  std::string name() const override { return "own foundation"; }
  ContactScales scales() const override { return law_.scales(); }
  double residual_indentation(ContactHistory history) const override {
    return law_.residual_indentation(history);
  }
  double yield_threshold(ContactHistory history) const override {
    return law_.yield_threshold(history);
  }
  double force(ContactHistory history, double x) const override { return law_.force(history, x); }
  double slope(ContactHistory history, double x) const override { return law_.slope(history, x); }
  double plastic_force(double x) const override { return law_.plastic_force(x); }
  double plastic_slope(double x) const override { return law_.plastic_slope(x); }
  double recoverable_energy(ContactHistory history, double x) const override {
    return law_.recoverable_energy(history, x);
  }
  double dissipated_energy(ContactHistory history) const override {
    return law_.dissipated_energy(history);
  }

 private:
  PowerContact law_;
};

class EveryMethod : public testing::TestWithParam<Method> {};

TEST_P(EveryMethod, GivesTheSameBitsWithTheBuiltInLawAsTheCallersOwn) {
  Case input = paper_case();
  input.solver.method = GetParam();
  if (GetParam() == Method::exponential) input.model.section = SectionKind::elastic;
  const Result built_in = simulate(input);
  EXPECT_EQ(built_in.used.contact_law, "foundation");
  ASSERT_GT(built_in.sub_impacts.size(), 2u);
  input.parts.contact_law = std::make_shared<OwnFoundation>(input.scene);
  const Result own = simulate(input);
  EXPECT_EQ(own.used.contact_law, "own foundation");
  EXPECT_EQ(own.used.critical_step, built_in.used.critical_step);
  EXPECT_EQ(own.used.contact_time, built_in.used.contact_time);
  EXPECT_EQ(own.used.yield_indentation, built_in.used.yield_indentation);
  expect_same(built_in, own);
}

INSTANTIATE_TEST_SUITE_P(, EveryMethod,
                         testing::Values(Method::erk, Method::nystrom, Method::exponential,
                                         Method::central_difference, Method::dirk),
                         NamedAsPrinted{});

TEST(AnOwnContactLaw, MakesTheKeysOfTheSceneUnnecessary) {
  Case input = paper_case();
  input.parts.contact_law = std::make_shared<OwnFoundation>(input.scene);
  const Result with_nose = simulate(input);
  input.scene.striker.nose_radius.reset();
  expect_same(with_nose, simulate(input));
  input.parts.contact_law = nullptr;
  EXPECT_THROW(simulate(input), InvalidCase);
}

/// Loading along k1, un- and reloading along k2: yields from the first touch on.
class TwoLines final : public ContactLaw {
 public:
  TwoLines(double k1, double k2) : k1_(k1), k2_(k2) {}
  std::string name() const override { return "two lines"; }
  ContactScales scales() const override { return {k1_, 1.0}; }
  double residual_indentation(ContactHistory history) const override {
    return (1.0 - k1_ / k2_) * history.max_indentation;
  }
  double yield_threshold(ContactHistory history) const override { return history.max_indentation; }
  double force(ContactHistory history, double x) const override {
    return k2_ * (x - residual_indentation(history));
  }
  double slope(ContactHistory, double) const override { return k2_; }
  double plastic_force(double x) const override { return k1_ * x; }
  double plastic_slope(double) const override { return k1_; }
  double recoverable_energy(ContactHistory history, double x) const override {
    const double depth = std::max(x - residual_indentation(history), 0.0);
    return 0.5 * k2_ * depth * depth;
  }
  double dissipated_energy(ContactHistory history) const override {
    return 0.5 * k1_ * history.max_indentation * residual_indentation(history);
  }

 private:
  double k1_, k2_;
};

Case rigid_case() {
  Case input = paper_run(SectionKind::exact, 2e-3);
  input.scene.striker.velocity = 1.0;
  input.scene.striker.nose_radius.reset();
  input.model.mesh = MeshKind::rigid;
  input.output.interval = 1e-5;
  return input;
}

TEST(AnOwnContactLaw, ThatYieldsFromTheFirstTouchHasItsRestitution) {
  for (const Method method :
       {Method::erk, Method::nystrom, Method::exponential, Method::central_difference}) {
    const double tolerance = method == Method::central_difference ? 1e-3 : 1e-7;
    for (const double ratio : {0.3, 0.8, 0.99}) {
      Case input = rigid_case();
      input.solver.method = method;
      input.parts.contact_law = std::make_shared<TwoLines>(1e7, 1e7 / ratio);
      const Result result = completed(input);
      ASSERT_EQ(result.sub_impacts.size(), 1u);
      EXPECT_NEAR(result.beam_mean_velocity - result.striker_velocity, std::sqrt(ratio), tolerance)
          << to_string(method) << ' ' << ratio;
      EXPECT_LT(result.first_contact_yield.value(), 1e-9);
    }
  }
}

/// A line less a jump (N) at the first touch, with a share of the energy that it should have.
class WrongLine final : public ContactLaw {
 public:
  WrongLine(double jump, double share) : jump_(jump), share_(share) {}
  std::string name() const override { return "wrong line"; }
  ContactScales scales() const override { return {k, 1.0}; }
  double residual_indentation(ContactHistory) const override { return 0.0; }
  double yield_threshold(ContactHistory) const override { return 1e300; }
  double force(ContactHistory, double x) const override { return k * x - jump_; }
  double slope(ContactHistory, double) const override { return k; }
  double plastic_force(double x) const override { return force({}, x); }
  double plastic_slope(double) const override { return k; }
  double recoverable_energy(ContactHistory, double x) const override {
    return share_ * (0.5 * k * x * x - jump_ * x);
  }
  double dissipated_energy(ContactHistory) const override { return 0.0; }

 private:
  static constexpr double k = 1e7;
  double jump_, share_;
};

// Without the look at the law beforehand: the accounts of the run find it.
TEST(AnOwnContactLaw, ThatBreaksItsContractIsCaughtByTheRunToo) {
  for (const Method method : {Method::erk, Method::nystrom, Method::central_difference}) {
    for (const auto& [jump, share] : {std::pair(0.0, 1.0), {100.0, 1.0}, {0.0, 0.9}, {0.0, 1.1}}) {
      Case input = rigid_case();
      input.solver.method = method;
      input.parts.contact_law = std::make_shared<WrongLine>(jump, share);
      ResolvedRun run = resolve(input);
      const auto integrator = run.parts().make_integrator();
      run.parts().given.output.interval = 1e-5;
      const Result result = simulate(run.parts(), *integrator);
      const bool is_right = jump == 0.0 && share == 1.0;
      EXPECT_EQ(result.outcome.kind, is_right ? OutcomeKind::completed : OutcomeKind::inaccurate)
          << to_string(method) << ' ' << jump << ' ' << share << ' ' << result.outcome.message;
    }
  }
}

}  // namespace
}  // namespace subimpact
