// Strikes on beams that shear: against times measured with other discretisations.

#include "paper_case.h"

namespace subimpact {
namespace {

Case shearing_case(SectionKind section, double end_time, int cells) {
  Case input = paper_case(section, end_time, cells, Method::nystrom);
  input.scene.beam.theory = BeamTheory::timoshenko;
  input.scene.beam.poisson = 0.33;
  input.scene.beam.shear_coefficient = 5.0 / 6.0;
  return input;
}

// The first n times of ends and starts by turns, us; fewer if contact is open at the end.
std::vector<double> times_us(const Result& result, std::size_t n) {
  std::vector<double> times;
  for (const SubImpact& s : result.sub_impacts) {
    if (!times.empty()) times.push_back(start_us(s));
    if (s.end) times.push_back(end_us(s));
  }
  times.resize(std::min(times.size(), n));
  return times;
}

Case at_low_speed(int cells, int elements = 0) {
  Case input = shearing_case(SectionKind::elastic, 0.66e-3, cells);
  input.scene.striker.velocity = 0.1;
  if (elements == 0) return input;
  input.model.mesh = MeshKind::spectral;
  input.model.elements = elements;
  return input;
}

// Two independent discretisations, converged to 0.05 us: the ends and starts at 0.1 m/s.
constexpr double times_at_low_speed_us[] = {424.18, 448.00, 503.00, 578.83, 636.60};

TEST(Timoshenko, HasTheTimesOfOtherDiscretisationsInTheLimitOfFineCells) {
  std::vector<std::vector<double>> times;
  for (const int cells : {501, 1001, 2001}) {
    times.push_back(times_us(simulate(at_low_speed(cells)), 5));
    ASSERT_EQ(times.back().size(), 5u);
  }
  for (std::size_t i = 0; i < 5; ++i) {
    const double coarse = times[1][i] - times[0][i];
    const double fine = times[2][i] - times[1][i];
    const double order = std::log(coarse / fine) / std::log(2.0);
    const double limit = times[2][i] + fine / 3.0;
    EXPECT_NEAR(limit, times_at_low_speed_us[i], 0.05);
    EXPECT_NEAR(order, 2.0, 0.3);
  }
}

TEST(Timoshenko, HasTheSameTimesOnSpectralElements) {
  expect_near(times_us(simulate(at_low_speed(501, 60)), 5), times_at_low_speed_us, 0.05);
}

TEST(Timoshenko, LeavesTheContactOfAYieldingBeamClosedUntil259Microseconds) {
  const auto first_end = [](int cells) {
    return end_us(simulate(shearing_case(SectionKind::exact, 0.27e-3, cells)).sub_impacts.at(0));
  };
  const double coarse = first_end(1001), fine = first_end(2001);
  EXPECT_NEAR(fine + (fine - coarse) / 3.0, 259.0, 0.5);
}

}  // namespace
}  // namespace subimpact
