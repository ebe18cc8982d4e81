#include "model/mesh/cell_mesh.h"
#include "mesh/mesh_contract.h"
#include "subimpact/model/mesh/matrix_mesh.h"

namespace subimpact {
namespace {

using Extent = CellMesh::Extent;
using Spacing = CellMesh::Spacing;

TEST(CellsAboutPoints, HaveTheEquationsOfABeamLongerByASpacing) {
  for (const Extent extent : {Extent::whole, Extent::half}) {
    const std::size_t n = 41;
    const Beam beam = paper_beam();
    Beam longer = beam;
    longer.length *= 41.0 / 40.0;
    const CellMesh points(beam, 0.5, n, extent, Spacing::points);
    const CellMesh cells(longer, 0.5, n, extent);
    const std::vector<double> w = random_numbers(5, cells.n_unknowns());
    ASSERT_EQ(points.n_unknowns(), cells.n_unknowns());
    EXPECT_NEAR(points.beam_mass(), longer.mass(), 1e-15);
    EXPECT_NEAR(points.mass().quadratic_form(w), cells.mass().quadratic_form(w), 1e-14);
    EXPECT_EQ(points.struck_point()(w), cells.struck_point()(w));
    EXPECT_NEAR(points.highest_frequency(1.0), cells.highest_frequency(1.0), 1e-9);
    const std::vector<double> kappa = curvatures_of(cells, w);
    expect_near(curvatures_of(points, w), kappa, 0.0, 1e-12);
    expect_near(points.section_weights(), cells.section_weights(), 1e-16);
    expect_near(bending_forces_of(points, kappa), bending_forces_of(cells, kappa), 0.0, 1e-12);
  }
}

TEST(CellsAboutPoints, LieFromEndToEnd) {
  const Beam beam = paper_beam();
  for (const double position : {0.0, 0.31, 0.5, 1.0}) {
    const CellMesh mesh(beam, position, 21, Extent::whole, Spacing::points);
    std::vector<double> x(21);
    for (std::size_t i = 0; i < 21; ++i) x[i] = static_cast<double>(i) * beam.length / 20.0;
    EXPECT_NEAR(mesh.struck_point()(x), position * beam.length, 1e-14);
    EXPECT_EQ(mesh.first_end()(x), 0.0);
    EXPECT_NEAR(mesh.section_positions().front(), x[1], 1e-15);
    EXPECT_NEAR(mesh.section_positions().back(), x[19], 1e-15);
  }
  const CellMesh half(beam, 0.5, 21, Extent::half, Spacing::points);
  EXPECT_NEAR(half.section_positions()[half.struck_section()], 0.5 * beam.length, 1e-15);
}

TEST(CellMesh, HasTheStruckPointWhereItIsAimedAndTheFirstEndBeforeTheFirstCentre) {
  const Beam beam = paper_beam();
  for (const double position : {0.03, 0.31, 0.5, 0.77, 0.97}) {
    const CellMesh mesh(beam, position, 20, Extent::whole);
    std::vector<double> x(20);
    for (std::size_t i = 0; i < 20; ++i) x[i] = (static_cast<double>(i) + 0.5) * beam.length / 20;
    EXPECT_NEAR(mesh.struck_point()(x), position * beam.length, 1e-14);
    EXPECT_NEAR(mesh.section_positions()[mesh.struck_section()], position * beam.length,
                1.001 * beam.length / 20);
    EXPECT_NEAR(mesh.first_end()(x), 0.0, 1e-15);
  }
}

TEST(CellMesh, RefusesShapesItCannotModel) {
  const Beam beam = paper_beam();
  EXPECT_THROW(CellMesh(beam, 0.5, 4, Extent::whole), std::invalid_argument);
  EXPECT_THROW(CellMesh(beam, 0.5, 50, Extent::half), std::invalid_argument);
  EXPECT_THROW(CellMesh(beam, 0.4, 51, Extent::half), std::invalid_argument);
  EXPECT_NO_THROW(CellMesh(beam, 0.4, 50, Extent::whole));
  const Beam held = paper_beam(BeamTheory::rayleigh, {clamped, pinned});
  EXPECT_THROW(CellMesh(held, 0.5, 6, Extent::whole), std::invalid_argument);
  EXPECT_THROW(CellMesh(held, 0.5, 7, Extent::half), std::invalid_argument);
  EXPECT_NO_THROW(CellMesh(held, 0.5, 7, Extent::whole));
  EXPECT_THROW(CellMesh(held, 0.5, 7, Extent::whole, Spacing::points), std::invalid_argument);
}

MeshMatrices matrices_of(const BeamMesh& mesh) {
  MeshMatrices matrices{.mass = mesh.mass()};
  for (std::size_t i = 0; i < mesh.n_sections(); ++i) {
    const auto [first, row] = mesh.section_stencil(i);
    matrices.curvature.push_back({first, {row.begin(), row.end()}});
    matrices.weights.push_back(mesh.section_weights()[i]);
    matrices.positions.push_back(mesh.section_positions()[i]);
  }
  matrices.struck_point = mesh.struck_point();
  matrices.first_end = mesh.first_end();
  matrices.translation.assign(mesh.translation().begin(), mesh.translation().end());
  return matrices;
}

TEST(AMeshOfTheMatricesOfCells, IsThatMesh) {
  const CellMesh cells(paper_scene().beam, 0.5, 61, CellMesh::Extent::whole,
                       CellMesh::Spacing::cells);
  const auto mesh = mesh_of(matrices_of(cells));
  EXPECT_EQ(mesh->struck_section(), cells.struck_section());
  EXPECT_NEAR(mesh->beam_mass(), cells.beam_mass(), 1e-12);
  std::vector<double> w(cells.n_unknowns());
  for (std::size_t i = 0; i < w.size(); ++i) w[i] = std::sin(0.7 * static_cast<double>(i * i));
  const std::vector<double> kappa = curvatures_of(cells, w);
  expect_near(curvatures_of(*mesh, w), kappa, 1e-6, 1e-9);
  expect_near(bending_forces_of(*mesh, kappa), bending_forces_of(cells, kappa), 1.0, 1e-9);
  expect_near(mesh->momentum_functional(), cells.momentum_functional(), 1e-12);
}

TEST(AMeshOfMatrices, BoundsItsHighestFrequencyClosely) {
  const CellMesh cells(paper_scene().beam, 0.5, 41, CellMesh::Extent::whole,
                       CellMesh::Spacing::cells);
  const auto mesh = mesh_of(matrices_of(cells));
  const double bound = mesh->highest_frequency(40.0);
  const double highest = dense_natural_modes(*mesh, 40.0).frequencies.back();
  EXPECT_GT(bound, highest);
  EXPECT_LT(bound, 1.002 * highest);
}

TEST(AMeshOfMatrices, IsRefusedWhereTheyDoNotGoTogether) {
  const CellMesh cells(paper_scene().beam, 0.5, 41, CellMesh::Extent::whole,
                       CellMesh::Spacing::cells);
  const MeshMatrices right = matrices_of(cells);
  MeshMatrices few_weights = right, long_row = right, no_mass = right;
  few_weights.weights.pop_back();
  long_row.curvature.back().first += 5;
  no_mass.mass.set_zero();
  for (const MeshMatrices& wrong : {few_weights, long_row, no_mass}) {
    EXPECT_THROW(mesh_of(wrong), std::invalid_argument);
  }
}

// A point impulse on a Rayleigh beam at rest: the velocities an instant later are Mass^-1 S I0.

std::vector<double> velocities_after(double impulse, const CellMesh& mesh) {
  std::vector<double> v(mesh.n_unknowns(), 0.0);
  mesh.struck_point().add_to(v, impulse);
  BandedSolver(mesh.mass()).solve(v);
  return v;
}

double effective_mass(const CellMesh& mesh) {
  return 1.0 / mesh.struck_point()(velocities_after(1.0, mesh));
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

}  // namespace
}  // namespace subimpact
