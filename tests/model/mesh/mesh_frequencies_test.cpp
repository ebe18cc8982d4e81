// Natural frequencies of the continuum, and those of cells (out of dense eigenvalues) and of
// Hermite elements, against the continuum.

#include "mesh/mesh_contract.h"
#include "model/mesh/cell_mesh.h"
#include "model/mesh/hermite/hermite_mesh.h"
#include "print.h"

namespace subimpact {
namespace {

// --- of the continuum ---

constexpr double last_digit = 1e-10;

void expect_wave_numbers(double slenderness, const std::vector<double>& expected,
                         const Ends& ends = free_ends) {
  const std::vector<double> found = flexural_wave_numbers(slenderness, ends, expected.size());
  SCOPED_TRACE(slenderness);
  expect_near(found, expected, last_digit);
}

TEST(FreeFreeBeam, HasTheWaveNumbersOfEulerAndBernoulli) {
  expect_wave_numbers(0.0,
                      {4.7300407449, 7.8532046241, 10.9956078380, 14.1371654913, 17.2787596574});
}

TEST(FreeFreeBeam, HasTheWaveNumbersOfRayleigh) {
  const Beam beam = paper_beam();  // whose slenderness shows in the last digits here
  EXPECT_NEAR(beam.radius_of_gyration() / beam.length, 0.003044240, 0.5e-9);
  EXPECT_NEAR(beam.mass(), 0.2260549, 0.5e-7);
  expect_wave_numbers(beam.radius_of_gyration() / beam.length,
                      {4.7294986445, 7.8512239742, 10.9908523965, 14.1278561451, 17.2626944721});
  expect_wave_numbers(0.05,
                      {4.5937950806, 7.3924333414, 9.9896525818, 12.3640608084, 14.5370373882});
}

TEST(SupportedBeam, HasTheWaveNumbersOfEulerAndBernoulli) {
  expect_wave_numbers(0.0, {4.7300407449, 7.8532046241, 10.9956078380}, {clamped, clamped});
  expect_wave_numbers(0.0, {3.9266023120, 7.0685827456, 10.2101761228}, {clamped, pinned});
  expect_wave_numbers(0.0, {3.9266023120, 7.0685827456, 10.2101761228}, {pinned, free_end});
  expect_wave_numbers(0.0, {1.8751040687, 4.6940911330, 7.8547574382}, {clamped, free_end});
}

TEST(SupportedBeam, DoesNotDependOnTheSideItIsLookedAtFrom) {
  for (const Ends& ends :
       {Ends{clamped, pinned}, Ends{clamped, free_end}, Ends{pinned, free_end}}) {
    expect_near(flexural_wave_numbers(0.03, ends, 8),
                flexural_wave_numbers(0.03, {ends[1], ends[0]}, 8), last_digit);
  }
}

TEST(PinnedPinnedBeam, OfRayleighHasSinesForModes) {
  for (const double r : {0.0, 0.003, 0.05}) {
    const std::vector<double> found = flexural_wave_numbers(r, {pinned, pinned}, 6);
    for (std::size_t k = 1; k <= found.size(); ++k) {
      const double wave = static_cast<double>(k) * std::numbers::pi;
      EXPECT_NEAR(found[k - 1], wave / std::pow(1.0 + r * r * wave * wave, 0.25), last_digit);
    }
  }
}

// --- of meshes ---

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

class ElementsOnSupports : public testing::TestWithParam<Support> {
 protected:
  Beam beam() const {
    const auto& [theory, ends] = GetParam();
    Beam beam = paper_beam(theory, ends);
    beam.thickness = thick;
    return beam;
  }
  // As Rayleigh quotients, out of the reach of the decomposition's rounding.
  auto frequencies(double position) const {
    return [this, position](std::size_t n) {
      return HermiteMesh(beam(), position, n, Extent::whole)
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

}  // namespace
}  // namespace subimpact
