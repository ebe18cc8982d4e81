#include "study/mesh_resolution.h"

#include "subimpact/case/simulate.h"
#include "subimpact/study/judgement.h"
#include "subimpact/study/other_mesh.h"
#include "subimpact/study/within.h"
#include "testing.h"

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

// The case, with mesh and method left to the program.
Case struck_at(double position, double striker_mass, double yield_stress, BeamTheory theory) {
  Case input = strip({});
  input.solver = {};
  input.scene.beam.length = 1.0;
  input.scene.beam.thickness = 0.02;
  input.scene.beam.theory = theory;
  input.scene.beam.poisson = 0.3;
  input.scene.beam.yield_stress = yield_stress;
  input.scene.beam.ends = {EndSupport::clamped, EndSupport::free};
  input.scene.striker.position = position;
  input.scene.striker.mass = striker_mass;
  return input;
}

TEST(TheFirstMeshOfAChoice, TakesEveryStrikeAndShowsIt) {
  for (const double yield_stress : {355e6, std::numeric_limits<double>::infinity()}) {
    for (const BeamTheory theory :
         {BeamTheory::euler_bernoulli, BeamTheory::rayleigh, BeamTheory::timoshenko}) {
      for (const auto& [position, mass] : {std::pair(0.992, 0.5), {0.03, 0.5}, {0.4, 0.04}}) {
        const Case input = struck_at(position, mass, yield_stress, theory);
        const Case first = first_choice(input, {}).input;
        EXPECT_EQ(mesh_doubt(first, resolve(first).settings()), "")
            << position << ", " << resolve(first).settings().mesh;
        for (const CaseBeside& beside : cases_beside(first)) {
          EXPECT_LT(mesh_count(beside.input), mesh_count(first));
        }
      }
    }
  }
}

// The mass that rotary inertia makes a blow move at once is the beam's own, whatever the mesh.
TEST(AFineMeshOfABeamWithRotaryInertia, IsNotDoubtedForTheMassThatTheBeamOpposesToTheStriker) {
  Case input = struck_at(0.3, 0.07, 355e6, BeamTheory::rayleigh);
  input.model.segments = 2001;
  const ResolvedSettings used = resolve(input).settings();
  EXPECT_GT(used.contact_mass_share, 0.2);
  EXPECT_EQ(mesh_doubt(input, used), "");
  input.scene.beam.theory = BeamTheory::euler_bernoulli;
  EXPECT_LT(resolve(input).settings().contact_mass_share, 0.1);
  input.model.segments = 41;
  EXPECT_NE(mesh_doubt(input, resolve(input).settings()), "");
}

TEST(AStrikeThatNoCoarserMeshTakes, IsNotCertainThoughRunsAtOtherTolerancesAgree) {
  Case input = struck_at(0.02, 0.5, 355e6, BeamTheory::rayleigh);
  input.model.segments = 26;
  const Result result = simulate_judged(input, cases_beside(input), 2);
  EXPECT_EQ(result.n_certain(), std::size_t{0});
  const std::string& reason = result.error_estimate->reason;
  expect_in(reason, "of the mesh");
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
