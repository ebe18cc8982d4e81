#include "subimpact/study/compare_theories.h"

namespace subimpact {

std::vector<TheoryRun> compare_theories(std::span<const Case> cases, Jobs jobs,
                                        const std::function<void(std::size_t)>& announce,
                                        const Progress& progress) {
  for (const Case& input : cases) resolve(input);
  std::vector<TheoryRun> runs;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (announce) announce(i);
    Case input = cases[i];
    input.output.keep_no_rows();
    TheoryRun run{input.scene.beam.theory, simulate_with_companion(input, jobs, progress), {}};
    if (run.result.outcome.kind == OutcomeKind::stopped) break;
    const Result& first = runs.empty() ? run.result : runs.front().result;
    run.pairs = match_sub_impacts(first.sub_impacts, run.result.sub_impacts);
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace subimpact
