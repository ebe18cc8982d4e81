// The struck beam's equations: what they conserve, and that they are what the header says.

#include "beam_under_test.h"
#include "system/readings/accounts.h"

namespace subimpact {
namespace {

constexpr double lambda_s = 1.56337e-5;

struct Situation {
  const char* name;
  ContactBranch branch;
  double max_indentation, indentation, rate, bending;
};

const Situation situations[] = {
    {"apart", ContactBranch::separated, 0.0, -1e-5, 1.0, 0.5},
    {"first touch", ContactBranch::elastic, 0.0, 0.4 * lambda_s, 9.0, 0.7},
    {"flowing contact", ContactBranch::plastic, 2.0 * lambda_s, 4.0 * lambda_s, 5.0, 2.0},
    {"unloading contact", ContactBranch::elastic, 6.0 * lambda_s, 5.5 * lambda_s, -3.0, 3.0},
};

TEST(StruckBeam, CommitsTheStateEvaluatedLastAsItCommitsAnyState) {
  for (const Model& model : models()) {
    SCOPED_TRACE(model.name);
    StruckBeam any = make_beam(model);
    StruckBeam evaluated = make_beam(model);
    bool flowed = false;
    for (const double bending : {0.5, 1.5, 3.0, 2.9, -2.0, 1.0, 2.5}) {
      const State y = smooth_state(any, 5, bending, 2.0 * lambda_s, 1.0);
      std::vector<double> ignored(evaluated.n_positions());
      evaluated.acceleration({y.data(), ignored.size()}, ignored);
      const bool flows = any.commit(y);
      EXPECT_EQ(evaluated.commit_evaluated(y), flows);
      flowed = flowed || flows;
      EXPECT_EQ(evaluated.contact().history().max_indentation,
                any.contact().history().max_indentation);
      for (std::size_t i = 0; i < any.sections().size(); ++i) {
        ASSERT_EQ(evaluated.sections().window_low()[i], any.sections().window_low()[i]);
        ASSERT_EQ(evaluated.sections().window_high()[i], any.sections().window_high()[i]);
      }
    }
    EXPECT_EQ(flowed, model.yields);
  }
}

TEST(StruckBeam, BeginsTouchingWithAllEnergyAndMomentumInTheStriker) {
  for (const Model& model : models()) {
    SCOPED_TRACE(model.name);
    StruckBeam beam = make_beam(model);
    const State y = beam.initial_state();
    const Energies energies = Accounts(beam).energies(y);
    EXPECT_EQ(energies.total(), energies.striker);
    EXPECT_NEAR(energies.striker, 25.4074, 0.5e-4);
    EXPECT_NEAR(Accounts(beam).momentum(y), 3.1959, 0.5e-4);
    EXPECT_NEAR(beam.mesh().beam_mass(), 0.2260549, 0.5e-7);
    EXPECT_EQ(beam.indentation(y), 0.0);
    EXPECT_EQ(beam.indentation_rate(y), 15.9);
  }
}

TEST(StruckBeam, AccelerationLeavesTheTotalMomentumAlone) {
  for (const Model& model : models()) {
    for (const Situation& now : situations) {
      for (unsigned seed = 0; seed < 5; ++seed) {
        StruckBeam beam = make_beam(model);
        enter(beam, now.branch, now.max_indentation);
        const State y = smooth_state(beam, seed, now.bending, now.indentation, now.rate);
        beam.commit(y);
        const std::size_t n = beam.n_positions();
        // The momentum of the accelerations as if they were velocities is the momentum's rate.
        State rates = y;
        beam.acceleration({y.data(), n}, {rates.data() + n, n});
        double size = std::abs(beam.contact_force(y));
        for (std::size_t i = n; i + 1 < 2 * n; ++i) {
          size += std::abs(rates[i]) * beam.mesh().beam_mass() / static_cast<double>(n);
        }
        EXPECT_NEAR(Accounts(beam).momentum(rates), 0.0, 1e-12 * size)
            << model.name << ", " << now.name;
      }
    }
  }
}

TEST(StruckBeam, EveryJouleStaysInTheAccountsAlongTheFlow) {
  for (const Model& model : models()) {
    for (const Situation& now : situations) {
      for (unsigned seed = 0; seed < 5; ++seed) {
        StruckBeam beam = make_beam(model);
        enter(beam, now.branch, now.max_indentation);
        // Bent and let be, then somewhere else: sections flow, unload and rest.
        beam.commit(smooth_state(beam, seed + 70, 0.6 * now.bending, 0.8 * now.indentation, 0.0));
        const State y = smooth_state(beam, seed, now.bending, now.indentation, now.rate);
        const double h = 1e-9;
        const Energies behind = Accounts(beam).energies(along_the_flow(beam, y, h));
        const Energies before = Accounts(beam).energies(along_the_flow(beam, y, -h));
        const double power = (behind.total() - before.total()) / (2.0 * h);
        const double exchanged = (std::abs(behind.striker - before.striker) +
                                  std::abs(behind.beam_kinetic - before.beam_kinetic)) /
                                 (2.0 * h);
        EXPECT_NEAR(power, 0.0, 2e-5 * exchanged) << model.name << ", " << now.name << ", " << seed;
        EXPECT_GT(exchanged, 1.0);
      }
    }
  }
}

TEST(StruckBeam, SmoothContactGoesOnWhereSwitchingContactLetsGo) {
  StruckBeam beam = make_beam(models()[0]);
  enter(beam, ContactBranch::elastic, 3.0 * lambda_s);
  const State inside = smooth_state(beam, 1, 0.3, 2.5 * lambda_s, 0.0);
  const State apart = smooth_state(beam, 1, 0.3, 1.5 * lambda_s, 0.0);  // below the residual 2
  const double force = beam.contact_force(inside);
  EXPECT_GT(force, 0.0);
  EXPECT_LT(beam.contact_force(apart), 0.0);
  beam.contact().set_evaluation(Evaluation::switching);
  EXPECT_EQ(beam.contact_force(inside), force);
  EXPECT_EQ(beam.contact_force(apart), 0.0);
}

}  // namespace
}  // namespace subimpact
