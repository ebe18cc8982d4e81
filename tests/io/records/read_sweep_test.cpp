#include "io/records/run_tables.h"

#include "subimpact/io/output_directory.h"
#include "subimpact/io/read_results.h"
#include "subimpact/io/results.h"
#include "temporary_directory.h"
#include "testing.h"

namespace subimpact {
namespace {

const std::string runs_csv =
    "run,striker.mass,solver.method,outcome,n_sub_impacts,wish_met,message\n"
    "0,0.25,erk,completed,2,,\n"
    "2,0.5,nystrom,refused,,,is not <allowed>; \"0\"\n";

// The rows of a table of events, as those of a run.
std::string rows_of(const std::string& events, int run) {
  std::string text;
  std::istringstream lines(events.substr(events.find('\n') + 1));
  for (std::string line; std::getline(lines, line);)
    text += std::to_string(run) + "," + line + '\n';
  return text;
}

Result two_sub_impacts() {
  Result result;
  SubImpact s;
  s.end = 1e-4 / 3.0;
  s.peak_force = 1234.5;
  s.zone = s.subzone = 1;
  s.start_error = 1e-9;
  SubImpact open = s;
  open.start = 1e-3;
  open.end = std::nullopt;
  result.sub_impacts = {s, open};
  result.outcome.time = 2e-3;
  return result;
}

std::string heading() {
  const std::string events = csv_of<SubImpact>(two_sub_impacts());
  return "run," + events.substr(0, events.find('\n') + 1);
}
std::string rows(int run) { return rows_of(csv_of<SubImpact>(two_sub_impacts()), run); }
std::string sub_impacts_csv() { return heading() + rows(0); }

class Sweep {
 public:
  Sweep(const std::string& runs, const std::string& sub_impacts) {
    std::ofstream(directory_.path / "runs.csv") << runs;
    std::ofstream(directory_.path / "sub_impacts.csv") << sub_impacts;
  }
  SweptRuns read() const { return read_sweep(directory_.path); }
  const std::filesystem::path& path() const { return directory_.path; }
  std::string refusal() const {
    return answer_of<ResultsError>([&] { read(); });
  }

 private:
  TemporaryDirectory directory_;
};

TEST(ReadSweep, HasKeysResultsAndSubImpactsOfEveryRun) {
  const SweptRuns runs = Sweep(runs_csv, sub_impacts_csv()).read();
  EXPECT_EQ(runs.numbers, (std::vector<long>{0, 2}));
  const auto* mass = runs.find("striker.mass");
  ASSERT_NE(mass, nullptr);
  EXPECT_TRUE(mass->is_key);
  EXPECT_EQ(mass->numbers, (std::vector<double>{0.25, 0.5}));
  const auto* method = runs.find("solver.method");
  ASSERT_NE(method, nullptr);
  EXPECT_TRUE(method->is_key);
  EXPECT_EQ(method->words, (std::vector<std::string>{"erk", "nystrom"}));
  const auto* count = runs.find("n_sub_impacts");
  ASSERT_NE(count, nullptr);
  EXPECT_FALSE(count->is_key);
  EXPECT_EQ(count->numbers[0], 2.0);
  EXPECT_TRUE(std::isnan(count->numbers[1]));
  EXPECT_EQ(runs.find("wish_met"), nullptr);  // without values
  ASSERT_EQ(runs.sub_impacts[0].size(), 2u);
  EXPECT_EQ(runs.sub_impacts[0][0].end, 1e-4 / 3.0);
  EXPECT_EQ(runs.sub_impacts[0][0].start_error, 1e-9);
  EXPECT_FALSE(runs.sub_impacts[0][1].end);
  EXPECT_TRUE(runs.sub_impacts[1].empty());
}

TEST(ReadSweep, NamesWhatADamagedTableHolds) {
  const std::string good = sub_impacts_csv();
  expect_in(Sweep("", good).refusal(), "runs.csv: has no heading");
  expect_in(Sweep("run,outcome\n", good).refusal(), "runs.csv: has no run yet");
  expect_in(Sweep("run,mass\n0,1\n", good).refusal(), "runs.csv: has no column outcome");
  expect_in(Sweep("run,outcome\n0\n", good).refusal(), "runs.csv:2: has 1 cell where");
  expect_in(Sweep("run,outcome\nx,completed\n", good).refusal(),
            "runs.csv:2: run is \"x\"; allowed: whole numbers from 0");
  expect_in(Sweep("run,outcome\n1,completed\n1,completed\n", good).refusal(),
            "runs.csv:3: run is \"1\"");
  expect_in(Sweep("run,outcome\n0,\n", good).refusal(), "runs.csv:2: outcome is \"\"");
  expect_in(Sweep(runs_csv, "run,start_s\n").refusal(), "sub_impacts.csv: has no column zone");
  expect_in(Sweep(runs_csv, heading() + rows(7)).refusal(),
            "sub_impacts.csv:2: run is \"7\"; allowed: a run of runs.csv");
  expect_in(Sweep(runs_csv, heading() + rows(0) + rows(2) + rows(0)).refusal(),
            "rows of one run after each other");
  std::string not_finite = good;
  not_finite.replace(not_finite.find("1234.5"), 6, "inf");
  expect_in(Sweep(runs_csv, not_finite).refusal(), "peak_force_N");
  for (const std::string& refusal :
       {Sweep("", good).refusal(), Sweep("run,outcome\n0\n", good).refusal()}) {
    expect_in(refusal, "run the sweep again");
  }
}

TEST(ReadSweep, NeedsBothTables) {
  const Sweep sweep(runs_csv, sub_impacts_csv());
  EXPECT_TRUE(holds_sweep(sweep.path()));
  std::filesystem::remove(sweep.path() / "sub_impacts.csv");
  expect_in(sweep.refusal(), "sub_impacts.csv: cannot be read");
  std::ofstream(sweep.path() / "summary.json") << "{}";
  EXPECT_FALSE(holds_sweep(sweep.path()));  // of one run
}

TEST(SealedTablesOfASweep, AreThoseOfTheManifestOrRefused) {
  const TemporaryDirectory directory;
  {
    OutputDirectory files(directory.path, "sweep", "5");
    std::ofstream(files.staging() / "runs.csv") << runs_csv;
    std::ofstream(files.staging() / "sub_impacts.csv") << sub_impacts_csv();
    files.commit();
  }
  EXPECT_EQ(read_sweep(directory.path).identity, "5");
  std::ofstream(directory.path / "runs.csv", std::ios::app) << "3,1,erk,completed,0,,\n";
  expect_in(message_of<ResultsError>([&] { read_sweep(directory.path); }), "changed or cut short");
}

}  // namespace
}  // namespace subimpact
