// Theory and contact law, chosen by the scene where the case leaves them open.

#include "subimpact/study/model.h"

#include <random>

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

struct Chosen {
  const char* scene;
  std::optional<NoseShape> nose;
  CrossSection section;
  MeshKind mesh;
  ContactKind law;
  IndentationFrom from;
  const char* words;
};

TEST(SceneChoice, OfALawFollowsFromNoseSectionAndWhetherTheBeamBends) {
  using enum NoseShape;
  const CrossSection plain{}, box{SectionShape::box, 0.0075, 0.0163, {}, 1e-3},
      bar{SectionShape::circle, {}, {}, 0.03}, tube{SectionShape::tube, {}, {}, 0.03, 0.003};
  constexpr auto half_space = IndentationFrom::half_space, mid_plane = IndentationFrom::mid_plane;
  constexpr auto cells = MeshKind::cells, rigid = MeshKind::rigid;
  constexpr auto as_sphere = ContactKind::sphere;
  for (const Chosen& row :
       {Chosen{"a ball", sphere, plain, cells, as_sphere, mid_plane, ""},
        Chosen{"a ball on a rigid body", sphere, plain, rigid, as_sphere, half_space,
               "a body that does not bend"},
        Chosen{"a hollow section", {}, box, cells, as_sphere, half_space, "bending walls"},
        Chosen{"a bar", {}, bar, cells, as_sphere, half_space, ""},
        Chosen{"a ball on a bar", sphere, bar, cells, as_sphere, half_space, ""},
        Chosen{"a cylinder on a bar", cylinder, bar, cells, as_sphere, half_space, ""},
        Chosen{"a cylinder on a tube", cylinder, tube, cells, as_sphere, half_space, ""}}) {
    SCOPED_TRACE(row.scene);
    Case input = yielding_case();
    input.scene.striker.nose = row.nose;
    input.model.mesh = row.mesh;
    if (row.section.wall || row.section.diameter) {
      input.scene.beam.section = row.section;
      input.scene.beam.thickness = input.scene.beam.width = 0.0;
    }
    choose_scene(input, {});
    EXPECT_EQ(input.scene.contact.kind, row.law);
    EXPECT_EQ(input.scene.contact.indentation, row.from);
    EXPECT_TRUE(input.scene.contact.pressure_by_depth);
    EXPECT_EQ(input.scene.beam.shears(), row.mesh == cells);
    expect_in(input.model_choice, row.words);
    EXPECT_NO_THROW(check(input));
  }
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

TEST(SceneChoice, OfANoseWithHalfOfItsModuliNamesTheOtherHalf) {
  Case input = yielding_case();
  input.scene.contact.striker_modulus = 210e9;
  try {
    choose_scene(input, {{"contact.striker_modulus"}, {}});
    FAIL() << "was taken";
  } catch (const InvalidCase& refused) {
    EXPECT_EQ(refused.key, "contact.striker_modulus");
    expect_in(refused.what(), "only where both", "contact.striker_poisson");
  }
}

// A steel ball of 1 kg on a plane of S235 at 1 m/s; all its energy in a dent under 2.8 Y (Tabor):
// 0.5 J = 2.8 Y pi R d^2.
Case ball_on_plane() {
  Case input;
  Beam& beam = input.scene.beam;
  beam.fixed = true;
  beam.density = 7850.0;
  beam.youngs_modulus = 210e9;
  beam.yield_stress = 235e6;
  beam.poisson = 0.3;
  Striker& striker = input.scene.striker;
  striker.mass = 1.0;
  striker.velocity = 1.0;
  striker.nose = NoseShape::sphere;
  striker.nose_radius = 0.02;
  input.scene.contact.striker_modulus = 210e9;
  input.scene.contact.striker_poisson = 0.3;
  input.model.mesh = MeshKind::rigid;
  input.end_time = 1e-3;
  return input;
}

TEST(SceneChoice, OfABallOnAPlaneYieldsByDepthAndPressesAsHardAsTaborSays) {
  Case input = ball_on_plane();
  choose_scene(input, {});
  EXPECT_TRUE(input.scene.contact.pressure_by_depth);
  const double hardness = 2.8 * 235e6, R = 0.02, depth = std::sqrt(0.5 / (M_PI * hardness * R));
  const double force = hardness * 2.0 * M_PI * R * depth;
  const Result result = simulate(input);
  ASSERT_EQ(result.sub_impacts.size(), 1u);
  EXPECT_NEAR(result.max_force, force, 0.15 * force);
  EXPECT_LT(result.sub_impacts[0].residual_indentation, depth);
  EXPECT_GT(result.sub_impacts[0].max_indentation, depth);
  // Thornton's law as published has half the force.
  input.scene.contact.pressure_by_depth = false;
  EXPECT_LT(simulate(input).max_force, 0.6 * force);
}

TEST(SceneChoice, OfACylinderOnAPlaneIsALineByDepthWhereThePlaneHasAThickness) {
  Case input = ball_on_plane();
  input.scene.striker.nose = NoseShape::cylinder;
  Case thick = input;
  EXPECT_TRUE(choose_scene(input, {}).empty());
  EXPECT_THROW(check(input), InvalidCase);  // a half-space gives it no finite indentation
  thick.scene.beam.width = 0.05;
  thick.scene.beam.thickness = 0.1;
  choose_scene(thick, {});
  EXPECT_EQ(thick.scene.contact.kind, ContactKind::line);
  EXPECT_TRUE(thick.scene.contact.pressure_by_depth);
  EXPECT_TRUE(simulate(thick).outcome.completed());
}

// As a case with --set model.elements = 40 and nothing else is read.
Case with_elements(Case input, int elements) {
  input.model.mesh = MeshKind::hermite;
  input.model.elements = elements;
  return input;
}

TEST(SceneChoice, OfElementsAloneIsThatOfTheSceneWithTheElementsOfItsTheory) {
  std::mt19937 random(32);
  const auto draw = [&](double least, double most) {
    return least * std::pow(most / least, std::uniform_real_distribution<>()(random));
  };
  int sheared = 0;
  constexpr int scenes = 24;
  for (int i = 0; i < scenes; ++i) {
    Case input = yielding_case();
    Beam& beam = input.scene.beam;
    beam.thickness = draw(1e-3, 2e-2);
    beam.length = beam.thickness * draw(10.0, 300.0);
    beam.width = draw(0.01, 0.05);
    if (i % 2 == 0) beam.ends = {EndSupport::pinned, EndSupport::pinned};
    if (i % 3 == 0) beam.yield_stress = INFINITY;
    Striker& striker = input.scene.striker;
    striker.mass = beam.mass() * draw(0.01, 5.0);
    striker.velocity = draw(0.01, 5.0);
    striker.position = draw(0.3, 0.97);
    if (i % 4 == 1) striker.nose = NoseShape::sphere;
    GivenKeys given;
    if (i % 4 == 3) {  // a soft pad
      input.scene.contact.kind = ContactKind::linear;
      input.scene.contact.stiffness = draw(1e2, 1e6);
      given.in_file = {"contact.law", "contact.stiffness"};
    }
    input.end_time = draw(1e-4, 2e-3);
    Case meshed = with_elements(input, 40);
    const auto keys = choose_scene(input, given);
    given.in_settings = {"model.elements"};
    EXPECT_EQ(choose_scene(meshed, given), keys);
    EXPECT_EQ(meshed.scene.beam.theory, input.scene.beam.theory) << i;
    EXPECT_EQ(meshed.scene.contact.kind, input.scene.contact.kind) << i;
    EXPECT_EQ(meshed.scene.contact.pressure_by_depth, input.scene.contact.pressure_by_depth) << i;
    EXPECT_EQ(meshed.model_choice, input.model_choice) << i;
    EXPECT_EQ(meshed.model.elements, 40);
    EXPECT_EQ(meshed.model.mesh,
              input.scene.beam.shears() ? MeshKind::spectral : MeshKind::hermite);
    sheared += input.scene.beam.shears() ? 1 : 0;
  }
  EXPECT_GT(sheared, 0);
  EXPECT_LT(sheared, scenes);
}

TEST(SceneChoice, RefusesAMeshWithoutTheShearThatTheSceneNeedsUnlessTheTheoryIsNamed) {
  Case input = with_elements(yielding_case(), 40);
  try {
    choose_scene(input, {{"model.mesh"}, {}});
    FAIL() << "Hermite elements do not shear";
  } catch (const InvalidCase& error) {
    EXPECT_EQ(error.key, "model.mesh");
    expect_in(error.what(), "\"cells\"", "\"spectral\"",
              "this scene needs shear: ", "to leave it out, write", "beam.theory = \"rayleigh\"");
  }
  choose_scene(input, {{"model.mesh", "beam.theory"}, {}});
  EXPECT_FALSE(input.scene.beam.shears());
  EXPECT_EQ(input.model.mesh, MeshKind::hermite);
  Case points = yielding_case();
  points.model.spacing = CellSpacing::points;
  EXPECT_THROW(choose_scene(points, {{"model.spacing"}, {}}), InvalidCase);
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
