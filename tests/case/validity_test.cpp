// What a run says about the limits of the model: each warning in a scene that deserves it and in
// one that does not.

#include "subimpact/case/case_keys.h"

#include "paper_case.h"

namespace subimpact {
namespace {

bool warns_of(const Case& input, const std::string& words) {
  return std::ranges::any_of(simulate(input).warnings, [&](const std::string& warning) {
    return warning.find(words) != std::string::npos;
  });
}

Case plain_case() { return paper_case(SectionKind::elastic, 0.6e-3, 101); }

TEST(TheModelsLimits, AreNotReachedByAnElasticStrikeOfASlenderBeam) {
  EXPECT_TRUE(simulate(plain_case()).warnings.empty());
}

TEST(AThickBeam, IsDoubtedWhereItsTheoryLeavesOutShear) {
  Case input = plain_case();
  input.scene.beam.thickness = 0.09 * input.scene.beam.length;
  EXPECT_FALSE(warns_of(input, "of its length"));
  input.scene.beam.thickness = 0.12 * input.scene.beam.length;
  EXPECT_TRUE(warns_of(input, "thickness is 0.12 of its length, and its theory leaves out shear"));
  input.scene.beam.theory = BeamTheory::timoshenko;
  input.scene.beam.poisson = 0.3;
  EXPECT_FALSE(warns_of(input, "of its length"));
  input.scene.beam.thickness = 0.4 * input.scene.beam.length;
  EXPECT_TRUE(warns_of(input, "thickness is 0.4 of its length: plane sections"));
}

TEST(LargeRotations, AreDoubted) {
  Case input = plain_case();
  input.scene.striker.position = 0.1;
  input.end_time = 3e-3;
  input.scene.striker.velocity = 2.0;
  EXPECT_FALSE(warns_of(input, "sections turn"));
  input.scene.striker.velocity = 40.0;
  EXPECT_TRUE(warns_of(input, "sections turn by up to"));
}

TEST(LargeDeflections, AreDoubtedOnBeamsHeldAtBothEnds) {
  Case input = plain_case();
  input.end_time = 2e-3;
  input.scene.striker.velocity = 4.0;
  EXPECT_FALSE(warns_of(input, "times the thickness"));  // a free beam moves away
  input.scene.beam.ends = {pinned, free_end};
  EXPECT_FALSE(warns_of(input, "times the thickness"));
  input.scene.beam.ends = {pinned, pinned};
  EXPECT_TRUE(warns_of(input, "times the thickness, on a beam held at both ends"));
  input.scene.striker.velocity = 0.4;
  EXPECT_FALSE(warns_of(input, "times the thickness"));
}

TEST(DeepIndentations, AreDoubted) {
  Case input = plain_case();
  input.scene.striker.nose_radius = 5e-3;
  EXPECT_FALSE(warns_of(input, "of the nose radius"));
  input.scene.striker.nose_radius = 1e-3;
  EXPECT_TRUE(warns_of(input, "of the nose radius"));
}

TEST(HighPressures, AreDoubtedWhereTheContactCannotYield) {
  Case input = plain_case();
  input.scene.contact = {ContactKind::hertz, {}, 210e9, 0.3, 0.33};
  input.scene.striker.velocity = 0.5;
  const double of_both = 0.91 / 210e9 + (1.0 - 0.33 * 0.33) / input.scene.beam.youngs_modulus;
  for (const auto from : {IndentationFrom::half_space, IndentationFrom::mid_plane}) {
    input.scene.contact.indentation = from;
    const double force = simulate(input).max_force, radius = *input.scene.striker.nose_radius;
    const double pressure = std::cbrt(6.0 * force / std::pow(radius * of_both, 2)) / M_PI;
    input.scene.beam.yield_stress = 1.01 * pressure / 1.6;
    EXPECT_FALSE(warns_of(input, "contact pressure"));
    input.scene.beam.yield_stress = 0.99 * pressure / 1.6;
    EXPECT_TRUE(warns_of(input, "contact pressure"));
  }
  input.scene.contact = {};
  EXPECT_FALSE(warns_of(input, "contact pressure"));
}

}  // namespace
}  // namespace subimpact
