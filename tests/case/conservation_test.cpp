// Momentum and energy at every accepted step, and in the rows of history.csv.

#include "paper_case.h"
#include "simulate/loop/event_loop.h"
#include "simulate/run_parts.h"

namespace subimpact {
namespace {

// Looks at every accepted state: the start of every step, and both sides of every event.
class Conserved final : public RunObserver {
 public:
  Conserved(const StruckBeam& beam, const State& initial)
      : accounts_(beam),
        energy_(accounts_.energies(initial).total()),
        momentum_(accounts_.momentum(initial)) {}

  void on_step(const ObservedStep& step, StruckBeam&) override {
    look_at(step.y0());
    ++steps;
  }
  void before_event(const Transition&, const State& y, StruckBeam&) override { look_at(y); }
  void after_event(const Transition&, const State& y, StruckBeam&) override { look_at(y); }

  double energy_error = 0.0;    // largest, relative
  double momentum_error = 0.0;  // largest, relative
  double plastic_loss = 0.0;    // largest decrease of a dissipated energy, J
  long steps = 0;

 private:
  void look_at(const State& y) {
    const Energies now = accounts_.energies(y);
    energy_error = std::max(energy_error, std::abs(now.total() / energy_ - 1.0));
    momentum_error = std::max(momentum_error, std::abs(accounts_.momentum(y) / momentum_ - 1.0));
    plastic_loss = std::max({plastic_loss, dissipated_.bending_plastic - now.bending_plastic,
                             dissipated_.contact_plastic - now.contact_plastic});
    dissipated_ = now;
  }
  Accounts accounts_;
  double energy_;
  double momentum_;
  Energies dissipated_;
};

Conserved followed(const Case& input) {
  ResolvedRun run = resolve(input);
  StruckBeam& beam = run.parts().beam;
  const auto integrator = run.parts().make_integrator();
  Conserved conserved(beam, beam.initial_state());
  Audit accounts(beam, beam.initial_state());
  EventLoop loop(beam, *integrator, conserved, accounts, loop_options(run.parts()));
  loop.start();
  while (!loop.finished()) loop.advance();
  return conserved;
}

void expect_conserved(const Case& input, long least_steps = 100, double of_momentum = 1e-12,
                      double of_loss = 1e-12) {
  const Conserved conserved = followed(input);
  EXPECT_GT(conserved.steps, least_steps);
  EXPECT_LT(conserved.energy_error, 1e-8);
  EXPECT_LT(conserved.momentum_error, of_momentum);
  EXPECT_LT(conserved.plastic_loss, of_loss);
}

class Conservation : public testing::TestWithParam<SectionKind> {};

TEST_P(Conservation, HoldsAtEveryStepOfErkAtOneInABillion) {
  expect_conserved(paper_case(GetParam(), 2e-3), 1000);
}

TEST_P(Conservation, HoldsAtEveryStepOfTheExponentialMethod) {
  expect_conserved(paper_case(GetParam(), 4e-3, 501, Method::exponential), 100, 1e-11, 1e-11);
}

TEST_P(Conservation, OfMomentumHoldsAtEveryCentralDifference) {
  const Conserved conserved =
      followed(paper_case(GetParam(), 2e-3, 501, Method::central_difference));
  EXPECT_LT(conserved.momentum_error, 1e-12);
  EXPECT_LT(conserved.energy_error, 0.05);  // of second order in the step
}

TEST_P(Conservation, HoldsForAStrikeAwayFromMidSpanBetweenTwoCells) {
  Case input = paper_case(GetParam(), 0.5e-3, 200);
  input.scene.striker.position = 0.31;
  const Conserved conserved = followed(input);
  EXPECT_LT(conserved.energy_error, 1e-8);
  EXPECT_LT(conserved.momentum_error, 1e-12);
}

TEST_P(Conservation, HoldsOnHermiteElements) {
  Case input = paper_case(GetParam(), 2e-3);
  input.model.mesh = MeshKind::hermite;
  input.model.elements = 100;
  expect_conserved(input);
}

TEST_P(Conservation, IsReportedInTheHistoryRows) {
  Case input = paper_case(GetParam(), 0.5e-3);
  input.output.interval = 1e-6;
  const Result result = simulate(input);
  ASSERT_GT(result.history.size(), 500u);
  for (const HistoryRow& row : result.history) {
    const double sum = row.striker_energy + row.beam_kinetic_energy + row.bending_elastic +
                       row.bending_plastic + row.contact_elastic + row.contact_plastic;
    EXPECT_NEAR(sum / result.used.initial_energy - 1.0, row.energy_error, 1e-14);
    EXPECT_LT(std::abs(row.energy_error), 1e-8) << row.time;
    EXPECT_LT(std::abs(row.momentum_error.value()), 1e-12) << row.time;
  }
}

/// A row per contact law of a case file: with its constants, on a section that it describes.
struct ShapedStrike {
  const char* name;
  ContactKind law;
  CrossSection section;
  IndentationFrom indentation = IndentationFrom::half_space;
  bool by_depth = false;
};

const CrossSection rectangle{.shape = SectionShape::rectangle, .height = 0.0075, .width = 0.0163};

const ShapedStrike laws[] = {
    {"foundation on a circle",
     ContactKind::foundation,
     {.shape = SectionShape::circle, .diameter = 0.011}},
    {"hertz on a tube",
     ContactKind::hertz,
     {.shape = SectionShape::tube, .diameter = 0.016, .wall = 0.0025}},
    {"linear on a box",
     ContactKind::linear,
     {.shape = SectionShape::box, .height = 0.012, .width = 0.016, .wall = 0.0015}},
    {"sphere on an I",
     ContactKind::sphere,
     {.shape = SectionShape::i, .height = 0.014, .width = 0.012, .flange = 0.002, .web = 0.0015}},
    {"sphere on a rectangle", ContactKind::sphere, rectangle},
    {"sphere from the mid-plane", ContactKind::sphere, rectangle, IndentationFrom::mid_plane},
    {"sphere by depth", ContactKind::sphere, rectangle, IndentationFrom::mid_plane, true},
    {"sphere by depth on a tube",
     ContactKind::sphere,
     {.shape = SectionShape::tube, .diameter = 0.016, .wall = 0.0025},
     IndentationFrom::half_space,
     true},
    {"hertz from the mid-plane", ContactKind::hertz, rectangle, IndentationFrom::mid_plane},
    {"line", ContactKind::line, rectangle, IndentationFrom::mid_plane},
    {"line by depth", ContactKind::line, rectangle, IndentationFrom::mid_plane, true},
};

TEST(ConservationOfShapes, HoldsForEveryLawWithAndWithoutHardening) {
  for (const ShapedStrike& strike : laws) {
    for (const double hardening : {0.0, 0.05}) {
      for (const SectionKind section : {SectionKind::exact, SectionKind::layers}) {
        SCOPED_TRACE(testing::Message() << strike.name << ' ' << hardening);
        Case input = paper_case(section, 0.4e-3, 101);
        Beam& beam = input.scene.beam;
        beam.width = beam.thickness = 0.0;
        beam.section = strike.section;
        beam.hardening = hardening;
        Contact& contact = input.scene.contact;
        contact.kind = strike.law;
        contact.indentation = strike.indentation;
        contact.pressure_by_depth = strike.by_depth;
        if (strike.law == ContactKind::linear) {
          contact.stiffness = 2e7;
        } else if (strike.law != ContactKind::foundation) {
          contact.striker_modulus = 2e11;
          contact.striker_poisson = contact.beam_poisson = 0.3;
        }
        expect_conserved(input);
        EXPECT_GT(simulate(input).n_yielded_sections, 0u);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Conservation,
                         testing::Values(SectionKind::elastic, SectionKind::exact,
                                         SectionKind::layers),
                         NamedAsPrinted{});

}  // namespace
}  // namespace subimpact
