// The struck beam as implicit methods see it: forces, mass and tangent stiffness.

#include "beam_under_test.h"

namespace subimpact {
namespace {

constexpr double unit = 1.56337e-5;  // yield indentation

// y = A x for the entries of a pattern.
std::vector<double> multiply(const SparsityPattern& pattern, const std::vector<double>& entries,
                             std::span<const double> x) {
  std::vector<double> y(pattern.size(), 0.0);
  for (std::size_t j = 0; j < pattern.size(); ++j) {
    for (std::size_t k = pattern.column_starts[j]; k < pattern.column_starts[j + 1]; ++k) {
      y[pattern.rows[k]] += entries[k] * x[j];
    }
  }
  return y;
}

class MechanicalBeam : public testing::TestWithParam<Model> {
 protected:
  StruckBeam beam_ = make_beam(GetParam());
  std::size_t n_ = beam_.n_positions();
  std::vector<double> force(const State& y) {
    std::vector<double> result(n_);
    beam_.force({y.data(), n_}, result);
    return result;
  }
};

INSTANTIATE_TEST_SUITE_P(Models, MechanicalBeam, testing::ValuesIn(models()), NamedAsPrinted{});

TEST_P(MechanicalBeam, MassTimesAccelerationIsForce) {
  enter(beam_, ContactBranch::elastic, 3.0 * unit);
  const State y = smooth_state(beam_, 4, 2.0, 2.7 * unit, 1.0);
  std::vector<double> a(n_), mass(beam_.pattern().n_entries());
  beam_.acceleration({y.data(), n_}, a);
  beam_.mass_entries(mass);
  const std::vector<double> product = multiply(beam_.pattern(), mass, a);
  const std::vector<double> all = force(y);
  expect_near(product, all, 1e-12 * largest_of(all));
}

TEST_P(MechanicalBeam, StiffnessIsMinusTheDerivativeOfTheForce) {
  enter(beam_, ContactBranch::plastic, 2.0 * unit);
  beam_.commit(smooth_state(beam_, 8, 1.8, 2.0 * unit, 1.0));
  const State y = smooth_state(beam_, 3, 2.0, 4.0 * unit, 1.0);
  std::vector<double> stiffness(beam_.pattern().n_entries());
  beam_.stiffness_entries({y.data(), n_}, stiffness);
  for (unsigned seed = 0; seed < 5; ++seed) {
    std::vector<double> direction = random_numbers(seed, n_);
    const double h = 1e-11;
    State ahead = y, behind = y;
    for (std::size_t i = 0; i < n_; ++i) {
      ahead[i] += h * direction[i];
      behind[i] -= h * direction[i];
    }
    const std::vector<double> expected = multiply(beam_.pattern(), stiffness, direction);
    const std::vector<double> f1 = force(ahead), f0 = force(behind);
    for (std::size_t i = 0; i < n_; ++i) {
      EXPECT_NEAR(expected[i], (f0[i] - f1[i]) / (2.0 * h), 1e-4 * largest_of(expected) + 1e-6);
    }
  }
}

TEST_P(MechanicalBeam, PatternIsAscendingAndSymmetric) {
  const SparsityPattern& pattern = beam_.pattern();
  ASSERT_EQ(pattern.size(), n_);
  const auto has = [&](std::size_t i, std::size_t j) {
    const auto begin = pattern.rows.begin() + static_cast<std::ptrdiff_t>(pattern.column_starts[j]);
    const auto end =
        pattern.rows.begin() + static_cast<std::ptrdiff_t>(pattern.column_starts[j + 1]);
    return std::find(begin, end, i) != end;
  };
  for (std::size_t j = 0; j < n_; ++j) {
    for (std::size_t k = pattern.column_starts[j]; k < pattern.column_starts[j + 1]; ++k) {
      EXPECT_TRUE(k == pattern.column_starts[j] || pattern.rows[k - 1] < pattern.rows[k]);
      EXPECT_TRUE(has(j, pattern.rows[k]));
    }
    EXPECT_TRUE(has(j, j));
  }
}

}  // namespace
}  // namespace subimpact
