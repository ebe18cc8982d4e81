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

// Moments are linear between force and supports: a patch test of forces and hinges.
TEST(HermiteMesh, DeflectsUnderAPointForceAsABeamWithHingesOrWithout) {
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
    for (const bool hinges : {false, true}) {
      for (const std::size_t n : {4u, 5u, 20u}) {
        const HermiteMesh mesh(beam, 0.3, n, Extent::whole, hinges);
        EXPECT_NEAR(compliance(mesh, stiffness) * stiffness, expected.compliance,
                    1e-9 * expected.compliance)
            << mesh.description() << ", ends " << static_cast<int>(expected.first)
            << static_cast<int>(expected.second);
      }
    }
  }
  beam.ends = {clamped, clamped};
  const HermiteMesh half(beam, 0.5, 12, Extent::half, true);
  EXPECT_NEAR(compliance(half, stiffness) * stiffness, l * l * l / 192.0, 1e-9 * l * l * l);
}

TEST(HermiteMesh, AHingeTakesOneUnknownMoreAndTurnsByItself) {
  const Beam beam = paper_beam();
  for (const Extent extent : {Extent::half, Extent::whole}) {
    const HermiteMesh without(beam, 0.5, 20, extent);
    const HermiteMesh with(beam, 0.5, 20, extent, true);
    EXPECT_EQ(with.n_unknowns(), without.n_unknowns() + 1);
    const double length = 2.0 * hinge_share * beam.length / 20;
    const std::size_t hinge = with.struck_section();
    EXPECT_NEAR(with.section_positions()[hinge], 0.5 * beam.length, 1e-15);
    EXPECT_NEAR(with.section_weights()[hinge], length, 1e-15);
    // Two rigid halves, w = -angle |x - l/2|/2, turn against each other in the hinge alone.
    const double angle = 0.02;
    const double h = beam.length / 20;
    std::vector<double> q;
    for (std::size_t i = 0; i <= (extent == Extent::half ? 10 : 20); ++i) {
      const double x = h * static_cast<double>(i) - 0.5 * beam.length;
      const double w = 0.5 * angle * std::abs(x);
      if (i == 10) q.push_back(-0.5 * angle * h);
      q.push_back(w);
      if (i == 10 && extent == Extent::half) break;
      q.push_back(i < 10 ? -0.5 * angle * h : 0.5 * angle * h);
    }
    ASSERT_EQ(q.size(), with.n_unknowns());
    const std::vector<double> kappa = curvatures_of(with, q);
    for (std::size_t i = 0; i < kappa.size(); ++i) {
      EXPECT_NEAR(kappa[i], i == hinge ? angle / length : 0.0, 1e-11) << i;
    }
  }
}

TEST(ARuleBesideAHinge, IntegratesWithTheHingeAnyQuadraticAndWithoutItTheInverseRoot) {
  const ElementRule rule = rule_beside_hinges(true, false);
  const ElementRule mirrored = rule_beside_hinges(false, true);
  double unit = hinge_share;
  double first = 0.0, second = 0.0, inverse_root = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    const double x = 0.5 * (1.0 + rule.points[i]);
    unit += rule.weights[i];
    first += rule.weights[i] * x;
    second += rule.weights[i] * x * x;
    inverse_root += rule.weights[i] / std::sqrt(x);
    EXPECT_NEAR(mirrored.points[1 - i], -rule.points[i], 1e-15);
    EXPECT_NEAR(mirrored.weights[1 - i], rule.weights[i], 1e-15);
  }
  EXPECT_NEAR(unit, 1.0, 1e-14);
  EXPECT_NEAR(first, 1.0 / 2.0, 1e-14);
  EXPECT_NEAR(second, 1.0 / 3.0, 1e-14);
  EXPECT_NEAR(inverse_root, 2.0, 1e-12);
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
