#include "process.h"

namespace subimpact {
namespace {

/// Ways to spoil the paper's case file, one for each stage at which it may be refused, and what
/// stderr must then hold; tests/io/case_file/bad_case_file_test.cpp has every kind of mistake.
constexpr const char* spoilt_cases[][3] = {
    {"[striker]", "[striker", "not valid TOML"},
    {"\nlength", "\nlenght", R"(unknown key "beam.lenght"|did you mean "beam.length")"},
    {"segments = 501", "segments = 500",
     R"(bad.toml:26:1: model.segments is 500|odd|499 or 501|symmetry = "off")"},
    {R"(method = "erk")", "method = \"central-difference\"\nstep = 1e-6",
     "solver.step is 1 us|stability limit|0.284"},
    {R"(method = "erk")", "method = \"nystrom\"\ntable = \"dop853\"",
     R"(solver.table is "dop853"|nystrom|dprkn8)"},
};

TEST(BadCaseFile, EndsEveryCommandWithStatus2AndAMessageThatNamesFileAndKey) {
  for (const auto& [from, to, message] : spoilt_cases) {
    std::string text = read_file(SUBIMPACT_PAPER_CASE);
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, std::string(from).size(), to);
    const TemporaryDirectory directory;
    directory.write("bad.toml", text);
    for (const char* command : {"run", "explain"}) {
      const Finished finished = run_in(directory, {command, "bad.toml"}, 2);
      EXPECT_EQ(finished.output, "") << to;
      EXPECT_TRUE(finished.errors.starts_with("bad.toml:")) << finished.errors;
      expect_all_in(finished.errors, message);
    }
    EXPECT_FALSE(directory.has("bad-results")) << "a refused case left a directory behind";
  }
}

struct BadLine {
  Words arguments;
  const char* message;
};

TEST(BadCommandLine, EndsWithStatus2AndSaysWhyAndLeavesNothing) {
  const std::string paper = SUBIMPACT_PAPER_CASE;
  const BadLine bad_lines[] = {
      {{}, "--help"},
      {{"rnu", "case.toml"}, R"(unknown command "rnu"|explain|did you mean "run"?)"},
      {{"run"}, "CASE is required|subimpact run --help"},
      {{"run", paper, "--fast"}, "--fast"},
      {{"run", paper, "--sett", "beam.length=1"},
       R"(unexpected "--sett beam.length=1"; did you mean "--set"?)"},
      {{"compare", paper, "--laws", "sper"}, "--laws: sper not in|sphere"},
      {{"work-precision", paper, "--sections", "elastc"}, "--sections: elastc not in|elastic"},
      {{"--fast"}, R"(unknown option "--fast")"},
      {{"run", paper, "--out", ""}, "--out: is empty"},
      {{"run", paper, "--method", ""}, "--method: is empty"},
      {{"compare", paper, "--methods", "erk", "--method", "bdf"}, "--method excludes --methods"},
      {{"compare", paper, "--theories", "rayleigh", "--out", "here"}, "excludes"},
      {{"run", paper, "--out"}, "--out"},
      {{"run", "nowhere.toml"}, "nowhere.toml|No such file"},
      {{"run", paper, "--set", "beam.length"}, "--set beam.length|table.key=value"},
      {{"run", paper, "--set", "model.segments=500"},
       "--set model.segments=500: model.segments is 500|odd"},
      {{"new", "bell"},
       "bell|hammer|ball-drop|cantilever|stop|repeated-strikes|tube|rollers|ensemble"},
      {{"keys", "yield", "--schema"}, "excludes"},
      {{"keys", "unheard-of"}, "no key has \"unheard-of\"|subimpact keys"},
      {{"run", paper, "--error-bars=none"}, "none|off"},
      {{"run", paper, "--within", "1us", "--error-bars=off"}, "--error-bars=off"},
      {{"explain", paper, "--within", "1"}, "unit"},
      {{"run", paper, "--within", "0.1"}, "with its unit, such as 1us"},
      {{"run", paper, "--opening", "1"}, "a number with its unit, such as 1um"},
      {{"run", paper, "--opening", "-1um"}, "--opening -1um: output.opening is -1e-06|0 or above"},
      {{"compare", paper, "--methods", "erk", "--opening", "thin"}, "is \"thin\"; allowed"},
      {{"run", paper, "--set", "output.opening=-1"}, "output.opening"},
      {{"run", paper, "--within", "1e300s"}, "--within 1e300s: accuracy.event_times"},
      {{"run", paper, "--within", "small"}, R"(is "small"; allowed: a number with its unit)"},
      {{"run", paper, "--method", "nystron"},
       R"(--method nystron: solver.method|did you mean "nystrom"?)"},
      {{"work-precision", paper, "--methods", "leapfrog", "--out", "chart"},
       R"(--methods leapfrog: solver.method is "leapfrog")"},
      {{"compare", paper, "--methods", "nystrom:dprkn9"},
       R"(--methods nystrom:dprkn9: solver.table is "dprkn9"|"dprkn12"|did you mean "dprkn8"?)"},
      {{"run", paper, "--out", "/dev/null/results"}, "/dev/null/results|choose another with --out"},
  };
  for (const BadLine& line : bad_lines) {
    expect_all_in(run_anywhere(line.arguments, 2).errors, line.message);
  }
}

}  // namespace
}  // namespace subimpact
