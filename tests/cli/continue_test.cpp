// `subimpact run --continue`: a run goes on from the files of another one.

#include "process.h"
#include "subimpact/io/read_results.h"

namespace subimpact {
namespace {

std::vector<std::string> run_to(const char* end, const std::string& out,
                                std::vector<std::string> more = {}) {
  more.insert(more.end(), {"--out", out});
  return paper("run", {std::string("time.end=") + end, "model.segments=201"}, more);
}

TEST(ContinuedRun, OfTheProgramLeavesTheFilesOfTheWholeStrike) {
  const TemporaryDirectory here;
  run_in(here, run_to("1.2 ms", "whole"));
  run_in(here, run_to("0.5 ms", "first"));
  const Finished on = run_in(here, run_to("1.2 ms", "both", {"--continue", "first"}));
  const FinishedRun whole = read_results(here.path / "whole");
  const FinishedRun both = read_results(here.path / "both");
  ASSERT_EQ(whole.result.sub_impacts.size(), both.result.sub_impacts.size());
  for (std::size_t i = 0; i < whole.result.sub_impacts.size(); ++i) {
    const SubImpact &a = whole.result.sub_impacts[i], &b = both.result.sub_impacts[i];
    EXPECT_NEAR(a.start, b.start, 1e-9) << i;
    EXPECT_EQ(a.zone, b.zone) << i;
    EXPECT_EQ(a.certain, b.certain) << i;
    EXPECT_TRUE(b.start_error) << "the runs beside went on too";
  }
  EXPECT_EQ(both.result.history.front().time, 0.0);
  EXPECT_EQ(both.result.history.size(), both.result.n_history_rows);
  EXPECT_EQ(both.result.shapes.front().time, 0.0);
  EXPECT_EQ(both.result.shapes.size(), both.result.n_shape_rows);
  for (std::size_t i = 0; i < whole.result.envelope.size(); ++i) {
    EXPECT_NEAR(whole.result.envelope[i].moment.largest.value,
                both.result.envelope[i].moment.largest.value, 0.2)
        << i;
  }
}

TEST(ContinuedRun, KeepsTheModelOfTheEarlierRunWhereTheCaseLeavesItOpen) {
  const TemporaryDirectory here;
  here.write("open.toml", open_case);
  run_in(here, {"run", "open.toml", "--error-bars=off", "--out", "first", "--set",
                "contact.law=foundation", "--set", "beam.theory=rayleigh"});
  run_in(here,
         {"run", "open.toml", "--continue", "first", "--set", "time.end=3e-4", "--out", "on"});
  const Scene scene = read_results(here.path / "on").input.scene;
  EXPECT_EQ(scene.contact.kind, ContactKind::foundation);
  EXPECT_FALSE(scene.contact.pressure_by_depth);
  EXPECT_FALSE(scene.beam.shears());
}

TEST(ContinuedRun, ThatWasToldToEndGoesOn) {
  const TemporaryDirectory here;
  const std::vector<std::string> slow = {"--set", "output.interval=1e-5", "--error-bars=off"};
  const Finished early = run_program(run_to("1 s", "here", slow), here.path, 1500, SIGTERM);
  ASSERT_EQ(early.status, 128 + SIGTERM) << early.errors;
  const double reached = read_results(here.path / "here").result.outcome.time;
  const std::string end = std::to_string(reached + 1e-3) + " s";
  run_in(here, run_to(end.c_str(), "here",
                      {"--set", "output.interval=1e-5", "--error-bars=off", "--continue", "here"}));
  const Result result = read_results(here.path / "here").result;
  EXPECT_TRUE(result.outcome.completed());
  EXPECT_GT(result.outcome.time, reached);
  EXPECT_EQ(result.sub_impacts.front().start, 0.0);
}

TEST(ContinuedRun, RefusesWhatDoesNotGoTogether) {
  const TemporaryDirectory here;
  run_in(here, run_to("0.3 ms", "first", {"--error-bars=off"}));
  const auto errors_of = [&](const Words& more, const char* end = "1 ms") {
    Words words = run_to(end, "next", {"--continue", "first"});
    words.insert(words.end(), more.begin(), more.end());
    return run_in(here, words, 2).errors;
  };
  expect_in(errors_of({"--set", "beam.width=0.02"}), "beam.width = 0.02, not 0.0163");
  expect_in(errors_of({"--set", "model.segments=301"}), "model.segments = 301, not 201");
  expect_in(errors_of({"--set", "model.section=elastic"}), "model.section");
  expect_in(errors_of({}, "0.2 ms"), "later");
  expect_in(errors_of({"--within", "1us"}), "accuracy.event_times");
  expect_in(errors_of({"--error-bars"}), "--continue");
  const auto state = here.path / "first" / "state.json";
  std::string text = read_file(state);
  text[text.size() / 2] = text[text.size() / 2] == '1' ? '2' : '1';
  std::ofstream(state) << text;
  expect_in(errors_of({}), "state.json");
  std::filesystem::remove(state);
  expect_in(errors_of({}), "state.json");
}

TEST(RepeatedStrikes, OfTheProgramHaveARowEachInATableAndOnTheScreen) {
  const TemporaryDirectory here;
  const std::vector<std::string> thrice = {"--set", "repeat.strikes=3", "--set",
                                           "beam.ends=pinned,pinned"};
  expect_in(run_in(here, run_to("1 ms", "here", thrice)).output, "strike sub-impacts");
  const Result result = read_results(here.path / "here").result;
  ASSERT_EQ(result.strikes.size(), 3U);
  EXPECT_EQ(result.strikes.back().sub_impacts, result.sub_impacts.size());
  EXPECT_EQ(result.strikes.back().dent, result.sub_impacts.back().residual_indentation);
  expect_in(run_in(here, paper("compare", {"repeat.strikes=3"}, {"--methods", "erk"}), 2).errors,
            "only `subimpact run` strikes more than once");
}

TEST(RepeatedStrikes, AreTheSameByHandFromDirectoryToDirectory) {
  const TemporaryDirectory here;
  run_in(here, run_to("1 ms", "at_once", {"--set", "repeat.strikes=2"}));
  run_in(here, run_to("1 ms", "first"));
  run_in(here, run_to("1 ms", "second", {"--continue", "first", "--set", "strike.rest=true"}));
  const Result a = read_results(here.path / "at_once").result;
  const Result b = read_results(here.path / "second").result;
  ASSERT_EQ(a.sub_impacts.size(), b.sub_impacts.size());
  for (std::size_t i = 0; i < a.sub_impacts.size(); ++i) {
    EXPECT_EQ(a.sub_impacts[i].start, b.sub_impacts[i].start) << i;
    EXPECT_EQ(a.sub_impacts[i].impulse, b.sub_impacts[i].impulse) << i;
    EXPECT_EQ(a.sub_impacts[i].start_error, b.sub_impacts[i].start_error) << i;
  }
}

}  // namespace
}  // namespace subimpact
