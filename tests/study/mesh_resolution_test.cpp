#include "study/mesh_resolution.h"

#include <gtest/gtest.h>

#include "subimpact/case/simulate.h"
#include "subimpact/study/judgement.h"
#include "subimpact/study/other_mesh.h"

namespace subimpact {
namespace {

Result judged_by_part(const Case& input, const Progress& progress = {}) {
  return simulate_judged(input, cases_beside_by_part(input), 2, progress);
}

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

void expect_nothing_is_certain(const Result& result) {
  ASSERT_TRUE(result.error_estimate);
  EXPECT_TRUE(result.sub_impacts.front().end);  // which the beam's does not
  EXPECT_EQ(result.n_certain(), std::size_t{0}) << result.error_estimate->reason;
  EXPECT_EQ(result.error_estimate->largest_error, 0.0);
}

TEST(AMeshThatDoesNotResolveTheWavesOfAContact, FindsNothingCertainThoughCoarserOnesAgree) {
  for (const Case& input : {strip_of_elements(20), strip_of_elements(40), strip_of_cells(301)}) {
    const Result result = simulate_judged(input, cases_beside(input), 2);
    expect_nothing_is_certain(result);
    EXPECT_EQ(result.error_estimate->parts.front().first_unresolved, std::size_t{0});
    const std::string& reason = result.error_estimate->reason;
    EXPECT_TRUE(reason.find("bending waves") != reason.npos ||
                reason.find("as heavy") != reason.npos)
        << reason;
    expect_nothing_is_certain(judged_by_part(input));
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

TEST(SubImpacts, AreNotAllCertainWhereTheRunComparedWithHasMore) {
  Result result;
  result.sub_impacts.resize(2);
  for (SubImpact& s : result.sub_impacts) s.certain = true;
  EXPECT_FALSE(result.all_certain());  // without an error estimate
  result.error_estimate = ErrorEstimate{};
  EXPECT_TRUE(result.all_certain());
  result.error_estimate->first_unresolved = 2;
  EXPECT_EQ(result.n_certain(), std::size_t{2});
  EXPECT_FALSE(result.all_certain());
}

}  // namespace
}  // namespace subimpact
