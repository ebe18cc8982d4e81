// Natural frequencies of the cell mesh, out of dense eigenvalues, against its bound and the
// continuum.

#include "dense.h"
#include "model/cell_mesh.h"
#include "model/modes.h"
#include "order_table.h"
#include "paper_scene.h"
#include "print.h"
#include "testing.h"

namespace subimpact {
namespace {

using Extent = CellMesh::Extent;

class CellMeshOfBothTheories : public testing::TestWithParam<BeamTheory> {
 protected:
  Beam beam() const {
    Beam result = paper_beam();
    result.theory = GetParam();
    return result;
  }
};

INSTANTIATE_TEST_SUITE_P(Theories, CellMeshOfBothTheories,
                         testing::Values(BeamTheory::rayleigh, BeamTheory::euler_bernoulli),
                         NamedAsPrinted{});

TEST_P(CellMeshOfBothTheories, HighestFrequencyIsAnUpperBoundForAnyNumberOfCells) {
  for (const std::size_t n : {5u, 6u, 9u, 20u, 51u}) {
    const CellMesh mesh(beam(), 0.5, n, Extent::whole);
    const double stiffness = beam().bending_stiffness();
    const double highest = highest_of(mesh, stiffness);
    EXPECT_GE(mesh.highest_frequency(stiffness), highest * (1.0 - 1e-12)) << n << " cells";
  }
}

TEST_P(CellMeshOfBothTheories, HighestFrequencyIsWithinOneThousandthOfTheLargest) {
  const double stiffness = beam().bending_stiffness();
  for (const Extent extent : {Extent::whole, Extent::half}) {
    const CellMesh mesh(beam(), 0.5, 151, extent);
    const double highest = highest_of(mesh, stiffness);
    EXPECT_LE(mesh.highest_frequency(stiffness), highest * 1.001);
    EXPECT_GE(mesh.highest_frequency(stiffness), highest * (1.0 - 1e-12));
  }
}

TEST(CellMesh, HighestFrequencyOfThePapersGrid) {
  const CellMesh mesh(paper_beam(), 0.5, 501, Extent::half);
  EXPECT_NEAR(mesh.highest_frequency(paper_beam().bending_stiffness()), 7.043e6, 0.5e3);
}

constexpr std::size_t n_modes = 5;
constexpr std::size_t refinements[] = {40, 80, 160, 240};

std::vector<OrderTable> tables_of_modes(const std::string& what) {
  std::vector<OrderTable> tables;
  for (std::size_t mode = 1; mode <= n_modes; ++mode) {
    tables.emplace_back("mode " + std::to_string(mode) + ": " + what + ", over cells");
  }
  return tables;
}

TEST(CellMesh, EulerBernoulliFrequenciesConvergeAtSecondOrder) {
  Beam beam = paper_beam();
  beam.theory = BeamTheory::euler_bernoulli;
  const std::vector<double> exact = flexural_frequencies(beam, n_modes);
  std::vector<OrderTable> tables = tables_of_modes("relative error of the frequency");
  for (const std::size_t n : refinements) {
    const CellMesh mesh(beam, 0.5, n, Extent::whole);
    const Eigen::VectorXd squares = squared_frequencies(mesh, beam.bending_stiffness());
    for (std::size_t mode = 0; mode < n_modes; ++mode) {
      const double found = std::sqrt(squares(index(mode + 2)));  // after the two rigid modes
      tables[mode].add(static_cast<double>(n), std::abs(found / exact[mode] - 1.0));
    }
  }
  for (const OrderTable& table : tables) table.expect_every_order_within(1.9, 2.1);
}

// The chain of n cells has n - 1 links that carry rotary inertia: that of the outer half cells is
// left out. It is a part dx/l of a small quantity, but of first order. Whole cells have it, and are
// of second order; what the others lack is of the size perturbation theory gives,
// d omega/omega = -r^2 dx phi'(0)^2/(2 integral (phi^2 + r^2 phi'^2) dx).
TEST(CellMesh, RayleighFrequenciesAreOfSecondOrderButForTheRotaryInertiaOfTheOuterHalfCells) {
  const Beam beam = paper_beam();
  const std::vector<double> exact = flexural_frequencies(beam, n_modes);
  std::vector<OrderTable> of_whole = tables_of_modes("relative error of whole cells");
  std::vector<OrderTable> left_out = tables_of_modes("what leaving the inertia out adds");
  for (const std::size_t n : refinements) {
    const CellMesh mesh(beam, 0.5, n, Extent::whole);
    const CellMesh whole(beam, 0.5, n, Extent::whole, CellMesh::Spacing::whole);
    const double dx = beam.length / static_cast<double>(n);
    const Eigen::VectorXd plain = squared_frequencies(mesh, beam.bending_stiffness());
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(
        stiffness_matrix(whole, beam.bending_stiffness()), dense(whole.mass()));
    for (std::size_t mode = 0; mode < n_modes; ++mode) {
      const auto k = index(mode + 2);
      const double found = std::sqrt(modes.eigenvalues()(k));
      const double added = (std::sqrt(plain(k)) - found) / exact[mode];
      of_whole[mode].add(static_cast<double>(n), std::abs(found / exact[mode] - 1.0));
      left_out[mode].add(static_cast<double>(n), added);
      const Eigen::VectorXd shape = modes.eigenvectors().col(k);  // of modal mass 1
      const double slope = (shape(1) - shape(0)) / dx;
      EXPECT_NEAR(added, 0.5 * beam.rotary_inertia() * dx * slope * slope, 0.02 * added);
    }
  }
  for (const OrderTable& table : of_whole) table.expect_every_order_within(1.9, 2.1);
  for (const OrderTable& table : left_out) table.expect_every_order_within(0.9, 1.1);
}

using Support = std::tuple<BeamTheory, std::array<EndSupport, 2>>;

class SupportedCells : public testing::TestWithParam<Support> {
 protected:
  Beam beam() const {
    Beam beam = paper_beam();
    std::tie(beam.theory, beam.ends) = GetParam();
    beam.thickness = 0.03;  // thick enough for the rotary inertia to matter
    return beam;
  }
};

INSTANTIATE_TEST_SUITE_P(
    Ends, SupportedCells,
    testing::Combine(testing::Values(BeamTheory::rayleigh, BeamTheory::euler_bernoulli),
                     testing::Values(std::array{EndSupport::pinned, EndSupport::pinned},
                                     std::array{EndSupport::clamped, EndSupport::clamped},
                                     std::array{EndSupport::clamped, EndSupport::pinned},
                                     std::array{EndSupport::pinned, EndSupport::clamped})),
    NamedAsPrinted{});

TEST_P(SupportedCells, FrequenciesConvergeAtSecondOrder) {
  const std::vector<double> exact = flexural_frequencies(beam(), n_modes);
  std::vector<OrderTable> tables = tables_of_modes("relative error of the frequency");
  for (const std::size_t n : refinements) {
    const CellMesh mesh(beam(), 0.5, n, Extent::whole);
    const Eigen::VectorXd squares = squared_frequencies(mesh, beam().bending_stiffness());
    for (std::size_t mode = 0; mode < n_modes; ++mode) {
      const double found = std::sqrt(squares(index(mode)));
      tables[mode].add(static_cast<double>(n), std::abs(found / exact[mode] - 1.0));
    }
  }
  for (const OrderTable& table : tables) table.expect_every_order_within(1.8, 2.2);
}

TEST_P(SupportedCells, HighestFrequencyIsAnUpperBound) {
  for (const std::size_t n : {7u, 8u, 51u, 151u}) {
    const CellMesh mesh(beam(), 0.5, n, Extent::whole);
    const double stiffness = beam().bending_stiffness();
    const double highest = highest_of(mesh, stiffness);
    EXPECT_GE(mesh.highest_frequency(stiffness), highest * (1.0 - 1e-12)) << n << " cells";
  }
}

TEST_P(SupportedCells, HalfModelHasTheSymmetricModesOfTheWhole) {
  const double stiffness = beam().bending_stiffness();
  Beam alike = beam();
  alike.ends[1] = alike.ends[0];
  const Eigen::VectorXd whole =
      squared_frequencies(CellMesh(alike, 0.5, 41, Extent::whole), stiffness);
  const Eigen::VectorXd half =
      squared_frequencies(CellMesh(alike, 0.5, 41, Extent::half), stiffness);
  for (Eigen::Index k = 0; k < half.size(); ++k) {
    EXPECT_NEAR(half(k), whole(2 * k), 1e-11 * whole(whole.size() - 1)) << k;
  }
}

TEST_P(CellMeshOfBothTheories, HasTwoRigidModesWholeAndOneInHalf) {
  for (const Extent extent : {Extent::whole, Extent::half}) {
    const CellMesh mesh(beam(), 0.5, 41, extent);
    const Eigen::VectorXd squares = squared_frequencies(mesh, beam().bending_stiffness());
    const double zero = 1e-12 * squares(squares.size() - 1);
    EXPECT_EQ((squares.array() < zero).count(), extent == Extent::whole ? 2 : 1);
    EXPECT_GT(squares.minCoeff(), -zero);
  }
}

TEST_P(CellMeshOfBothTheories, HalfModelHasTheSymmetricModesOfTheWhole) {
  const double stiffness = beam().bending_stiffness();
  const Eigen::VectorXd whole =
      squared_frequencies(CellMesh(beam(), 0.5, 41, Extent::whole), stiffness);
  const Eigen::VectorXd half =
      squared_frequencies(CellMesh(beam(), 0.5, 41, Extent::half), stiffness);
  // Of the whole's modes 0 translates, 1 rotates, then symmetric and antisymmetric ones take turns.
  for (Eigen::Index k = 1; k < half.size(); ++k) {
    EXPECT_NEAR(half(k), whole(2 * k), 1e-11 * whole(whole.size() - 1)) << k;
  }
}

}  // namespace
}  // namespace subimpact
