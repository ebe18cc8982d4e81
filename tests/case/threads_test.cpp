// Several runs at once, each with the results that it has alone.

#include <future>

#include "paper_scene.h"
#include "runs.h"
#include "same_results.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/case/simulate.h"

namespace subimpact {
namespace {

std::vector<Case> different_cases() {
  std::vector<Case> cases;
  for (const Method method :
       {Method::erk, Method::nystrom, Method::exponential, Method::central_difference,
        Method::adams, Method::bdf, Method::dirk, Method::imex}) {
    for (const MeshKind mesh : {MeshKind::cells, MeshKind::hermite}) {
      Case input;
      input.scene = paper_scene();
      input.model.mesh = mesh;
      input.model.segments = 51;
      input.model.elements = 20;
      input.model.section =
          method == Method::exponential ? SectionKind::elastic : SectionKind::exact;
      input.end_time = 3e-4;
      input.output.interval = 1e-5;
      input.solver.method = method;
      input.solver.rtol = 1e-7;
      cases.push_back(input);
    }
  }
  return cases;
}

TEST(RunsInSeveralThreads, GiveTheBitsOfRunsOneAfterTheOther) {
  const std::vector<Case> cases = different_cases();
  // Twice over, so that every case also runs beside itself.
  std::vector<std::future<Result>> at_once;
  for (int round = 0; round < 2; ++round) {
    for (const Case& input : cases) {
      at_once.push_back(std::async(std::launch::async, [&input] { return simulate(input); }));
    }
  }
  for (std::size_t i = 0; i < at_once.size(); ++i) {
    const Case& input = cases[i % cases.size()];
    SCOPED_TRACE(to_string(input.solver.method));
    const Result alone = completed(input);
    expect_same(at_once[i].get(), alone);
  }
}

}  // namespace
}  // namespace subimpact
