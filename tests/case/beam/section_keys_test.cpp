// What a case may give of sections, noses and contact laws, and what is refused.

#include "paper_case.h"
#include "settings.h"

namespace subimpact {
namespace {

Case with(const Settings& settings, bool short_form = false) {
  Case input = paper_case(SectionKind::exact, 1e-4, 101);
  if (!short_form) input.scene.beam.width = input.scene.beam.thickness = 0.0;
  return changed(input, settings);
}

const Settings tube{
    {"beam.section.shape", "tube"}, {"beam.section.diameter", 0.03}, {"beam.section.wall", 0.002}};
const Settings of_nose{
    {"contact.striker_modulus", 2.1e11}, {"contact.striker_poisson", 0.3}, {"beam.poisson", 0.33}};

TEST(SectionKeys, TakeEveryShapeByItsDimensions) {
  const Settings sphere = Settings{{"contact.law", "sphere"}} + of_nose;
  EXPECT_NO_THROW(check(with(tube + Settings{{"contact.law", "hertz"}} + of_nose)));
  EXPECT_NO_THROW(check(with({{"beam.section.shape", "circle"}, {"beam.section.diameter", 0.01}})));
  EXPECT_NO_THROW(check(with({{"beam.section.height", 0.01}, {"beam.section.width", 0.02}})));
  EXPECT_NO_THROW(check(with(sphere + Settings{{"beam.section.shape", "box"},
                                               {"beam.section.height", 0.03},
                                               {"beam.section.width", 0.02},
                                               {"beam.section.wall", 0.002}})));
  EXPECT_NO_THROW(check(with(sphere + Settings{{"beam.section.shape", "i"},
                                               {"beam.section.height", 0.1},
                                               {"beam.section.width", 0.055},
                                               {"beam.section.flange", 0.0057},
                                               {"beam.section.web", 0.0041}})));
}

TEST(SectionKeys, RefuseWhatIsMissingTooMuchOrImpossible) {
  expect_refused(with({}), "beam.width", "is missing; give it in m, or beam.section.width");
  expect_refused(with({{"beam.section.height", 0.01}}, true), "beam.thickness", "given twice");
  expect_refused(with({{"beam.section.shape", "tube"}, {"beam.section.diameter", 0.03}}),
                 "beam.section.wall", "is missing");
  expect_refused(with(tube + Settings{{"beam.section.web", 0.002}}), "beam.section.web",
                 "the shape has beam.section.diameter, beam.section.wall; leave it out");
  expect_refused(with(tube, true), "beam.width", "leave it out");
  expect_refused(with({{"beam.section.shape", "tube"},
                       {"beam.section.diameter", 0.03},
                       {"beam.section.wall", 0.015}}),
                 "beam.section.wall", "allowed: below 0.015 m");
  expect_refused(with({{"beam.section.shape", "i"},
                       {"beam.section.height", 0.1},
                       {"beam.section.width", 0.05},
                       {"beam.section.flange", 0.05},
                       {"beam.section.web", 0.004}}),
                 "beam.section.flange", "allowed: below 0.05 m");
}

TEST(SectionKeys, RefuseLawsThatDoNotDescribeNoseAndSection) {
  expect_refused(with(tube), "contact.law", "this section is hollow");
  const Settings circle{{"beam.section.shape", "circle"}, {"beam.section.diameter", 0.01}};
  expect_refused(with(circle + Settings{{"contact.law", "sphere"}} + of_nose), "contact.law",
                 "touch in an ellipse");
  for (const char* law : {"hertz", "sphere"}) {
    expect_refused(
        with(Settings{{"contact.law", law}, {"striker.nose", "cylinder"}} + of_nose, true),
        "contact.law", "touches it along a line");
  }
  expect_refused(with({{"contact.yield_pressure", 4e8}}, true), "contact.yield_pressure",
                 "only \"sphere\" and \"line\" yield at it");
  expect_refused(
      with(Settings{{"contact.law", "sphere"}, {"contact.damping", 0.1}} + of_nose, true),
      "contact.damping", "contact.law = \"sphere\" loses its energy by yielding");
}

// Three fixed numbers of the physics: a heavier section, a harder one and a rounder nose.
TEST(SectionKeys, HardeningBendsLessAndARoundNosePressesDeeper) {
  Case input = with({}, true);
  input.end_time = 5e-4;
  const Result plain = simulate(input);
  input.scene.beam.hardening = 0.2;
  EXPECT_LT(simulate(input).final_energies.bending_plastic,
            0.95 * plain.final_energies.bending_plastic);
  input.scene.beam.hardening = 0.0;
  input.scene.striker.nose = NoseShape::sphere;
  EXPECT_GT(simulate(input).max_indentation, 1.3 * plain.max_indentation);
}

}  // namespace
}  // namespace subimpact
