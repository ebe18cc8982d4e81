// Stated errors of event times, mesh and layers included, against a far finer computation.

#include "judgement/coverage.h"
#include "paper_run.h"
#include "print.h"
#include "study/judgement/mesh_resolution.h"
#include "subimpact/case/simulate.h"
#include "subimpact/study/judgement/judgement.h"
#include "subimpact/study/run_as_asked.h"

namespace subimpact {
namespace {

Result judged(const Case& input, const Progress& progress = {}) {
  return simulate_judged(input, cases_beside(input), 2, progress);
}

Case scene(SectionKind section, double end_time, int segments = 201) {
  return paper_run(section, end_time, segments, Method::nystrom);
}

Case on_elements(Case input, int elements) {
  input.model.mesh = MeshKind::hermite;
  input.model.elements = elements;
  return input;
}

// Ten scenes unlike each other in speed, mass, place, thickness, theory, supports, section, mesh
// and method.
std::vector<Case> ten_scenes() {
  std::vector<Case> cases;
  cases.push_back(scene(SectionKind::elastic, 1.6e-3, 501));
  cases.push_back(on_elements(scene(SectionKind::elastic, 1.6e-3), 160));
  cases.push_back(scene(SectionKind::exact, 0.9e-3, 401));
  cases.back().scene.striker.velocity = 7.0;
  cases.push_back(scene(SectionKind::layers, 0.9e-3, 401));
  cases.back().scene.striker.mass = 0.08;
  cases.push_back(on_elements(scene(SectionKind::elastic, 1.5e-3), 120));
  cases.back().scene.striker.mass = 0.5;
  cases.back().solver.method = Method::exponential;
  cases.push_back(on_elements(scene(SectionKind::elastic, 1.5e-3), 100));
  cases.back().scene.striker.velocity = 8.0;
  cases.back().scene.beam.ends = {pinned, pinned};
  cases.push_back(scene(SectionKind::elastic, 1.5e-3, 301));
  cases.back().scene.beam.thickness = 0.01;
  cases.back().scene.beam.ends = {clamped, clamped};
  cases.back().solver.method = Method::erk;
  cases.push_back(on_elements(scene(SectionKind::elastic, 1.5e-3), 160));
  cases.back().scene.striker.position = 0.37;
  cases.push_back(scene(SectionKind::elastic, 1.2e-3, 401));
  cases.back().scene.striker.velocity = 25.0;
  cases.back().solver.method = Method::central_difference;
  cases.push_back(on_elements(scene(SectionKind::exact, 0.6e-3), 160));
  cases.back().scene.striker.velocity = 10.0;
  return cases;
}

// The same without errors worth the name: the exact section, a mesh many times as fine.
Case far_finer(const Case& input) {
  Case accurate = input;
  const bool elastic = input.model.section == SectionKind::elastic;
  accurate.solver = {};
  accurate.solver.method = elastic ? Method::exponential : Method::nystrom;
  accurate.solver.rtol = 1e-10;
  if (elastic) {
    accurate.model.mesh = MeshKind::hermite;
    accurate.model.elements = 480;
  } else {
    accurate.model.mesh = MeshKind::cells;
    accurate.model.segments = 2001;
    accurate.model.section = SectionKind::exact;
  }
  return accurate;
}

TEST(StatedErrorsOfTimeAndMesh, CoverTheTrueOnesWithoutBeingVain) {
  Coverage coverage;
  for (const Case& input : ten_scenes()) {
    coverage.judge(judged(input), simulate(far_finer(input)));
  }
  coverage.expect(80, 8.0);
}

// Meshes of them agree on a contact that the beam opens.
TEST(ElementsThatYieldUnderTheStriker, AreCertainOfNoSubImpact) {
  const Result result = judged(on_elements(scene(SectionKind::exact, 0.84e-3), 200));
  EXPECT_EQ(result.n_certain(), 0u);
  EXPECT_TRUE(result.sub_impacts[0].doubt->kind == Reason::Kind::yielding_elements);
}

TEST(StatedErrorsOfACantileverStruckAtItsEnd, CoverTheTrueOnesWithoutBeingVain) {
  Coverage coverage;
  Case input = on_elements(scene(SectionKind::exact, 0.84e-3), 200);
  input.scene.beam.ends = {clamped, free_end};
  input.scene.striker.position = 1.0;
  Case accurate = input;
  accurate.model.elements = 800;
  const Result exact = simulate(accurate);
  for (const int elements : {120, 160, 200}) {
    input.model.elements = elements;
    const Result result = judged(input);
    EXPECT_GT(result.n_yielded_sections, 0u);
    coverage.judge(result, exact);
  }
  coverage.expect(30, 16.0);
}

TEST(AnotherMesh, KeepsWhatSymmetryNeedsAndTheStableStep) {
  Case input = scene(SectionKind::elastic, 1e-4, 501);
  EXPECT_EQ(mesh_count(*on_other_mesh(input, 2.0)), 1003);
  EXPECT_EQ(mesh_count(*on_other_mesh(input, 0.5)), 251);
  input.model.symmetry = SymmetryUse::off;
  EXPECT_EQ(mesh_count(*on_other_mesh(input, 2.0)), 1002);
  EXPECT_EQ(mesh_order(input), 2);
  input.model.spacing = CellSpacing::points;
  EXPECT_EQ(mesh_order(input), 1);
  EXPECT_EQ(on_other_mesh(input, 2.0)->model.spacing, CellSpacing::points);
  input.model.spacing = CellSpacing::cells;
  input = on_elements(input, 50);
  EXPECT_EQ(mesh_count(*on_other_mesh(input, 0.5)), 26);  // a node at mid-span
  input.model.symmetry = SymmetryUse::automatic;
  EXPECT_EQ(mesh_count(*on_other_mesh(input, 0.5)) % 2, 0);
  EXPECT_EQ(mesh_order(input), 4);
  input.model.section = SectionKind::exact;
  EXPECT_EQ(mesh_order(input), 1);
  input.model.elements = 4;
  EXPECT_FALSE(on_other_mesh(input, 0.5).has_value());
  input.model.mesh = MeshKind::rigid;
  EXPECT_FALSE(on_other_mesh(input, 2.0).has_value());
  input = scene(SectionKind::elastic, 1e-4, 501);
  input.solver.method = Method::central_difference;
  input.solver.step = 0.9 * resolve(input).settings().critical_step;
  const Case fine = *on_other_mesh(input, 2.0);
  EXPECT_LT(*fine.solver.step, *input.solver.step);
  EXPECT_NO_THROW(resolve(fine));
}

TEST(AStoppedRun, StopsItsCompanionsToo) {
  Case input = scene(SectionKind::elastic, 5e-3, 501);
  const Result result = judged(input, [](double) { return false; });
  EXPECT_EQ(result.outcome.kind, OutcomeKind::stopped);
  EXPECT_FALSE(result.error_estimate.has_value());
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
Case strip_of_elements(int n) { return strip({.mesh = MeshKind::hermite, .elements = n}); }

void expect_nothing_is_certain(const Result& result) {
  ASSERT_TRUE(result.error_estimate);
  EXPECT_TRUE(result.sub_impacts.front().end);  // which the beam's does not
  EXPECT_EQ(result.n_certain(), std::size_t{0}) << words_of(result.error_estimate->reason);
  EXPECT_EQ(result.error_estimate->largest_error, 0.0);
}

TEST(AMeshThatDoesNotResolveTheWavesOfAContact, FindsNothingCertainThoughCoarserOnesAgree) {
  for (const Case& input : {strip_of_elements(20), strip_of_elements(40), strip_of_cells(301)}) {
    const Result result = simulate_judged(input, cases_beside(input), 2);
    expect_nothing_is_certain(result);
    EXPECT_EQ(result.error_estimate->first_unresolved, std::size_t{0});
    const Reason& reason = *result.error_estimate->reason;
    using enum Reason::Kind;
    const auto shown = {heavy_part, unended_contact, short_contact, short_separation};
    EXPECT_NE(std::ranges::find(shown, reason.kind), shown.end()) << words_of(reason);
  }
}

TEST(TheShortestContactThatAMeshShows, FallsWithTheSquareOfItsParts) {
  const double of_cells = shortest_contact_shown(strip_of_cells(101));
  const double rounding = 1e-9 * of_cells;
  EXPECT_GT(of_cells, 0.0);
  EXPECT_NEAR(shortest_contact_shown(strip_of_cells(303)), of_cells / 9.0, rounding);
  // Elements count as two cells.
  EXPECT_NEAR(shortest_contact_shown(strip_of_elements(202)), of_cells / 16.0, rounding);
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
  input.scene.beam.ends = {clamped, free_end};
  input.scene.striker.position = position;
  input.scene.striker.mass = striker_mass;
  return input;
}

TEST(TheFirstMeshOfAChoice, TakesEveryStrikeAndShowsIt) {
  for (const double yield_stress : {355e6, std::numeric_limits<double>::infinity()}) {
    for (const BeamTheory theory :
         {BeamTheory::euler_bernoulli, BeamTheory::rayleigh, BeamTheory::timoshenko}) {
      for (const auto& [position, mass] :
           {std::pair(1.0, 0.5), {0.992, 0.5}, {0.03, 0.5}, {0.4, 0.04}}) {
        const Case input = struck_at(position, mass, yield_stress, theory);
        const Case first = first_choice(input, {}).input;
        EXPECT_FALSE(mesh_doubt(first, resolve(first).settings()))
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
  EXPECT_FALSE(mesh_doubt(input, used));
  input.scene.beam.theory = BeamTheory::euler_bernoulli;
  EXPECT_LT(resolve(input).settings().contact_mass_share, 0.1);
  input.model.segments = 41;
  EXPECT_TRUE(mesh_doubt(input, resolve(input).settings()));
}

TEST(AStrikeThatNoCoarserMeshTakes, IsNotCertainThoughRunsAtOtherTolerancesAgree) {
  Case input = struck_at(0.02, 0.5, 355e6, BeamTheory::rayleigh);
  input.model.segments = 26;
  const Result result = simulate_judged(input, cases_beside(input), 2);
  EXPECT_EQ(result.n_certain(), std::size_t{0});
  expect_in(words_of(result.error_estimate->reason), "of the mesh");
}

}  // namespace
}  // namespace subimpact
