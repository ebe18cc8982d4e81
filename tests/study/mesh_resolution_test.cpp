#include "study/mesh_resolution.h"

#include <gtest/gtest.h>

#include "subimpact/case/simulate.h"
#include "subimpact/study/companion.h"
#include "subimpact/study/mesh_error_bars.h"

namespace subimpact {
namespace {

// A steel ball that follows a steel strip for longer than 400 us. Nodes of a coarse mesh are so
// heavy that the ball rebounds from the one that it meets.
Case strip(const ModelOptions& model) {
  Case input;
  input.scene.beam = {
      .length = 2.0, .width = 0.02, .thickness = 0.001, .density = 7850.0, .youngs_modulus = 210e9};
  input.scene.striker.mass = 0.02;
  input.scene.striker.nose_radius = 0.0085;
  input.scene.striker.velocity = 2.0;
  input.scene.contact.kind = ContactKind::hertz;
  input.scene.contact.striker_modulus = 210e9;
  input.scene.contact.striker_poisson = input.scene.contact.beam_poisson = 0.3;
  input.end_time = 0.4e-3;
  input.solver.method = Method::exponential;
  input.solver.rtol = 1e-9;
  input.output.keep_no_rows();
  input.model = model;
  return input;
}

Case strip_of_cells(int n) { return strip({.segments = n}); }
Case strip_of_elements(int n, double refinement = 1.0) {
  return strip({.mesh = MeshKind::hermite, .elements = n, .strike_refinement = refinement});
}

void expect_nothing_is_decided(const Result& result) {
  ASSERT_TRUE(result.error_estimate);
  EXPECT_TRUE(result.sub_impacts.front().end);  // which the beam's does not
  EXPECT_EQ(result.n_decided(), std::size_t{0}) << result.error_estimate->reason;
  EXPECT_EQ(result.error_estimate->largest_error, 0.0);
}

TEST(AMeshThatDoesNotResolveTheWavesOfAContact, DecidesNothingThoughCoarserOnesAgree) {
  for (const Case& input : {strip_of_elements(20), strip_of_elements(40), strip_of_cells(301)}) {
    const Result result = simulate_with_companion(input, 1);
    expect_nothing_is_decided(result);
    EXPECT_EQ(result.error_estimate->parts.front().first_unresolved, std::size_t{0});
    EXPECT_NE(result.error_estimate->reason.find("bending waves"), std::string::npos)
        << result.error_estimate->reason;
    expect_nothing_is_decided(simulate_with_all_error_bars(input));
  }
}

TEST(TheShortestContactThatAMeshShows, FallsWithTheSquareOfItsParts) {
  const double of_cells = shortest_contact_shown(strip_of_cells(101));
  const double rounding = 1e-9 * of_cells;
  EXPECT_GT(of_cells, 0.0);
  EXPECT_NEAR(shortest_contact_shown(strip_of_cells(303)), of_cells / 9.0, rounding);
  // Elements count as two cells.
  EXPECT_NEAR(shortest_contact_shown(strip_of_elements(202)), of_cells / 16.0, rounding);
  EXPECT_NEAR(shortest_contact_shown(strip_of_elements(202, 2.0)), of_cells / 64.0, rounding);
  EXPECT_EQ(shortest_contact_shown(strip({.mesh = MeshKind::rigid})), 0.0);
}

TEST(SubImpacts, AreNotAllDecidedWhereTheRunComparedWithHasMore) {
  Result result;
  result.sub_impacts.resize(2);
  EXPECT_FALSE(result.all_decided());  // without an error estimate
  result.error_estimate = ErrorEstimate{};
  EXPECT_TRUE(result.all_decided());
  result.error_estimate->first_unresolved = 2;
  EXPECT_EQ(result.n_decided(), std::size_t{2});
  EXPECT_FALSE(result.all_decided());
}

}  // namespace
}  // namespace subimpact
