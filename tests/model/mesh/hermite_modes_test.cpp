// Natural modes of equal Hermite elements in closed form against a dense decomposition.

#include "mesh/mesh_contract.h"
#include "model/mesh/hermite/hermite_mesh.h"
#include "print.h"

namespace subimpact {
namespace {

using Extent = HermiteMesh::Extent;

struct Chain {
  Ends ends;
  Extent extent;
};

std::ostream& operator<<(std::ostream& out, const Chain& chain) {
  return out << chain.ends[0] << ' ' << chain.ends[1]
             << (chain.extent == Extent::half ? " half" : " whole");
}

class ModesOfElements : public testing::TestWithParam<std::tuple<Chain, BeamTheory, std::size_t>> {
 protected:
  Beam beam() const {
    const auto& [chain, theory, n] = GetParam();
    return paper_beam(theory, chain.ends);
  }
  std::size_t n_elements() const { return std::get<2>(GetParam()); }
  Extent extent() const { return std::get<0>(GetParam()).extent; }
  HermiteMesh mesh() const {
    // Struck at a node, so that all elements are equal.
    const double position =
        extent() == Extent::half ? 0.5 : 1.0 / static_cast<double>(n_elements());
    return {beam(), position, n_elements(), extent()};
  }
  double stiffness() const { return beam().bending_stiffness(); }
};

TEST_P(ModesOfElements, HaveTheDenseDecompositionsFrequencies) {
  const HermiteMesh elements = mesh();
  ASSERT_TRUE(elements.has_closed_modes());
  const NaturalModes found = elements.natural_modes(stiffness());
  const NaturalModes dense = dense_natural_modes(elements, stiffness());
  ASSERT_EQ(found.size(), dense.size());
  for (std::size_t k = 0; k < dense.size(); ++k) {
    if (dense.frequencies[k] == 0.0) {
      EXPECT_EQ(found.frequencies[k], 0.0) << k;
      continue;
    }
    // The dense one cannot tell a low mode's share of a high one below rounding.
    const double rounding = 2e-16 * dense.frequencies.back() / dense.frequencies[k];
    EXPECT_NEAR(found.frequencies[k] / dense.frequencies[k], 1.0, 2e-14 + rounding) << k;
  }
}

TEST_P(ModesOfElements, BendWithTheEnergyOfTheirFrequency) {
  // phi^T K phi = omega^2, to digits that no decomposition has for low modes of fine meshes.
  const HermiteMesh elements = mesh();
  const NaturalModes modes = elements.natural_modes(stiffness());
  std::vector<double> kappa(elements.n_sections());
  for (std::size_t k = 0; k < modes.size(); ++k) {
    if (modes.frequencies[k] == 0.0) continue;
    elements.curvatures(modes.shape(k), kappa);
    double sum = 0.0;
    for (std::size_t i = 0; i < kappa.size(); ++i) {
      sum += elements.section_weights()[i] * stiffness() * kappa[i] * kappa[i];
    }
    EXPECT_NEAR(std::sqrt(sum) / modes.frequencies[k], 1.0, 1e-11) << k;
  }
}

// phi_i^T Mass phi_j between modes in closed form and decomposed ones, which differ by more without
// the corrections.
TEST(DenseModes, OfAFineMeshMixNoLowModes) {
  const Beam beam = paper_beam(BeamTheory::rayleigh, {free_end, pinned});
  const std::size_t n = 300;
  const HermiteMesh mesh(beam, 1.0 / static_cast<double>(n), n, Extent::whole);
  const NaturalModes closed = mesh.natural_modes(beam.bending_stiffness());
  const NaturalModes dense = dense_natural_modes(mesh, beam.bending_stiffness());
  std::vector<double> inertia(mesh.n_unknowns());
  for (std::size_t i = 0; i < 20; ++i) {
    mesh.mass().multiply(dense.shape(i), inertia);
    for (std::size_t j = 0; j < 20; ++j) {
      double product = 0.0;
      for (std::size_t k = 0; k < inertia.size(); ++k) product += inertia[k] * closed.shape(j)[k];
      EXPECT_NEAR(std::abs(product), i == j ? 1.0 : 0.0, 1e-8) << i << ", " << j;
    }
  }
}

// Sylvester: as many eigenvalues lie below sigma as K - sigma Mass has negative pivots.
std::size_t n_below(const HermiteMesh& mesh, double stiffness, double sigma) {
  const std::size_t n = mesh.n_unknowns();
  BandedMatrix shifted(n, 3);
  mesh.add_stiffness(std::vector<double>(mesh.n_sections(), stiffness), shifted);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i; j < std::min(i + 4, n); ++j)
      shifted.at(i, j) -= sigma * mesh.mass().at(i, j);
  }
  std::size_t count = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double pivot = shifted.at(k, k);
    if (pivot < 0.0) ++count;
    const std::size_t end = std::min(k + 4, n);
    for (std::size_t i = k + 1; i < end; ++i) {
      for (std::size_t j = i; j < end; ++j) {
        shifted.at(i, j) -= shifted.at(i, k) * shifted.at(j, k) / pivot;
      }
    }
  }
  return count;
}

