#include "model/mesh/hermite/hermite_mesh.h"

#include "mesh/mesh_contract.h"
#include "numerics/mass_solver.h"

namespace subimpact {
namespace {

using Extent = HermiteMesh::Extent;

// Meshes of every shape: hinges, theories, supports, whole and half, strikes in the
// middle, aside and at free ends, few and many elements.
std::vector<HermiteMesh> meshes() {
  std::vector<HermiteMesh> all;
  for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
    for (const EndSupport first : all_ends) {
      for (const EndSupport second : all_ends) {
        const Beam beam = paper_beam(theory, {first, second});
        for (const bool hinges : {false, true}) {
          const auto add = [&](double position, std::size_t n, Extent extent) {
            all.emplace_back(beam, position, n, extent, hinges);
          };
          for (const std::size_t n : {4u, 5u, 12u}) {
            for (const double position : {0.2, 0.5, 0.77}) add(position, n, Extent::whole);
            if (first == second && n % 2 == 0) add(0.5, n, Extent::half);
          }
          if (first == free_end) add(0.0, 6, Extent::whole);
          if (second == free_end) add(1.0, 6, Extent::whole);
        }
      }
    }
  }
  return all;
}

// Displacement and slope at every node of a free beam's mesh.
template <class W, class T>
std::vector<double> nodal(std::span<const double> nodes, double slope_unit, W w, T t) {
  std::vector<double> q;
  for (const double x : nodes) {
    q.push_back(w(x));
    q.push_back(slope_unit * t(x));
  }
  return q;
}

std::vector<double> equal_nodes(const Beam& beam, std::size_t n, std::size_t kept) {
  std::vector<double> nodes;
  for (std::size_t i = 0; i <= kept; ++i) {
    nodes.push_back(beam.length * static_cast<double>(i) / static_cast<double>(n));
  }
  return nodes;
}

TEST(HermiteMesh, KeepsTheContractOfMeshes) {
  for (const HermiteMesh& mesh : meshes()) {
    expect_mesh_contract(mesh);
    EXPECT_LE(mesh.stiffness_bandwidth(), 3u);
  }
}

TEST(HermiteMesh, SectionsWeighTheWholeBeamAndStandInOrder) {
  for (const HermiteMesh& mesh : meshes()) {
    const auto weights = mesh.section_weights();
    const auto positions = mesh.section_positions();
    const double length = paper_beam().length;
    EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), length, 1e-14);
    for (const double weight : weights) EXPECT_GT(weight, 0.0);
    for (std::size_t i = 1; i < positions.size(); ++i) EXPECT_GT(positions[i], positions[i - 1]);
    EXPECT_GE(positions.front(), 0.0);
    EXPECT_LE(positions.back(), length * (1.0 + 1e-15));
  }
}

TEST(HermiteMesh, CubicsHaveTheirCurvatureInEverySection) {
  const Beam beam = paper_beam();
  const double h = beam.length / 12;
  const auto w = [](double x) { return 0.3 + 0.2 * x + 0.35 * x * x - 0.8 * x * x * x; };
  const auto t = [](double x) { return 0.2 + 0.7 * x - 2.4 * x * x; };
  const HermiteMesh mesh(beam, 0.5, 12, Extent::whole);
  const std::vector<double> q = nodal(equal_nodes(beam, 12, 12), h, w, t);
  const std::vector<double> kappa = curvatures_of(mesh, q);
  for (std::size_t i = 0; i < kappa.size(); ++i) {
    EXPECT_NEAR(kappa[i], 0.7 - 4.8 * mesh.section_positions()[i], 1e-12);
  }
}

TEST(HermiteMesh, OfConstantCurvatureIsBentByMomentsAtItsEndsAlone) {
  const Beam beam = paper_beam();
  const HermiteMesh mesh(beam, 0.3, 10, Extent::whole);
  const std::vector<double> moments(mesh.n_sections(), 5.0);
  const std::vector<double> forces = bending_forces_of(mesh, moments);
  const double h = beam.length / 10;
  // The couple M belongs to the slope t, of which the unknown is h t.
  EXPECT_NEAR(forces[1], 5.0 / h, 1e-12);
  EXPECT_NEAR(forces[forces.size() - 1], -5.0 / h, 1e-12);
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const bool couple = i == 1 || i + 1 == forces.size();
    EXPECT_NEAR(couple ? 0.0 : forces[i], 0.0, 1e-11) << i;
  }
}

