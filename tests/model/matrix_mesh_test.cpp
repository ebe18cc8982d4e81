#include "subimpact/model/matrix_mesh.h"

#include "model/cell_mesh.h"
#include "paper_scene.h"
#include "testing.h"

namespace subimpact {
namespace {

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
  const std::size_t n = cells.n_unknowns(), n_sections = cells.n_sections();
  std::vector<double> w(n), kappa(n_sections), same(n_sections), forces(n), same_forces(n);
  for (std::size_t i = 0; i < n; ++i) w[i] = std::sin(0.7 * static_cast<double>(i * i));
  cells.curvatures(w, kappa);
  mesh->curvatures(w, same);
  cells.bending_forces(kappa, forces);
  mesh->bending_forces(kappa, same_forces);
  for (std::size_t i = 0; i < n_sections; ++i) {
    EXPECT_NEAR(same[i], kappa[i], 1e-9 * std::abs(kappa[i]) + 1e-6);
  }
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(same_forces[i], forces[i], 1e-9 * std::abs(forces[i]) + 1.0);
  }
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(mesh->momentum_functional()[i], cells.momentum_functional()[i], 1e-12);
  }
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
