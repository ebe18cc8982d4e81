// How far the body itself may be from the exact solution of the model.

#include "elastic_case.h"
#include "study/model/body_runs.h"
#include "study/model/coarse_strike.h"
#include "subimpact/case/simulate.h"
#include "subimpact/study/model.h"
#include "subimpact/study/run_as_asked.h"
#include "testing.h"

namespace subimpact {
namespace {

std::optional<BodyErrors> body_errors(const Case& input, Result result,
                                      const Progress& progress = {}) {
  add_body_errors(input, result, progress);
  return result.body_errors;
}

const BodyErrors::Part* part_of(const BodyErrors& errors, BodyPart name) {
  const auto found = std::ranges::find(errors.parts, name, &BodyErrors::Part::kind);
  return found == errors.parts.end() ? nullptr : &*found;
}

// At 0.1 m/s nothing yields: the first contact of the published beam ends at 403.89 us, with shear
// (k = 5/6, nu = 0.33) at 424.18 us, in the limit of fine meshes.
TEST(BodyErrors, OfMissingShearIsThatOfFineMeshesToAQuarterOfItsSize) {
  Case input = elastic_case(0.6e-3);
  input.scene.striker.velocity = 0.1;
  input.scene.beam.poisson = 0.33;
  input.scene.beam.shear_coefficient = 5.0 / 6.0;
  const auto errors = body_errors(input, simulate(input));
  ASSERT_TRUE(errors);
  const BodyErrors::Part* shear = part_of(*errors, BodyPart::shear);
  ASSERT_TRUE(shear != nullptr && shear->change.parting);
  EXPECT_NEAR(*shear->change.parting, 424.18e-6 - 403.89e-6, 5e-6);
}

TEST(BodyErrors, AddUpToTheErrorAndNameWhatIsNotKnown) {
  Case input = elastic_case(2e-3);
  input.model = {};
  input.output.interval = 1e-5;
  const auto errors = body_errors(input, simulate(input));
  ASSERT_TRUE(errors);
  double sum = 0.0;
  for (const BodyErrors::Part& part : errors->parts) sum += part.change.peak_force.value_or(0.0);
  EXPECT_DOUBLE_EQ(sum, *errors->error.peak_force);
  const BodyErrors::Part* hinge = part_of(*errors, BodyPart::hinge_length);
  ASSERT_TRUE(hinge != nullptr);
  EXPECT_EQ(hinge->change.peak_force, 0.0);
  EXPECT_GT(*hinge->change.permanent_set, 0.0);
  EXPECT_TRUE(part_of(*errors, BodyPart::width) != nullptr);
  EXPECT_TRUE(part_of(*errors, BodyPart::stretching) == nullptr);  // the ends are free
}

// By hand: the tension of a pinned beam over its buckling load, (w/2r)^2, within a factor of four.
TEST(BodyErrors, OfStretchingAreOfTheSizeOfTheTensionOverTheBucklingLoad) {
  Case input = elastic_case(0.4e-3);
  input.scene.beam.ends = {EndSupport::pinned, EndSupport::pinned};
  const Result result = simulate(input);
  const auto errors = body_errors(input, result);
  ASSERT_TRUE(errors);
  const BodyErrors::Part* stretching = part_of(*errors, BodyPart::stretching);
  ASSERT_TRUE(stretching != nullptr && stretching->change.striker_velocity);
  const double half = 0.5 * result.largest_displacement / input.scene.beam.radius_of_gyration();
  EXPECT_GT(*stretching->change.striker_velocity, 0.0);
  EXPECT_LT(*stretching->change.striker_velocity,
            4.0 * half * half * std::abs(result.striker_velocity));
}

// Spectral elements have no modes in closed form between unlike ends.
TEST(BodyErrors, DecomposeNoLargeMatrixForShear) {
  Case input = elastic_case(0.6e-3, 501, Method::exponential);
  input.scene.beam.theory = BeamTheory::euler_bernoulli;
  input.scene.beam.ends = {EndSupport::clamped, EndSupport::pinned};
  input.model.mesh = MeshKind::hermite;
  const auto decomposition = [&](int elements) -> std::optional<double> {
    input.model.elements = elements;
    const Result result = simulate(input);
    BodyRuns runs(input, result, std::nullopt, 5.0, {});
    Case sheared = input;
    sheared.scene.beam.theory = BeamTheory::timoshenko;
    sheared.scene.beam.poisson = 0.3;
    const auto run = runs.on_mesh(sheared, runs.horizons().back());
    return run ? std::optional(run->used.decomposition) : std::nullopt;
  };
  EXPECT_LT(decomposition(300).value_or(1e99), 3e7);
  EXPECT_LT(decomposition(3000).value_or(0.0), 3e7);
}

TEST(BodyErrors, AreNoneWhereTheRunIsToEnd) {
  const Case input = elastic_case(0.6e-3);
  int n_asked = 0;
  const auto stop = [&](double) {
    ++n_asked;
    return false;
  };
  EXPECT_FALSE(body_errors(input, simulate(input), stop));
  EXPECT_LT(n_asked, 5);
}

TEST(BodyErrors, AreNoneWithoutContactAndOfARigidBeamHaveItsBending) {
  Case input = elastic_case(0.6e-3);
  Result untouched = simulate(input);
  untouched.sub_impacts.clear();
  EXPECT_FALSE(body_errors(input, untouched));
  input.model.mesh = MeshKind::rigid;
  const auto errors = body_errors(input, simulate(input));
  ASSERT_TRUE(errors);
  EXPECT_TRUE(part_of(*errors, BodyPart::bending) != nullptr);
  EXPECT_TRUE(part_of(*errors, BodyPart::shear) == nullptr);
}

}  // namespace
}  // namespace subimpact
