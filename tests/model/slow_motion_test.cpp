// The lowest modes and the static response of meshes by banded factorisation, beside those by all
// modes.

#include "model/modes.h"

#include "model/cell_mesh.h"
#include "paper_scene.h"
#include "testing.h"

namespace subimpact {
namespace {

Beam beam_with(EndSupport first, EndSupport last) {
  Beam beam = paper_scene().beam;
  beam.ends = {first, last};
  return beam;
}

void expect_same(const BeamMesh& mesh, double stiffness, double first_period) {
  constexpr std::size_t n_modes = 8;
  const auto found = slow_motion(mesh, stiffness, first_period, n_modes);
  ASSERT_TRUE(found.has_value());
  const NaturalModes all = mesh.natural_modes(stiffness);
  double compliance = 0.0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double share = mesh.struck_point()(all.shape(k));
    if (all.frequencies[k] > 0.0) compliance += std::pow(share / all.frequencies[k], 2);
    if (k >= n_modes) continue;
    EXPECT_NEAR(found->frequencies[k], all.frequencies[k], 1e-5 * all.frequencies[k]) << k;
    if (all.frequencies[k] > 0.0) {
      EXPECT_NEAR(std::abs(mesh.struck_point()(found->shapes[k])), std::abs(share),
                  1e-3 * std::sqrt(1.0 / mesh.beam_mass()))
          << k;
    }
  }
  EXPECT_NEAR(mesh.struck_point()(found->response), compliance, 1e-6 * compliance);
}

TEST(SlowMotion, IsThatOfAllModesWhateverTheEnds) {
  constexpr EndSupport kinds[] = {EndSupport::free, EndSupport::pinned, EndSupport::clamped};
  for (const EndSupport first : kinds) {
    for (const EndSupport last : kinds) {
      const Beam beam = beam_with(first, last);
      const double period = 2.0 * M_PI / flexural_frequencies(beam, 1).front();
      expect_same(CellMesh(beam, 0.4, 61, BeamMesh::Extent::whole), beam.bending_stiffness(),
                  period);
    }
  }
}

}  // namespace
}  // namespace subimpact
