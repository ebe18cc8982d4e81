#include "integrate/sundials.h"

#include "banded_examples.h"
#include "model/mesh/cell_mesh.h"
#include "paper_scene.h"
#include "testing.h"

namespace subimpact {
namespace {

TEST(KluMassSolver, AgreesWithTheBandedSolver) {
  for (const std::size_t bandwidth : {0u, 1u, 2u, 3u}) {
    for (const std::size_t n : {1u, 2u, 7u, 8u, 60u, 501u}) {
      const BandedMatrix matrix = random_positive_definite(n, bandwidth, 11);
      std::vector<double> x = random_numbers(12, n);
      std::vector<double> expected = x;
      make_klu_mass_solver(matrix)->solve(x);
      BandedSolver(matrix).solve(expected);
      EXPECT_LE(relative_difference(x, expected), 1e-13) << n << " of bandwidth " << bandwidth;
    }
  }
}

TEST(KluMassSolver, AgreesWithTheBandedSolverOnThePapersMass) {
  for (const auto extent : {CellMesh::Extent::whole, CellMesh::Extent::half}) {
    const CellMesh mesh(paper_beam(), 0.5, 501, extent);
    std::vector<double> x = random_numbers(13, mesh.n_unknowns());
    std::vector<double> expected = x;
    make_klu_mass_solver(mesh.mass())->solve(x);
    BandedSolver(mesh.mass()).solve(expected);
    EXPECT_LE(relative_difference(x, expected), 1e-13);
  }
}

TEST(KluMassSolver, FactorsOnceForManySolutions) {
  const BandedMatrix matrix = random_positive_definite(30, 1, 2);
  const auto solver = make_klu_mass_solver(matrix);
  for (unsigned seed = 0; seed < 5; ++seed) {
    const std::vector<double> expected = random_numbers(seed, 30);
    std::vector<double> x(30);
    matrix.multiply(expected, x);
    solver->solve(x);
    EXPECT_LE(relative_difference(x, expected), 1e-13);
  }
}

TEST(KluMassSolver, RefusesASingularMatrix) {
  BandedMatrix singular = random_positive_definite(10, 0, 2);
  singular.at(4, 4) = 0.0;
  EXPECT_THROW(make_klu_mass_solver(singular), std::runtime_error);
}

}  // namespace
}  // namespace subimpact
