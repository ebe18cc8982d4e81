// What holds on meshes of every kind, shape, theory and end.

#include "mesh/mesh_contract.h"
#include "model/mesh/cell_mesh.h"
#include "model/mesh/hermite/hermite_mesh.h"
#include "model/mesh/shear/spectral_mesh.h"
#include "model/mesh/shear/timoshenko_mesh.h"

namespace subimpact {
namespace {

// A mesh, the beam that it is of, and the struck point and number of parts asked for.
using Check = std::function<void(const BeamMesh&, const Beam&, double, std::size_t)>;

// Whole and half; `odd`: a half model takes an odd number of parts, or else an even one.
template <class Mesh, class... Details>
void on_meshes(const Beam& beam, const std::vector<std::size_t>& sizes,
               const std::vector<double>& positions, bool odd, const Check& check,
               const Details&... details) {
  for (const std::size_t n : sizes) {
    for (const double position : positions) {
      check(Mesh(beam, position, n, Mesh::Extent::whole, details...), beam, position, n);
    }
    if (beam.ends[0] != beam.ends[1] || (n % 2 == 1) != odd) continue;
    check(Mesh(beam, 0.5, n, Mesh::Extent::half, details...), beam, 0.5, n);
  }
}

void on_every_mesh(const Check& check) {
  for (const EndSupport first : all_ends) {
    for (const EndSupport second : all_ends) {
      const Ends ends{first, second};
      for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
        const Beam beam = paper_beam(theory, ends);
        on_meshes<CellMesh>(beam, {7, 8, 31}, {0.1, 0.5, 0.77}, true, check);
        on_meshes<HermiteMesh>(beam, {4, 5, 12}, {0.2, 0.5, 0.77}, false, check);
      }
      const Beam shearing = shearing_beam(ends);
      on_meshes<TimoshenkoMesh>(shearing, {7, 8, 31}, {0.1, 0.5, 0.77}, true, check);
      on_meshes<SpectralMesh>(shearing, {2, 5, 12}, {0.27, 0.5, 0.71}, false, check);
    }
  }
  // Struck at free ends, between other nodes, and of every remainder of eight unknowns.
  const Beam beam = paper_beam();
  for (const auto spacing : {CellMesh::Spacing::points, CellMesh::Spacing::whole}) {
    on_meshes<CellMesh>(beam, {5, 11, 101}, {0.0, 0.013, 0.31, 1.0}, true, check, spacing);
  }
  on_meshes<HermiteMesh>(beam, {6}, {0.0, 1.0}, false, check);
  for (std::size_t n = 9; n < 24; ++n) {
    on_meshes<TimoshenkoMesh>(shearing_beam(), {n}, {0.13}, true, check);
  }
}

TEST(Meshes, KeepTheirContract) {
  on_every_mesh([](const BeamMesh& mesh, const Beam& beam, double position, std::size_t n) {
    expect_mesh_contract(mesh);
    const double part = beam.length / static_cast<double>(n);
    EXPECT_NEAR(mesh.section_positions()[mesh.struck_section()], position * beam.length,
                1.51 * part)
        << mesh.description();
  });
}

TEST(Meshes, BoundTheirHighestFrequencyCloselyAndHaveTheRigidModesOfTheirEnds) {
  on_every_mesh([](const BeamMesh& mesh, const Beam& beam, double, std::size_t) {
    SCOPED_TRACE(mesh.description());
    const double stiffness = beam.bending_stiffness();
    const Eigen::VectorXd squares = squared_frequencies(mesh, stiffness);
    const double highest = squares(squares.size() - 1);
    const double bound = std::pow(mesh.highest_frequency(stiffness), 2);
    EXPECT_GE(bound, highest * (1.0 - 1e-12));
    EXPECT_LE(bound, highest * 1.5);
    EXPECT_GT(squares(0), -1e-11 * highest);
    const auto n_rigid = static_cast<std::size_t>((squares.array() < 1e-11 * highest).count());
    EXPECT_EQ(n_rigid, mesh.symmetric() && beam.is_free() ? 1 : n_rigid_modes(beam));
  });
}

// Of long half models, where the critical step of a run comes from.
TEST(Meshes, OfManyPartsBoundTheirHighestFrequencyToAThousandth) {
  for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
    const Beam beam = paper_beam(theory);
    const double stiffness = beam.bending_stiffness();
    const CellMesh cells(beam, 0.5, 151, CellMesh::Extent::whole);
    EXPECT_LE(cells.highest_frequency(stiffness), 1.001 * highest_of(cells, stiffness));
    const HermiteMesh elements(beam, 0.5, 200, HermiteMesh::Extent::half);
    EXPECT_LE(elements.highest_frequency(stiffness),
              (1.0 + 1e-5) * highest_of(elements, stiffness));
  }
}

// Displacements of struck point and first end under (K + s Mass) x = S.
std::array<double, 2> response(const BeamMesh& mesh, double stiffness, double s) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(index(mesh.n_unknowns()));
  mesh.struck_point().add_to(entries(load), 1.0);
  const Eigen::VectorXd x =
      solution(stiffness_matrix(mesh, stiffness) + s * dense(mesh.mass()), load);
  return {mesh.struck_point()(entries(x)), mesh.first_end()(entries(x))};
}

template <class Mesh, class... Details>
void expect_half_answers_as_whole(Beam beam, std::size_t n, const Details&... details) {
  for (const EndSupport end : all_ends) {
    beam.ends = {end, end};
    const Mesh half(beam, 0.5, n, Mesh::Extent::half, details...);
    const Mesh whole(beam, 0.5, n, Mesh::Extent::whole, details...);
    SCOPED_TRACE(half.description());
    EXPECT_NEAR(half.section_positions()[half.struck_section()],
                whole.section_positions()[whole.struck_section()], 1e-12);
    for (const double s : {1e4, 1e8, 1e12}) {
      const double stiffness = beam.bending_stiffness();
      const auto found = response(half, stiffness, s), expected = response(whole, stiffness, s);
      expect_near(found, expected, 1e-9 * std::abs(expected[0]));
    }
  }
}

TEST(HalfMeshes, AnswerAForceAtTheirMiddleAsWholeOnesDo) {
  for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
    expect_half_answers_as_whole<CellMesh>(paper_beam(theory), 41);
    expect_half_answers_as_whole<HermiteMesh>(paper_beam(theory), 8);
  }
  expect_half_answers_as_whole<TimoshenkoMesh>(shearing_beam(), 41);
  expect_half_answers_as_whole<SpectralMesh>(shearing_beam(), 8);
}

}  // namespace
}  // namespace subimpact
