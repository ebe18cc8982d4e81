// Natural frequencies of the Hermite mesh, out of dense eigenvalues, against the continuum.

#include "dense.h"
#include "model/hermite_mesh.h"
#include "model/modes.h"
#include "order_table.h"
#include "paper_scene.h"
#include "print.h"
#include "testing.h"

namespace subimpact {
namespace {

using Support = std::tuple<BeamTheory, std::array<EndSupport, 2>>;

class ElementsOnSupports : public testing::TestWithParam<Support> {
 protected:
  Beam beam() const {
    Beam beam = paper_beam();
    std::tie(beam.theory, beam.ends) = GetParam();
    beam.thickness = 0.03;  // thick enough for the rotary inertia to matter
    return beam;
  }
  std::size_t n_rigid() const {
    const auto ends = beam().ends;
    if (beam().is_free()) return 2;
    const bool free_end = ends[0] == EndSupport::free || ends[1] == EndSupport::free;
    const bool pin = ends[0] == EndSupport::pinned || ends[1] == EndSupport::pinned;
    return free_end && pin ? 1 : 0;
  }
};

INSTANTIATE_TEST_SUITE_P(
    Ends, ElementsOnSupports,
    testing::Combine(testing::Values(BeamTheory::rayleigh, BeamTheory::euler_bernoulli),
                     testing::Values(std::array{EndSupport::free, EndSupport::free},
                                     std::array{EndSupport::pinned, EndSupport::pinned},
                                     std::array{EndSupport::clamped, EndSupport::clamped},
                                     std::array{EndSupport::pinned, EndSupport::free},
                                     std::array{EndSupport::clamped, EndSupport::free},
                                     std::array{EndSupport::clamped, EndSupport::pinned})),
    NamedAsPrinted{});

TEST_P(ElementsOnSupports, FrequenciesConvergeAtFourthOrder) {
  constexpr std::size_t n_modes = 5;
  const std::vector<double> exact = flexural_frequencies(beam(), n_modes);
  for (std::size_t mode = 0; mode < n_modes; ++mode) {
    OrderTable table("mode " + std::to_string(mode + 1) +
                     ": relative error of the frequency, over elements");
    for (const std::size_t n : {16u, 24u, 32u, 48u}) {
      const HermiteMesh mesh(beam(), 0.375, n, 2, HermiteMesh::Extent::whole);
      // As Rayleigh quotients, out of the reach of the decomposition's rounding.
      const NaturalModes modes = mesh.natural_modes(beam().bending_stiffness());
      const double found = modes.frequencies[mode + n_rigid()];
      table.add(static_cast<double>(n), std::abs(found / exact[mode] - 1.0));
    }
    table.expect_every_order_within(3.7, 4.3);
  }
}

// A hinge sees the moment at its node, the sections beside it the linear part of theirs: where the
// moment is curved an order is lost in the hinge's share of the weights.
TEST_P(ElementsOnSupports, GradedKeepTheFourthOrderAndWithHingesTheThird) {
  constexpr std::size_t n_modes = 4;
  const std::vector<double> exact = flexural_frequencies(beam(), n_modes);
  for (const HermiteMesh::Options& options :
       {HermiteMesh::Options{{3.0, 0.2}, false}, HermiteMesh::Options{{}, true}}) {
    for (std::size_t mode = 0; mode < n_modes; ++mode) {
      OrderTable table("mode " + std::to_string(mode + 1) +
                       ": relative error of the frequency, over elements");
      for (const std::size_t n : {16u, 32u, 64u}) {
        const HermiteMesh mesh(beam(), 0.5, n, 2, HermiteMesh::Extent::whole, options);
        const NaturalModes modes = mesh.natural_modes(beam().bending_stiffness());
        const double found = modes.frequencies[mode + n_rigid()];
        table.add(static_cast<double>(n), std::abs(found / exact[mode] - 1.0));
      }
      if (options.hinges) {
        table.expect_every_order_within(2.7, 4.3);
      } else {
        table.expect_every_order_within(3.7, 4.3);
      }
    }
  }
}

TEST_P(ElementsOnSupports, HaveTheBeamsRigidModes) {
  const HermiteMesh mesh(beam(), 0.4, 10, 2, HermiteMesh::Extent::whole);
  const Eigen::VectorXd squares = squared_frequencies(mesh, beam().bending_stiffness());
  const double zero = 1e-12 * squares(squares.size() - 1);
  EXPECT_EQ(static_cast<std::size_t>((squares.array() < zero).count()), n_rigid());
}

}  // namespace
}  // namespace subimpact
