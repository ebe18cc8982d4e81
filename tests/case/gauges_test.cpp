// Strain gauges and points: against moments along the beam, a load at rest, modal sums, and
// yielding fibres.

#include <Eigen/Dense>

#include "case/problem.h"
#include "linear_case.h"

namespace subimpact {
namespace {

// --- the bending moment --------------------------------------------------------------------------

// M of a shape at x (m), linear between its points.
double moment_at(const std::vector<ShapeRow>& shape, double x) {
  const auto after = std::ranges::lower_bound(shape, x, {}, &ShapeRow::position);
  if (after == shape.begin()) return after->moment;
  const ShapeRow& before = *(after - 1);
  if (after == shape.end()) return before.moment;
  const double share = (x - before.position) / (after->position - before.position);
  return before.moment + share * (after->moment - before.moment);
}

struct GaugeRun {
  MeshKind mesh;
  EndSupport end;
  double strike;  // as a fraction of the length; at 0.5 one half of the beam is modelled
  Method method;
};

class AGauge : public testing::TestWithParam<GaugeRun> {};

TEST_P(AGauge, ReadsTheMomentTimesHalfTheThicknessOverTheStiffness) {
  const auto [mesh, end, strike, method] = GetParam();
  Case input = linear_case(mesh, mesh == MeshKind::cells ? 51 : 24, strike, end);
  if (mesh == MeshKind::spectral) {
    input.scene.beam.theory = BeamTheory::timoshenko;
    input.scene.beam.poisson = 0.3;
  }
  input.solver.method = method;
  input.output.interval = input.output.shapes = input.end_time / 20.0;
  input.output.shape_points = 10000;
  for (const double x : {0.0, 0.003, 0.2, 0.335, 0.5, 0.77, 0.995, 1.0}) {
    input.output.gauges.push_back({x, Face::back});
    input.output.gauges.push_back({x, Face::front});
  }
  const Result result = completed(input);
  std::map<double, std::vector<ShapeRow>> shapes;
  for (const ShapeRow& row : result.shapes) shapes[row.time].push_back(row);
  const Beam& beam = input.scene.beam;
  double largest = 0.0, difference = 0.0;
  for (const HistoryRow& row : result.history) {
    ASSERT_EQ(row.gauge_strains.size(), input.output.gauges.size());
    const auto shape = shapes.find(row.time);
    ASSERT_NE(shape, shapes.end());
    for (std::size_t i = 0; i < row.gauge_strains.size(); ++i) {
      const auto& [position, face] = input.output.gauges[i];
      const double expected = (face == Face::front ? 0.5 : -0.5) * beam.thickness *
                              moment_at(shape->second, position * beam.length) /
                              beam.bending_stiffness();
      difference = std::max(difference, std::abs(row.gauge_strains[i] - expected));
      largest = std::max(largest, std::abs(expected));
    }
  }
  EXPECT_GT(largest, 1e-4);
  EXPECT_LT(difference, 1e-9 * largest);
  RecordProperty("relative_difference", fmt::format("{:.2e}", difference / largest));
}

INSTANTIATE_TEST_SUITE_P(
    OnElasticBeams, AGauge,
    testing::Values(GaugeRun{MeshKind::cells, EndSupport::free, 0.5, Method::nystrom},
                    GaugeRun{MeshKind::cells, EndSupport::clamped, third, Method::exponential},
                    GaugeRun{MeshKind::hermite, EndSupport::clamped, 0.5, Method::nystrom},
                    GaugeRun{MeshKind::hermite, EndSupport::pinned, third, Method::nystrom},
                    GaugeRun{MeshKind::hermite, EndSupport::free, third, Method::exponential},
                    GaugeRun{MeshKind::spectral, EndSupport::free, third, Method::erk}));

// --- closed forms --------------------------------------------------------------------------------

// A pinned beam without contact, at rest under forces, in the time that the strike needs to arrive.
Case loaded_case(int segments, std::vector<PointForce> forces) {
  Case input = linear_case(MeshKind::cells, segments, 0.5, EndSupport::pinned);
  input.scene.beam.theory = BeamTheory::euler_bernoulli;
  input.scene.beam.start = BeamStart::equilibrium;
  input.scene.beam.forces = std::move(forces);
  input.scene.striker.velocity = 1e-3;
  input.scene.striker.gap = 1.0;
  return input;
}

TEST(Gauges, AgreeWithTheClosedFormOfABeamUnderAForce) {
  constexpr double force = 100.0;
  Case input = loaded_case(101, {{0.5, {{0.0, force}}}});
  input.end_time = 1e-4;
  input.output.interval = 1e-5;
  const std::vector<double> places = {0.0, 0.1, 0.25, 0.3333, 0.45, 0.6, 0.9};
  for (const double x : places) input.output.gauges.push_back({x});
  const Beam& beam = input.scene.beam;
  const double per_moment = 0.5 * beam.thickness / beam.bending_stiffness();
  const double largest = per_moment * 0.25 * force * beam.length;
  const Result result = completed(input);
  for (const HistoryRow& row : result.history) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      // The back is in tension where the force presses the beam down between its supports.
      const double moment = 0.5 * force * beam.length * std::min(places[i], 1.0 - places[i]);
      EXPECT_NEAR(row.gauge_strains[i], per_moment * moment, 1e-9 * largest) << places[i];
    }
  }
}

