// Strikes on beams that shear: against times measured with other discretisations, by every method.

#include "order_table.h"
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

double largest_error(const std::vector<double>& found, const std::vector<double>& expected) {
  EXPECT_EQ(found.size(), expected.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) {
    largest = std::max(largest, std::abs(found[i] - expected[i]));
  }
  return largest;
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

TEST(Timoshenko, ConvergesOnSpectralElementsAtLowSpeedFasterThanSecondOrder) {
  const auto times = [](int elements) {
    Case input = at_low_speed(501, elements);
    input.solver.rtol = 1e-11;
    return times_us(simulate(input), 5);
  };
  const std::vector<double> expected = times(160);
  OrderTable table("largest error of five times, us, over elements");
  ASSERT_EQ(expected.size(), 5u);
  for (const int elements : {20, 40, 80}) {
    table.add(elements, largest_error(times(elements), expected));
  }
  table.print();
  table.expect_overall_order_within(2.5, 8.5);
}

TEST(Timoshenko, LeavesTheContactOfAYieldingBeamClosedUntil259Microseconds) {
  const auto first_end = [](int cells) {
    return end_us(simulate(shearing_case(SectionKind::exact, 0.27e-3, cells)).sub_impacts.at(0));
  };
  const double coarse = first_end(1001), fine = first_end(2001);
  EXPECT_NEAR(fine + (fine - coarse) / 3.0, 259.0, 0.5);
}

struct Scene {
  std::string name;
  SectionKind section;
  Ends ends;
  double position;
};
std::ostream& operator<<(std::ostream& out, const Scene& scene) { return out << scene.name; }

class TimoshenkoScene : public testing::TestWithParam<Scene> {
 protected:
  Case input() const {
    Case input = shearing_case(GetParam().section, 0.5e-3, 201);
    input.scene.beam.ends = GetParam().ends;
    input.scene.striker.position = GetParam().position;
    input.solver.rtol = 1e-9;
    return input;
  }
};

INSTANTIATE_TEST_SUITE_P(
    , TimoshenkoScene,
    testing::Values(Scene{"elastic", SectionKind::elastic, {free_end, free_end}, 0.5},
                    Scene{"exact", SectionKind::exact, {free_end, free_end}, 0.5},
                    Scene{"layers", SectionKind::layers, {free_end, free_end}, 0.31},
                    Scene{"pinned_exact", SectionKind::exact, {pinned, pinned}, 0.5},
                    Scene{"clamped_exact", SectionKind::exact, {clamped, free_end}, 0.7},
                    Scene{"held_elastic", SectionKind::elastic, {clamped, pinned}, 0.37}),
    NamedAsPrinted{});

TEST_P(TimoshenkoScene, MovesAlikeByEveryMethodThatLocatesEvents) {
  const Result expected = completed(input());
  ASSERT_GE(expected.sub_impacts.size(), 2u);
  struct Tried {
    const char* name;
    Method method;
    double rtol, tolerance_us;
  };
  for (const Tried& tried :
       {Tried{"erk", Method::erk, 1e-9, 1e-4},
        Tried{"exponential", Method::exponential, 1e-9, 1e-4},
        Tried{"dirk", Method::dirk, 1e-8, 2e-4}, Tried{"adams", Method::adams, 1e-9, 1e-3},
        Tried{"bdf", Method::bdf, 1e-9, 1e-3}}) {
    Case other = input();
    other.solver.method = tried.method;
    other.solver.rtol = tried.rtol;
    other.end_time = tried.method == Method::erk || tried.method == Method::exponential
                         ? other.end_time
                         : 0.3e-3;
    SCOPED_TRACE(tried.name);
    const std::vector<double> times = times_us(completed(other), 9);
    ASSERT_GE(times.size(), 1u);
    for (std::size_t i = 0; i < times.size(); ++i) {
      EXPECT_NEAR(times[i], times_us(expected, 9).at(i), tried.tolerance_us) << i;
    }
  }
}

TEST_P(TimoshenkoScene, ConservesEnergyAndMomentum) {
  const Result result = simulate(input());
  EXPECT_LT(result.max_energy_error, 1e-8);
  EXPECT_LT(result.max_momentum_error.value_or(0.0), 1e-12);
}

TEST_P(TimoshenkoScene, ConvergesByCentralDifferencesAtSecondOrder) {
  Case fine = input();
  fine.end_time = 0.4e-3;
  const std::vector<double> expected = times_us(simulate(fine), 3);
  ASSERT_EQ(expected.size(), 3u);
  OrderTable table("largest error of the first three times, us");
  for (const double part : {1.0, 2.0, 4.0}) {
    Case input = fine;
    input.solver.method = Method::central_difference;
    input.solver.step = 1e-7 / part;
    table.add(part, largest_error(times_us(simulate(input), 3), expected));
  }
  table.print();
  EXPECT_GE(table.overall_order(), 1.5);
  EXPECT_LE(table.overall_order(), 2.6);
}

}  // namespace
}  // namespace subimpact
