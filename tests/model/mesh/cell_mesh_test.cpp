#include "model/mesh/cell_mesh.h"
#include "mesh/mesh_contract.h"
#include "numerics/mass_solver.h"
#include "subimpact/model/mesh/matrix_mesh.h"

namespace subimpact {
namespace {

using Extent = CellMesh::Extent;
using Spacing = CellMesh::Spacing;

// Meshes of every shape: whole and half, few and many cells, strikes on and between centres and at
// the ends.
std::vector<CellMesh> meshes() {
  std::vector<CellMesh> all;
  for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
    const Beam beam = paper_beam(theory);
    for (const std::size_t n : {5u, 7u, 11u, 101u}) {
      all.emplace_back(beam, 0.5, n, Extent::whole);
      all.emplace_back(beam, 0.5, n, Extent::half);
      all.emplace_back(beam, 0.31, n, Extent::whole);
      all.emplace_back(beam, 0.31, n, Extent::whole, Spacing::points);
      all.emplace_back(beam, 0.5, n, Extent::half, Spacing::points);
    }
    for (const double position : {0.0, 0.013, 0.5, 0.77, 1.0}) {
      all.emplace_back(beam, position, 20, Extent::whole);
    }
  }
  return all;
}

// The same on supports.
std::vector<CellMesh> supported_meshes() {
  std::vector<CellMesh> all;
  for (const EndSupport first : all_ends) {
    for (const EndSupport second : all_ends) {
      const Beam beam = paper_beam(BeamTheory::rayleigh, {first, second});
      if (beam.is_free()) continue;
      for (const std::size_t n : {7u, 8u, 31u}) {
        for (const double position : {0.1, 0.5, 0.77}) {
          all.emplace_back(beam, position, n, Extent::whole);
        }
        if (first == second && n % 2 == 1) all.emplace_back(beam, 0.5, n, Extent::half);
      }
    }
  }
  return all;
}

std::vector<CellMesh> all_meshes() {
  std::vector<CellMesh> all = meshes();
  for (CellMesh& mesh : supported_meshes()) all.push_back(std::move(mesh));
  return all;
}

TEST(CellMesh, KeepsTheContractOfMeshes) {
  for (const CellMesh& mesh : all_meshes()) expect_mesh_contract(mesh, 1e-14);
}

TEST(CellMesh, RigidMotionsDoNotBend) {
  for (const CellMesh& mesh : meshes()) {
    std::vector<double> motion(mesh.n_unknowns());
    for (std::size_t i = 0; i < motion.size(); ++i) {
      motion[i] = 3.0 + (mesh.symmetric() ? 0.0 : 0.25 * static_cast<double>(i));
    }
    const std::vector<double> curvatures = curvatures_of(mesh, motion);
    for (const double kappa : curvatures) EXPECT_EQ(kappa, 0.0) << mesh.description();
  }
}

TEST(CellMesh, ParabolaHasItsCurvatureInEverySection) {
  const Beam beam = paper_beam();
  for (const Extent extent : {Extent::whole, Extent::half}) {
    const CellMesh mesh(beam, 0.5, 41, extent);
    const double dx = beam.length / 41;
    std::vector<double> w(mesh.n_unknowns());
    for (std::size_t i = 0; i < w.size(); ++i) {
      const double x = (static_cast<double>(i) + 0.5) * dx - 0.5 * beam.length;
      w[i] = 0.35 * x * x;
    }
    for (const double kappa : curvatures_of(mesh, w)) EXPECT_NEAR(kappa, 0.7, 1e-11);
  }
}

TEST(CellMesh, HasTheBeamsMassAndTheRotaryInertiaOfAnInnerRotationOrOfAWholeOne) {
  for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
    const Beam beam = paper_beam(theory);
    const CellMesh half(beam, 0.5, 41, Extent::half);
    EXPECT_NEAR(half.mass().quadratic_form(half.translation()), beam.mass(), 1e-13 * beam.mass());
    const CellMesh mesh(beam, 0.5, 200, Extent::whole);
    EXPECT_NEAR(mesh.mass().quadratic_form(mesh.translation()), beam.mass(), 1e-13 * beam.mass());
    std::vector<double> rotation(200);
    const double dx = beam.length / 200;
    for (std::size_t i = 0; i < 200; ++i) {
      rotation[i] = (static_cast<double>(i) + 0.5) * dx - 0.5 * beam.length;
    }
    // Cells as points (n^2 - 1 of n^2 parts) and the rotation of the 199 links between them.
    const double points = beam.mass() * beam.length * beam.length / 12.0 * (1.0 - 1.0 / 40000.0);
    const double links = beam.rotary_inertia() * dx * 199.0;
    EXPECT_NEAR(mesh.mass().quadratic_form(rotation), points + links, 1e-12 * points);
    EXPECT_EQ(links > 0.0, theory == BeamTheory::rayleigh);
    const CellMesh whole(beam, 0.5, 200, Extent::whole, CellMesh::Spacing::whole);
    const double all = points + beam.rotary_inertia() * beam.length;
    EXPECT_NEAR(whole.mass().quadratic_form(rotation), all, 1e-12 * points);
  }
}

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

