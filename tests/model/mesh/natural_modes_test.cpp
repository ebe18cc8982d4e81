// Natural modes in closed form against a dense decomposition, and a beam in their coordinates.

#include "mesh/mesh_contract.h"
#include "model/mesh/cell_mesh.h"
#include "model/mesh/hermite/hermite_mesh.h"
#include "model/mesh/modal_mesh.h"
#include "model/mesh/shear/spectral_mesh.h"
#include "model/mesh/shear/timoshenko_mesh.h"

namespace subimpact {
namespace {

using Extent = BeamMesh::Extent;

Beam shearing(double share = 1.0, EndSupport ends = free_end) {  // of the published k G
  Beam beam = shearing_beam({ends, ends});
  beam.poisson = 0.3;
  beam.shear_coefficient = share * 0.85;
  return beam;
}

// A mesh with modes in closed form, and what rounding may leave: of frequencies, relative; of the
// equations of motion; of orthogonality.
struct Chain {
  std::shared_ptr<const BeamMesh> mesh;
  double stiffness, of_frequencies, of_motion, of_products;
};

template <class Mesh, class... Details>
Chain chain(const Beam& beam, double position, std::size_t n, Extent extent,
            const std::array<double, 3>& rounding, const Details&... details) {
  return {std::make_shared<Mesh>(beam, position, n, extent, details...), beam.bending_stiffness(),
          rounding[0], rounding[1], rounding[2]};
}

auto n_ends(const Beam& beam, EndSupport end) { return std::ranges::count(beam.ends, end); }

std::vector<Chain> chains() {
  std::vector<Chain> all;
  constexpr std::array of_cells{1e-12, 5e-13, 1e-12};
  for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
    const Beam beam = paper_beam(theory);
    for (const std::size_t n : {5u, 101u, 501u}) {
      for (const auto spacing : {CellMesh::Spacing::cells, CellMesh::Spacing::points}) {
        all.push_back(chain<CellMesh>(beam, 0.5, n, Extent::half, of_cells, spacing));
        if (n > 101) continue;
        all.push_back(chain<CellMesh>(beam, 0.5, n + 1, Extent::whole, of_cells, spacing));
      }
    }
  }
  // Hermite elements, struck at a node, so that all of them are equal.
  constexpr std::array of_hermite{2e-14, 1e-12, 1e-12};
  for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
    for (const EndSupport first : all_ends) {
      for (const EndSupport second : all_ends) {
        const Beam beam = paper_beam(theory, {first, second});
        if (n_ends(beam, free_end) == 1 && n_ends(beam, clamped) == 1) continue;
        for (const std::size_t n : {4u, 5u, 41u}) {
          const double position = 1.0 / static_cast<double>(n);
          all.push_back(chain<HermiteMesh>(beam, position, n, Extent::whole, of_hermite));
        }
        for (const std::size_t n : {4u, 6u, 216u}) {
          if (first != second) break;
          all.push_back(chain<HermiteMesh>(beam, 0.5, n, Extent::half, of_hermite));
        }
      }
    }
  }
  // Next to the top of a band an angle loses digits as n^2.
  constexpr std::array that_shear{1e-11, 5e-11, 5e-11};
  for (const auto& [n, share] : {std::pair(5u, 1.0), {101u, 1.0}, {101u, 0.01}, {101u, 50.0}}) {
    for (const Extent extent : {Extent::half, Extent::whole}) {
      all.push_back(chain<TimoshenkoMesh>(shearing(share), 0.5, n, extent, that_shear));
    }
  }
  all.push_back(chain<TimoshenkoMesh>(shearing(), 0.5, 501, Extent::half, that_shear));
  constexpr std::array of_elements{1e-12, 5e-12, 1e-12};
  const auto add = [&](std::size_t n, double position, Extent extent, EndSupport ends = free_end,
                       double share = 1.0) {
    const Beam beam = shearing(share, ends);
    all.push_back(chain<SpectralMesh>(beam, position, n, extent, of_elements));
  };
  for (const EndSupport ends : {free_end, pinned}) {
    add(2, 0.5, Extent::whole, ends);
    add(3, 1.0 / 3.0, Extent::whole, ends);
    add(50, 0.5, Extent::half, ends);
    add(50, 0.3, Extent::whole, ends);
  }
  add(2, 0.5, Extent::half);
  add(50, 0.0, Extent::whole);
  add(50, 0.5, Extent::half, free_end, 0.01);
  add(50, 0.5, Extent::whole, free_end, 50.0);
  add(200, 0.5, Extent::half);
  return all;
}

