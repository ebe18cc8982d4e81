#include "model/cell_mesh.h"

#include "dense.h"
#include "mesh_contract.h"
#include "numerics/mass_solver.h"
#include "paper_scene.h"
#include "random_walk.h"
#include "testing.h"

namespace subimpact {
namespace {

using Extent = CellMesh::Extent;
using Spacing = CellMesh::Spacing;

Beam beam_of(BeamTheory theory) {
  Beam beam = paper_beam();
  beam.theory = theory;
  return beam;
}

// Meshes of every shape: whole and half, few and many cells, strikes on and between centres and at
// the ends.
std::vector<CellMesh> meshes() {
  std::vector<CellMesh> all;
  for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
    const Beam beam = beam_of(theory);
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
  for (const EndSupport first : {EndSupport::free, EndSupport::pinned, EndSupport::clamped}) {
    for (const EndSupport second : {EndSupport::free, EndSupport::pinned, EndSupport::clamped}) {
      Beam beam = paper_beam();
      beam.ends = {first, second};
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

TEST(CellMesh, BendingHasNoNetMoment) {
  for (const CellMesh& mesh : meshes()) {
    if (mesh.symmetric()) continue;  // the mirrored half's moment cancels this half's
    const std::vector<double> moments = random_numbers(4, mesh.n_sections());
    std::vector<double> forces(mesh.n_unknowns());
    mesh.bending_forces(moments, forces);
    double net_moment = 0.0, force_size = 0.0;
    for (std::size_t i = 0; i < forces.size(); ++i) {
      net_moment += forces[i] * static_cast<double>(i);
      force_size += std::abs(forces[i]);
    }
    EXPECT_NEAR(net_moment, 0.0, 1e-14 * force_size * static_cast<double>(forces.size()));
  }
}

TEST(CellMesh, RigidMotionsDoNotBend) {
  for (const CellMesh& mesh : meshes()) {
    std::vector<double> motion(mesh.n_unknowns());
    for (std::size_t i = 0; i < motion.size(); ++i) {
      motion[i] = 3.0 + (mesh.symmetric() ? 0.0 : 0.25 * static_cast<double>(i));
    }
    std::vector<double> curvatures(mesh.n_sections());
    mesh.curvatures(motion, curvatures);
    for (const double kappa : curvatures) EXPECT_EQ(kappa, 0.0) << mesh.description();
  }
}

TEST(CellMesh, ParabolaHasItsCurvatureInEverySection) {
  const Beam beam = paper_beam();
  for (const Extent extent : {Extent::whole, Extent::half}) {
    const CellMesh mesh(beam, 0.5, 41, extent);
    const double dx = beam.length / 41;
    std::vector<double> w(mesh.n_unknowns()), curvatures(mesh.n_sections());
    for (std::size_t i = 0; i < w.size(); ++i) {
      const double x = (static_cast<double>(i) + 0.5) * dx - 0.5 * beam.length;
      w[i] = 0.35 * x * x;
    }
    mesh.curvatures(w, curvatures);
    for (const double kappa : curvatures) EXPECT_NEAR(kappa, 0.7, 1e-11);
  }
}

TEST(CellMesh, HasTheBeamsMassAndTheRotaryInertiaOfAnInnerRotationOrOfAWholeOne) {
  for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
    const Beam beam = beam_of(theory);
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
    std::vector<double> kappa(cells.n_sections()), expected(cells.n_sections());
    points.curvatures(w, kappa);
    cells.curvatures(w, expected);
    for (std::size_t i = 0; i < kappa.size(); ++i) {
      EXPECT_NEAR(kappa[i], expected[i], 1e-12 * std::abs(expected[i]));
      EXPECT_NEAR(points.section_weights()[i], cells.section_weights()[i], 1e-16);
    }
    std::vector<double> forces(w.size()), expected_forces(w.size());
    points.bending_forces(expected, forces);
    cells.bending_forces(expected, expected_forces);
    for (std::size_t i = 0; i < w.size(); ++i) {
      EXPECT_NEAR(forces[i], expected_forces[i], 1e-12 * std::abs(expected_forces[i]));
    }
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
      const Beam beam = beam_of(theory);
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

      std::vector<double> kappa(half.n_sections()), both_kappa(whole.n_sections());
      half.curvatures(w, kappa);
      whole.curvatures(both, both_kappa);
      double energy = 0.0, both_energy = 0.0;
      for (std::size_t i = 0; i < kappa.size(); ++i) {
        EXPECT_NEAR(kappa[i], both_kappa[i], 1e-12 * std::abs(kappa[i]));
        energy += half.section_weights()[i] * kappa[i] * kappa[i];
      }
      for (std::size_t i = 0; i < both_kappa.size(); ++i) {
        both_energy += whole.section_weights()[i] * both_kappa[i] * both_kappa[i];
      }
      EXPECT_NEAR(energy, both_energy, 1e-12 * energy);

      std::vector<double> forces(w.size()), both_forces(n);
      half.bending_forces(kappa, forces);
      whole.bending_forces(both_kappa, both_forces);
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
  beam.ends = {EndSupport::pinned, EndSupport::pinned};
  const CellMesh pinned(beam, 0.5, n, Extent::whole);
  std::vector<double> w(pinned.n_unknowns());
  std::vector<double> curvatures(pinned.n_sections());
  const double wave = 3.0 * M_PI / beam.length;
  for (std::size_t i = 0; i < w.size(); ++i) {
    w[i] = std::sin(wave * (static_cast<double>(i) + 0.5) * dx);
  }
  pinned.curvatures(w, curvatures);
  const double factor = -4.0 * std::pow(std::sin(0.5 * wave * dx) / dx, 2);
  for (std::size_t i = 0; i < w.size(); ++i) EXPECT_NEAR(curvatures[i], factor * w[i], 1e-9);

  beam.ends = {EndSupport::clamped, EndSupport::free};
  const CellMesh clamped(beam, 0.5, n, Extent::whole);
  w.resize(clamped.n_unknowns());
  curvatures.resize(clamped.n_sections());
  for (std::size_t i = 0; i < w.size(); ++i) {
    w[i] = 0.35 * std::pow((static_cast<double>(i) + 1.5) * dx, 2);
  }
  clamped.curvatures(w, curvatures);
  for (const double kappa : curvatures) EXPECT_NEAR(kappa, 0.7, 1e-11);
  EXPECT_EQ(clamped.first_end()(w), 0.0);
  EXPECT_TRUE(clamped.translation().empty());
}

TEST(CellMesh, StrikesTheCellBesideAClampAsIfItWereAnUnknown) {
  Beam beam = paper_beam();
  beam.ends = {EndSupport::clamped, EndSupport::clamped};
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
  Beam clamped = paper_beam();
  clamped.ends = {EndSupport::clamped, EndSupport::pinned};
  EXPECT_THROW(CellMesh(clamped, 0.5, 6, Extent::whole), std::invalid_argument);
  EXPECT_THROW(CellMesh(clamped, 0.5, 7, Extent::half), std::invalid_argument);
  EXPECT_NO_THROW(CellMesh(clamped, 0.5, 7, Extent::whole));
  EXPECT_THROW(CellMesh(clamped, 0.5, 7, Extent::whole, Spacing::points), std::invalid_argument);
}

TEST(BandedSolver, SolvesTheMassMatricesOfBeams) {
  Beam slender = paper_beam();
  slender.theory = BeamTheory::euler_bernoulli;
  for (const Beam& beam : {paper_beam(), slender}) {
    for (const std::size_t n : {5u, 17u, 251u, 501u, 2001u}) {
      for (const auto extent : {CellMesh::Extent::whole, CellMesh::Extent::half}) {
        const CellMesh mesh(beam, 0.5, n, extent);
        const BandedSolver solver(mesh.mass());
        const std::vector<double> expected = random_numbers(9, mesh.n_unknowns());
        std::vector<double> x(mesh.n_unknowns());
        mesh.mass().multiply(expected, x);
        solver.solve(x);
        // The rotary inertia of small cells makes the matrix stiff: up to 1 + 4 r^2/dx^2.
        EXPECT_LE(relative_difference(x, expected), 1e-12) << mesh.description();
      }
    }
  }
}

}  // namespace
}  // namespace subimpact