TEST(CellMesh, HalfAndWholeModelAgreeOnSymmetricFields) {
  for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
    for (const std::size_t n : {5u, 7u, 51u}) {
      const Beam beam = paper_beam(theory);
      const auto spacing = n == 7 ? CellMesh::Spacing::whole : CellMesh::Spacing::cells;
      const CellMesh whole(beam, 0.5, n, Extent::whole, spacing);
      const CellMesh half(beam, 0.5, n, Extent::half, spacing);
      const std::vector<double> w = random_numbers(3, half.n_unknowns());
      std::vector<double> both(n);
      for (std::size_t i = 0; i < w.size(); ++i) both[i] = both[n - 1 - i] = w[i];

      EXPECT_NEAR(half.mass().quadratic_form(w), whole.mass().quadratic_form(both), 1e-13);
      EXPECT_EQ(half.struck_point()(w), whole.struck_point()(both));
      EXPECT_EQ(half.first_end()(w), whole.first_end()(both));
      EXPECT_DOUBLE_EQ(half.section_positions()[half.struck_section()],
                       whole.section_positions()[whole.struck_section()]);

      const std::vector<double> kappa = curvatures_of(half, w);
      const std::vector<double> both_kappa = curvatures_of(whole, both);
      double energy = 0.0, both_energy = 0.0;
      for (std::size_t i = 0; i < kappa.size(); ++i) {
        EXPECT_NEAR(kappa[i], both_kappa[i], 1e-12 * std::abs(kappa[i]));
        energy += half.section_weights()[i] * kappa[i] * kappa[i];
      }
      for (std::size_t i = 0; i < both_kappa.size(); ++i) {
        both_energy += whole.section_weights()[i] * both_kappa[i] * both_kappa[i];
      }
      EXPECT_NEAR(energy, both_energy, 1e-12 * energy);

      const std::vector<double> forces = bending_forces_of(half, kappa);
      const std::vector<double> both_forces = bending_forces_of(whole, both_kappa);
      for (std::size_t i = 0; i < w.size(); ++i) {
        const double folded =
            i + 1 < w.size() ? both_forces[i] + both_forces[n - 1 - i] : both_forces[i];
        EXPECT_NEAR(forces[i], folded, 1e-10 * std::abs(both_forces[0])) << i;
      }
    }
  }
}

