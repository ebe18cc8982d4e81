#include "subimpact/simulate/records.h"
#include "lumped.h"
#include "simulate/loop/audit.h"
#include "simulate/loop/quadratures.h"
#include "testing.h"

namespace subimpact {
namespace {

using Numbers = std::vector<std::pair<int, int>>;
using Times = std::vector<std::pair<double, std::optional<double>>>;

// Zones end with separations of 10, sub-zones with those of 2.
Numbers zones(const Times& times) {
  std::vector<SubImpact> list;
  for (const auto& [start, end] : times) {
    list.push_back({});
    list.back().start = start;
    list.back().end = end;
  }
  assign_zones(list, 10.0, 2.0);
  Numbers numbers;
  for (const SubImpact& one : list) numbers.emplace_back(one.zone, one.subzone);
  return numbers;
}

TEST(Zones, AreNumberedBySeparationsThatAreAsLongAsTheirGaps) {
  const struct {
    const char* sentence;
    Times times;
    Numbers numbers;
  } all[] = {{"No sub-impacts make no zones", {}, {}},
             {"A lone one is zone one, sub-zone one", {{0.0, 1.0}}, {{1, 1}}},
             {"Separations shorter than both gaps stay together",
              {{0.0, 1.0}, {2.0, 3.0}, {4.5, 5.0}},
              {{1, 1}, {1, 1}, {1, 1}}},
             {"A longer separation begins a sub-zone and a still longer one a zone",
              {{0.0, 1.0}, {2.0, 3.0}, {6.0, 7.0}, {20.0, 21.0}, {22.0, 23.0}},
              {{1, 1}, {1, 1}, {1, 2}, {2, 1}, {2, 1}}},
             {"Sub-zones are numbered anew in every zone",
              {{0.0, 1.0}, {5.0, 6.0}, {10.0, 11.0}, {30.0, 31.0}, {35.0, 36.0}},
              {{1, 1}, {1, 2}, {1, 3}, {2, 1}, {2, 2}}},
             {"Separation is from end to start: of two 12 apart the first lasts 11",
              {{0.0, 11.0}, {12.0, 13.0}},
              {{1, 1}, {1, 1}}},
             {"A separation as long as the gap of sub-zones parts them",
              {{0.0, 1.0}, {3.0, 4.0}},
              {{1, 1}, {1, 2}}},
             {"and of zones", {{0.0, 1.0}, {11.0, 12.0}}, {{1, 1}, {2, 1}}},
             {"A shorter one does not", {{0.0, 1.0}, {2.9999999, 4.0}}, {{1, 1}, {1, 1}}},
             {"nor of zones", {{0.0, 1.0}, {10.9999999, 12.0}}, {{1, 1}, {1, 2}}},
             {"One still open has a zone", {{0.0, 1.0}, {20.0, std::nullopt}}, {{1, 1}, {2, 1}}}};
  for (const auto& [sentence, times, numbers] : all) EXPECT_EQ(zones(times), numbers) << sentence;
}

TEST(EventKinds, EveryKindHasANameOfItsOwn) {
  std::set<std::string_view> names;
  for (const EventKind kind :
       {EventKind::contact_begins, EventKind::contact_yields, EventKind::contact_unloads,
        EventKind::contact_ends, EventKind::section_reverses}) {
    names.insert(to_string(kind));
  }
  EXPECT_EQ(names.size(), 5u);
  EXPECT_EQ(names.count("unknown"), 0u);
}

// The integral of the contact force over steps.

IndentationStep indentation_step(const StruckBeam& beam, const StepEnds& step) {
  return {step.t0,
          step.t1,
          beam.indentation(step.y0),
          beam.indentation_rate(step.y0),
          beam.indentation(step.y1),
          beam.indentation_rate(step.y1)};
}

TEST(TheForceIntegral, OfAStepWithoutLengthIsZero) {
  StruckBeam beam = TwoBodies{}.make();
  const auto integrator = Way{}.make(beam);
  beam.contact().set(ContactBranch::elastic, {0.0});
  State y = beam.initial_state();
  y[1] = 1e-4;  // pressed in
  integrator->restart(0.0, y);
  SectionCorrector corrector(beam, std::numeric_limits<double>::infinity());
  ForceQuadrature force(1e-12);
  const StepEnds empty{0.0, 0.0, y, y};
  const StepEnds whole{0.0, 1e-6, y, y};
  const double impulse = beam.contact_force(y) * 1e-6;
  EXPECT_GT(impulse, 0.0);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(force.over(ObservedStep(empty, indentation_step(beam, empty), *integrator, corrector),
                         beam),
              0.0);
  }
  force.forget_neighbour();
  integrator->step();
  EXPECT_NEAR(
      force.over(ObservedStep(whole, indentation_step(beam, whole), *integrator, corrector), beam),
      impulse, 0.1 * impulse);
}

/// How many of n runs are ended by the audit, with strikers of `first` kg and more by `spacing`.
int n_stopped(int n, double first, double spacing) {
  int stopped = 0;
  for (int k = 0; k < n; ++k) {
    Scene scene;
    scene.beam.length = scene.beam.width = scene.beam.thickness = scene.beam.density = 1.0;
    scene.striker = {
        .mass = first + spacing * k, .nose_radius = 0.5, .velocity = 1.0, .position = 0.5};
    scene.contact.kind = ContactKind::linear;
    scene.contact.stiffness = 4e6;
    StruckBeam beam =
        struck_beam_of(scene, std::make_unique<LumpedMesh>(1.0), SectionField(1, 2e6));
    try {
      run_two_bodies(beam, {"dprkn12", 1e-14, {}, EventHandling::located}, 8e-3, {},
                     {.energy = 1e-6});
    } catch (const RunStopped&) {
      ++stopped;
    }
  }
  return stopped;
}

// Its error estimate compares two steps. Steps of a tenth of a radian and more, as methods of high
// order take them, must not make it vanish by chance: the audit would then end a run that is right.
TEST(TheForceIntegral, EqualsTheImpulseOnLongStepsWhateverTheirPhase) {
  EXPECT_EQ(n_stopped(4000, 2.0, 0.004), 0);
  EXPECT_EQ(n_stopped(300, 3.2, 1e-4), 0);  // the first estimate of a contact vanishes at 3.221 kg
}

}  // namespace
}  // namespace subimpact
