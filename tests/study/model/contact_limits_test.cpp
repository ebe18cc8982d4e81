// What bounds the force of a contact, and what a case leaves open of the bodies in contact.

#include "elastic_case.h"
#include "study/model/body_runs.h"
#include "subimpact/case/simulate.h"
#include "subimpact/study/model.h"
#include "testing.h"

namespace subimpact {
namespace {

Case ball_on_plane(double yield_stress) {
  Case input = elastic_case(2e-3);
  input.scene.beam.fixed = true;
  input.scene.beam.yield_stress = yield_stress;
  input.scene.striker.nose = NoseShape::sphere;
  input.scene.striker.velocity = 2.0;
  input.model = {};
  input.model.mesh = MeshKind::rigid;
  choose_scene(input, {});
  return input;
}

TEST(LargestPossibleForce, IsThatOfAStrikerOnAPlaneAndIsNotReachedOnABeam) {
  for (const double yield_stress : {150e6, double(INFINITY)}) {
    Case input = ball_on_plane(yield_stress);
    const Result on_plane = simulate(input);
    const double most = largest_possible_force(input, on_plane);
    EXPECT_NEAR(on_plane.max_force, most, 1e-6 * most) << yield_stress;
    input.scene.gravity = standard_gravity;
    const Result in_gravity = simulate(input);
    EXPECT_LE(in_gravity.max_force, largest_possible_force(input, in_gravity));
    EXPECT_NEAR(largest_possible_force(input, in_gravity), most, 1e-2 * most);
    input.scene.beam.fixed = false;
    const Result on_body = simulate(input);
    EXPECT_LT(on_body.max_force, 0.9 * most);
  }
}

TEST(LargestPossibleForce, OfADampedContactIsNotKnown) {
  Case input = elastic_case(1e-4);
  input.scene.contact.kind = ContactKind::linear;
  input.scene.contact.stiffness = 1e6;
  const Result result = simulate(input);
  EXPECT_LE(result.max_force, largest_possible_force(input, result));
  input.scene.contact.damping = 0.1;
  EXPECT_EQ(largest_possible_force(input, result), INFINITY);
}

TEST(SteelContact, IsOfANoseOrAPlaneWithoutModuliAndSoftensTheContact) {
  Case input = ball_on_plane(150e6);
  const auto steel = with_steel_contact(input);
  ASSERT_TRUE(steel);
  EXPECT_NO_THROW(check(*steel));
  EXPECT_LT(simulate(*steel).max_force, simulate(input).max_force);
  EXPECT_FALSE(with_steel_contact(*steel));  // nothing is open any more

  Case plane = *steel;
  plane.scene.beam.youngs_modulus = 0.0;
  const auto steel_plane = with_steel_contact(plane);
  ASSERT_TRUE(steel_plane);
  EXPECT_NO_THROW(check(*steel_plane));
  EXPECT_LT(simulate(*steel_plane).max_force, simulate(plane).max_force);
}

TEST(SteelContact, IsNotThatOfAGivenStiffness) {
  Case input = elastic_case(1e-4);
  input.scene.contact.kind = ContactKind::hertz;
  input.scene.contact.stiffness = 1e9;
  EXPECT_FALSE(with_steel_contact(input));
}

}  // namespace
}  // namespace subimpact