TEST(CellMesh, StrikeArrivesWhereItIsAimed) {
  const Beam beam = paper_beam();
  for (const double position : {0.03, 0.31, 0.5, 0.77, 0.97}) {
    const CellMesh mesh(beam, position, 20, Extent::whole);
    std::vector<double> x(20);
    for (std::size_t i = 0; i < 20; ++i) x[i] = (static_cast<double>(i) + 0.5) * beam.length / 20;
    EXPECT_NEAR(mesh.struck_point()(x), position * beam.length, 1e-14);
    EXPECT_NEAR(mesh.section_positions()[mesh.struck_section()], position * beam.length,
                1.001 * beam.length / 20);
  }
}

TEST(CellMesh, FirstEndIsTheEndAndNotTheFirstCentre) {
  const Beam beam = paper_beam();
  const CellMesh mesh(beam, 0.5, 20, Extent::whole);
  std::vector<double> w(20);
  for (std::size_t i = 0; i < 20; ++i) w[i] = 2.0 + 3.0 * (static_cast<double>(i) + 0.5);
  EXPECT_NEAR(mesh.first_end()(w), 2.0, 1e-14);
}

// What the ends allow: a sine between pins, a parabola out of a clamp.
TEST(CellMesh, OnSupportsKeepsTheShapesTheyAreMadeFor) {
  Beam beam = paper_beam();
  const std::size_t n = 40;
  const double dx = beam.length / static_cast<double>(n);
  beam.ends = {pinned, pinned};
  const CellMesh on_pins(beam, 0.5, n, Extent::whole);
  std::vector<double> w(on_pins.n_unknowns());
  const double wave = 3.0 * M_PI / beam.length;
  std::vector<double> expected(w.size());
  for (std::size_t i = 0; i < w.size(); ++i) {
    w[i] = std::sin(wave * (static_cast<double>(i) + 0.5) * dx);
    expected[i] = -4.0 * std::pow(std::sin(0.5 * wave * dx) / dx, 2) * w[i];
  }
  expect_near(curvatures_of(on_pins, w), expected, 1e-9);

  beam.ends = {clamped, free_end};
  const CellMesh cantilever(beam, 0.5, n, Extent::whole);
  w.resize(cantilever.n_unknowns());
  for (std::size_t i = 0; i < w.size(); ++i) {
    w[i] = 0.35 * std::pow((static_cast<double>(i) + 1.5) * dx, 2);
  }
  for (const double kappa : curvatures_of(cantilever, w)) EXPECT_NEAR(kappa, 0.7, 1e-11);
  EXPECT_EQ(cantilever.first_end()(w), 0.0);
  EXPECT_TRUE(cantilever.translation().empty());
}

TEST(CellMesh, StrikesTheCellBesideAClampAsIfItWereAnUnknown) {
  const Beam beam = paper_beam(BeamTheory::rayleigh, {clamped, clamped});
  for (const double position : {0.5 / 20, 1.0 / 20, 19.5 / 20}) {
    const CellMesh mesh(beam, position, 20, Extent::whole);
    std::vector<double> w(mesh.n_unknowns(), 9.0);
    const double cells = position * 20.0 < 10.0 ? position * 20.0 : 20.0 - position * 20.0;
    EXPECT_NEAR(mesh.struck_point()(w), 1.0 + 8.0 * (cells - 0.5), 1e-12);
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

TEST(BandedSolver, SolvesTheMassMatricesOfBeams) {
  for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
    for (const std::size_t n : {5u, 17u, 251u, 501u, 2001u}) {
      for (const Extent extent : {Extent::whole, Extent::half}) {
        const CellMesh mesh(paper_beam(theory), 0.5, n, extent);
        const BandedSolver solver(mesh.mass());
        const std::vector<double> expected = random_numbers(9, mesh.n_unknowns());
        std::vector<double> x = times(mesh.mass(), expected);
        solver.solve(x);
        // The rotary inertia of small cells makes the matrix stiff: up to 1 + 4 r^2/dx^2.
        EXPECT_LE(relative_difference(x, expected), 1e-12) << mesh.description();
      }
    }
  }
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

}  // namespace
}  // namespace subimpact