TEST_P(ModesOfElements, AreNeitherLostNorDoubledByTheirCountBetweenThem) {
  const HermiteMesh elements = mesh();
  const NaturalModes modes = elements.natural_modes(stiffness());
  for (std::size_t k = 1; k < modes.size(); ++k) {
    const double a = modes.frequencies[k - 1];
    const double b = modes.frequencies[k];
    if (b == 0.0 || b - a < 1e-9 * b) continue;  // rigid, or a pair too close for rounding
    EXPECT_EQ(n_below(elements, stiffness(), 0.25 * (a + b) * (a + b)), k);
  }
}

TEST_P(ModesOfElements, AreOrthonormalAndSatisfyTheEquationsOfMotion) {
  expect_modes(mesh(), stiffness(), 1e-12);
}

TEST(HermiteModes, OfUnequalElementsAndOfACantileverAreDecomposed) {
  Beam beam = paper_beam();
  const HermiteMesh unequal(beam, 0.33, 10, Extent::whole);
  EXPECT_EQ(unequal.natural_modes(beam.bending_stiffness()).frequencies,
            dense_natural_modes(unequal, beam.bending_stiffness()).frequencies);
  beam.ends = {clamped, free_end};
  const HermiteMesh cantilever(beam, 0.5, 10, Extent::whole);
  EXPECT_EQ(cantilever.natural_modes(beam.bending_stiffness()).frequencies,
            dense_natural_modes(cantilever, beam.bending_stiffness()).frequencies);
}

INSTANTIATE_TEST_SUITE_P(
    Whole, ModesOfElements,
    testing::Combine(testing::Values(Chain{{free_end, free_end}, Extent::whole},
                                     Chain{{pinned, pinned}, Extent::whole},
                                     Chain{{clamped, clamped}, Extent::whole},
                                     Chain{{free_end, pinned}, Extent::whole},
                                     Chain{{pinned, free_end}, Extent::whole},
                                     Chain{{clamped, pinned}, Extent::whole},
                                     Chain{{pinned, clamped}, Extent::whole}),
                     testing::Values(BeamTheory::rayleigh, BeamTheory::euler_bernoulli),
                     testing::Values(4, 5, 40, 41, 160)),
    NamedAsPrinted{});

INSTANTIATE_TEST_SUITE_P(Half, ModesOfElements,
                         testing::Combine(testing::Values(Chain{{free_end, free_end}, Extent::half},
                                                          Chain{{pinned, pinned}, Extent::half},
                                                          Chain{{clamped, clamped}, Extent::half}),
                                          testing::Values(BeamTheory::rayleigh,
                                                          BeamTheory::euler_bernoulli),
                                          testing::Values(4, 6, 40, 216, 600)),
                         NamedAsPrinted{});

// A frequency far below the highest is not that of a rigid mode: hinges add ten times higher ones.
TEST(ACantileverOfManyElementsAndHinges, VibratesInItsLowestMode) {
  const Beam beam = paper_beam(BeamTheory::euler_bernoulli, {clamped, free_end});
  const HermiteMesh mesh(beam, 0.44, 560, Extent::whole, true);
  const NaturalModes modes = mesh.natural_modes(beam.bending_stiffness());
  EXPECT_LT(modes.frequencies.front(), 1e-7 * modes.frequencies.back());
  EXPECT_NEAR(modes.frequencies.front(), flexural_frequencies(beam, 1).front(),
              1e-6 * flexural_frequencies(beam, 1).front());
}

}  // namespace
}  // namespace subimpact
