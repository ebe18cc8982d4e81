// The struck beam as implicit methods see it: force, mass, pattern, and the tangent stiffness
// against differences of the force, in every branch of the contact and over sections at rest,
// flowing and reversed.

#include "beam_under_test.h"
#include "dense.h"
#include "model/contact/power_contact.h"
#include "system/contact/contact_resonance.h"

namespace subimpact {
namespace {

constexpr double unit = 1.56337e-5;  // yield indentation, m

struct Contact {
  const char* name;
  ContactBranch branch;
  double largest, now;  // indentations in units of the yield indentation
};

void PrintTo(const Contact& contact, std::ostream* out) { *out << contact.name; }

std::vector<double> force(StruckBeam& beam, const State& y) {
  std::vector<double> result(beam.n_positions());
  beam.force({y.data(), result.size()}, result);
  return result;
}

class Tangent : public testing::TestWithParam<Contact> {
 protected:
  // Largest difference, column by column, relative to the largest entry of the column.
  double worst_column(StruckBeam& beam, const State& y) {
    const std::size_t n = beam.n_positions();
    const SparsityPattern& pattern = beam.pattern();
    std::vector<double> stiffness(pattern.n_entries());
    beam.stiffness_entries({y.data(), n}, stiffness);
    double worst = 0.0;
    for (std::size_t j = 0; j < n; ++j) {
      const double h = 1e-12;
      State ahead = y, behind = y;
      ahead[j] += h;
      behind[j] -= h;
      const std::vector<double> f1 = force(beam, ahead);
      const std::vector<double> f0 = force(beam, behind);
      std::vector<double> column(n, 0.0);
      double size = 0.0;
      for (std::size_t k = pattern.column_starts[j]; k < pattern.column_starts[j + 1]; ++k) {
        column[pattern.rows[k]] = stiffness[k];
        size = std::max(size, std::abs(stiffness[k]));
      }
      for (std::size_t i = 0; i < n; ++i) {
        const double difference = std::abs(column[i] - (f0[i] - f1[i]) / (2.0 * h));
        worst = std::max(worst, difference / std::max(size, 1e3));
      }
    }
    return worst;
  }
};

INSTANTIATE_TEST_SUITE_P(, Tangent,
                         testing::Values(Contact{"separated", ContactBranch::separated, 3.0, 1.5},
                                         Contact{"first_elastic", ContactBranch::elastic, 0.0, 0.7},
                                         Contact{"reloaded_elastic", ContactBranch::elastic, 3.0,
                                                 2.6},
                                         Contact{"plastic", ContactBranch::plastic, 2.0, 3.5}),
                         NamedAsPrinted{});

TEST_P(Tangent, IsMinusTheDerivativeOfTheForceInThisBranch) {
  const Contact& contact = GetParam();
  for (const Model& model : models()) {
    for (const bool turned : {false, true}) {
      StruckBeam beam = make_beam(model);
      enter(beam, contact.branch, contact.largest * unit);
      // Sections driven to twice their yield curvature, then further on, or part of the way back.
      beam.commit(smooth_state(beam, 5, 2.0, contact.largest * unit, 1.0));
      const State y = smooth_state(beam, 5, turned ? -0.5 : 2.3, contact.now * unit, 1.0);
      const double worst = worst_column(beam, y);
      EXPECT_LT(worst, 2e-5) << model.name << (turned ? ", turned" : ", flowing");
    }
  }
}

TEST_P(Tangent, FollowsTheIndentationWhereTheForceDoes) {
  const Contact& contact = GetParam();
  StruckBeam beam = make_beam(models().back());
  enter(beam, ContactBranch::separated, contact.largest * unit);
  beam.contact().set_evaluation(Evaluation::switching);
  const State y = smooth_state(beam, 6, 0.8, contact.now * unit, 1.0);
  EXPECT_LT(worst_column(beam, y), 2e-5);
}

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
};

INSTANTIATE_TEST_SUITE_P(Models, MechanicalBeam, testing::ValuesIn(models()), NamedAsPrinted{});

TEST_P(MechanicalBeam, MassTimesAccelerationIsForce) {
  enter(beam_, ContactBranch::elastic, 3.0 * unit);
  const State y = smooth_state(beam_, 4, 2.0, 2.7 * unit, 1.0);
  std::vector<double> a(n_), mass(beam_.pattern().n_entries());
  beam_.acceleration({y.data(), n_}, a);
  beam_.mass_entries(mass);
  const std::vector<double> product = multiply(beam_.pattern(), mass, a);
  const std::vector<double> all = force(beam_, y);
  expect_near(product, all, 1e-12 * largest_of(all));
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

// The highest frequency of beam and striker joined by the contact, against dense eigenvalues.

class JoinedBodies : public testing::TestWithParam<Model> {};

double dense_frequency(const StruckBeam& beam, double slope) {
  const Eigen::Index n = index(beam.mesh().n_unknowns());
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n + 1, n + 1);
  mass.topLeftCorner(n, n) = dense(beam.mesh().mass());
  mass(n, n) = beam.striker_mass();
  Eigen::VectorXd d = Eigen::VectorXd::Zero(n + 1);
  std::vector<double> struck(beam.mesh().n_unknowns(), 0.0);
  beam.mesh().struck_point().add_to(struck, 1.0);
  for (Eigen::Index i = 0; i < n; ++i) d(i) = -struck[static_cast<std::size_t>(i)];
  d(n) = 1.0;
  Eigen::MatrixXd stiffness = slope * d * d.transpose();
  stiffness.topLeftCorner(n, n) += stiffness_matrix(beam.mesh(), beam.sections().stiffness());
  return std::sqrt(largest_eigenvalue(stiffness, mass));
}

TEST_P(JoinedBodies, HaveTheFrequencyOfTheDenseEigenvalueProblem) {
  const StruckBeam beam = make_beam(GetParam());
  const double alone = beam.mesh().highest_frequency(beam.sections().stiffness());
  for (const double stiffer : {1e-3, 1.0, 1e3, 1e6}) {
    const double indentation = 1e-4 * stiffer * stiffer;  // the slope grows as its root
    const ContactResonance found = contact_resonance(beam, indentation);
    const double exact = dense_frequency(beam, found.largest_slope);
    EXPECT_GE(found.highest_frequency, exact * (1.0 - 1e-6));
    EXPECT_LE(found.highest_frequency, std::max(exact, alone) * (1.0 + 1e-6));
  }
}

INSTANTIATE_TEST_SUITE_P(, JoinedBodies, testing::ValuesIn(models()));

}  // namespace
}  // namespace subimpact