TEST(NaturalModesInClosedForm, HaveTheDenseDecompositionsFrequencies) {
  for (const Chain& each : chains()) {
    SCOPED_TRACE(each.mesh->description());
    EXPECT_TRUE(each.mesh->has_closed_modes());
    const NaturalModes closed = each.mesh->natural_modes(each.stiffness);
    ASSERT_EQ(closed.size(), each.mesh->n_unknowns());
    const auto expected = dense_natural_modes(*each.mesh, each.stiffness).frequencies;
    for (std::size_t k = 0; k < expected.size(); ++k) {
      // The dense one cannot tell a low mode's share of a high one below rounding.
      EXPECT_NEAR(closed.frequencies[k], expected[k],
                  each.of_frequencies * expected[k] + 2e-16 * expected.back())
          << k;
    }
  }
}

TEST(NaturalModesInClosedForm, AreOrthonormalAndSatisfyTheEquationsOfMotion) {
  for (const Chain& each : chains()) {
    SCOPED_TRACE(each.mesh->description());
    expect_modes(*each.mesh, each.stiffness, each.of_motion, each.of_products);
  }
}

// At these k G two waves of the half beam have the same frequency to the last digit.
TEST(NaturalModesInClosedForm, AreOrthonormalWhereTwoWavesHaveOneFrequency) {
  for (const double apart : {0.0, 1e-12, 1e-10, 1e-8, 1e-6}) {
    SCOPED_TRACE(apart);
    Beam beam = shearing(1.0007773822171875 * (1.0 + apart));
    const double stiffness = beam.bending_stiffness();
    expect_modes(TimoshenkoMesh(beam, 0.5, 501, Extent::half), stiffness, 2e-10, 2e-10);
    beam = shearing(1.0177107203805 * (1.0 + apart));
    const SpectralMesh elements(beam, 0.5, 100, Extent::half);
    expect_modes(elements, stiffness, 1e-11, 1e-11);
    expect_near(elements.natural_modes(stiffness).frequencies,
                dense_natural_modes(elements, stiffness).frequencies, 0.0, 1e-12);
  }
}

