#include "model/mesh/shear/timoshenko_mesh.h"

#include "mesh/mesh_contract.h"
#include "model/mesh/cell_mesh.h"
#include "model/mesh/modal_mesh.h"
#include "model/mesh/shear/spectral_mesh.h"

namespace subimpact {
namespace {

using Extent = TimoshenkoMesh::Extent;

constexpr Ends pinned_ends = {pinned, pinned};
constexpr Ends clamped_ends = {clamped, clamped};

Beam shearing_beam(Ends ends = free_ends) {
  Beam beam = paper_beam(BeamTheory::timoshenko, ends);
  beam.poisson = 0.33;
  beam.shear_coefficient = 5.0 / 6.0;
  return beam;
}

// Whole and half, few and many cells or elements, all ends, strikes on and between the nodes of
// equal ones. `odd`: a half model takes an odd number of them, or else an even one.
template <class Mesh>
std::vector<Mesh> meshes(const std::vector<std::size_t>& sizes,
                         const std::vector<double>& positions, bool odd) {
  std::vector<Mesh> all;
  for (const EndSupport first : all_ends) {
    for (const EndSupport second : all_ends) {
      const Beam beam = shearing_beam({first, second});
      for (const std::size_t n : sizes) {
        for (const double position : positions) {
          all.emplace_back(beam, position, n, Mesh::Extent::whole);
        }
        if (first == second && (n % 2 == 1) == odd)
          all.emplace_back(beam, 0.5, n, Mesh::Extent::half);
      }
    }
  }
  return all;
}

// Calls check(mesh) on all of both kinds.
template <class Check>
void on_every_mesh(Check check) {
  for (const auto& mesh : meshes<TimoshenkoMesh>({7, 8, 31}, {0.1, 0.5, 0.77}, true)) check(mesh);
  for (const auto& mesh : meshes<SpectralMesh>({2, 5, 12}, {0.27, 0.5, 0.71}, false)) check(mesh);
}

TEST(MeshesThatShear, KeepTheContractOfMeshes) {
  on_every_mesh([](const BeamMesh& mesh) { expect_mesh_contract(mesh); });
}

TEST(MeshesThatShear, ShearForcesAreThoseOfTheStiffnessMatrixAndItsEnergy) {
  on_every_mesh([](const BeamMesh& mesh) {
    const std::vector<double> q = random_numbers(4, mesh.n_unknowns());
    std::vector<double> forces(mesh.n_unknowns(), 0.0), by_matrix(mesh.n_unknowns(), 0.0);
    mesh.add_shear_forces(q, forces);
    mesh.BeamMesh::add_shear_forces(q, by_matrix);
    SCOPED_TRACE(mesh.description());
    expect_near(forces, by_matrix, 1e-13 * std::sqrt(dot(by_matrix, by_matrix)));
    EXPECT_NEAR(mesh.shear_energy(q), -0.5 * dot(forces, q), 1e-12 * mesh.shear_energy(q));
  });
}

TEST(MeshesThatShear, ReadNothingBesideTheirUnknowns) {
  const auto check = [](const BeamMesh& mesh) {
    constexpr std::size_t beside = 16;
    const std::size_t n = mesh.n_unknowns();
    const std::vector<double> q = random_numbers(4, n);
    std::vector<double> surrounded(n + 2 * beside, NAN), forces(n), expected(n);
    std::ranges::copy(q, surrounded.begin() + beside);
    mesh.add_shear_forces({surrounded.data() + beside, n}, forces);
    mesh.add_shear_forces(q, expected);
    EXPECT_EQ(forces, expected) << mesh.description();
    std::vector<double> kappa(mesh.n_sections());
    mesh.curvatures({surrounded.data() + beside, n}, kappa);
    for (const double k : kappa) EXPECT_TRUE(std::isfinite(k)) << mesh.description();
  };
  for (std::size_t n = 5; n < 24; ++n) {  // every remainder of eight unknowns
    for (const auto& mesh : meshes<TimoshenkoMesh>({n}, {0.1, 0.5, 0.77}, true)) check(mesh);
  }
  for (const auto& mesh : meshes<SpectralMesh>({2, 5, 12}, {0.27, 0.5, 0.71}, false)) check(mesh);
}

TEST(TimoshenkoMesh, RigidMotionsOfAFreeBeamStrainNothing) {
  for (const double position : {0.13, 0.5}) {
    const TimoshenkoMesh mesh(shearing_beam(), position, 31, Extent::whole);
    std::vector<double> forces(mesh.n_unknowns(), 0.0), kappa(mesh.n_sections());
    mesh.add_shear_forces(mesh.translation(), forces);
    mesh.curvatures(mesh.translation(), kappa);
    EXPECT_NEAR(mesh.shear_energy(mesh.translation()), 0.0, 1e-18);
    EXPECT_EQ(dot(kappa, kappa), 0.0);
    EXPECT_NEAR(mesh.mass().quadratic_form(mesh.translation()) / shearing_beam().mass(), 1.0,
                1e-13);
    EXPECT_NEAR(dot(mesh.momentum_functional(), mesh.translation()) / mesh.beam_mass(), 1.0, 1e-14);
  }
}

TEST(MeshesThatShear, HaveANodeUnderTheStrike) {
  on_every_mesh([](const BeamMesh& mesh) {
    ASSERT_EQ(mesh.struck_point().terms.size(), 1u) << mesh.description();
    EXPECT_EQ(mesh.struck_point().terms.front().coefficient, 1.0);
  });
  const TimoshenkoMesh mesh(shearing_beam(), 0.317, 60, Extent::whole);
  EXPECT_NEAR(mesh.section_positions()[mesh.struck_section()], 0.317 * shearing_beam().length,
              1e-12);
}

TEST(TimoshenkoMesh, RefusesWhatItCannotModel) {
  EXPECT_THROW(TimoshenkoMesh(paper_beam(), 0.5, 31, Extent::whole), std::invalid_argument);
  EXPECT_THROW(TimoshenkoMesh(shearing_beam(), 0.5, 4, Extent::whole), std::invalid_argument);
  EXPECT_THROW(TimoshenkoMesh(shearing_beam(), 0.5, 30, Extent::half), std::invalid_argument);
  EXPECT_THROW(TimoshenkoMesh(shearing_beam(), 0.4, 31, Extent::half), std::invalid_argument);
}

template <class Mesh = TimoshenkoMesh>
std::vector<double> frequencies(const Beam& beam, double position, std::size_t n) {
  const Mesh mesh(beam, position, n, Mesh::Extent::whole);
  return mesh.natural_modes(beam.bending_stiffness()).frequencies;
}

// The bound is above the highest frequency, and at most `times` it.
template <class Mesh>
void expect_bound(std::size_t n, double times) {
  for (const Ends& ends : {free_ends, pinned_ends, clamped_ends}) {
    const Beam beam = shearing_beam(ends);
    for (const double position : {0.5, 0.13}) {
      const Mesh mesh(beam, position, n, Mesh::Extent::whole);
      const double highest = mesh.natural_modes(beam.bending_stiffness()).frequencies.back();
      const double bound = mesh.highest_frequency(beam.bending_stiffness());
      EXPECT_GE(bound, highest * (1.0 - 1e-12)) << mesh.description();
      EXPECT_LE(bound, times * highest) << mesh.description();
    }
  }
}

TEST(MeshesThatShear, HaveABoundOnTheirHighestFrequencyWhichIsClose) {
  for (const std::size_t n : {7u, 20u, 101u}) expect_bound<TimoshenkoMesh>(n, 1.1);
  expect_bound<SpectralMesh>(12, 1.2);
}

// Both roots W = omega^2 of (rho^2 I/(k G)) W^2 - (rho A + rho I b^2 (1 + E/(k G))) W + E I b^4
// = 0 with b = n pi/l, the lower one first; divided by A.
std::array<double, 2> pinned_frequencies(const Beam& beam, int n) {
  const double b2 = std::pow(n * M_PI / beam.length, 2);
  const double shear = beam.shear_stiffness() / beam.area();  // k G
  const double r2 = beam.second_moment() / beam.area();
  const double a = beam.density * beam.density * r2 / shear;
  const double b = beam.density * (1.0 + r2 * b2 * (1.0 + beam.youngs_modulus / shear));
  const double c = beam.youngs_modulus * r2 * b2 * b2;
  const double root = std::sqrt(b * b - 4.0 * a * c);
  return {std::sqrt(2.0 * c / (b + root)), std::sqrt((b + root) / (2.0 * a))};
}

double nearest(const std::vector<double>& all, double value) {
  double best = all.front();
  for (const double x : all) {
    if (std::abs(x - value) < std::abs(best - value)) best = x;
  }
  return best;
}

Beam pinned_beam(double slenderness) {
  Beam beam = shearing_beam(pinned_ends);
  beam.length = slenderness * beam.thickness;
  return beam;
}

// Of the frequencies of a stubby beam on pins, with cells or elements.
template <class Mesh>
void expect_order_in_both_branches(const std::vector<int>& modes,
                                   const std::vector<std::size_t>& sizes, double low, double high) {
  const Beam stubby = pinned_beam(10.0);
  std::map<std::size_t, std::vector<double>> found;
  for (const std::size_t n : sizes) found[n] = frequencies<Mesh>(stubby, 0.5, n);
  for (const int mode : modes) {
    for (const std::size_t branch : {0u, 1u}) {
      OrderTable table("relative error of mode " + std::to_string(mode) + ", branch " +
                       std::to_string(branch));
      const double exact = pinned_frequencies(stubby, mode)[branch];
      for (const std::size_t n : sizes) {
        table.add(static_cast<double>(n), std::abs(nearest(found[n], exact) / exact - 1.0));
      }
      table.expect_every_order_within(low, high);
    }
  }
}

TEST(TimoshenkoMesh, PinnedFrequenciesOfBothBranchesConvergeAtSecondOrder) {
  expect_order_in_both_branches<TimoshenkoMesh>({1, 2, 3, 5}, {41, 81, 161, 321}, 1.9, 2.1);
}

// The order at which a mode converges at l/h = 1000.
template <class Mesh>
void expect_no_locking(int mode, const std::vector<std::size_t>& sizes, double low, double high) {
  const Beam slender = pinned_beam(1000.0);
  OrderTable table("relative error of mode " + std::to_string(mode) + " at l/h = 1000");
  const double exact = pinned_frequencies(slender, mode)[0];
  for (const std::size_t n : sizes) {
    const double found = frequencies<Mesh>(slender, 0.5, n)[static_cast<std::size_t>(mode - 1)];
    table.add(static_cast<double>(n), std::abs(found / exact - 1.0));
  }
  table.expect_every_order_within(low, high);
}

// What locking costs an element without reduced integration is the order, and then all accuracy.
TEST(TimoshenkoMesh, DoesNotLockAsTheBeamBecomesSlender) {
  for (const int mode : {1, 3})
    expect_no_locking<TimoshenkoMesh>(mode, {21, 41, 81, 161}, 1.9, 2.1);
}

TEST(TimoshenkoMesh, FrequenciesOfAllEndsConvergeAtSecondOrderWithTheStrikeAnywhere) {
  for (const Ends& ends :
       {free_ends, clamped_ends, Ends{clamped, free_end}, Ends{pinned, clamped}}) {
    Beam beam = shearing_beam(ends);
    beam.length = 20.0 * beam.thickness;
    for (const double position : {0.5, 0.371}) {
      OrderTable table("differences of the third bending frequency from half the cells, " +
                       std::string(beam.is_free() ? "free" : "supported"));
      const std::size_t mode = beam.is_free() ? 4 : 2;
      double before = frequencies(beam, position, 31)[mode];
      for (const std::size_t n : {61u, 121u, 241u}) {
        const double here = frequencies(beam, position, n)[mode];
        table.add(static_cast<double>(n), std::abs(here / before - 1.0));
        before = here;
      }
      table.expect_every_order_within(1.75, 2.25);
    }
  }
}

TEST(TimoshenkoMesh, WithoutLimitOfTheShearStiffnessIsRayleighsCells) {
  const Beam rayleigh = paper_beam(BeamTheory::rayleigh, pinned_ends);
  const CellMesh cells(rayleigh, 0.5, 41, CellMesh::Extent::whole);
  const auto expected = cells.natural_modes(rayleigh.bending_stiffness()).frequencies;
  OrderTable table("relative distance of the seventh frequency from Rayleigh's cells, over k");
  for (const double coefficient : {1e2, 1e3, 1e4}) {
    Beam stiff = shearing_beam(pinned_ends);
    stiff.shear_coefficient = coefficient;
    table.add(coefficient, std::abs(frequencies(stiff, 0.5, 41)[6] / expected[6] - 1.0));
  }
  table.expect_every_order_within(0.9, 1.1);
}

TEST(TimoshenkoMesh, WithoutLimitOfTheShearStiffnessHasTheFrequenciesOfRayleighsFreeBeam) {
  const std::vector<double> exact = flexural_frequencies(paper_beam(), 5);
  Beam stiff = shearing_beam();
  stiff.shear_coefficient = 1e3;
  for (const std::size_t mode : {0u, 2u, 4u}) {
    OrderTable table("relative error of mode " + std::to_string(mode + 1));
    for (const std::size_t n : {41u, 81u, 161u}) {
      table.add(static_cast<double>(n),
                std::abs(frequencies(stiff, 0.5, n)[mode + 2] / exact[mode] - 1.0));
    }
    table.expect_every_order_within(1.9, 2.1);
  }
}

TEST(TimoshenkoMesh, WithoutShearAndRotaryInertiaHasEulersFrequencies) {
  Beam euler = paper_beam(BeamTheory::euler_bernoulli);
  const std::vector<double> exact = flexural_frequencies(euler, 1);
  OrderTable table("relative distance of the first frequency from Euler's over length/thickness");
  for (const double slenderness : {20.0, 40.0, 80.0}) {
    const Beam beam = pinned_beam(slenderness);
    euler.ends = beam.ends;
    euler.length = beam.length;
    const double found = frequencies(beam, 0.5, 251)[0];
    const double mesh = pinned_frequencies(beam, 1)[0];
    EXPECT_NEAR(found / mesh, 1.0, 1e-4);
    table.add(slenderness, std::abs(mesh / flexural_frequencies(euler, 1)[0] - 1.0));
  }
  table.expect_every_order_within(1.9, 2.1);
}

TEST(TimoshenkoMesh, InNaturalModesHasTheSameForcesAndEnergies) {
  const auto mesh =
      std::make_shared<const TimoshenkoMesh>(shearing_beam(), 0.31, 21, Extent::whole);
  const ModalMesh modal(mesh, shearing_beam().bending_stiffness());
  const std::size_t n = mesh->n_unknowns();
  const std::vector<double> q = random_numbers(5, n);
  std::vector<double> z(n), forces(n, 0.0), modal_forces(n, 0.0), expected(n);
  modal.to_modal(q, z);
  EXPECT_NEAR(modal.shear_energy(z), mesh->shear_energy(q), 1e-10 * mesh->shear_energy(q));
  mesh->add_shear_forces(q, forces);
  modal.add_shear_forces(z, modal_forces);
  // Work on a virtual displacement is the same in both.
  const std::vector<double> virtual_q = random_numbers(6, n);
  std::vector<double> virtual_z(n);
  modal.to_modal(virtual_q, virtual_z);
  const double work = dot(forces, virtual_q);
  EXPECT_NEAR(dot(modal_forces, virtual_z), work,
              1e-10 * std::sqrt(dot(forces, forces) * dot(virtual_q, virtual_q)));
}

// --- spectral elements ---------------------------------------------------------------------------

TEST(SpectralMesh, PinnedFrequenciesOfBothBranchesConvergeAtEighthOrder) {
  expect_order_in_both_branches<SpectralMesh>({3, 5}, {8, 12, 16}, 7.0, 9.0);
}

TEST(SpectralMesh, DoesNotLockAsTheBeamBecomesSlender) {
  expect_no_locking<SpectralMesh>(5, {3, 5, 8}, 6.0, 10.0);
}

// Two discretisations that have nothing in common but the continuum.
TEST(SpectralMesh, HasTheFrequenciesThatCellsTendToForAllEnds) {
  for (const Ends& ends :
       {free_ends, clamped_ends, Ends{clamped, free_end}, Ends{pinned, clamped}}) {
    Beam beam = shearing_beam(ends);
    beam.length = 20.0 * beam.thickness;
    const std::size_t mode = beam.is_free() ? 4 : 2;
    const double coarse = frequencies(beam, 0.5, 121)[mode];
    const double fine = frequencies(beam, 0.5, 241)[mode];
    const double limit = fine + (fine - coarse) / (std::pow(241.0 / 121.0, 2) - 1.0);
    const double found = frequencies<SpectralMesh>(beam, 0.37, 16)[mode];
    EXPECT_NEAR(found / limit, 1.0, 2e-6);
  }
}

TEST(SpectralMesh, RefusesWhatItCannotModel) {
  EXPECT_THROW(SpectralMesh(paper_beam(), 0.5, 8, Extent::whole), std::invalid_argument);
  EXPECT_THROW(SpectralMesh(shearing_beam(), 0.5, 1, Extent::whole), std::invalid_argument);
  EXPECT_THROW(SpectralMesh(shearing_beam(), 0.5, 7, Extent::half), std::invalid_argument);
  EXPECT_THROW(SpectralMesh(shearing_beam(), 0.4, 8, Extent::half), std::invalid_argument);
}

}  // namespace
}  // namespace subimpact
