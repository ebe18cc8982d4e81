// Fields along the beam over whole runs: energy of shapes, extremes, supports' momentum.

#include <fmt/ranges.h>

#include "linear_case.h"
#include "order_table.h"

namespace subimpact {
namespace {

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
  const Result at_nodes = simulate(subimpact::at_nodes(input));
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

// --- extremes --------------------------------------------------------------------------------

TEST(ASampledPeak, BoundsTheTopOfAParabolaBetweenItsInstants) {
  constexpr double drop = 0.01;  // a unit of time from the top
  for (double top = -0.5; top <= 0.5; top += 0.125) {
    SampledPeak peak;
    for (int i = -3; i <= 3; ++i) peak.follow(1.0 - drop * (i - top) * (i - top), i % 2 == 0);
    EXPECT_LE(peak.largest, 1.0);
    EXPECT_GE(peak.largest + peak.sampling_error(), 1.0 - 1e-15) << top;
    EXPECT_NEAR(peak.sampling_error(), 0.25 * drop, 1e-15) << top;
    EXPECT_EQ(peak.shared, 1.0 - drop * top * top) << top;
  }
}

Case case_in_modes() {
  Case input = paper_case(SectionKind::elastic, 0.5e-3, 501, Method::exponential);
  input.scene.contact = {ContactKind::linear, 2e6, {}, {}, {}};
  input.scene.striker.position = 0.4;
  input.model.mesh = MeshKind::hermite;
  input.model.elements = 40;
  input.output.interval = 1e-6;
  return input;
}

TEST(TheEnvelope, BoundsEveryShapeAndIsReached) {
  Case yielding = paper_case(SectionKind::exact, 1e-3, 101);
  yielding.output.interval = 1e-6;
  // Fields of states in modes are read many at a time.
  for (Case input : {yielding, case_in_modes()}) {
    input.output.shapes = input.output.interval;  // so that nothing lies between shapes
    const Result result = simulate(input);
    const std::size_t n = result.used.n_shape_points;
    ASSERT_EQ(result.envelope.size(), n);
    std::vector<double> largest(n, 0.0), smallest(n, 0.0);
    const double rounding = 1e-7 * result.peaks.moment.shared;
    for (std::size_t k = 0; k < result.shapes.size(); ++k) {
      const ShapeRow& row = result.shapes[k];
      const EnvelopeRow& here = result.envelope[k % n];
      ASSERT_EQ(row.position, here.position);
      largest[k % n] = std::max(largest[k % n], row.moment);
      smallest[k % n] = std::min(smallest[k % n], row.moment);
      EXPECT_LE(row.displacement, here.displacement.largest.value + 1e-12);
      EXPECT_LE(-row.curvature * 0.5 * input.scene.beam.thickness,
                here.strain.largest.value + 1e-10);
      EXPECT_LE(row.plastic_curvature, here.plastic_curvature.largest.value);
      if (row.time == here.moment.largest.time) {
        EXPECT_NEAR(row.moment, here.moment.largest.value, rounding);
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_NEAR(result.envelope[i].moment.largest.value, largest[i], rounding) << i;
      EXPECT_NEAR(result.envelope[i].moment.smallest.value, smallest[i], rounding) << i;
    }
    if (result.n_yielded_sections > 0) continue;  // with shapes at events, too
    EXPECT_NEAR(result.peaks.moment.shared,
                std::max(std::ranges::max(largest), -std::ranges::min(smallest)), rounding);
  }
}

// So that runs beside one another can be compared whatever shapes one of them keeps.
TEST(TheExtremesOfShapes, AreOfTheSameInstantsHoweverFewShapesAreKept) {
  Case input = case_in_modes();
  input.output.interval.reset();
  const Result usual = simulate(input);
  input.output.shapes = 0.1 * input.end_time;
  const Result few = simulate(input);
  input.output.shapes = input.output.extremes_interval(input.end_time);
  input.output.interval = 0.0;  // as a run beside
  const Result none = simulate(input);
  EXPECT_LT(5 * few.n_shape_rows, usual.n_shape_rows);
  for (const Result* other : {&few, &none}) {
    EXPECT_NEAR(other->peaks.moment.shared / usual.peaks.moment.shared, 1.0, 1e-7);
    EXPECT_NEAR(other->peaks.displacement.shared / usual.peaks.displacement.shared, 1.0, 1e-7);
    EXPECT_NEAR(other->peaks.strain.shared / usual.peaks.strain.shared, 1.0, 1e-7);
  }
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

TEST(Reactions, HaveTheirExtremesInTheResultAndAWarningWhereASupportPulls) {
  for (const EndSupport end : {pinned, clamped}) {
    for (const double interval : {1e-6, 0.0}) {
      Case input = linear_case(MeshKind::hermite, 30, third, end);
      input.output.interval = interval;
      if (interval == 0.0) input.output.shapes = 1e-6;
      const Result result = completed(input);
      double least = 0.0, largest = 0.0;
      for (const HistoryRow& row : result.history) {
        least = std::min({least, *row.first_reaction, *row.last_reaction});
        largest = std::max({largest, *row.first_reaction, *row.last_reaction});
      }
      ASSERT_TRUE(result.reactions[0] && result.reactions[1]);
      const auto& [first, last] = result.reactions;
      EXPECT_LE(std::min(first->smallest.value, last->smallest.value), least);
      EXPECT_GE(std::max(first->largest.value, last->largest.value), largest);
      EXPECT_GT(largest, interval > 0.0 ? 0.0 : -1.0) << "waves lift the ends first";
      const std::string warnings = fmt::format("{}", fmt::join(result.warnings, "\n"));
      EXPECT_EQ(warnings.find("pulls the beam by up to") != std::string::npos, end == pinned);
    }
  }
  Case free = linear_case(MeshKind::hermite, 30, third, EndSupport::free);
  EXPECT_FALSE(completed(free).reactions[0]);
}

}  // namespace
}  // namespace subimpact
