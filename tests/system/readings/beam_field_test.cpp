// Fields along the beam, read through the mesh's functionals of displacement and rotation, against
// static solutions of dense matrices and of textbooks.

#include "system/readings/beam_field.h"

#include "dense.h"
#include "kinds_of_mesh.h"
#include "model/mesh/modal_mesh.h"
#include "order_table.h"
#include "struck_beam_of.h"
#include "system/readings/support_reactions.h"

namespace subimpact {
namespace {

constexpr double third = 1.0 / 3.0;

class Meshes : public testing::TestWithParam<std::tuple<Kind, Ends>> {};

INSTANTIATE_TEST_SUITE_P(
    , Meshes,
    testing::Combine(testing::Values(Kind::cells, Kind::hermite, Kind::timoshenko, Kind::spectral),
                     testing::Values(Ends{free_end, free_end}, Ends{pinned, pinned},
                                     Ends{clamped, free_end}, Ends{pinned, clamped},
                                     Ends{clamped, clamped})),
    NamedAsPrinted{});

TEST_P(Meshes, ShowTheirSupportsByDisplacementAndRotationOfTheEnds) {
  const auto [kind, ends] = GetParam();
  const auto mesh = make_mesh(kind, beam_with(ends, kind), third, 33);
  const double l = paper_beam().length;
  EXPECT_EQ(support_at(*mesh, 0.0), ends[0]);
  EXPECT_EQ(support_at(*mesh, l), ends[1]);
  const ModalMesh modal(mesh, paper_beam().bending_stiffness());
  EXPECT_EQ(support_at(modal, 0.0), ends[0]);
  EXPECT_EQ(support_at(modal, l), ends[1]);
}

TEST_P(Meshes, HaveTheirOwnDisplacementOfTheStruckPointAndOfTheFirstEnd) {
  const auto [kind, ends] = GetParam();
  const Beam beam = beam_with(ends, kind);
  for (const bool half : {false, true}) {
    if (half && ends[0] != ends[1]) continue;
    const std::size_t n = has_cells(kind) ? 33 : 32;
    const auto mesh = make_mesh(kind, beam, half ? 0.5 : third, n, half);
    const std::vector<double> q = random_numbers(7, mesh->n_unknowns());
    const double struck_at = (half ? 0.5 : third) * beam.length;
    EXPECT_NEAR((*mesh->displacement_at(struck_at))(q), mesh->struck_point()(q), 1e-12);
    EXPECT_NEAR((*mesh->displacement_at(0.0))(q), mesh->first_end()(q), 1e-12);
    EXPECT_TRUE(!half || (*mesh->rotation_at(struck_at))(q) == 0.0);
  }
}

// Slopes are derivatives of displacements, and curvatures those of slopes, where they are smooth.
TEST_P(Meshes, HaveSlopesThatAreDerivativesOfTheirDisplacements) {
  const auto [kind, ends] = GetParam();
  if (shears(kind)) return;  // rotations are no derivatives
  const Beam beam = beam_with(ends, kind);
  const double l = beam.length;
  OrderTable table("slope against differences of displacements");
  for (const std::size_t n : {33u, 66u, 132u}) {
    const auto mesh = make_mesh(kind, beam, third, n);
    // The shape of its softest deformation.
    const NaturalModes modes = mesh->natural_modes(beam.bending_stiffness());
    const auto q = modes.shape(3);
    double largest = 0.0, error = 0.0;
    for (double x = 0.05 * l; x < l; x += 0.0731 * l) {
      const double h = 0.01 * l;  // fixed, so that kinks between centres average out
      const double w0 = (*mesh->displacement_at(x - h))(q), w1 = (*mesh->displacement_at(x + h))(q);
      double mean = 0.0;  // of the slope between them
      constexpr int parts = 64;
      for (int k = 0; k < parts; ++k) {
        mean += (*mesh->rotation_at(x - h + (k + 0.5) * 2.0 * h / parts))(q) / parts;
      }
      largest = std::max(largest, std::abs(mean));
      error = std::max(error, std::abs((w1 - w0) / (2.0 * h) - mean));
    }
    table.add(static_cast<double>(n), error / largest);
    EXPECT_TRUE(kind != Kind::hermite || error < 2e-5 * largest) << error / largest;
  }
  if (kind == Kind::cells) table.expect_overall_order_within(1.5, 2.6);
}

TEST(AFreeMesh, HasTheMomentOfMomentumOfARigidRotation) {
  for (const Kind kind : {Kind::cells, Kind::hermite, Kind::timoshenko, Kind::spectral}) {
    const Beam beam = beam_with({free_end, free_end}, kind);
    const auto mesh = make_mesh(kind, beam, third, 33);
    const std::size_t n = mesh->n_unknowns();
    // The rotation x: the motion without curvature and shear that no translation is.
    const Eigen::MatrixXd shapes = eigen_pairs(stiffness_matrix(*mesh, 1.0)).vectors;
    for (Eigen::Index k = 0; k < 2; ++k) {
      const Eigen::VectorXd rigid = shapes.col(k);
      const double w0 = (*mesh->displacement_at(0.0))(entries(rigid));
      const double turn =
          ((*mesh->displacement_at(beam.length))(entries(rigid)) - w0) / beam.length;
      double moment = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        moment += mesh->moment_functional()[i] * rigid(static_cast<Eigen::Index>(i));
      }
      const double m = beam.mass(), l = beam.length;
      const double expected =
          w0 * m * l / 2.0 + turn * (m * l * l / 3.0 + beam.rotary_inertia() * l);
      const double size = std::abs(w0) * m * l / 2.0 + std::abs(turn) * m * l * l / 3.0;
      // Cells: the mass of a cell is at its centre, m l^2/3 less a twelfth of a cell's square; the
      // outer halves of free end cells have no rotary inertia. The stiffness of shear leaves some
      // 1e-8 of other shapes in the rigid ones of the dense decomposition.
      const double tolerance = has_cells(kind) ? 4e-4 : shears(kind) ? 1e-7 : 1e-9;
      EXPECT_NEAR(moment, expected, tolerance * size) << kind;
    }
  }
}

// --- the permanent set ------------------------------------------------------------------------

// The unknowns of the beam at rest: of least elastic energy with plastic curvatures as they are.
Eigen::VectorXd at_rest(const BeamMesh& mesh, const Beam& beam,
                        const std::vector<double>& plastic) {
  std::vector<double> moments(plastic.begin(), plastic.end());
  for (double& moment : moments) moment *= beam.bending_stiffness();
  Eigen::VectorXd load(index(mesh.n_unknowns()));
  mesh.bending_forces(moments, entries(load));
  return solution(stiffness_matrix(mesh, beam.bending_stiffness()), -load);
}

double largest_difference(const BeamMesh& mesh, const Beam& beam,
                          const std::vector<double>& plastic, const std::vector<double>& places,
                          double& largest) {
  const Eigen::VectorXd q = at_rest(mesh, beam, plastic);
  const double length = beam.length;
  const double shear_flexibility =
      beam.shears() ? beam.bending_stiffness() / beam.shear_stiffness() : 0.0;
  const auto w = [&](double x) { return (*mesh.displacement_at(x))(entries(q)); };
  const PermanentSet set(mesh, length, shear_flexibility, plastic);
  const double end = mesh.symmetric() ? 0.0 : w(length);
  const double start = w(0.0);
  const auto& ends = beam.ends;
  const bool is_cantilever = !mesh.symmetric() && ((ends[0] == clamped && ends[1] == free_end) ||
                                                   (ends[0] == free_end && ends[1] == clamped));
  double difference = 0.0;
  for (const double x : places) {
    const double chord = start + (mesh.symmetric() ? 0.0 : (end - start) * x / length);
    const double from_supports = is_cantilever ? w(x) : w(x) - chord;
    largest = std::max({largest, std::abs(set.at(x)), std::abs(set.from_supports(x))});
    difference = std::max({difference, std::abs(set.at(x) - (w(x) - chord)),
                           std::abs(set.from_supports(x) - from_supports)});
  }
  return difference;
}

TEST_P(Meshes, LieAtRestAsTheDoubleIntegralOfTheirPlasticCurvature) {
  const auto [kind, ends] = GetParam();
  const Beam beam = beam_with(ends, kind);
  for (const bool half : {false, true}) {
    if (half && ends[0] != ends[1]) continue;
    const std::size_t n = has_cells(kind) ? 33 : 36;
    const auto mesh = make_mesh(kind, beam, half ? 0.5 : third, n, half);
    const double part = half ? 0.5 * beam.length : beam.length;
    std::vector<double> places;  // nodes and centres, where sums of sections are exact
    if (has_cells(kind)) {
      const auto positions = mesh->section_positions();
      places.assign(positions.begin(), positions.end());
    } else {
      for (int i = 0; i <= 36; ++i) {
        if (i * beam.length / 36.0 < part * (1.0 + 1e-9)) places.push_back(i * beam.length / 36.0);
      }
    }
    const std::vector<double> plastic = random_numbers(11, mesh->n_sections());
    double largest = 0.0;
    const double difference = largest_difference(*mesh, beam, plastic, places, largest) / largest;
    // A clamped end of cells is a parabola through its first centres, to second order; and cells
    // integrate the residual moments of a beam held at both ends to second order.
    const bool is_clamped = ends[0] == clamped || ends[1] == clamped;
    // Shear is so much stiffer than bending that the dense solution has some 1e-9 of rounding.
    EXPECT_LT(difference, has_cells(kind) && is_clamped ? 0.03 : shears(kind) ? 1e-8 : 1e-10);
  }
}

// --- reactions -------------------------------------------------------------------------------

// Under a constant force at rest, by textbook, without shear; `ends` decide the share of x = 0.
double share_of_first(Ends ends, double xi) {
  const double eta = 1.0 - xi;  // distance from the far end
  if (ends[0] == free_end) return 0.0;
  if (ends[1] == free_end) return 1.0;
  if (ends == Ends{clamped, clamped}) return eta * eta * (1.0 + 2.0 * xi);
  if (ends == Ends{pinned, clamped}) return 0.5 * eta * eta * (2.0 + xi);
  if (ends == Ends{clamped, pinned}) return 1.0 - 0.5 * xi * xi * (3.0 - xi);
  return eta;
}

class Reactions : public testing::TestWithParam<std::tuple<Kind, Ends, bool>> {};

INSTANTIATE_TEST_SUITE_P(
    , Reactions,
    testing::Combine(testing::Values(Kind::cells, Kind::hermite, Kind::timoshenko, Kind::spectral),
                     testing::Values(Ends{pinned, pinned}, Ends{clamped, free_end},
                                     Ends{pinned, clamped}, Ends{clamped, clamped}),
                     testing::Bool()),
    NamedAsPrinted{});

TEST_P(Reactions, CarryAConstantForceAsInTextbooks) {
  const auto [kind, ends, in_modes] = GetParam();
  Scene scene = paper_scene();
  scene.beam = beam_with(ends, kind);
  scene.contact.kind = ContactKind::linear;
  scene.contact.stiffness = 1e6;
  const double xi = ends == Ends{clamped, free_end} ? 0.6 : third;
  scene.striker.position = xi;
  const double stiffness = scene.beam.bending_stiffness();
  const std::size_t n_parts = has_cells(kind) ? 201 : 30;
  std::shared_ptr<const BeamMesh> mesh = make_mesh(kind, scene.beam, xi, n_parts);
  if (in_modes) mesh = std::make_shared<ModalMesh>(mesh, stiffness);
  const std::size_t n = mesh->n_unknowns();
  constexpr double force = 10.0;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(index(n));
  mesh->struck_point().add_to(entries(load), force);
  const Eigen::VectorXd q = solution(stiffness_matrix(*mesh, stiffness), load);
  StruckBeam beam = struck_beam_of(scene, mesh, SectionField(mesh->n_sections(), stiffness));
  State y(2 * (n + 1), 0.0);
  std::copy(q.data(), q.data() + n, y.begin());
  y[n] = mesh->struck_point()(entries(q)) + force / 1e6;
  beam.contact().set(ContactBranch::elastic, {});
  Accounts accounts(beam);
  const SupportReactions reactions(beam, scene.beam.length, xi * scene.beam.length);
  ASSERT_TRUE(reactions.exist());
  const auto [first, last] = reactions.at(0.0, y, accounts);
  const double share = share_of_first(ends, xi);
  // Cells bend at clamped ends to second order in their length.
  // Shear changes the shares of supports that bending alone does not decide, by some 1e-4.
  const double tolerance = has_cells(kind) ? 2e-3 : shears(kind) ? 3e-4 : 1e-6;
  EXPECT_EQ(first.has_value(), ends[0] != free_end);
  EXPECT_EQ(last.has_value(), ends[1] != free_end);
  EXPECT_NEAR(first.value_or(0.0), -force * share, tolerance * force);
  EXPECT_NEAR(last.value_or(0.0), -force * (1.0 - share), tolerance * force);
  EXPECT_NEAR(first.value_or(0.0) + last.value_or(0.0), -force, 1e-6 * force);
}

// A state that moves with the velocities `v`, undeformed, or is deformed as they say and at rest.
State moving(std::span<const double> v, bool deformed) {
  const std::size_t n = v.size();
  State y(2 * (n + 1), 0.0);
  std::copy(v.begin(), v.end(), y.begin() + static_cast<std::ptrdiff_t>(deformed ? 0 : n + 1));
  return y;
}

TEST(ReactionsOfADampedBeam, AreOfTheDampingWithinTheBeamAndNotOfThatFromOutside) {
  for (const Kind kind : {Kind::cells, Kind::hermite, Kind::timoshenko, Kind::spectral}) {
    for (const bool in_modes : {false, true}) {
      Scene scene = paper_scene();
      scene.beam = beam_with({clamped, pinned}, kind);
      const double stiffness = scene.beam.bending_stiffness();
      std::shared_ptr<const BeamMesh> mesh = make_mesh(kind, scene.beam, third, 15);
      if (in_modes) mesh = std::make_shared<ModalMesh>(mesh, stiffness);
      const std::vector<double> v = random_numbers(5, mesh->n_unknowns());
      const auto reactions_at = [&](const BeamDamping& damping, const State& y) {
        scene.beam.damping = damping;
        StruckBeam beam = struck_beam_of(scene, mesh, SectionField(mesh->n_sections(), stiffness));
        Accounts accounts(beam);
        const auto forces = SupportReactions(beam, scene.beam.length, third * scene.beam.length)
                                .at(0.0, y, accounts);
        return std::array<double, 2>{forces[0].value(), forces[1].value()};
      };
      const auto elastic = reactions_at({}, moving(v, true));
      const auto viscous = reactions_at({.mass = 30.0, .stiffness = 2.0}, moving(v, false));
      const auto outer = reactions_at({.mass = 30.0}, moving(v, false));
      for (const std::size_t end : {0u, 1u}) {
        EXPECT_GT(std::abs(elastic[end]), 1.0) << kind;
        EXPECT_NEAR(viscous[end], 2.0 * elastic[end], 1e-9 * std::abs(elastic[end])) << kind;
        EXPECT_NEAR(outer[end], 0.0, 1e-9 * std::abs(elastic[end])) << kind;
      }
    }
  }
}

// --- stations ----------------------------------------------------------------------------------

TEST(BeamField, KeepsAsManyStationsAsAskedForAndTheStruckOneAmongThem) {
  Scene scene = paper_scene();
  for (const bool half : {false, true}) {
    auto mesh = std::make_shared<CellMesh>(scene.beam, 0.5, 2001,
                                           half ? CellMesh::Extent::half : CellMesh::Extent::whole);
    StruckBeam beam = struck_beam_of(
        scene, mesh, SectionField(mesh->n_sections(), scene.beam.bending_stiffness()));
    for (const std::size_t most : {5u, 51u, 101u, 400u, 100000u}) {
      const BeamField field(beam, scene.beam.length, most);
      const std::size_t n = BeamField::whole_size(*mesh, scene.beam.length, most);
      EXPECT_EQ(n, field.size() + field.n_mirrored()) << most;
      EXPECT_LE(n, std::min<std::size_t>(most + 2, 2001u)) << most;
      EXPECT_GE(n, std::min<std::size_t>(most / 2, 2001u)) << most;
      EXPECT_EQ(field.position(0), 0.0);
      std::size_t struck = 0;
      while (struck < field.size() && field.position(struck) < 0.5 * scene.beam.length - 1e-9)
        ++struck;
      ASSERT_LT(struck, field.size()) << most;
      EXPECT_NEAR(field.position(struck), 0.5 * scene.beam.length, 1e-9) << most;
    }
    EXPECT_EQ(BeamField(beam, scene.beam.length, 0).size(), 0u);
  }
}

TEST(PlasticZones, AreNeighboursOfOneSignWithTheIntegralOfTheirCurvature) {
  const Beam beam = paper_beam();
  const CellMesh mesh(beam, 0.5, 21, CellMesh::Extent::half);
  std::vector<double> plastic(mesh.n_sections(), 0.0);
  plastic[2] = 1.0;
  plastic[3] = 2.0;
  plastic[4] = -1.0;
  plastic.back() = 5.0;
  const std::vector<PlasticZone> zones = plastic_zones(mesh, beam.length, plastic, 1e-3);
  ASSERT_EQ(zones.size(), 5u);
  const double dx = beam.length / 21.0;
  EXPECT_NEAR(zones[0].rotation, 3.0 * dx, 1e-12);
  EXPECT_NEAR(zones[0].to - zones[0].from, 2.0 * dx, 1e-12);
  EXPECT_NEAR(zones[1].rotation, -dx, 1e-12);
  EXPECT_NEAR(zones[2].rotation, 5.0 * dx, 1e-12);  // at mid-span, whole
  EXPECT_NEAR(zones[3].rotation, -dx, 1e-12);
  EXPECT_NEAR(zones[4].from, beam.length - zones[0].to, 1e-12);
}

}  // namespace
}  // namespace subimpact
