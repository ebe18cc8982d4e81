// Samples of a case with scatter: means, deviations and quantiles of the strike as a whole.

#include "paper_run.h"
#include "subimpact/study/other_mesh.h"
#include "subimpact/study/sensitivity/predictability.h"
#include "testing.h"

#include <algorithm>

namespace subimpact {
namespace {

// A mass on a spring against a rigid bar: the largest force is in proportion to the velocity.
Case against_rigid_bar() {
  Case input = paper_run(SectionKind::elastic, 1e-3);
  input.model.mesh = MeshKind::rigid;
  input.scene.contact.kind = ContactKind::linear;
  input.scene.contact.stiffness = 1e7;
  return input;
}

const Predictability::Sampled& total(const Predictability& found, const std::string& name) {
  return *std::ranges::find(found.totals, name, &Predictability::Sampled::name);
}

Predictability sampled(const Case& input, Jobs jobs = 1) {
  Predictability found;
  SensitivityOptions options;
  options.jobs = jobs;
  add_samples(found, input, options);
  return found;
}

TEST(Samples, OfALinearContactScatterInForceAsTheVelocityDoes) {
  Case input = against_rigid_bar();
  input.scatter = {{"striker.velocity", 0.02}};
  const Predictability found = sampled(input);
  EXPECT_EQ(found.n_samples, most_samples);
  const auto& force = total(found, "peak_force_N");
  const double one = simulate(input).max_force;
  // 64 samples leave an eighth of a deviation open in their mean, and 9 % of the deviation itself.
  EXPECT_NEAR(force.mean, one, 3.0 * 0.02 * one / 8.0);
  EXPECT_NEAR(force.deviation, 0.02 * one, 0.3 * 0.02 * one);
  EXPECT_NEAR(force.quantile_95 - force.quantile_5, 2.0 * 1.645 * 0.02 * one, 0.4 * 0.066 * one);
  EXPECT_NEAR(total(found, "restitution").deviation, 0.0, 1e-6);
  EXPECT_NEAR(*found.striker_velocity_scatter, total(found, "striker_velocity_m_per_s").deviation,
              0.0);
}

TEST(Samples, AreTheSameWithSeveralJobs) {
  Case input = against_rigid_bar();
  input.scatter = {{"striker.mass", 0.05}, {"striker.velocity", 0.05}};
  const Predictability one = sampled(input), three = sampled(input, 3);
  ASSERT_EQ(one.totals.size(), three.totals.size());
  for (std::size_t k = 0; k < one.totals.size(); ++k) {
    EXPECT_EQ(one.totals[k].deviation, three.totals[k].deviation) << one.totals[k].name;
  }
}

TEST(AnAffordableCase, IsTheCaseItselfWhereItsRunsTakeLittle) {
  const Case input = paper_run(SectionKind::elastic, 1e-4, 101);
  EXPECT_EQ(mesh_count(affordable_case(input, 10.0)), mesh_count(input));
}

TEST(AnAffordableCase, IsCoarserTheMoreRunsThereAre) {
  const Case input = paper_run(SectionKind::elastic, 1e-4, 401);
  const int some = mesh_count(affordable_case(input, 3e3));
  const int many = mesh_count(affordable_case(input, 3e6));
  EXPECT_LT(some, mesh_count(input));
  EXPECT_LT(many, some);
  EXPECT_GE(many, mesh_count(input) / 8);
}

}  // namespace
}  // namespace subimpact
