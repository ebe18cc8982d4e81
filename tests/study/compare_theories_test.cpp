#include "subimpact/study/compare.h"

#include "paper_scene.h"
#include "subimpact/case/case_keys.h"
#include "testing.h"

namespace subimpact {
namespace {

Case strike(BeamTheory theory) {
  Case input;
  input.scene = paper_scene();
  input.scene.striker.velocity = 0.1;
  input.scene.beam.theory = theory;
  input.scene.beam.poisson = 0.33;
  input.scene.beam.shear_coefficient = 5.0 / 6.0;
  input.model.segments = 501;
  input.model.section = SectionKind::elastic;
  input.end_time = 0.5e-3;
  input.solver.method = Method::nystrom;
  return input;
}

const std::string names[] = {"rayleigh", "timoshenko"};

// The converged times are 403.89 us by Rayleigh's theory and 424.18 us by Timoshenko's.
TEST(CompareModels, FindsWhatShearAddsToTheFirstContact) {
  const Case cases[] = {strike(BeamTheory::rayleigh), strike(BeamTheory::timoshenko)};
  const auto runs = compare_models(cases, names, 2);
  ASSERT_EQ(runs.size(), 2u);
  const double added =
      1e6 * (*runs[1].result.sub_impacts.at(0).end - *runs[0].result.sub_impacts.at(0).end);
  EXPECT_NEAR(added, 424.18 - 403.89, 0.5);
  EXPECT_EQ(n_leading_matches(runs[1].pairs), 2u);
}

TEST(CompareModels, EndsWhenProgressSaysSo) {
  const Case cases[] = {strike(BeamTheory::rayleigh), strike(BeamTheory::timoshenko)};
  std::size_t begun = 0;
  const auto runs = compare_models(
      cases, names, 1, [&](std::size_t i) { begun = i + 1; }, [&](double) { return begun < 2; });
  EXPECT_EQ(runs.size(), 1u);
}

TEST(CompareModels, RefusesBeforeAnyRunWhatATheoryCannotModel) {
  Case elements = strike(BeamTheory::timoshenko);
  elements.model.mesh = MeshKind::hermite;
  const Case cases[] = {strike(BeamTheory::rayleigh), elements};
  std::size_t begun = 0;
  EXPECT_THROW(compare_models(cases, names, 1, [&](std::size_t) { ++begun; }), InvalidCase);
  EXPECT_EQ(begun, 0u);
}

TEST(CompareModels, ByContactLawsDropTheConstantsThatALawDoesNotUse) {
  Case input = strike(BeamTheory::rayleigh);
  input.scene.beam.shear_coefficient.reset();
  input.scene.contact = {ContactKind::sphere, {}, 2.1e11, 0.3, {}};
  input.scene.contact.yield_pressure = 3e8;
  const Case foundation = with_contact_law(input, "foundation");
  EXPECT_FALSE(foundation.scene.contact.striker_modulus);
  EXPECT_FALSE(foundation.scene.contact.yield_pressure);
  const Case hertz = with_contact_law(input, "hertz");
  EXPECT_TRUE(hertz.scene.contact.striker_modulus);
  EXPECT_FALSE(hertz.scene.contact.yield_pressure);
  for (const Case& one : {input, foundation, hertz}) EXPECT_NO_THROW(check(one));
  EXPECT_THROW(with_contact_law(input, "spere"), InvalidCase);
}

}  // namespace
}  // namespace subimpact
