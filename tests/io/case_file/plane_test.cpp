// A plane or wall as a user writes it: beam.fixed = true and nothing else about the beam.

#include "refusal.h"
#include "runs.h"
#include "subimpact/io/case_file.h"
#include "testing.h"

namespace subimpact {
namespace {

Case struck_plane(const std::string& rest) {
  return read_case_text("beam.fixed = true\nstriker.mass = 2\ntime.end = 1e-3\n" + rest,
                        "plane.toml")
      .value;
}

TEST(APlane, NeedsNoSizeDensityOrMesh) {
  const Case input =
      struck_plane("striker.velocity = 3\ncontact.law = \"linear\"\ncontact.stiffness = 8e7\n");
  const Result result = completed(input);
  ASSERT_EQ(result.sub_impacts.size(), 1u);
  EXPECT_NEAR(result.sub_impacts[0].end.value(), M_PI * std::sqrt(2.0 / 8e7), 1e-11);
  EXPECT_NEAR(result.striker_velocity, -3.0, 1e-8);
  Case with_size = input;
  with_size.scene.beam.length = 0.3;
  with_size.scene.beam.width = with_size.scene.beam.thickness = 0.02;
  with_size.scene.beam.density = 7800.0;
  with_size.scene.beam.youngs_modulus = 2e11;
  EXPECT_EQ(simulate(with_size).sub_impacts[0].end, result.sub_impacts[0].end);
}

TEST(APlane, WithoutAModulusIsRigidUnderASphereThatHasOne) {
  const Case input = struck_plane(
      "striker.velocity = 0.1\nstriker.nose_radius = 0.02\ncontact.law = \"sphere\"\n"
      "contact.striker_modulus = 2e11\ncontact.striker_poisson = 0.3\n"
      "contact.beam_poisson = 0.3\n");
  const Result result = completed(input);
  const double k = 4.0 / 3.0 * 2e11 / (1.0 - 0.09) * std::sqrt(0.02);
  const double depth = std::pow(2.5 * 2.0 * 0.1 * 0.1 / (2.0 * k), 0.4);
  ASSERT_EQ(result.sub_impacts.size(), 1u);
  EXPECT_NEAR(result.sub_impacts[0].peak_force, k * std::pow(depth, 1.5),
              1e-6 * result.sub_impacts[0].peak_force);
}

TEST(APlane, WithoutASizeTakesNoLawThatFollowsIts) {
  const std::string strike =
      "striker.velocity = 1\nstriker.nose_radius = 0.02\nbeam.youngs_modulus = 2e11\n"
      "beam.poisson = 0.3\n";
  for (const char* law :
       {"\"foundation\"", "\"line\"", "\"sphere\"\ncontact.indentation = \"mid-plane\""}) {
    expect_in(
        answer_of<CaseFileError>([&] { struck_plane(strike + "contact.law = " + law + "\n"); }),
        "the plane has no size");
  }
}

TEST(APlane, WithoutASizeSetsNoLimitToAnIndentation) {
  const Result result = completed(
      struck_plane("striker.velocity = 1000\ncontact.law = \"hertz\"\ncontact.stiffness = 1e8\n"));
  EXPECT_GT(result.max_indentation, 0.06);
}

TEST(APlane, WithoutAModulusTakesNoLawThatNeedsOne) {
  const std::string strike = "striker.velocity = 1\nstriker.nose_radius = 0.02\n";
  const std::string of_nose = "contact.striker_modulus = 2e11\ncontact.striker_poisson = 0.3\n";
  const std::string laws[] = {
      "law = \"foundation\"\n", "law = \"line\"\ncontact.beam_poisson = 0.3\n",
      "law = \"sphere\"\ncontact.beam_poisson = 0.3\n",
      "law = \"hertz\"\ncontact.beam_poisson = 0.3\ncontact.indentation = \"mid-plane\"\n" +
          of_nose};
  for (const std::string& law : laws) {
    expect_in(answer_of<CaseFileError>([&] { struck_plane(strike + "contact." + law); }),
              "contact.law", "beam.youngs_modulus is missing: the plane is rigid");
  }
}

}  // namespace
}  // namespace subimpact
