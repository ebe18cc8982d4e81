#include "model/mesh/shear/timoshenko_mesh.h"

#include "mesh/mesh_contract.h"
#include "model/mesh/shear/spectral_mesh.h"

namespace subimpact {
namespace {

using Extent = TimoshenkoMesh::Extent;

constexpr Ends pinned_ends = {pinned, pinned};
constexpr Ends clamped_ends = {clamped, clamped};

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
    const double coarse = frequencies(beam, 0.371, 121)[mode];
    const double fine = frequencies(beam, 0.371, 241)[mode];
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
