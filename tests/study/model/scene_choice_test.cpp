// Theory and contact law, chosen by the scene where the case leaves them open.

#include "subimpact/study/model/scene_choice.h"
#include "elastic_case.h"
#include "subimpact/case/simulate.h"
#include "testing.h"

namespace subimpact {
namespace {

Case yielding_case() {
  Case input = elastic_case(8e-3);
  input.model = {};
  return input;
}

TEST(SceneChoice, OfThePublishedStrikeIsShearAndALineContactByDepth) {
  Case input = yielding_case();
  const auto keys = choose_scene(input, {});
  EXPECT_EQ(keys, (std::vector<std::string>{"beam.theory", "beam.poisson", "contact.law",
                                            "contact.yield_pressure"}));
  EXPECT_TRUE(input.scene.beam.shears());
  EXPECT_EQ(input.scene.beam.poisson, usual_poisson);
  EXPECT_EQ(input.scene.contact.kind, ContactKind::line);
  EXPECT_TRUE(input.scene.contact.pressure_by_depth);
  expect_in(input.model_choice, "on a coarse mesh", "a cylinder across a solid beam",
            "a nose not given is a cylinder", "beam.poisson = 0.3");
  EXPECT_NO_THROW(check(input));
}

TEST(SceneChoice, LeavesGivenKeysAlone) {
  Case input = yielding_case();
  const Case before = input;
  EXPECT_TRUE(choose_scene(input, {{"beam.theory", "contact.law"}, {}}).empty());
  EXPECT_FALSE(input.scene.beam.shears());
  EXPECT_EQ(input.scene.contact.kind, before.scene.contact.kind);
  EXPECT_FALSE(input.scene.beam.poisson);  // neither of the two needs it
  EXPECT_EQ(input.model_choice, "");
}

TEST(SceneChoice, OfABallIsASphereFromTheMidPlaneWhereTheBeamBends) {
  Case input = yielding_case();
  input.scene.striker.nose = NoseShape::sphere;
  Case rigid = input;
  choose_scene(input, {});
  EXPECT_EQ(input.scene.contact.kind, ContactKind::sphere);
  EXPECT_EQ(input.scene.contact.indentation, IndentationFrom::mid_plane);
  EXPECT_TRUE(input.scene.contact.pressure_by_depth);
  rigid.model.mesh = MeshKind::rigid;
  choose_scene(rigid, {});
  EXPECT_EQ(rigid.scene.contact.indentation, IndentationFrom::half_space);
  EXPECT_FALSE(rigid.scene.beam.shears());
}

TEST(SceneChoice, OnAHollowSectionTakesABallOnTheHalfSpaceAndSaysWhatThatLacks) {
  Case input = yielding_case();
  Beam& beam = input.scene.beam;
  beam.section = {SectionShape::box, beam.thickness, beam.width, {}, 1e-3};
  beam.thickness = beam.width = 0.0;
  choose_scene(input, {});
  EXPECT_EQ(input.scene.contact.kind, ContactKind::sphere);
  EXPECT_EQ(input.scene.contact.indentation, IndentationFrom::half_space);
  expect_in(input.model_choice, "bending walls");
  EXPECT_NO_THROW(check(input));
}

TEST(SceneChoice, IsRayleighOnMeshesThatCannotShear) {
  Case input = yielding_case();
  input.model.mesh = MeshKind::hermite;
  choose_scene(input, {{"model.mesh"}, {}});
  EXPECT_FALSE(input.scene.beam.shears());
  expect_in(input.model_choice, "this mesh cannot shear");
}

TEST(SceneChoice, IsRayleighWhereATestShowsThatShearDoesNotMatter) {
  // A light pad, slow and soft: the beam bends in its lowest mode alone.
  Case input = yielding_case();
  input.scene.beam.yield_stress = INFINITY;
  input.scene.beam.ends = {EndSupport::pinned, EndSupport::pinned};
  input.scene.contact.kind = ContactKind::linear;
  input.scene.contact.stiffness = 2e3;
  input.scene.striker.velocity = 0.1;
  input.end_time = 0.1;
  choose_scene(input, {{"contact.law", "contact.stiffness"}, {}});
  EXPECT_FALSE(input.scene.beam.shears()) << input.model_choice;
  expect_in(input.model_choice, "less than 5 us", "less than 1 %");
}

TEST(SceneChoice, DependsOnTheSceneAlone) {
  Case input = yielding_case(), other = input;
  other.model.segments = 1001;
  other.solver.method = Method::nystrom;
  other.solver.rtol = 1e-5;
  other.output.keep_no_rows();
  choose_scene(input, {});
  choose_scene(other, {{"model.segments", "solver.method", "solver.rtol"}, {}});
  EXPECT_EQ(input.model_choice, other.model_choice);
}

}  // namespace
}  // namespace subimpact
