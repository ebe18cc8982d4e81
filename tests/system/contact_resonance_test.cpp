// The highest frequency of beam and striker joined by the contact, against dense eigenvalues.

#include "system/contact_resonance.h"

#include "beam_under_test.h"
#include "dense.h"
#include "model/contact_laws.h"
#include "testing.h"

namespace subimpact {
namespace {

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
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness, mass,
                                                                         Eigen::EigenvaluesOnly);
  return std::sqrt(solver.eigenvalues().maxCoeff());
}

TEST_P(JoinedBodies, HaveTheFrequencyOfTheDenseEigenvalueProblem) {
  const StruckBeam beam = make_beam(GetParam());
  const double alone = beam.mesh().highest_frequency(beam.sections().stiffness());
  for (const double stiffer : {1e-3, 1.0, 1e3, 1e6}) {
    const double indentation = 1e-4 * stiffer * stiffer;  // the slope grows as its root
    const ContactResonance found = contact_resonance(beam, indentation);
    const double exact = dense_frequency(beam, found.largest_slope);
    std::printf("slope %.1e N/m: joined %.6e rad/s, dense %.6e, beam alone %.6e\n",
                found.largest_slope, found.highest_frequency, exact, alone);
    EXPECT_GE(found.highest_frequency, exact * (1.0 - 1e-6));
    EXPECT_LE(found.highest_frequency, std::max(exact, alone) * (1.0 + 1e-6));
  }
}

INSTANTIATE_TEST_SUITE_P(, JoinedBodies, testing::ValuesIn(models()));

TEST(TheLargestIndentation, TakesTheWholeEnergyOfTheStrike) {
  for (const double yield : {1e-5, 1e-3, std::numeric_limits<double>::infinity()}) {
    for (const double exponent : {1.0, 1.5}) {
      const PowerContact law(1e9, exponent, yield);
      for (const double energy : {1e-6, 1e-2, 10.0}) {
        const double indentation = law.indentation_at(energy);
        const ContactHistory reached{indentation};
        EXPECT_NEAR(law.recoverable_energy(reached, indentation) + law.dissipated_energy(reached),
                    energy, 1e-9 * energy);
      }
    }
  }
}

}  // namespace
}  // namespace subimpact
