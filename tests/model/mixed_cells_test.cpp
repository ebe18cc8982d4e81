// Mixed cells alone: frequencies as central differences see them, and what the mesh conserves.

#include "mesh_contract.h"
#include "model/mixed_mesh.h"
#include "model/mixed_sections.h"
#include "print.h"
#include "random_walk.h"

namespace subimpact {
namespace {

class MixedCellsOnSupports : public testing::TestWithParam<Ends> {
 protected:
  Beam beam() const {
    Beam beam = paper_beam(BeamTheory::rayleigh, GetParam());
    beam.thickness = 0.03;  // thick enough for the rotary inertia to matter
    return beam;
  }
};

INSTANTIATE_TEST_SUITE_P(Ends, MixedCellsOnSupports,
                         testing::Values(Ends{free_end, free_end}, Ends{pinned, pinned},
                                         Ends{clamped, clamped}, Ends{clamped, pinned}),
                         NamedAsPrinted{});

// A mode of frequency omega in space moves at the frequency 2/dt asin(omega dt/2) in steps of dt,
// which may be shorter than the natural one, or so short that they do not matter.
TEST_P(MixedCellsOnSupports, MoveAtFrequenciesOfFourthOrderInTheStepTheyAreMadeFor) {
  const std::vector<double> exact = flexural_frequencies(beam(), 5);
  // What free ends leave, of higher order, changes the sign of the higher modes' errors; of other
  // ends, rounding would show in the first mode.
  const std::vector<std::size_t> modes =
      beam().is_free() ? std::vector<std::size_t>{0} : std::vector<std::size_t>{1, 2, 4};
  for (const double ratio : {1.0, 0.3, 0.0}) {
    for (const std::size_t mode : modes) {
      OrderTable table("step ratio " + std::to_string(ratio) + ", mode " +
                       std::to_string(mode + 1) + ": relative error of the frequency, over cells");
      for (const std::size_t n : {48u, 64u, 80u}) {
        const MixedMesh mesh(beam(), 0.375, n, MixedMesh::Extent::whole, ratio);
        const double step = ratio * *mesh.natural_step();
        const double in_space = mesh.natural_modes(beam().bending_stiffness())
                                    .frequencies[mode + n_rigid_modes(beam())];
        const double found = step > 0.0 ? 2.0 / step * std::asin(0.5 * in_space * step) : in_space;
        table.add(static_cast<double>(n), std::abs(found / exact[mode] - 1.0));
      }
      table.expect_overall_order_within(3.6, 4.6);
    }
  }
}

// v^T Mass v/2 from the energy, with v = Mass^-1 f from the solver.
TEST_P(MixedCellsOnSupports, HaveOneMassInSolutionsAndEnergies) {
  for (const double ratio : {1.0, 0.3, 0.0}) {
    for (const auto extent : {MixedMesh::Extent::half, MixedMesh::Extent::whole}) {
      if (extent == MixedMesh::Extent::half && beam().ends[0] != beam().ends[1]) continue;
      const MixedMesh mesh(beam(), 0.5, 40, extent, ratio);
      std::vector<double> force = random_numbers(3, mesh.n_unknowns()), v = force;
      mesh.make_mass_solver()->solve(v);
      std::vector<double> scratch(mesh.n_kept_cells());
      const double energy = mesh.kinetic_energy(v, scratch);
      EXPECT_NEAR(0.5 * dot(force.data(), v.data(), v.size()) / energy, 1.0, 1e-12);
    }
  }
}

// A force at the strike, with the inertia of rigid motions against it where the supports leave any.
TEST_P(MixedCellsOnSupports, BalanceAForceByMoments) {
  for (const double position : {0.5, 0.37}) {
    const MixedMesh mesh(beam(), position, 48, MixedMesh::Extent::whole, 0.6);
    std::vector<double> load(mesh.n_unknowns(), 0.0), forces(load);
    mesh.struck_point().add_to(load, 1.0);
    for (const MixedMesh::RigidMotion& motion : mesh.rigid_motions()) {
      const double share = mesh.struck_point()(motion.shape);
      for (std::size_t i = 0; i < load.size(); ++i) load[i] -= share * motion.inertia[i];
    }
    const std::vector<double> moments = mesh.moments_under(load);
    mesh.forces_of(moments.data(), 1.0, forces.data());
    for (std::size_t i = 0; i < load.size(); ++i) EXPECT_NEAR(forces[i], -load[i], 1e-9);
    // The deflection under the force that textbooks give, from the energy.
    const double l = beam().length, found = mesh.square_of(moments);
    const auto [first, last] = beam().ends;
    if (position != 0.5 || first == free_end) continue;
    const double exact = first == pinned  ? l * l * l / 48.0
                         : last == pinned ? 7.0 * l * l * l / 768.0
                                          : l * l * l / 192.0;
    EXPECT_NEAR(found / exact, 1.0, 1e-10);
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
    for (const double ratio : {1.0, 0.3, 0.0}) {
      const MixedMesh mesh(beam(), position, 48, MixedMesh::Extent::whole, ratio);
      const NaturalModes modes = mesh.natural_modes(beam().bending_stiffness());
      const double bound = mesh.highest_frequency(beam().bending_stiffness());
      EXPECT_LT(modes.frequencies.back(), bound);
      EXPECT_GT(modes.frequencies.back(), 0.98 * bound);
    }
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
  std::vector<double> turned(mesh.n_unknowns());
  for (std::size_t i = 0; i < turned.size(); ++i) turned[i] = 0.3 + 0.1 * mesh.node_position(i);
  for (const double k : curvatures_of(mesh, turned)) EXPECT_NEAR(k, 0.0, 1e-11);
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
  EXPECT_THROW(MixedMesh(beam, 0.5, 100, MixedMesh::Extent::half, 1.1), std::invalid_argument);
  beam.theory = BeamTheory::euler_bernoulli;
  EXPECT_THROW(make(0.5, 100, MixedMesh::Extent::whole), std::invalid_argument);
}

// The bending of mixed cells at given displacements.

class BentMixedCells : public testing::Test {
 protected:
  // The middle displaced sharply, times `size`: elastic up to 0.02, a hinge above 1.
  std::vector<double> bent(double size) const {
    std::vector<double> w(mesh_.n_unknowns());
    for (std::size_t i = 0; i < w.size(); ++i) {
      const double x = (mesh_.node_position(i) - 0.5 * beam_.length) / 0.01;
      w[i] = size * 1e-4 * std::exp(-std::abs(x)) * (1.0 + std::abs(x));
    }
    return w;
  }
  double largest_moment() const {
    return largest_of(sections_.elastic_curvatures()) / beam_.yield_curvature();
  }

  Beam beam_ = paper_beam();
  MixedMesh mesh_{beam_, 0.5, 200, MixedMesh::Extent::half};
  MixedSections sections_{mesh_, beam_.bending_stiffness(),
                          SectionLaw(beam_, Fibres::continuous())};
};

TEST_F(BentMixedCells, CarryNoMomentAboveTheFullPlasticOne) {
  for (const double size : {0.01, 0.05, 0.2, 0.5, 1.0, 2.0, 4.0}) {
    std::vector<double> w = bent(size);
    ASSERT_TRUE(sections_.settle(w)) << size;
    EXPECT_LE(largest_moment(), 1.5 + 1e-5) << size;
    sections_.commit(0.0);
  }
  EXPECT_GT(largest_moment(), 1.49);
  EXPECT_GE(sections_.n_yielded(), 3u);
}

TEST_F(BentMixedCells, HaveTheSameMomentsWhenEvaluatedWhereTheyHaveSettled) {
  for (const double size : {0.05, 0.2, 0.6, 0.4, -0.3}) {
    std::vector<double> w = bent(size);
    ASSERT_TRUE(sections_.settle(w));
    const std::vector<double> settled(sections_.elastic_curvatures().begin(),
                                      sections_.elastic_curvatures().end());
    ASSERT_TRUE(sections_.evaluate(w));
    for (std::size_t i = 0; i < settled.size(); ++i) {
      EXPECT_NEAR(sections_.elastic_curvatures()[i], settled[i], 1e-4 * beam_.yield_curvature());
    }
    sections_.commit(0.0);
  }
}

TEST_F(BentMixedCells, StayPutWhileNothingFlows) {
  const std::vector<double> straight(mesh_.n_unknowns(), 0.25);
  std::vector<double> w = straight;
  ASSERT_TRUE(sections_.settle(w));
  EXPECT_EQ(w, straight);
  EXPECT_FALSE(sections_.commit(0.0));
  EXPECT_EQ(sections_.energies().plastic, 0.0);
}

TEST_F(BentMixedCells, ForgetWhatWasNotCommitted) {
  std::vector<double> small = bent(0.05), far = bent(1.0);
  ASSERT_TRUE(sections_.settle(far));
  EXPECT_GT(sections_.energies().plastic, 0.0);
  const std::vector<double> straight(mesh_.n_unknowns(), 0.0);
  ASSERT_TRUE(sections_.evaluate(straight));
  EXPECT_EQ(largest_moment(), 0.0);
  EXPECT_EQ(sections_.energies().plastic, 0.0);
}

// What bends the beam by force and lets go leaves the plastic work behind, and no less.
TEST_F(BentMixedCells, LoseNoPlasticWork) {
  double before = 0.0;
  for (const double size : {0.1, 0.3, 0.1, -0.2, 0.5, 0.0}) {
    std::vector<double> w = bent(size);
    ASSERT_TRUE(sections_.settle(w));
    EXPECT_GE(sections_.energies().plastic, before - 1e-12);
    before = sections_.energies().plastic;
    sections_.commit(0.0);
    EXPECT_NEAR(sections_.energies().plastic, before, 1e-9 * (1.0 + before));
  }
}

}  // namespace
}  // namespace subimpact