// The striker on its spring and the modes sin(k pi x/l) of a pinned beam as one eigenproblem, valid
// up to the end of the first contact. Modes beyond the first n follow the force as at rest.
TEST(APoint, MovesAsAModalSumOfAPinnedBeamStruckAtAThird) {
  using Real =
      long double;  // rounding of the largest squared frequency must not reach the smallest
  using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
  Case input = linear_case(MeshKind::hermite, 900, third, EndSupport::pinned);
  input.scene.contact.stiffness = 1e5;
  input.solver.method = Method::exponential;
  input.solver.rtol = 1e-12;
  input.output.interval = 2e-5;
  input.output.points = {0.5, 0.1};
  constexpr int n = 240;
  const Beam& beam = input.scene.beam;
  const Real l = beam.length, struck_at = l * third;
  const auto wave = [&](int k) { return (k + 1) * std::numbers::pi_v<Real> / l; };
  const auto stiffness = [&](int k) {
    return beam.bending_stiffness() * std::pow(wave(k), 4) * l / 2;
  };
  const auto compliance_of_rest = [&](Real x) {
    Real sum = 0.0;
    for (int k = n; k < 20 * n; ++k) {
      sum += std::sin(wave(k) * x) * std::sin(wave(k) * struck_at) / stiffness(k);
    }
    return sum;
  };
  const Real spring = 1 / (1 / Real(1e5) + compliance_of_rest(struck_at));
  Vector root_mass(n + 1), indentation(n + 1);
  Matrix matrix = Matrix::Zero(n + 1, n + 1);
  for (int k = 0; k < n; ++k) {
    const Real mass = beam.mass_per_length() + beam.rotary_inertia() * wave(k) * wave(k);
    root_mass(k) = std::sqrt(mass * l / 2);
    matrix(k, k) = stiffness(k);
    indentation(k) = -std::sin(wave(k) * struck_at);
  }
  root_mass(n) = std::sqrt(input.scene.striker.mass);
  indentation(n) = 1.0;
  matrix += spring * indentation * indentation.transpose();
  const auto inverse = root_mass.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(inverse * matrix * inverse);
  const Vector omega = solver.eigenvalues().cwiseSqrt();
  const Vector rates =
      solver.eigenvectors().row(n).transpose() * root_mass(n) * input.scene.striker.velocity;
  const Result result = completed(input);
  const double end = result.end_of(result.sub_impacts.front());
  ASSERT_GT(end, 1e-4);
  Real largest = 0.0, error = 0.0;
  for (const PointRow& row : result.point_history) {
    if (row.time > end) break;
    const Vector amplitudes =
        rates.array() * (omega.array() * Real(row.time)).sin() / omega.array();
    const Vector unknowns = inverse * (solver.eigenvectors() * amplitudes);
    Real expected = spring * indentation.dot(unknowns) * compliance_of_rest(row.position);
    for (int k = 0; k < n; ++k) expected += std::sin(wave(k) * row.position) * unknowns(k);
    largest = std::max(largest, std::abs(expected));
    error = std::max(error, std::abs(row.displacement - expected));
  }
  EXPECT_LT(error, 1e-8 * largest);
}

