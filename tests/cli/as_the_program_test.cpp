#include "process.h"
#include "subimpact/io/case_file.h"
#include "subimpact/io/read_results.h"
#include "subimpact/study/run_as_asked.h"
#include "temporary_directory.h"

namespace subimpact {
namespace {

TEST(ARunAsAsked, GivesWhatTheProgramGivesNumberForNumber) {
  const TemporaryDirectory directory;
  run_in(directory, paper("run", {"time.end=3e-4"}, {"--out", "here", "--quiet"}));
  const FinishedRun program = read_results(directory.path / "here");
  const LoadedCase loaded = read_case_file(SUBIMPACT_PAPER_CASE, {parse_override("time.end=3e-4")});
  const WithinRun here = run_as_asked(loaded.value, loaded.given);
  EXPECT_EQ(here.result.used.mesh, program.result.used.mesh);
  ASSERT_EQ(here.result.sub_impacts.size(), program.result.sub_impacts.size());
  for (std::size_t i = 0; i < here.result.sub_impacts.size(); ++i) {
    const SubImpact &a = here.result.sub_impacts[i], &b = program.result.sub_impacts[i];
    EXPECT_EQ(a.start, b.start);
    EXPECT_EQ(a.end, b.end);
    EXPECT_EQ(a.peak_force, b.peak_force);
    EXPECT_EQ(a.end_error, b.end_error);
  }
  EXPECT_EQ(here.result.striker_velocity, program.result.striker_velocity);
}

}  // namespace
}  // namespace subimpact
