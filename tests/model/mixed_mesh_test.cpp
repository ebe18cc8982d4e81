// Mixed cells alone: frequencies as central differences see them, and what the mesh conserves.

#include "model/mixed_mesh.h"

#include "model/modes.h"
#include "order_table.h"
#include "paper_scene.h"
#include "print.h"
#include "testing.h"

namespace subimpact {
namespace {

class MixedCellsOnSupports : public testing::TestWithParam<std::array<EndSupport, 2>> {
 protected:
  Beam beam() const {
    Beam beam = paper_beam();
    beam.ends = GetParam();
    beam.thickness = 0.03;  // thick enough for the rotary inertia to matter
    return beam;
  }
  std::size_t n_rigid() const {
    if (beam().is_free()) return 2;
    const auto has = [&](EndSupport end) { return beam().ends[0] == end || beam().ends[1] == end; };
    return has(EndSupport::free) && has(EndSupport::pinned) ? 1 : 0;
  }
};

INSTANTIATE_TEST_SUITE_P(Ends, MixedCellsOnSupports,
                         testing::Values(std::array{EndSupport::free, EndSupport::free},
                                         std::array{EndSupport::pinned, EndSupport::pinned},
                                         std::array{EndSupport::clamped, EndSupport::clamped},
                                         std::array{EndSupport::clamped, EndSupport::pinned}),
                         NamedAsPrinted{});

// A mode of frequency omega in space moves at the frequency 2/dt asin(omega dt/2) in steps of dt.
TEST_P(MixedCellsOnSupports, MoveAtFrequenciesOfFourthOrderInTheirOwnStep) {
  const std::vector<double> exact = flexural_frequencies(beam(), 5);
  // What free ends leave, of higher order, changes the sign of the higher modes' errors.
  const std::vector<std::size_t> modes =
      beam().is_free() ? std::vector<std::size_t>{0} : std::vector<std::size_t>{0, 2, 4};
  for (const std::size_t mode : modes) {
    OrderTable table("mode " + std::to_string(mode + 1) +
                     ": relative error of the frequency, over cells");
    for (const std::size_t n : {48u, 64u, 80u}) {
      const MixedMesh mesh(beam(), 0.375, n, MixedMesh::Extent::whole);
      const double step = *mesh.natural_step();
      const double in_space =
          mesh.natural_modes(beam().bending_stiffness()).frequencies[mode + n_rigid()];
      const double found = 2.0 / step * std::asin(0.5 * in_space * step);
      table.add(static_cast<double>(n), std::abs(found / exact[mode] - 1.0));
    }
    table.print();
    EXPECT_GT(table.overall_order(), 3.6);
    EXPECT_LT(table.overall_order(), 4.6);
  }
}

TEST_P(MixedCellsOnSupports, KeepTheStepBelowTheStabilityLimit) {
  for (const std::size_t n : {16u, 40u, 100u, 400u}) {
    const MixedMesh mesh(beam(), 0.5, n, MixedMesh::Extent::whole);
    EXPECT_LT(*mesh.natural_step() * mesh.highest_frequency(beam().bending_stiffness()), 2.0);
  }
}

TEST_P(MixedCellsOnSupports, HaveNoFrequencyAboveTheirBound) {
  for (const double position : {0.5, 0.37}) {
    const MixedMesh mesh(beam(), position, 48, MixedMesh::Extent::whole);
    const NaturalModes modes = mesh.natural_modes(beam().bending_stiffness());
    const double bound = mesh.highest_frequency(beam().bending_stiffness());
    EXPECT_LT(modes.frequencies.back(), bound);
    EXPECT_GT(modes.frequencies.back(), 0.98 * bound);
  }
}

TEST(MixedCells, WeighWhatTheBeamWeighsAndBalanceAtItsMiddle) {
  const Beam beam = paper_beam();
  const MixedMesh mesh(beam, 0.37, 60, MixedMesh::Extent::whole);
  double mass = 0.0, moment = 0.0;
  for (std::size_t i = 0; i < mesh.n_unknowns(); ++i) {
    mass += mesh.momentum_functional()[i];
    moment += mesh.moment_functional()[i];
  }
  EXPECT_NEAR(mass, beam.mass(), 1e-14 * beam.mass());
  // The cells before the strike and after it differ in length.
  EXPECT_NEAR(moment, 0.5 * beam.length * beam.mass(), 1e-4 * beam.length * beam.mass());
}

TEST(MixedCells, MoveRigidlyWithoutMoments) {
  const Beam beam = paper_beam();
  const MixedMesh mesh(beam, 0.5, 60, MixedMesh::Extent::whole);
  std::vector<double> turned(mesh.n_unknowns()), kappa(mesh.n_sections());
  for (std::size_t i = 0; i < turned.size(); ++i) turned[i] = 0.3 + 0.1 * mesh.node_position(i);
  mesh.curvatures(turned, kappa);
  for (const double k : kappa) EXPECT_NEAR(k, 0.0, 1e-11);
}

TEST(MixedCells, MoveAlikeAsAHalfAndAsAWhole) {
  Beam beam = paper_beam();
  const MixedMesh half(beam, 0.5, 40, MixedMesh::Extent::half);
  const MixedMesh whole(beam, 0.5, 40, MixedMesh::Extent::whole);
  const auto of_half = half.natural_modes(beam.bending_stiffness()).frequencies;
  const auto of_whole = whole.natural_modes(beam.bending_stiffness()).frequencies;
  // Symmetric modes: translation, then every other one.
  for (const std::size_t mode : {1u, 2u, 5u}) {
    EXPECT_NEAR(of_half[mode] / of_whole[2 * mode], 1.0, 1e-7);
  }
}

TEST(MixedCells, RefuseWhatTheyCannotModel) {
  Beam beam = paper_beam();
  const auto make = [&](double position, std::size_t n, MixedMesh::Extent extent) {
    return MixedMesh(beam, position, n, extent);
  };
  EXPECT_THROW(make(0.5, 8, MixedMesh::Extent::whole), std::invalid_argument);
  EXPECT_THROW(make(0.05, 100, MixedMesh::Extent::whole), std::invalid_argument);
  EXPECT_THROW(make(0.5, 101, MixedMesh::Extent::half), std::invalid_argument);
  beam.theory = BeamTheory::euler_bernoulli;
  EXPECT_THROW(make(0.5, 100, MixedMesh::Extent::whole), std::invalid_argument);
}

}  // namespace
}  // namespace subimpact