// --- yielding ------------------------------------------------------------------------------------

// Elastic-perfectly plastic layers of a rectangle, each with the stress of its middle.
class Layers {
 public:
  Layers(const Beam& beam, int n) : beam_(beam), stresses_(static_cast<std::size_t>(n)) {}

  // M, when the fibre of the back has reached a strain.
  double moment_at(double strain) {
    const double height = beam_.thickness / static_cast<double>(stresses_.size());
    double moment = 0.0;
    for (std::size_t i = 0; i < stresses_.size(); ++i) {
      const double z = (static_cast<double>(i) + 0.5) * height - 0.5 * beam_.thickness;
      const double change = (strain - strain_) * z / (0.5 * beam_.thickness);
      stresses_[i] = std::clamp(stresses_[i] + beam_.youngs_modulus * change, -beam_.yield_stress,
                                beam_.yield_stress);
      moment -= stresses_[i] * z * beam_.width * height;
    }
    strain_ = strain;
    return moment;
  }

 private:
  const Beam& beam_;
  std::vector<double> stresses_;
  double strain_ = 0.0;
};

TEST(Gauges, ReadTheStrainWithWhichFibresThatYieldGiveTheMoment) {
  constexpr int n_layers = 40;
  Case input = paper_case(SectionKind::layers, 4e-4, 101);
  input.model.layers = n_layers;
  input.output.interval = 2e-7;
  input.output.sections = {0.5, 0.46};
  const double l = input.scene.beam.length;
  const auto places = simulate(input).section_history;
  input.output.gauges = {{places[0].position / l, Face::back},
                         {places[1].position / l, Face::back}};
  const Beam& beam = input.scene.beam;
  std::vector<Layers> layers(2, Layers(beam, n_layers));
  const Result result = completed(input);
  double difference = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < result.history.size(); ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      const double strain = result.history[i].gauge_strains[k];
      const double moment = layers[k].moment_at(strain);
      difference =
          std::max(difference, std::abs(moment - result.section_history[2 * i + k].moment));
      largest = std::max(largest, std::abs(strain));
    }
  }
  EXPECT_GT(largest, 2.0 * beam.yield_stress / beam.youngs_modulus);
  EXPECT_LT(difference, 1e-4 * beam.yield_moment());
  RecordProperty("difference_over_yield_moment",
                 fmt::format("{:.2e}", difference / beam.yield_moment()));
}

// --- all readings --------------------------------------------------------------------------------

TEST(Readings, OfGaugesSectionsPointsAndShapesChangeNothingElse) {
  Case input = paper_case(SectionKind::exact, 2e-4, 51);
  input.output.interval = 1e-6;
  input.output.shapes = 0.0;
  const Result without = simulate(input);
  EXPECT_TRUE(without.shapes.empty() && without.envelope.empty());
  input.output.gauges = {{0.3, Face::front}};
  input.output.sections = input.output.points = {0.5};
  input.output.shapes = 1e-6;
  const Result with = simulate(input);
  EXPECT_FALSE(with.shapes.empty() || with.section_history.empty());
  EXPECT_EQ(with.history.size(), without.history.size());
  EXPECT_EQ(with.work.steps, without.work.steps);
  EXPECT_EQ(with.striker_velocity, without.striker_velocity);
}

TEST(Readings, WithoutHistoryRowsAreRefused) {
  Case gauges = paper_case(SectionKind::exact, 1e-4, 51), sections = gauges;
  gauges.output.gauges = {{0.3, Face::back}};
  sections.output.sections = {0.5};
  for (const Case& input : {gauges, sections}) EXPECT_THROW(simulate(input), InvalidCase);
}

}  // namespace
}  // namespace subimpact
