// A point impulse on a Rayleigh beam at rest: the velocities an instant later are Mass^-1 S I0.

#include "mesh/mesh_contract.h"
#include "model/mesh/cell_mesh.h"
#include "numerics/mass_solver.h"

namespace subimpact {
namespace {

std::vector<double> velocities_after(double impulse, const CellMesh& mesh) {
  std::vector<double> v(mesh.n_unknowns(), 0.0);
  mesh.struck_point().add_to(v, impulse);
  BandedSolver(mesh.mass()).solve(v);
  return v;
}

double effective_mass(const CellMesh& mesh) {
  return 1.0 / mesh.struck_point()(velocities_after(1.0, mesh));
}

TEST(PointImpulse, MeetsTheEffectiveContactMassOfTheInfiniteGrid) {
  const Beam beam = paper_beam();
  const double dx = beam.length / 501;
  const double r = beam.radius_of_gyration();
  const double infinite = beam.mass_per_length() * dx * std::sqrt(1.0 + 4.0 * r * r / (dx * dx));
  for (const auto extent : {CellMesh::Extent::whole, CellMesh::Extent::half}) {
    const double found = effective_mass(CellMesh(beam, 0.5, 501, extent));
    EXPECT_NEAR(found, infinite, 1e-13 * infinite);
    EXPECT_NEAR(found, 1.44840e-3, 0.5e-8);
  }
}

TEST(PointImpulse, MovesTheGridByAGeometricSeries) {
  const Beam beam = paper_beam();
  const CellMesh mesh(beam, 0.5, 501, CellMesh::Extent::whole);
  const double dx = beam.length / 501;
  const double r = beam.radius_of_gyration();
  // The decaying root of q + 1/q = 2 + dx^2/r^2.
  const double half = 1.0 + 0.5 * dx * dx / (r * r);
  const double q = half - std::sqrt(half * half - 1.0);
  const std::vector<double> v = velocities_after(3.0, mesh);
  const double middle = v[250];
  for (std::size_t i = 0; i < 501; ++i) {
    const double distance = std::abs(static_cast<double>(i) - 250.0);
    EXPECT_NEAR(v[i], middle * std::pow(q, distance), 1e-13 * middle) << i;
  }
}

TEST(PointImpulse, ApproachesTheExponentialOfTheContinuumAtSecondOrder) {
  const Beam beam = paper_beam();
  const double r = beam.radius_of_gyration(), rho_a = beam.mass_per_length();
  EXPECT_NEAR(2.0 * rho_a * r, 1.37633e-3, 0.5e-8);
  const double impulse = 0.7;
  const double peak = impulse / (2.0 * rho_a * r);
  OrderTable masses("effective contact mass over cells, relative error");
  OrderTable shapes("velocity after a point impulse over cells, error over peak");
  for (const std::size_t n : {2001u, 4001u, 8001u, 16001u}) {
    const CellMesh mesh(beam, 0.5, n, CellMesh::Extent::half);
    const std::vector<double> v = velocities_after(impulse, mesh);
    const double dx = beam.length / static_cast<double>(n);
    double largest = 0.0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const double distance = static_cast<double>(v.size() - 1 - i) * dx;
      largest = std::max(largest, std::abs(v[i] - peak * std::exp(-distance / r)));
    }
    masses.add(static_cast<double>(n), effective_mass(mesh) / (2.0 * rho_a * r) - 1.0);
    shapes.add(static_cast<double>(n), largest / peak);
  }
  masses.expect_every_order_within(1.9, 2.1);
  shapes.expect_every_order_within(1.9, 2.1);
}

TEST(PointImpulse, GivesTheBeamTheWholeImpulse) {
  const Beam beam = paper_beam();
  for (const double position : {0.1, 0.31, 0.5}) {
    const CellMesh mesh(beam, position, 60, CellMesh::Extent::whole);
    const std::vector<double> v = velocities_after(2.0, mesh);
    std::vector<double> momenta = times(mesh.mass(), v);
    double sum = 0.0;
    for (const double momentum : momenta) sum += momentum;
    EXPECT_NEAR(sum, 2.0, 1e-13);
  }
}

TEST(PointImpulse, MeetsOneCellAloneOnAnEulerBernoulliBeam) {
  const Beam beam = paper_beam(BeamTheory::euler_bernoulli);
  for (const std::size_t n : {51u, 501u}) {
    const CellMesh mesh(beam, 0.5, n, CellMesh::Extent::whole);
    EXPECT_NEAR(effective_mass(mesh), beam.mass() / static_cast<double>(n), 1e-15);
  }
}

}  // namespace
}  // namespace subimpact
