// Fields along the beam over whole runs: energy of shapes, supports' momentum, points against
// modal sums, permanent set.

#include <Eigen/Dense>

#include "case/problem.h"
#include "order_table.h"
#include "paper_case.h"

namespace subimpact {
namespace {

constexpr double third = 1.0 / 3.0;

Case linear_case(MeshKind mesh, int n, double position, EndSupport end) {
  Case input = paper_case(SectionKind::elastic, 0.5e-3);
  input.scene.contact = {ContactKind::linear, 2e6, {}, {}, {}};
  input.scene.striker.position = position;
  input.scene.beam.ends = {end, end};
  input.model.mesh = mesh;
  (mesh == MeshKind::cells ? input.model.segments : input.model.elements) = n;
  input.solver.method = Method::nystrom;
  input.solver.rtol = 1e-11;
  return input;
}

// The rows of each shape.
std::map<double, std::vector<ShapeRow>> shapes_of(const Result& result) {
  std::map<double, std::vector<ShapeRow>> shapes;
  for (const ShapeRow& row : result.shapes) shapes[row.time].push_back(row);
  return shapes;
}

// --- energy --------------------------------------------------------------------------------------

// Integrated over a shape: by the trapezoidal rule, or by the weights of Gauss points in equal
// elements, two each, with the ends left out.
double energy_of(const std::vector<ShapeRow>& shape, const Case& input) {
  const Beam& beam = input.scene.beam;
  const auto density = [&](const ShapeRow& row) {
    return 0.5 * (beam.mass_per_length() * row.velocity * row.velocity +
                  row.moment * row.moment / beam.bending_stiffness());
  };
  double energy = 0.0;
  if (input.model.mesh == MeshKind::hermite) {
    for (std::size_t i = 1; i + 1 < shape.size(); ++i) {
      energy += 0.5 * beam.length / input.model.elements * density(shape[i]);
    }
    return energy;
  }
  for (std::size_t i = 1; i < shape.size(); ++i) {
    energy += 0.5 * (shape[i].position - shape[i - 1].position) *
              (density(shape[i]) + density(shape[i - 1]));
  }
  return energy;
}

void expect_order_of_energy(MeshKind mesh, EndSupport end, const std::vector<int>& sizes,
                            double low, double high) {
  OrderTable table("energy of shapes, relative");
  for (const int n : sizes) {
    Case input = linear_case(mesh, n, third, end);
    input.scene.beam.theory = BeamTheory::euler_bernoulli;  // no energy of rotation
    input.output.interval = input.output.shapes = input.end_time / 20.0;
    input.output.shape_points = 10000;
    const Result result = simulate(input);
    const auto shapes = shapes_of(result);
    double error = 0.0;
    for (const HistoryRow& row : result.history) {
      const double account = row.beam_kinetic_energy + row.bending_elastic;
      const auto shape = shapes.find(row.time);
      ASSERT_NE(shape, shapes.end());
      error = std::max(error, std::abs(energy_of(shape->second, input) - account));
    }
    table.add(n, error / result.used.initial_energy);
  }
  table.expect_every_order_within(low, high);
}

TEST(AShape, HoldsTheEnergyOfTheAccountToTheOrderOfTheMesh) {
  expect_order_of_energy(MeshKind::cells, free_end, {45, 90, 180, 360}, 1.7, 2.3);
  expect_order_of_energy(MeshKind::hermite, pinned, {24, 48, 96}, 3.4, 4.6);
}

TEST(AShape, ShowsBothHalvesOfABeamOfWhichOneIsModelled) {
  for (const MeshKind mesh : {MeshKind::cells, MeshKind::hermite}) {
    Case input = linear_case(mesh, mesh == MeshKind::cells ? 41 : 40, 0.5, free_end);
    input.output.shape_points = 1000;
    input.output.shapes = 1e-4;
    const auto half = shapes_of(simulate(input));
    input.model.symmetry = SymmetryUse::off;
    const auto whole = shapes_of(simulate(input));
    const auto& a = std::prev(half.end(), 2)->second;
    const auto& b = std::prev(whole.end(), 2)->second;
    std::size_t n_compared = 0;
    for (const ShapeRow& one : b) {
      const auto same = std::find_if(a.begin(), a.end(), [&](const ShapeRow& other) {
        return std::abs(other.position - one.position) < 1e-12;
      });
      ASSERT_NE(same, a.end()) << one.position;
      ++n_compared;
      EXPECT_NEAR(same->displacement, one.displacement, 1e-9);
      EXPECT_NEAR(same->rotation, one.rotation, 1e-8);
      EXPECT_NEAR(same->moment, one.moment, 1e-4);
      EXPECT_NEAR(same->velocity, one.velocity, 1e-5);
    }
    EXPECT_GE(n_compared, 41u);
  }
}

// In modes the fields of many states are computed at once.
TEST(Shapes, AreTheSameInModesAndAtNodes) {
  Case input = linear_case(MeshKind::hermite, 24, third, pinned);
  input.output.interval = input.end_time / 300.0;
  input.output.shapes = input.end_time / 110.0;
  const Result in_modes = simulate(input);
  EXPECT_NE(in_modes.used.mesh.find("in natural modes"), std::string::npos);
  input.study.mass_solver = MassSolverKind::klu;
  const Result at_nodes = simulate(input);
  EXPECT_EQ(at_nodes.used.mesh.find("in natural modes"), std::string::npos);
  const auto regular = [&](const Result& run) {
    auto shapes = shapes_of(run);
    std::erase_if(shapes, [&](const auto& shape) {
      const double interval = shape.first / *input.output.shapes;
      return std::abs(interval - std::round(interval)) > 1e-9;
    });
    return shapes;
  };
  const auto a = regular(in_modes), b = regular(at_nodes);
  ASSERT_EQ(a.size(), 111u);
  ASSERT_EQ(b.size(), a.size());
  for (const auto member : {&ShapeRow::position, &ShapeRow::displacement, &ShapeRow::velocity,
                            &ShapeRow::rotation, &ShapeRow::curvature, &ShapeRow::moment}) {
    double largest = 0.0, difference = 0.0;
    for (auto one = a.begin(), other = b.begin(); one != a.end(); ++one, ++other) {
      for (std::size_t i = 0; i < one->second.size(); ++i) {
        largest = std::max(largest, std::abs(one->second[i].*member));
        difference =
            std::max(difference, std::abs(one->second[i].*member - other->second.at(i).*member));
      }
    }
    EXPECT_GT(largest, 0.0);
    EXPECT_LT(difference, 1e-6 * largest);
  }
}

TEST(Shapes, AreOfRegularInstantsOfEveryEventAndOfTheEnd) {
  Case input = paper_case(SectionKind::exact, 0.6e-3, 101);
  input.output.interval = 1e-6;
  const Result result = simulate(input);
  EXPECT_NEAR(result.used.shape_interval, 2e-6, 1e-18);  // a whole number of history rows
  const auto shapes = shapes_of(result);
  EXPECT_EQ(result.n_shape_rows, result.shapes.size());
  EXPECT_EQ(result.shapes.size(), shapes.size() * result.used.n_shape_points);
  EXPECT_TRUE(std::is_sorted(result.shapes.begin(), result.shapes.end(),
                             [](const ShapeRow& a, const ShapeRow& b) { return a.time < b.time; }));
  for (const Transition& event : result.transitions) {
    if (event.kind == EventKind::section_reverses) continue;
    EXPECT_EQ(shapes.count(event.time), 1u) << event.time;
  }
  EXPECT_EQ(shapes.rbegin()->first, input.end_time);
  EXPECT_GE(shapes.size(), 301u);
  EXPECT_LE(shapes.size(), 302u + result.transitions.size());
  EXPECT_LE(result.used.n_shape_points, 103u);
}

TEST(ARunWithoutShapes, IsTheSame) {
  Case input = paper_case(SectionKind::exact, 0.6e-3, 101);
  EXPECT_EQ(resolve(input).settings().shape_interval, 0.0);  // no rows, no shapes
  input.output.shapes = 1e-6;
  const Result with = simulate(input);
  input.output.shapes = 0.0;
  const Result without = simulate(input);
  EXPECT_TRUE(without.shapes.empty());
  EXPECT_TRUE(without.envelope.empty());
  EXPECT_EQ(with.work.steps, without.work.steps);
  EXPECT_GT(with.work.right_hand_sides, without.work.right_hand_sides);  // of states within steps
  ASSERT_EQ(with.sub_impacts.size(), without.sub_impacts.size());
  for (std::size_t i = 0; i < with.sub_impacts.size(); ++i) {
    EXPECT_EQ(with.sub_impacts[i].start, without.sub_impacts[i].start);
  }
}

// --- envelope and permanent set ---------------------------------------------------------------

TEST(TheEnvelope, BoundsEveryShapeAndIsReachedAtItsTimes) {
  Case input = paper_case(SectionKind::exact, 1e-3, 101);
  input.output.interval = 1e-6;
  const Result result = simulate(input);
  const std::size_t n = result.used.n_shape_points;
  ASSERT_EQ(result.envelope.size(), n);
  for (std::size_t k = 0; k < result.shapes.size(); ++k) {
    const ShapeRow& row = result.shapes[k];
    const EnvelopeRow& here = result.envelope[k % n];
    ASSERT_EQ(row.position, here.position);
    EXPECT_LE(row.moment, here.moment.largest.value);
    EXPECT_GE(row.moment, here.moment.smallest.value);
    EXPECT_LE(row.displacement, here.displacement.largest.value);
    EXPECT_LE(-row.curvature * 0.5 * input.scene.beam.thickness, here.strain.largest.value);
    EXPECT_LE(row.plastic_curvature, here.plastic_curvature.largest.value);
    if (row.time == here.moment.largest.time) {
      EXPECT_EQ(row.moment, here.moment.largest.value);
    }
  }
}

// The slope jumps by kappa_p W at every section, hinges included, and is constant in between.
double mid_span_set(const std::vector<ShapeRow>& shape, const BeamMesh& mesh, double length) {
  double slope = 0.0, displacement = 0.0, middle = 0.0, x = 0.0;
  const auto go_to = [&](double next) {
    displacement += slope * (next - x);
    x = next;
  };
  bool passed = false;
  for (std::size_t j = 0; j < mesh.n_sections(); ++j) {
    const double at = mesh.section_positions()[j];
    if (!passed && at >= 0.5 * length) {
      go_to(0.5 * length);
      middle = displacement;
      passed = true;
    }
    go_to(at);
    const auto row = std::find_if(shape.begin(), shape.end(), [&](const ShapeRow& r) {
      return std::abs(r.position - at) < 1e-12;
    });
    if (row == shape.end()) return std::nan("");
    slope += row->plastic_curvature * mesh.section_weights()[j];
  }
  go_to(length);
  return middle - 0.5 * displacement;
}

TEST(PlasticCurvatures, OfElasticBeamsAreZeroAndNotRounding) {
  for (const MeshKind kind : {MeshKind::cells, MeshKind::hermite}) {
    Case input = linear_case(kind, 40, third, pinned);
    input.output.shapes = 1e-5;
    input.output.interval = 1e-6;
    input.output.sections = {0.25, 0.5};
    const Result result = simulate(input);
    EXPECT_GT(result.max_indentation, 0.0);
    const auto is_elastic = [](const auto& row) { return row.plastic_curvature == 0.0; };
    EXPECT_TRUE(std::ranges::all_of(result.shapes, is_elastic));
    EXPECT_TRUE(std::ranges::all_of(result.section_history, is_elastic));
  }
}

TEST(ThePermanentSet, IsTheDoubleIntegralOfTheLastPlasticCurvatures) {
  for (const MeshKind kind : {MeshKind::cells, MeshKind::hermite}) {
    Case input = paper_case(SectionKind::exact, 1e-3, 101, Method::nystrom);
    input.model.mesh = kind;
    input.model.elements = 60;
    input.model.symmetry = SymmetryUse::off;
    input.output.shapes = 1e-4;
    input.output.shape_points = 1000;
    const Result result = simulate(input);
    const std::shared_ptr<const BeamMesh> mesh = problem_of(input).mesh;
    const double l = input.scene.beam.length;
    const std::size_t n = result.used.n_shape_points;
    const std::vector<ShapeRow> last(result.shapes.end() - static_cast<std::ptrdiff_t>(n),
                                     result.shapes.end());
    const double set = mid_span_set(last, *mesh, l);
    double found = 0.0, rotation = 0.0;
    for (const EnvelopeRow& row : result.envelope) {
      if (std::abs(row.position - 0.5 * l) < 1e-9) found = row.permanent_set;
    }
    for (const PlasticZone& zone : result.plastic_zones) {
      if (zone.from <= 0.5 * l && zone.to >= 0.5 * l) rotation = zone.rotation;
    }
    EXPECT_GT(std::abs(found), 1e-4);
    EXPECT_NEAR(found, set, 1e-10 * std::abs(set));
    EXPECT_LT(rotation * found, 0.0);  // a hinge that turns the ends back
  }
}

// --- reactions -----------------------------------------------------------------------------------

// The integral over time of rows at unequal distances: between two rows the cubic through them and
// their neighbours, within pieces between events.
double integral(const std::vector<HistoryRow>& rows) {
  const auto force = [&](std::size_t i) {
    return rows[i].first_reaction.value_or(0.0) + rows[i].last_reaction.value_or(0.0);
  };
  constexpr double gauss[] = {0.21132486540518711775, 0.78867513459481288225};
  double sum = 0.0;
  std::size_t first = 0;
  while (first < rows.size()) {
    std::size_t end = first + 1;  // of the piece: two rows of one time part pieces
    while (end < rows.size() && rows[end].time > rows[end - 1].time) ++end;
    for (std::size_t i = first; i + 1 < end; ++i) {
      const std::size_t n = std::min<std::size_t>(6, end - first);
      const std::size_t start =
          std::clamp<std::size_t>(i < first + 2 ? first : i - 2, first, end - n);
      for (const double place : gauss) {
        const double t = rows[i].time + place * (rows[i + 1].time - rows[i].time);
        double value = 0.0;
        for (std::size_t a = start; a < start + n; ++a) {
          double factor = 1.0;
          for (std::size_t b = start; b < start + n; ++b) {
            if (b != a) factor *= (t - rows[b].time) / (rows[a].time - rows[b].time);
          }
          value += factor * force(a);
        }
        sum += 0.5 * (rows[i + 1].time - rows[i].time) * value;
      }
    }
    first = end;
  }
  return sum;
}

struct Supported {
  const char* name;
  MeshKind mesh;
  int n;  // cells or elements
  BeamTheory theory;
  double damping;  // by stiffness, s
};

TEST(Reactions, CloseTheBalanceOfMomentumOfSupportedBeams) {
  for (const Supported& beam :
       {Supported{"cells", MeshKind::cells, 21, BeamTheory::rayleigh, 0.0},
        Supported{"hermite", MeshKind::hermite, 9, BeamTheory::rayleigh, 0.0},
        Supported{"cells that shear", MeshKind::cells, 21, BeamTheory::timoshenko, 0.0},
        Supported{"spectral", MeshKind::spectral, 6, BeamTheory::timoshenko, 0.0},
        Supported{"damped cells", MeshKind::cells, 21, BeamTheory::rayleigh, 1e-6}}) {
    for (const EndSupport end : {pinned, clamped}) {
      Case input = linear_case(beam.mesh, beam.n, third, end);
      input.scene.beam.theory = beam.theory;
      if (beam.theory == BeamTheory::timoshenko) input.scene.beam.poisson = 0.33;
      input.scene.beam.damping.stiffness = beam.damping;
      if (beam.damping > 0.0) input.solver.method = Method::erk;
      input.solver.rtol = 1e-13;
      input.output.interval = 2e-8;
      const Result result = completed(input);
      const double m = input.scene.striker.mass;
      const double initial = m * input.scene.striker.velocity;
      const double last =
          m * result.striker_velocity + input.scene.beam.mass() * result.beam_mean_velocity;
      const double impulse = integral(result.history);
      EXPECT_GT(std::abs(impulse), 1e-3 * initial) << beam.name;
      EXPECT_NEAR(initial + impulse, last, 1e-10 * initial) << beam.name;
    }
  }
}

TEST(Reactions, ChangePlacesWithTheEnds) {
  Case input = linear_case(MeshKind::hermite, 30, third, clamped);
  input.output.interval = 1e-5;
  input.scene.beam.ends = {clamped, pinned};
  const Result here = simulate(input);
  input.scene.beam.ends = {pinned, clamped};
  input.scene.striker.position = 1.0 - third;
  const Result there = simulate(input);
  ASSERT_EQ(here.history.size(), there.history.size());
  double largest = 0.0;
  for (const HistoryRow& row : here.history) largest = std::max(largest, *row.first_reaction);
  for (std::size_t i = 0; i < here.history.size(); ++i) {
    EXPECT_NEAR(*here.history[i].first_reaction, *there.history[i].last_reaction, 1e-6 * largest);
    EXPECT_NEAR(*here.history[i].last_reaction, *there.history[i].first_reaction, 1e-6 * largest);
  }
}

TEST(Reactions, AreNoneAtFreeEnds) {
  Case input = linear_case(MeshKind::cells, 31, 0.5, free_end);
  input.output.interval = 1e-5;
  for (const HistoryRow& row : simulate(input).history) {
    EXPECT_FALSE(row.first_reaction);
    EXPECT_FALSE(row.last_reaction);
  }
}

// --- points --------------------------------------------------------------------------------------

// Striker, linear spring and modes of a pinned beam, sin(n pi x/l), as one eigenproblem; valid up
// to the end of the first contact. The first modes move, the others follow the force as at rest:
// they are a spring in series with that of the contact.
class ModalSum {
  // Rounding of squared frequencies, relative to the largest, must not reach the smallest.
  using Real = long double;
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

