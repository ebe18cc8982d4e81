// The paper's example on Hermite elements: against the limit of fine meshes, by every method.

#include "order_table.h"
#include "paper_case.h"
#include "settings.h"

namespace subimpact {
namespace {

Case hermite_case(SectionKind section, double end_time, int half_model_elements) {
  Case input = paper_case(section, end_time, 501, Method::nystrom);
  input.model.mesh = MeshKind::hermite;
  input.model.elements = 2 * half_model_elements;
  return input;
}

TEST(HermiteElements, ComeToTheLimitOfFineMeshes) {
  const std::vector<ReferenceEvent> reference = reference_table("mesh_limit_elastic");
  struct Expected {
    int elements;
    double bound_us, third_start_us;
  };
  // The third contact begins at a graze, so its start is the most sensitive of these times.
  for (const Expected& expected : {Expected{100, 0.04, 0.075}, Expected{200, 2.5e-3, 4.3e-3}}) {
    const Result result = simulate(hermite_case(SectionKind::elastic, 0.84e-3, expected.elements));
    ASSERT_EQ(result.sub_impacts.size(), 9u);
    std::vector<double> errors = errors_us(result, reference, 9);
    EXPECT_LT(std::exchange(errors[4], 0.0), expected.third_start_us);
    EXPECT_LT(std::ranges::max(errors), expected.bound_us);
  }
}

// Explicit methods integrate equal elements in natural modes where no section can yield.
TEST(HermiteElements, MoveAlikeInNodesAndInModes) {
  struct Way {
    Method method;
    double tolerance_us;  // of event times: rounding, or steps chosen by different means of errors
  };
  for (const bool half : {true, false}) {
    for (const Way& way : {Way{Method::central_difference, 1e-7}, Way{Method::erk, 1e-4},
                           Way{Method::nystrom, 1e-4}}) {
      Case input = hermite_case(SectionKind::elastic, 0.6e-3, 40);
      input.scene.contact = {ContactKind::hertz, 5e9, {}, {}, {}};
      if (!half) {
        input.scene.striker.position = 0.25;
        input.scene.beam.ends = {free_end, pinned};
      }
      input.solver.method = way.method;
      input.solver.rtol = 1e-9;
      if (way.method == Method::central_difference) input.solver.step = 1e-7;
      input.output.interval = 1e-5;
      input.output.sections = {0.25, 0.4};
      const Result modes = simulate(input);
      const Result nodes = simulate(at_nodes(input));
      expect_in(modes.used.mesh, "natural modes");
      expect_not_in(nodes.used.mesh, "natural modes");
      EXPECT_EQ(modes.work.mass_solves, 0);
      EXPECT_GT(nodes.work.mass_solves, 0);
      EXPECT_LT(modes.max_energy_error, std::max(1e-12, 2.0 * nodes.max_energy_error));
      ASSERT_GE(modes.sub_impacts.size(), 2u);
      expect_same_starts(modes, nodes, way.tolerance_us);
      expect_same_ends(modes, nodes, way.tolerance_us);
      if (way.method != Method::central_difference) continue;
      ASSERT_EQ(modes.history.size(), nodes.history.size());
      for (std::size_t i = 0; i < modes.history.size(); ++i) {
        EXPECT_NEAR(modes.history[i].back_stress, nodes.history[i].back_stress, 10.0) << i;  // Pa
        EXPECT_NEAR(modes.history[i].striker_relative, nodes.history[i].striker_relative, 1e-14);
        EXPECT_NEAR(modes.history[i].bending_elastic, nodes.history[i].bending_elastic, 1e-9);
      }
      ASSERT_EQ(modes.section_history.size(), nodes.section_history.size());
      for (std::size_t i = 0; i < modes.section_history.size(); ++i) {
        EXPECT_NEAR(modes.section_history[i].moment, nodes.section_history[i].moment, 1e-6) << i;
      }
    }
  }
}

TEST(HermiteElements, BringTheFirstFiveSubImpactsAtFourthOrder) {
  const std::vector<ReferenceEvent> reference = reference_table("mesh_limit_elastic");
  OrderTable first("end of sub-impact 1, us, over elements of the half model");
  OrderTable five("starts and ends of sub-impacts 1 to 5, root of the sum of squares");
  for (const int elements : {100, 140, 200}) {
    const Result result = simulate(hermite_case(SectionKind::elastic, 0.4e-3, elements));
    ASSERT_EQ(result.sub_impacts.size(), 5u);
    const std::vector<double> errors = errors_us(result, reference, 5);
    first.add(elements, errors[1]);
    five.add(elements, root_of_squares(errors));
  }
  first.print();
  five.print();
  first.expect_overall_order_within(3.6, 4.4);
  five.expect_overall_order_within(3.6, 4.4);
}

TEST(HermiteElements, AreRefusedWhereTheyDoNotFit) {
  const Case fits = hermite_case(SectionKind::elastic, 1e-4, 40);
  const Settings odd{{"model.elements", 81}}, whole = odd + Settings{{"model.symmetry", "off"}};
  const Settings at_the_end = whole + Settings{{"striker.position", 0.0}};
  const std::pair<const char*, Settings> cases[] = {
      {"", {}},
      {"model.elements", odd},
      {"", whole},
      {"striker.position", whole + Settings{{"striker.position", 0.003}}},
      {"", at_the_end},
      {"striker.position", at_the_end + Settings{{"beam.ends", Names{"pinned", "free"}}}}};
  for (const auto& [key, settings] : cases) {
    EXPECT_EQ(refusal_of(changed(fits, settings)).key, key);
  }
}

}  // namespace
}  // namespace subimpact
