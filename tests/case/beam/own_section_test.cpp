// Sections that a caller brings, through the public door.

#include "paper_run.h"
#include "runs.h"
#include "same_results.h"

namespace subimpact {
namespace {

Case paper_case() {
  Case input = paper_run(SectionKind::exact, 1e-3, 101);
  input.output.interval = 2e-5;
  input.solver.rtol = 1e-9;
  return input;
}

TEST(AnOwnSection, IsTheBuiltInOneBitForBitWhereItIsTheSame) {
  Case input = paper_case();
  const Result exact = simulate(input);
  EXPECT_EQ(exact.used.section, "exact");
  input.parts.section = Fibres::continuous();
  expect_same(exact, simulate(input));
  input.parts.section = Fibres::layered(40);
  const Result own_layers = simulate(input);
  input.parts.section.reset();
  input.model.section = SectionKind::layers;
  expect_same(simulate(input), own_layers);
}

// A fibre may be as strong as the whole and half as wide: a beam of half the width has half the
// stiffness and, at half the density, the same motion.
TEST(AnOwnSection, OfHalfTheWidthIsABeamOfHalfTheWidth) {
  Case wide = paper_case();
  wide.scene.contact = {ContactKind::hertz, 2e10, {}, {}, {}};
  Case narrow = wide;
  narrow.scene.beam.width *= 0.5;
  wide.scene.beam.density *= 0.5;
  wide.parts.section = Fibres::strips({{.width = 0.5}}, "half the width");
  wide.scene.beam.theory = narrow.scene.beam.theory = BeamTheory::euler_bernoulli;
  const Result a = simulate(narrow);
  const Result b = simulate(wide);
  EXPECT_NEAR(b.used.first_period, a.used.first_period, 1e-12 * a.used.first_period);
  expect_same_starts(a, b, 1e6 * 1e-10);
}

TEST(AnOwnSection, KeepsItsAccountsWhereItYieldsAndWhereItDoesNot) {
  Case input = paper_case();
  input.parts.section = Fibres::strips({{.from = 0.0, .to = 0.8, .modulus = 0.1, .yield = 0.15},
                                        {.from = 0.8, .to = 1.0, .width = 1.2}},
                                       "sandwich");
  for (const Method method : {Method::erk, Method::nystrom, Method::exponential}) {
    input.solver.method = method;
    input.model.section = method == Method::exponential ? SectionKind::elastic : SectionKind::exact;
    const Result result = completed(input);
    EXPECT_LT(result.max_energy_error, 1e-5);
    EXPECT_EQ(result.n_yielded_sections > 0, method != Method::exponential);
    EXPECT_EQ(result.used.section,
              method == Method::exponential ? "sandwich, elastic" : "sandwich");
  }
}

}  // namespace
}  // namespace subimpact
