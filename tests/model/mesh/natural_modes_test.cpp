// Natural modes in closed form against a dense decomposition, and a beam in their coordinates.

#include "mesh/mesh_contract.h"
#include "model/mesh/cell_mesh.h"
#include "model/mesh/modal_mesh.h"
#include "model/mesh/shear/spectral_mesh.h"
#include "model/mesh/shear/timoshenko_mesh.h"
#include "print.h"

namespace subimpact {
namespace {

struct Chain {
  std::size_t n_cells;
  CellMesh::Extent extent;
  BeamTheory theory;
  CellMesh::Spacing spacing = CellMesh::Spacing::cells;
};

std::ostream& operator<<(std::ostream& out, const Chain& chain) {
  return out << chain.n_cells << (chain.extent == CellMesh::Extent::half ? " half " : " whole ")
             << chain.theory << (chain.spacing == CellMesh::Spacing::points ? " points" : "");
}

class ModesOfCells : public testing::TestWithParam<Chain> {
 protected:
  CellMesh mesh() const {
    return {beam(), 0.5, GetParam().n_cells, GetParam().extent, GetParam().spacing};
  }
  Beam beam() const { return paper_beam(GetParam().theory); }
};

TEST_P(ModesOfCells, InClosedFormHaveTheDenseDecompositionsFrequencies) {
  const CellMesh chain = mesh();
  const NaturalModes closed = chain.natural_modes(beam().bending_stiffness());
  const NaturalModes dense = dense_natural_modes(chain, beam().bending_stiffness());
  EXPECT_EQ(closed.size(), chain.n_unknowns());
  expect_near(closed.frequencies, dense.frequencies, 0.0, 1e-12);
}

TEST_P(ModesOfCells, AreOrthonormalAndSatisfyTheEquationsOfMotion) {
  expect_modes(mesh(), beam().bending_stiffness(), 5e-13);
}

INSTANTIATE_TEST_SUITE_P(
    , ModesOfCells,
    testing::Values(
        Chain{5, CellMesh::Extent::half, BeamTheory::rayleigh},
        Chain{6, CellMesh::Extent::whole, BeamTheory::rayleigh},
        Chain{101, CellMesh::Extent::half, BeamTheory::rayleigh},
        Chain{101, CellMesh::Extent::half, BeamTheory::euler_bernoulli},
        Chain{100, CellMesh::Extent::whole, BeamTheory::rayleigh},
        Chain{101, CellMesh::Extent::whole, BeamTheory::euler_bernoulli},
        Chain{501, CellMesh::Extent::half, BeamTheory::rayleigh},
        Chain{101, CellMesh::Extent::half, BeamTheory::rayleigh, CellMesh::Spacing::points},
        Chain{20, CellMesh::Extent::whole, BeamTheory::rayleigh, CellMesh::Spacing::points},
        Chain{501, CellMesh::Extent::whole, BeamTheory::euler_bernoulli}),
    NamedAsPrinted{});

struct ShearChain {
  std::size_t n_cells;
  TimoshenkoMesh::Extent extent;
  double shear_share = 1.0;  // of the published beam's k G
};

std::ostream& operator<<(std::ostream& out, const ShearChain& chain) {
  return out << chain.n_cells
             << (chain.extent == TimoshenkoMesh::Extent::half ? " half " : " whole ")
             << static_cast<int>(1000.0 * chain.shear_share) << " thousandths of k G";
}

class ModesOfCellsThatShear : public testing::TestWithParam<ShearChain> {
 protected:
  TimoshenkoMesh mesh() const { return {beam(), 0.5, GetParam().n_cells, GetParam().extent}; }
  Beam beam() const {
    Beam beam = paper_beam(BeamTheory::timoshenko);
    beam.poisson = 0.3;
    beam.shear_coefficient = GetParam().shear_share * 0.85;
    return beam;
  }
};

TEST_P(ModesOfCellsThatShear, FromOneEquationHaveTheDenseDecompositionsFrequencies) {
  const TimoshenkoMesh chain = mesh();
  ASSERT_TRUE(chain.has_closed_modes());
  const NaturalModes closed = chain.natural_modes(beam().bending_stiffness());
  const NaturalModes dense = dense_natural_modes(chain, beam().bending_stiffness());
  EXPECT_EQ(closed.size(), chain.n_unknowns());
  expect_near(closed.frequencies, dense.frequencies, 0.0, 1e-11);
}

TEST_P(ModesOfCellsThatShear, AreOrthonormalAndSatisfyTheEquationsOfMotion) {
  // Next to the top of a band an angle loses digits as n^2.
  expect_modes(mesh(), beam().bending_stiffness(), 5e-11, 5e-11);
}

INSTANTIATE_TEST_SUITE_P(, ModesOfCellsThatShear,
                         testing::Values(ShearChain{5, TimoshenkoMesh::Extent::half},
                                         ShearChain{5, TimoshenkoMesh::Extent::whole},
                                         ShearChain{101, TimoshenkoMesh::Extent::half},
                                         ShearChain{101, TimoshenkoMesh::Extent::whole},
                                         ShearChain{101, TimoshenkoMesh::Extent::half, 0.01},
                                         ShearChain{101, TimoshenkoMesh::Extent::whole, 50.0},
                                         ShearChain{501, TimoshenkoMesh::Extent::half}),
                         NamedAsPrinted{});

// At this k G two waves of the half beam have the same frequency to the last digit.
TEST(CellsThatShear, HaveOrthonormalModesWhereTwoWavesHaveOneFrequency) {
  for (const double apart : {0.0, 1e-12, 1e-10, 1e-8, 1e-6}) {
    Beam beam = paper_beam(BeamTheory::timoshenko);
    beam.poisson = 0.3;
    beam.shear_coefficient = 0.85 * 1.0007773822171875 * (1.0 + apart);
    const TimoshenkoMesh mesh(beam, 0.5, 501, TimoshenkoMesh::Extent::half);
    SCOPED_TRACE(apart);
    expect_modes(mesh, beam.bending_stiffness(), 2e-10, 2e-10);
  }
}

struct SpectralChain {
  std::size_t n_elements;
  SpectralMesh::Extent extent;
  EndSupport ends = EndSupport::free;
  double shear_share = 1.0;  // of the published beam's k G
  double position = 0.5;
};

std::ostream& operator<<(std::ostream& out, const SpectralChain& chain) {
  return out << chain.n_elements
             << (chain.extent == SpectralMesh::Extent::half ? " half " : " whole ") << chain.ends
             << " struck at " << static_cast<int>(100.0 * chain.position) << " percent "
             << static_cast<int>(1000.0 * chain.shear_share) << " thousandths of k G";
}

class ModesOfSpectralElements : public testing::TestWithParam<SpectralChain> {
 protected:
  Beam beam() const {
    Beam beam = paper_beam(BeamTheory::timoshenko);
    beam.ends = {GetParam().ends, GetParam().ends};
    beam.poisson = 0.3;
    beam.shear_coefficient = GetParam().shear_share * 0.85;
    return beam;
  }
  SpectralMesh mesh() const {
    return {beam(), GetParam().position, GetParam().n_elements, GetParam().extent};
  }
};

TEST_P(ModesOfSpectralElements, FromWavesHaveTheDenseDecompositionsFrequencies) {
  const SpectralMesh chain = mesh();
  ASSERT_TRUE(chain.has_closed_modes());
  const NaturalModes closed = chain.natural_modes(beam().bending_stiffness());
  const NaturalModes dense = dense_natural_modes(chain, beam().bending_stiffness());
  EXPECT_EQ(closed.size(), chain.n_unknowns());
  expect_near(closed.frequencies, dense.frequencies, 0.0, 1e-12);
}

TEST_P(ModesOfSpectralElements, AreOrthonormalAndSatisfyTheEquationsOfMotion) {
  expect_modes(mesh(), beam().bending_stiffness(), 5e-12, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    , ModesOfSpectralElements,
    testing::Values(
        SpectralChain{2, SpectralMesh::Extent::half}, SpectralChain{2, SpectralMesh::Extent::whole},
        SpectralChain{3, SpectralMesh::Extent::whole, EndSupport::free, 1.0, 1.0 / 3.0},
        SpectralChain{2, SpectralMesh::Extent::whole, EndSupport::pinned},
        SpectralChain{3, SpectralMesh::Extent::whole, EndSupport::pinned, 1.0, 1.0 / 3.0},
        SpectralChain{50, SpectralMesh::Extent::half},
        SpectralChain{50, SpectralMesh::Extent::whole, EndSupport::free, 1.0, 0.0},
        SpectralChain{51, SpectralMesh::Extent::whole, EndSupport::free, 1.0, 1.0 / 3.0},
        SpectralChain{50, SpectralMesh::Extent::half, EndSupport::pinned},
        SpectralChain{50, SpectralMesh::Extent::whole, EndSupport::pinned, 1.0, 0.3},
        SpectralChain{50, SpectralMesh::Extent::half, EndSupport::free, 0.01},
        SpectralChain{50, SpectralMesh::Extent::whole, EndSupport::free, 50.0},
        SpectralChain{200, SpectralMesh::Extent::half}),
    NamedAsPrinted{});

TEST(SpectralElements, OfUnequalLengthsHaveNoModesFromWaves) {
  Beam beam = paper_beam(BeamTheory::timoshenko);
  beam.poisson = 0.3;
  const SpectralMesh mesh(beam, 0.31, 50, SpectralMesh::Extent::whole);
  EXPECT_FALSE(mesh.has_closed_modes());
  EXPECT_EQ(mesh.natural_modes(beam.bending_stiffness()).frequencies,
            dense_natural_modes(mesh, beam.bending_stiffness()).frequencies);
  expect_modes(mesh, beam.bending_stiffness(), 1e-12, 1e-9);
}

// At this k G two waves of the half beam have the same frequency.
TEST(SpectralElements, HaveOrthonormalModesWhereTwoWavesHaveOneFrequency) {
  for (const double apart : {0.0, 1e-12, 1e-10, 1e-8, 1e-6}) {
    Beam beam = paper_beam(BeamTheory::timoshenko);
    beam.poisson = 0.3;
    beam.shear_coefficient = 0.85 * 1.0177107203805 * (1.0 + apart);
    const SpectralMesh mesh(beam, 0.5, 100, SpectralMesh::Extent::half);
    SCOPED_TRACE(apart);
    expect_modes(mesh, beam.bending_stiffness(), 1e-11, 1e-11);
    expect_near(mesh.natural_modes(beam.bending_stiffness()).frequencies,
                dense_natural_modes(mesh, beam.bending_stiffness()).frequencies, 0.0, 1e-12);
  }
}

class ModalCoordinates : public testing::Test {
 protected:
  Beam beam_ = paper_beam();
  CellMesh physical_{beam_, 0.3, 100, CellMesh::Extent::whole};
  ModalMesh modal_{std::make_unique<CellMesh>(beam_, 0.3, 100, CellMesh::Extent::whole),
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

TEST_F(ModalCoordinates, GiveTheCurvatureOfEachSectionAlone) {
  const std::vector<double> all = curvatures_of(physical_, q_);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_NEAR(physical_.curvature(i, q_), all[i], 1e-13) << i;
    EXPECT_NEAR(modal_.curvature(i, z_), all[i], 1e-10) << i;
  }
}

TEST_F(ModalCoordinates, HaveThemselvesAsModes) {
  const NaturalModes modes = modal_.natural_modes(4.0 * beam_.bending_stiffness());
  for (std::size_t k = 0; k < modes.size(); ++k) {
    EXPECT_NEAR(modes.frequencies[k], 2.0 * modal_.frequencies()[k], 1e-9);
    EXPECT_NEAR(modal_.mass().quadratic_form(modes.shape(k)), 1.0, 1e-14);
  }
}

TEST_F(ModalCoordinates, MakeTheElasticForceDiagonal) {
  std::vector<double> moments = curvatures_of(modal_, z_);
  for (double& m : moments) m *= beam_.bending_stiffness();
  const std::vector<double> force = bending_forces_of(modal_, moments);
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
