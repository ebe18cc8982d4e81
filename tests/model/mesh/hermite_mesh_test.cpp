#include "model/mesh/hermite/hermite_mesh.h"

#include "mesh/mesh_contract.h"

namespace subimpact {
namespace {

using Extent = HermiteMesh::Extent;

// The displacement of the struck point under unit force there, of an elastic beam.
double compliance(const HermiteMesh& mesh, double bending_stiffness) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(index(mesh.n_unknowns()));
  mesh.struck_point().add_to(entries(load), 1.0);
  const Eigen::VectorXd answer = solution(stiffness_matrix(mesh, bending_stiffness), load);
  return mesh.struck_point()(entries(answer));
}

// Moments are linear between force and supports: a patch test of forces.
TEST(HermiteMesh, DeflectsUnderAPointForceAsABeam) {
  Beam beam = paper_beam();
  const double stiffness = beam.bending_stiffness(), l = beam.length;
  const double a = 0.3 * l;
  const double b = 0.7 * l;
  struct Expected {
    EndSupport first, second;
    double compliance;
  };
  const Expected table[] = {
      {clamped, free_end, a * a * a / 3.0},
      {pinned, pinned, a * a * b * b / (3.0 * l)},
      {clamped, clamped, a * a * a * b * b * b / (3.0 * l * l * l)},
      {clamped, pinned, a * a * a * b * b * (3.0 * l + b) / (12.0 * l * l * l)},
  };
  for (const Expected& expected : table) {
    beam.ends = {expected.first, expected.second};
    for (const std::size_t n : {4u, 5u, 20u}) {
      const HermiteMesh mesh(beam, 0.3, n, Extent::whole);
      EXPECT_NEAR(compliance(mesh, stiffness) * stiffness, expected.compliance,
                  1e-9 * expected.compliance)
          << mesh.description() << ", ends " << static_cast<int>(expected.first)
          << static_cast<int>(expected.second);
    }
  }
  beam.ends = {clamped, clamped};
  const HermiteMesh half(beam, 0.5, 12, Extent::half);
  EXPECT_NEAR(compliance(half, stiffness) * stiffness, l * l * l / 192.0, 1e-9 * l * l * l);
}

TEST(HermiteMesh, RefusesShapesItCannotModel) {
  const Beam beam = paper_beam();
  EXPECT_THROW(HermiteMesh(beam, 0.5, 3, Extent::whole), std::invalid_argument);
  EXPECT_THROW(HermiteMesh(beam, 0.5, 9, Extent::half), std::invalid_argument);
  EXPECT_THROW(HermiteMesh(beam, 0.4, 8, Extent::half), std::invalid_argument);
  const Beam on_pin = paper_beam(BeamTheory::rayleigh, {pinned, free_end});
  EXPECT_THROW(HermiteMesh(on_pin, 0.5, 8, Extent::half), std::invalid_argument);
  EXPECT_THROW(HermiteMesh(on_pin, 0.0, 8, Extent::whole), std::invalid_argument);
  EXPECT_NO_THROW(HermiteMesh(on_pin, 1.0, 8, Extent::whole));
}

}  // namespace
}  // namespace subimpact