 public:
  ModalSum(const Scene& scene, Eigen::Index n_modes)
      : n_(n_modes), scene_(scene), length_(scene.beam.length) {
    const Beam& beam = scene.beam;
    Vector root_mass(n_ + 1);
    Matrix stiffness = Matrix::Zero(n_ + 1, n_ + 1);
    indentation_.resize(n_ + 1);
    for (Eigen::Index k = 0; k < n_; ++k) {
      const Real b = wave(k);
      const Real mass = beam.mass_per_length() + beam.rotary_inertia() * b * b;
      root_mass(k) = std::sqrt(mass * length_ / 2);
      stiffness(k, k) = modal_stiffness(k);
      indentation_(k) = -std::sin(b * scene.striker.position * length_);
    }
    root_mass(n_) = std::sqrt(scene.striker.mass);
    indentation_(n_) = 1.0;
    spring_ = 1 / (1 / Real(*scene.contact.stiffness) +
                   compliance_of_rest(scene.striker.position * length_));
    stiffness += spring_ * indentation_ * indentation_.transpose();
    const Vector inverse = root_mass.cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Matrix> solver(inverse.asDiagonal() * stiffness *
                                                       inverse.asDiagonal());
    frequencies_ = solver.eigenvalues().cwiseSqrt();
    shapes_ = inverse.asDiagonal() * solver.eigenvectors();
    rates_ = solver.eigenvectors().row(n_).transpose() * root_mass(n_) * scene.striker.velocity;
  }
  double displacement(double x, double t) const {
    const Vector amplitudes =
        rates_.array() * (frequencies_.array() * Real(t)).sin() / frequencies_.array();
    const Vector unknowns = shapes_ * amplitudes;
    Real sum = spring_ * indentation_.dot(unknowns) * compliance_of_rest(x);
    for (Eigen::Index k = 0; k < n_; ++k) sum += std::sin(wave(k) * x) * unknowns(k);
    return static_cast<double>(sum);
  }

