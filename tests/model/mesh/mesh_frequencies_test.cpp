// Natural frequencies of cells (out of dense eigenvalues) and of Hermite elements, against the
// bounds of the meshes and the continuum.

#include "mesh/mesh_contract.h"
#include "model/mesh/cell_mesh.h"
#include "model/mesh/hermite/hermite_mesh.h"
#include "print.h"

namespace subimpact {
namespace {

using Extent = BeamMesh::Extent;
using Support = std::tuple<BeamTheory, Ends>;

constexpr double thick = 0.03;  // thick enough for the rotary inertia to matter
constexpr std::size_t n_modes = 5;
constexpr std::size_t refinements[] = {40, 80, 160, 240};

const auto both_theories = testing::Values(BeamTheory::rayleigh, BeamTheory::euler_bernoulli);

class CellsOnSupports : public testing::TestWithParam<Support> {
 protected:
  Beam beam() const {
    const auto& [theory, ends] = GetParam();
    Beam beam = paper_beam(theory, ends);
    if (!beam.is_free()) beam.thickness = thick;
    return beam;
  }
  double stiffness() const { return beam().bending_stiffness(); }
};

INSTANTIATE_TEST_SUITE_P(
    Ends, CellsOnSupports,
    testing::Combine(both_theories,
                     testing::Values(free_ends, Ends{pinned, pinned}, Ends{clamped, clamped},
                                     Ends{clamped, pinned}, Ends{pinned, clamped})),
    NamedAsPrinted{});

// Not of Rayleigh's free beams: see the next test.
TEST_P(CellsOnSupports, FrequenciesConvergeAtSecondOrder) {
  const bool is_free = beam().is_free();
  if (is_free && beam().theory == BeamTheory::rayleigh) GTEST_SKIP() << "see the next test";
  const auto found = [&](std::size_t n) {
    return dense_frequencies(CellMesh(beam(), 0.5, n, Extent::whole), stiffness());
  };
  const double band = is_free ? 0.1 : 0.2;
  expect_order_of_frequencies(beam(), n_modes, refinements, found, 2.0 - band, 2.0 + band);
}

// The chain of n cells has n - 1 links that carry rotary inertia: that of the outer half cells is
// left out. It is a part dx/l of a small quantity, but of first order. Whole cells have it, and are
// of second order; what the others lack is of the size perturbation theory gives,
// d omega/omega = -r^2 dx phi'(0)^2/(2 integral (phi^2 + r^2 phi'^2) dx).
TEST(CellMesh, RayleighFrequenciesAreOfSecondOrderButForTheRotaryInertiaOfTheOuterHalfCells) {
  const Beam beam = paper_beam();
  const std::vector<double> exact = flexural_frequencies(beam, n_modes);
  std::vector<OrderTable> of_whole = tables_of_modes(n_modes), left_out = tables_of_modes(n_modes);
  for (const std::size_t n : refinements) {
    const CellMesh mesh(beam, 0.5, n, Extent::whole);
    const CellMesh whole(beam, 0.5, n, Extent::whole, CellMesh::Spacing::whole);
    const double dx = beam.length / static_cast<double>(n);
    const std::vector<double> plain = dense_frequencies(mesh, beam.bending_stiffness());
    const EigenPairs modes =
        eigen_pairs(stiffness_matrix(whole, beam.bending_stiffness()), dense(whole.mass()));
    for (std::size_t mode = 0; mode < n_modes; ++mode) {
      const double found = std::sqrt(modes.values(index(mode + 2)));
      const double added = (plain[mode + 2] - found) / exact[mode];
      of_whole[mode].add(static_cast<double>(n), std::abs(found / exact[mode] - 1.0));
      left_out[mode].add(static_cast<double>(n), added);
      const Eigen::VectorXd shape = modes.vectors.col(index(mode + 2));  // of modal mass 1
      const double slope = (shape(1) - shape(0)) / dx;
      EXPECT_NEAR(added, 0.5 * beam.rotary_inertia() * dx * slope * slope, 0.02 * added);
    }
  }
  for (const OrderTable& table : of_whole) table.expect_every_order_within(1.9, 2.1);
  for (const OrderTable& table : left_out) table.expect_every_order_within(0.9, 1.1);
}

TEST_P(CellsOnSupports, HighestFrequencyIsAnUpperBoundForAnyNumberOfCells) {
  for (const std::size_t n : {5u, 6u, 7u, 8u, 9u, 20u, 51u, 151u}) {
    if (n < 7 && !beam().is_free()) continue;  // too few
    const CellMesh mesh(beam(), 0.5, n, Extent::whole);
    const double highest = highest_of(mesh, stiffness());
    EXPECT_GE(mesh.highest_frequency(stiffness()), highest * (1.0 - 1e-12)) << n << " cells";
    if (n == 151 && beam().is_free()) {
      EXPECT_LE(mesh.highest_frequency(stiffness()), highest * 1.001);
    }
  }
}

TEST_P(CellsOnSupports, HalfModelHasTheSymmetricModesOfTheWhole) {
  Beam alike = beam();
  alike.ends[1] = alike.ends[0];
  const auto squares = [&](Extent extent) {
    return squared_frequencies(CellMesh(alike, 0.5, 41, extent), stiffness());
  };
  const Eigen::VectorXd whole = squares(Extent::whole), half = squares(Extent::half);
  const double highest = whole(whole.size() - 1);
  // Of a free whole's modes 0 translates, 1 rotates; symmetric and antisymmetric ones take turns.
  for (Eigen::Index k = 0; k < half.size(); ++k) {
    EXPECT_NEAR(half(k), whole(2 * k), 1e-11 * highest) << k;
  }
  const auto n_rigid = [&](const Eigen::VectorXd& all) {
    EXPECT_GT(all.minCoeff(), -1e-12 * highest);
    return (all.array() < 1e-12 * highest).count();
  };
  EXPECT_EQ(n_rigid(whole), alike.is_free() ? 2 : 0);
  EXPECT_EQ(n_rigid(half), alike.is_free() ? 1 : 0);
}

class ElementsOnSupports : public testing::TestWithParam<Support> {
 protected:
  Beam beam() const {
    const auto& [theory, ends] = GetParam();
    Beam beam = paper_beam(theory, ends);
    beam.thickness = thick;
    return beam;
  }
  // As Rayleigh quotients, out of the reach of the decomposition's rounding.
  auto frequencies(double position, bool hinges = false) const {
    return [this, position, hinges](std::size_t n) {
      return HermiteMesh(beam(), position, n, Extent::whole, hinges)
          .natural_modes(beam().bending_stiffness())
          .frequencies;
    };
  }
};

INSTANTIATE_TEST_SUITE_P(
    Ends, ElementsOnSupports,
    testing::Combine(both_theories,
                     testing::Values(free_ends, Ends{pinned, pinned}, Ends{clamped, clamped},
                                     Ends{pinned, free_end}, Ends{clamped, free_end},
                                     Ends{clamped, pinned})),
    NamedAsPrinted{});

TEST_P(ElementsOnSupports, FrequenciesConvergeAtFourthOrder) {
  constexpr std::size_t sizes[] = {16, 24, 32, 48};
  expect_order_of_frequencies(beam(), 5, sizes, frequencies(0.375), 3.7, 4.3);
}

// A hinge sees the moment at its node, the sections beside it the linear part of theirs: where the
// moment is curved an order is lost in the hinge's share of the weights.
TEST_P(ElementsOnSupports, WithHingesKeepTheThirdOrder) {
  constexpr std::size_t sizes[] = {16, 32, 64};
  expect_order_of_frequencies(beam(), 4, sizes, frequencies(0.5, true), 2.7, 4.3);
}

TEST_P(ElementsOnSupports, HaveTheBeamsRigidModes) {
  const HermiteMesh mesh(beam(), 0.4, 10, Extent::whole);
  const Eigen::VectorXd squares = squared_frequencies(mesh, beam().bending_stiffness());
  const double zero = 1e-12 * squares(squares.size() - 1);
  EXPECT_EQ(static_cast<std::size_t>((squares.array() < zero).count()), n_rigid_modes(beam()));
}

}  // namespace
}  // namespace subimpact