TEST(HermiteMesh, HasMassMomentumAndRotaryInertiaOfTheBeam) {
  for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
    const Beam beam = paper_beam(theory);
    for (const Extent extent : {Extent::whole, Extent::half}) {
      const HermiteMesh mesh(beam, 0.5, 8, extent);
      EXPECT_NEAR(mesh.mass().quadratic_form(mesh.translation()), beam.mass(), 1e-13);
      EXPECT_NEAR(dot(mesh.momentum_functional(), mesh.translation()), beam.mass(), 1e-13);
      expect_near(times(mesh.mass(), mesh.translation()), mesh.momentum_functional(), 1e-14);
    }
    const HermiteMesh mesh(beam, 0.3, 8, Extent::whole);
    // Elements of two lengths: 2 over 0.3 l, 6 over 0.7 l.
    std::vector<double> nodes;
    for (std::size_t i = 0; i <= 8; ++i) {
      const double part =
          i <= 2 ? 0.15 * static_cast<double>(i) : 0.3 + 0.7 / 6.0 * static_cast<double>(i - 2);
      nodes.push_back(part * beam.length);
    }
    const double middle = 0.5 * beam.length;
    const std::vector<double> rotation = nodal(
        nodes, beam.length / 8, [&](double x) { return x - middle; }, [](double) { return 1.0; });
    const double exact =
        beam.mass() * beam.length * beam.length / 12.0 + beam.rotary_inertia() * beam.length;
    EXPECT_NEAR(mesh.mass().quadratic_form(rotation), exact, 1e-13 * exact);
  }
}

TEST(HermiteMesh, HalfAndWholeModelAgreeOnSymmetricFields) {
  for (const EndSupport end : all_ends) {
    const Beam beam = paper_beam(BeamTheory::rayleigh, {end, end});
    const HermiteMesh half(beam, 0.5, 8, Extent::half);
    const HermiteMesh whole(beam, 0.5, 8, Extent::whole);
    const std::vector<double> w = random_numbers(3, half.n_unknowns());
    // The mirror image: displacements the same, slopes with the other sign.
    const std::size_t held = end == free_end ? 0 : end == pinned ? 1 : 2;
    const auto padded = [&](std::size_t i) { return i < held ? 0.0 : w[i - held]; };
    std::vector<double> both;
    for (std::size_t node = 0; node <= 8; ++node) {
      const bool mirrored = node > 4;
      const std::size_t from = mirrored ? 8 - node : node;
      const double slope = from == 4 ? 0.0 : padded(2 * from + 1);
      const bool at_end = node == 0 || node == 8;
      if (!at_end || end == free_end) both.push_back(padded(2 * from));
      if (!at_end || end != clamped) both.push_back(mirrored ? -slope : slope);
    }
    ASSERT_EQ(both.size(), whole.n_unknowns());
    EXPECT_NEAR(half.mass().quadratic_form(w), whole.mass().quadratic_form(both), 1e-12);
    EXPECT_EQ(half.struck_point()(w), whole.struck_point()(both));
    EXPECT_EQ(half.first_end()(w), whole.first_end()(both));
    EXPECT_NEAR(dot(half.momentum_functional(), w), dot(whole.momentum_functional(), both), 1e-13);
    const std::vector<double> kappa = curvatures_of(half, w);
    const std::vector<double> both_kappa = curvatures_of(whole, both);
    for (std::size_t i = 0; i < kappa.size(); ++i) {
      EXPECT_NEAR(kappa[i], both_kappa[i], 1e-11);
      EXPECT_NEAR(kappa[i], both_kappa[both_kappa.size() - 1 - i], 1e-10);
    }
  }
}

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

TEST(HermiteMesh, HasANodeAtTheStrikeAndASectionBesideIt) {
  const Beam beam = paper_beam();
  for (const double position : {0.0, 0.05, 0.31, 0.5, 0.77, 1.0}) {
    const HermiteMesh mesh(beam, position, 20, Extent::whole);
    ASSERT_EQ(mesh.struck_point().terms.size(), 1u);
    EXPECT_EQ(mesh.struck_point().terms.front().coefficient, 1.0);
    EXPECT_NEAR(mesh.section_positions()[mesh.struck_section()], position * beam.length,
                0.5 * beam.length / 20);
  }
}

TEST(HermiteMesh, IsSolvedForItsMassByTheBandedSolver) {
  for (const HermiteMesh& mesh : meshes()) {
    const std::vector<double> x = random_numbers(5, mesh.n_unknowns());
    std::vector<double> b = times(mesh.mass(), x);
    BandedSolver(mesh.mass()).solve(b);
    expect_near(b, x, 1e-10);
  }
}

TEST(HermiteMesh, HighestFrequencyIsAnUpperBoundAndClose) {
  for (const HermiteMesh& mesh : meshes()) {
    const double stiffness = paper_beam().bending_stiffness();
    const double highest = highest_of(mesh, stiffness);
    EXPECT_GE(mesh.highest_frequency(stiffness), highest * (1.0 - 1e-12)) << mesh.description();
  }
  for (const BeamTheory theory : {BeamTheory::rayleigh, BeamTheory::euler_bernoulli}) {
    const Beam beam = paper_beam(theory);
    const HermiteMesh mesh(beam, 0.5, 200, Extent::half);
    const double highest = highest_of(mesh, beam.bending_stiffness());
    EXPECT_LE(mesh.highest_frequency(beam.bending_stiffness()), (1.0 + 1e-5) * highest);
  }
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
