// Extremes along the beam: as they are found at instants, by themselves and many states at once,
// and how far they may lie from the true ones.

#include "paper_case.h"

namespace subimpact {
namespace {

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

TEST(ALargestMoment, LiesWithinItsErrorOfThatAtTenTimesAsManyInstants) {
  Case input = paper_case(SectionKind::elastic, 2e-3, 101, Method::central_difference);
  input.output.interval.reset();
  const Result coarse = simulate(input);
  input.output.interval = 1e-7;
  const Result fine = simulate(input);
  EXPECT_GT(coarse.peaks.moment.sampling_error(), 0.0);
  EXPECT_LE(fine.peaks.moment.largest - coarse.peaks.moment.largest,
            coarse.peaks.moment.sampling_error());
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

// Fields of states in modes are read many at a time.
TEST(TheEnvelope, BoundsEveryShapeOfABeamInModesAndIsReached) {
  Case input = case_in_modes();
  input.output.shapes = 1e-6;  // as the rows, so that nothing lies between shapes
  const Result result = simulate(input);
  const std::size_t n = result.used.n_shape_points;
  std::vector<double> largest(n, 0.0), smallest(n, 0.0);
  for (std::size_t k = 0; k < result.shapes.size(); ++k) {
    largest[k % n] = std::max(largest[k % n], result.shapes[k].moment);
    smallest[k % n] = std::min(smallest[k % n], result.shapes[k].moment);
  }
  const double scale = *std::ranges::max_element(largest);
  ASSERT_GT(scale, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(result.envelope[i].moment.largest.value, largest[i], 1e-7 * scale) << i;
    EXPECT_NEAR(result.envelope[i].moment.smallest.value, smallest[i], 1e-7 * scale) << i;
  }
  EXPECT_NEAR(result.peaks.moment.shared, std::max(scale, -*std::ranges::min_element(smallest)),
              1e-7 * scale);
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

}  // namespace
}  // namespace subimpact
