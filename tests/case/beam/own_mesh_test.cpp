// Meshes of a caller's own, and runs made of parts.

#include <atomic>
#include <future>

#include "model/mesh/cell_mesh.h"
#include "paper_run.h"
#include "runs.h"
#include "same_results.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

Case short_case() {
  Case input = paper_run(SectionKind::exact, 3e-4, 51);
  input.output.interval = 1e-5;
  return input;
}

// Passes everything on to cells, and counts how often its modes are computed: once per model built.
class CountingMesh final : public BeamMesh {
 public:
  explicit CountingMesh(const CellMesh& cells)
      : BeamMesh(cells.n_unknowns(), cells.mass().half_bandwidth(), cells.symmetric()),
        cells_(cells) {
    mass_ = cells.mass();
    weights_.assign(cells.section_weights().begin(), cells.section_weights().end());
    positions_.assign(cells.section_positions().begin(), cells.section_positions().end());
    struck_point_ = cells.struck_point();
    first_end_ = cells.first_end();
    struck_section_ = cells.struck_section();
    translation_.assign(cells.translation().begin(), cells.translation().end());
    momentum_functional_.assign(cells.momentum_functional().begin(),
                                cells.momentum_functional().end());
    beam_mass_ = cells.beam_mass();
  }
  void curvatures(std::span<const double> unknowns, std::span<double> kappa) const override {
    cells_.curvatures(unknowns, kappa);
  }
  void bending_forces(std::span<const double> moments, std::span<double> forces) const override {
    cells_.bending_forces(moments, forces);
  }
  SectionStencil section_stencil(std::size_t section) const override {
    return cells_.section_stencil(section);
  }
  double highest_frequency(double bending_stiffness) const override {
    return cells_.highest_frequency(bending_stiffness);
  }
  NaturalModes natural_modes(double bending_stiffness) const override {
    ++n_models;
    return cells_.natural_modes(bending_stiffness);
  }
  std::string description() const override { return "counted cells"; }

  mutable std::atomic<int> n_models = 0;

 private:
  const CellMesh& cells_;
};

TEST(AMeshOfOnesOwn, GivesTheBitsOfTheBuiltInOneThatItIs) {
  Case input = short_case();
  const CellMesh cells(input.scene.beam, 0.5, 51, CellMesh::Extent::half);
  for (const Method method : {Method::nystrom, Method::exponential, Method::dirk, Method::adams,
                              Method::central_difference}) {
    input.solver.method = method;
    input.parts.mesh = nullptr;
    const Result built_in = completed(input);
    input.parts.mesh = std::make_shared<CountingMesh>(cells);
    expect_same(simulate(input), built_in);
  }
}

TEST(AMeshOfOnesOwn, WithoutDisplacementsHasNoShapesAndRefusesThoseAskedFor) {
  Case input = short_case();
  EXPECT_FALSE(simulate(input).shapes.empty());
  const CellMesh cells(input.scene.beam, 0.5, 51, CellMesh::Extent::half);
  input.parts.mesh = std::make_shared<CountingMesh>(cells);
  const Result result = simulate(input);
  EXPECT_TRUE(result.shapes.empty());
  EXPECT_TRUE(result.envelope.empty());
  EXPECT_EQ(result.used.shape_interval, 0.0);
  Case shapes = input, points = input;
  shapes.output.shapes = 1e-5;
  points.output.points = {0.5};
  EXPECT_EQ(refusal_of(shapes).key, "output.shapes");
  EXPECT_EQ(refusal_of(points).key, "output.points");
}

TEST(ARun, BuildsItsModelOnce) {
  Case input = short_case();
  input.model.section = SectionKind::elastic;
  input.solver.method = Method::exponential;
  const CellMesh cells(input.scene.beam, 0.5, 51, CellMesh::Extent::half);
  const auto mesh = std::make_shared<CountingMesh>(cells);
  input.parts.mesh = mesh;
  EXPECT_TRUE(simulate(input).outcome.completed());
  EXPECT_EQ(mesh->n_models, 1);
  ResolvedRun run = resolve(input);
  EXPECT_GT(run.settings().critical_step, 0.0);
  EXPECT_TRUE(simulate(std::move(run)).outcome.completed());
  EXPECT_EQ(mesh->n_models, 2);
}

TEST(ARunOfParts, GivesTheBitsOfTheCase) {
  const Case input = short_case();
  const Result of_parts = simulate(problem_of(input), input);
  expect_same(of_parts, simulate(input));
  EXPECT_TRUE(of_parts.is_usable());
}

TEST(ARunOfParts, IsRefusedWithoutAMeshOrALawOrAnEnd) {
  const Case input = short_case();
  const auto key_refused = [](const Problem& problem, const Options& options) {
    return refusal_of([&] { resolve(problem, options); }).key;
  };
  Problem problem = problem_of(input);
  EXPECT_EQ(key_refused(problem, input), "");
  EXPECT_EQ(key_refused(problem, {}), "time.end");
  problem.contact_law = nullptr;
  EXPECT_EQ(key_refused(problem, input), "contact.law");
  problem.mesh = nullptr;
  EXPECT_EQ(key_refused(problem, input), "model.mesh");
}

TEST(RunsThatShareTheirParts, GiveInSeveralThreadsTheBitsOfRunsAlone) {
  Case input = short_case();
  for (const SectionKind section : {SectionKind::elastic, SectionKind::exact}) {
    input.model.section = section;
    const Problem problem = problem_of(input);
    for (const Method method : {Method::exponential, Method::erk, Method::bdf}) {
      Options options = input;
      options.solver.method = method;
      std::vector<std::future<Result>> at_once;
      for (int i = 0; i < 4; ++i) {
        at_once.push_back(
            std::async(std::launch::async, [&] { return simulate(problem, options); }));
      }
      const Result alone = simulate(problem, options);
      for (auto& run : at_once) expect_same(run.get(), alone);
    }
  }
}

}  // namespace
}  // namespace subimpact
