// The first-order part of the error of cells with free ends.

#include "model/modes.h"
#include "paper_run.h"
#include "study/mesh_resolution.h"
#include "subimpact/study/judgement.h"
#include "subimpact/study/other_mesh.h"
#include "testing.h"

namespace subimpact {
namespace {

// A thick beam, whose second-order error is small from some 1000 cells on.
Case thick_case(int segments) {
  Case input = paper_run(SectionKind::elastic, 0.52e-3, segments, Method::central_difference);
  input.scene.beam.thickness = 0.03;
  input.scene.striker.mass = 1.0;
  return input;
}

// Modes of fine cells beside those of the continuum: the difference is the first-order part.
TEST(CellsWithFreeEnds, RaiseFrequenciesAsMuchAsTheClosedFormSays) {
  Case input = thick_case(40001);
  const Beam& beam = input.scene.beam;
  const std::vector<double> exact = flexural_frequencies(beam, 24);
  const double cells = input.model.segments;
  const NaturalModes modes =
      free_cell_modes({static_cast<std::size_t>(cells), beam.length / cells, beam.mass_per_length(),
                       beam.rotary_inertia(), beam.bending_stiffness()},
                      false, 1);
  for (const std::size_t k : {5u, 10u, 20u, 23u}) {
    const double shift = modes.frequencies[k + 2] / exact[k] - 1.0;
    const double stated = free_end_error(input, 1.0 / exact[k], 1.0);
    printf("mode %zu: %.3e, stated %.3e\n", k, shift, stated);
    EXPECT_NEAR(stated, shift, 0.15 * shift) << k;
  }
}

TEST(MeshErrorsOfFineCellsWithFreeEnds, CoverTheTrueOnesThoughTwoMeshesNearlyAgree) {
  Case exact = thick_case(2001);
  exact.model.mesh = MeshKind::hermite;
  exact.model.elements = 400;
  exact.solver = {};
  exact.solver.method = Method::exponential;
  exact.solver.rtol = 1e-11;
  const double truth = *simulate(exact).sub_impacts.at(0).end;
  for (const int segments : {2001, 4001}) {
    const Case input = thick_case(segments);
    const Result result = simulate_judged(input, cases_beside(input), 2);
    const double error = std::abs(*result.sub_impacts.at(0).end - truth);
    const double stated = result.sub_impacts.at(0).end_error.value();
    printf("%d cells: off by %.4f us, stated %.4f\n", segments, 1e6 * error, 1e6 * stated);
    EXPECT_LT(error, stated);
    EXPECT_LT(stated, 20.0 * error);
  }
}

TEST(OtherMeshesAndEnds, HaveNoFirstOrderPart) {
  Case input = thick_case(501);
  EXPECT_GT(free_end_error(input, 1e-5, 1e-3), 0.0);
  Case pinned = input;
  pinned.scene.beam.ends = {EndSupport::pinned, EndSupport::clamped};
  EXPECT_EQ(free_end_error(pinned, 1e-5, 1e-3), 0.0);
  Case half_free = pinned;
  half_free.scene.beam.ends[0] = EndSupport::free;
  // After many reflections half of two free ends'.
  EXPECT_NEAR(free_end_error(half_free, 1e-5, 1.0), 0.5 * free_end_error(input, 1e-5, 1.0),
              0.01 * free_end_error(input, 1e-5, 1.0));
  // At first one reflection, whether the other end is free or not.
  EXPECT_DOUBLE_EQ(free_end_error(half_free, 1e-5, 1e-4), free_end_error(input, 1e-5, 1e-4));
  Case slender = input;
  slender.scene.beam.theory = BeamTheory::euler_bernoulli;
  EXPECT_EQ(free_end_error(slender, 1e-5, 1e-3), 0.0);
  Case elements = input;
  elements.model.mesh = MeshKind::hermite;
  EXPECT_EQ(free_end_error(elements, 1e-5, 1e-3), 0.0);
}

}  // namespace
}  // namespace subimpact