 private:
  Real wave(Eigen::Index k) const {
    return static_cast<Real>(k + 1) * std::numbers::pi_v<Real> / length_;
  }
  Real modal_stiffness(Eigen::Index k) const {
    return scene_.beam.bending_stiffness() * std::pow(wave(k), 4) * length_ / 2;
  }
  // Displacement at x by a force of 1 N at the strike, of the modes beyond the first n.
  Real compliance_of_rest(Real x) const {
    const Real struck_at = scene_.striker.position * length_;
    Real sum = 0.0;
    for (Eigen::Index k = n_; k < 20 * n_; ++k) {
      sum += std::sin(wave(k) * x) * std::sin(wave(k) * struck_at) / modal_stiffness(k);
    }
    return sum;
  }

  Eigen::Index n_;
  Scene scene_;
  Real length_, spring_;
  Vector indentation_, frequencies_, rates_;
  Matrix shapes_;
};

TEST(APoint, MovesAsAModalSumOfAPinnedBeamStruckAtAThird) {
  Case input = linear_case(MeshKind::hermite, 900, third, pinned);
  input.scene.contact.stiffness = 1e5;
  input.solver.method = Method::exponential;
  input.solver.rtol = 1e-12;
  input.output.interval = 2e-5;
  input.output.points = {0.5, 0.1};
  const Result result = completed(input);
  const double end = result.end_of(result.sub_impacts.front());
  ASSERT_GT(end, 1e-4);
  const ModalSum sum(input.scene, 240);
  double largest = 0.0, error = 0.0;
  for (const PointRow& row : result.point_history) {
    if (row.time > end) break;
    const double expected = sum.displacement(row.position, row.time);
    largest = std::max(largest, std::abs(expected));
    error = std::max(error, std::abs(row.displacement - expected));
  }
  EXPECT_LT(error, 1e-8 * largest);
}

}  // namespace
}  // namespace subimpact