TEST(MeshesWithoutModesInClosedForm, AreDecomposed) {
  const Beam beam = shearing(), plain = paper_beam();
  const double stiffness = beam.bending_stiffness();
  const SpectralMesh unequal(beam, 0.31, 50, Extent::whole);
  const HermiteMesh unequal_too(plain, 0.33, 10, Extent::whole);
  const HermiteMesh cantilever(paper_beam(plain.theory, {clamped, free_end}), 0.5, 10,
                               Extent::whole);
  for (const BeamMesh* mesh : std::array<const BeamMesh*, 3>{&unequal, &unequal_too, &cantilever}) {
    SCOPED_TRACE(mesh->description());
    EXPECT_FALSE(mesh->has_closed_modes());
    EXPECT_EQ(mesh->natural_modes(stiffness).frequencies,
              dense_natural_modes(*mesh, stiffness).frequencies);
  }
  expect_modes(unequal, stiffness, 1e-12, 1e-9);
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

// A frequency far below the highest is not that of a rigid mode: a short element beside the strike
// adds ten times higher ones.
TEST(ACantileverOfManyElements, VibratesInItsLowestMode) {
  const Beam beam = paper_beam(BeamTheory::euler_bernoulli, {clamped, free_end});
  const HermiteMesh mesh(beam, 4e-4, 560, Extent::whole);
  const NaturalModes modes = mesh.natural_modes(beam.bending_stiffness());
  EXPECT_LT(modes.frequencies.front(), 1e-7 * modes.frequencies.back());
  EXPECT_NEAR(modes.frequencies.front(), flexural_frequencies(beam, 1).front(),
              1e-6 * flexural_frequencies(beam, 1).front());
}

class ModalCoordinates : public testing::Test {
 protected:
  Beam beam_ = shearing();
  TimoshenkoMesh physical_{beam_, 0.3, 50, Extent::whole};
  ModalMesh modal_{std::make_unique<TimoshenkoMesh>(beam_, 0.3, 50, Extent::whole),
                   beam_.bending_stiffness()};
  std::vector<double> q_ = [this] {
    std::vector<double> q(physical_.n_unknowns());
    for (std::size_t i = 0; i < q.size(); ++i) {
      q[i] = 1e-3 * std::sin(0.1 * static_cast<double>(i)) + 1e-5 * static_cast<double>(i);
    }
    return q;
  }();
  std::vector<double> z_ = [this] {
    std::vector<double> z(q_.size());
    modal_.to_modal(q_, z);
    return z;
  }();
};

TEST_F(ModalCoordinates, AndBackIsTheSameField) {
  std::vector<double> back(q_.size());
  modal_.to_physical(z_, back);
  expect_near(back, q_, 1e-15);
}

TEST_F(ModalCoordinates, KeepEnergiesCurvaturesAndFunctionals) {
  const double kinetic = physical_.mass().quadratic_form(q_);
  EXPECT_NEAR(modal_.mass().quadratic_form(z_), kinetic, 1e-12 * kinetic);
  EXPECT_NEAR(modal_.struck_point()(z_), physical_.struck_point()(q_), 1e-15);
  EXPECT_NEAR(modal_.first_end()(z_), physical_.first_end()(q_), 1e-15);
  expect_near(curvatures_of(modal_, z_), curvatures_of(physical_, q_), 1e-10);
  const double shear = physical_.shear_energy(q_);
  EXPECT_NEAR(modal_.shear_energy(z_), shear, 1e-10 * shear);
}

TEST_F(ModalCoordinates, HaveTheBeamsRootMeanSquare) {
  // Of a translation by 1 m, and of any field weighted with its mass.
  double sum = 0.0;
  for (const double x : modal_.translation()) sum += x * x;
  const auto n = static_cast<double>(modal_.n_unknowns());
  EXPECT_NEAR(std::sqrt(sum / n), 1.0, 1e-13);
  for (std::size_t k = 0; k < modal_.n_unknowns(); ++k) {
    EXPECT_NEAR(modal_.mass().at(k, k), modal_.beam_mass() / n, 1e-15);
  }
}

TEST(AModalMesh, HasItsUnknownsAsModesAtAnyStiffness) {
  const Beam beam = paper_beam();
  const double stiffness = beam.bending_stiffness();
  const ModalMesh mesh(std::make_unique<CellMesh>(beam, 0.3, 100, Extent::whole), stiffness);
  const NaturalModes modes = mesh.natural_modes(4.0 * stiffness);
  for (std::size_t k = 0; k < modes.size(); ++k) {
    EXPECT_NEAR(modes.frequencies[k], 2.0 * mesh.frequencies()[k], 1e-9);
    EXPECT_NEAR(mesh.mass().quadratic_form(modes.shape(k)), 1.0, 1e-14);
  }
}

TEST_F(ModalCoordinates, MakeTheElasticForceDiagonal) {
  std::vector<double> moments = curvatures_of(modal_, z_);
  for (double& m : moments) m *= beam_.bending_stiffness();
  std::vector<double> force(z_.size());
  modal_.internal_forces(z_, moments, force);
  for (std::size_t k = 0; k < z_.size(); ++k) {
    const double w = modal_.frequencies()[k];
    EXPECT_NEAR(force[k], -modal_.mass().at(k, k) * w * w * z_[k], 1e-9 * largest_of(force)) << k;
  }
}

// The lowest modes and the static response of meshes by banded factorisation, beside those by all
// modes.

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
  for (const EndSupport first : all_ends) {
    for (const EndSupport last : all_ends) {
      const Beam beam = paper_beam(BeamTheory::rayleigh, {first, last});
      const double period = 2.0 * M_PI / flexural_frequencies(beam, 1).front();
      expect_same(CellMesh(beam, 0.4, 61, BeamMesh::Extent::whole), beam.bending_stiffness(),
                  period);
    }
  }
}

}  // namespace
}  // namespace subimpact
