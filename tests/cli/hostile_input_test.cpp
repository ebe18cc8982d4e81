#include "process.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

using ACaseFile = InADirectory;

// Into `name` below the directory.
void make_run(const TemporaryDirectory& directory, const std::string& name) {
  run_in(directory, paper("run", {"time.end=1e-4", "model.segments=51", "output.sections=0.5"},
                          {"--out", name, "--quiet"}));
}

// --- text ---------------------------------------------------------------------------------------

TEST(ATerminal, GetsNoControlCharactersOfTitlesKeysAndPaths) {
  const TemporaryDirectory directory;
  const std::string escape = "\x1b[2J\x07\xc2\x9b\x9b\x7f";
  std::string text = read_file(SUBIMPACT_PAPER_CASE);
  text.insert(text.find("title = ") + 9, "\\u001b[2J\\u0007\\u009b\\u007f h\u00e4rter ");
  directory.write("title.toml", text);
  directory.write("key.toml", "\"a\\u001b[2Jb\" = 1\n");
  directory.write(escape + ".toml", "nonsense\n");
  make_run(directory, "results");
  directory.write("results/events.csv", "a" + escape + ",b\n1,2\n");
  const std::vector<std::vector<std::string>> commands = {
      {"explain", "title.toml"},
      {"explain", "key.toml"},
      {"explain", escape + ".toml"},
      {"explain", escape},
      {"explain", "title.toml", "--set", "a" + escape + "=1"},
      {"compare", "title.toml", "--methods", escape},
      {escape},
      {"report", escape},
      {"report", "results"},
      {"--" + escape}};
  for (const std::vector<std::string>& command : commands) {
    const Finished finished = run_program(command, directory.path);
    const std::string shown = finished.output + finished.errors;
    expect_not_in(shown, "\x1b", "\x07", "\x9b", "\x7f");
  }
  expect_in(run_program({"explain", "title.toml"}, directory.path).output,
            "\\x1b[2J\\x07\\xc2\\x9b\\x7f h\u00e4rter ");
}

// --- sizes --------------------------------------------------------------------------------------

TEST_F(ACaseFile, NestedTooDeeplyOrTooLargeIsRefused) {
  std::string key = "a";
  for (int i = 0; i < 40000; ++i) key += ".a";
  const std::string many(100000, '[');
  std::string tables;
  for (int i = 0; i < 50000; ++i) tables += "{a=";
  for (const std::string& text : {key + " = 1\n", "\n[" + key + "]\n", "a = " + many,
                                  "a = " + tables, "\"\"\"\n\\\"\"\"\"\"." + key + "=1"}) {
    directory.write("deep.toml", text);
    expect_in(run_in(directory, {"explain", "deep.toml"}, 2).errors,
              "deep.toml:", "nested deeper than 32");
  }
  directory.write("large.toml", std::string(1'000'001, '#'));
  const Finished large = run_in(directory, {"explain", "large.toml"}, 2);
  expect_in(large.errors, "large.toml: is larger than 1000000 bytes");
  run_anywhere({"explain", "/dev/zero"}, 2);
}

TEST(ASetting, NestedTooDeeplyIsRefused) {
  std::string value = "1\na";
  for (int i = 0; i < 30000; ++i) value += ".a";
  expect_in(run_anywhere(paper("explain", {"beam.length=" + value + "=1"}), 2).errors,
            "beam.length is ");
}

TEST_F(ACaseFile, OfManyUnknownKeysIsRefusedAtOnce) {
  std::string text;
  for (int i = 0; i < 100000; ++i) text.append("k").append(std::to_string(i)).append("=1\n");
  directory.write("keys.toml", text + std::string(100000, 'k') + "=1\n");
  const Finished finished = run_in(directory, {"explain", "keys.toml"}, 2);
  EXPECT_LT(finished.errors.size(), 100000u);
}

// --- numbers ------------------------------------------------------------------------------------

TEST(Numbers, ThatOverflowTogetherAreRefusedByKeyInsteadOfHanging) {
  for (const char* key : {"beam.length", "beam.width", "beam.thickness", "beam.density",
                          "beam.youngs_modulus", "beam.yield_stress", "striker.mass",
                          "striker.nose_radius", "striker.velocity", "time.end"}) {
    for (const char* value : {"1e-308", "4.9e-324", "1e-200", "1e-61", "1e61", "1e308"}) {
      expect_in(run_anywhere(paper("explain", {std::string(key) + "=" + value}), 2).errors,
                std::string(key) + " is ", "allowed: ");
    }
  }
  expect_in(run_anywhere(paper("explain", {"beam.length=1e-25"}), 2).errors,
            "moment of inertia of the beam is some 1e-");
}

// --- streams ------------------------------------------------------------------------------------

TEST(StandardOutput, ThatCannotBeWrittenEndsEveryCommandWithStatus3) {
  const TemporaryDirectory directory;
  directory.write("case.toml", read_file(SUBIMPACT_PAPER_CASE));
  make_run(directory, "run");
  for (const std::string command :
       {"--help", "--version", "keys", "keys --schema", "methods", "columns", "explain case.toml",
        "run case.toml --set time.end=1e-5 --set model.segments=21 --out other",
        "sensitivity case.toml --set time.end=1e-5 --set model.segments=21",
        "plot run --only timeline --format svg", "report run"}) {
    EXPECT_EQ(shell("subimpact " + command + " > /dev/full 2> errors", directory.path), 3)
        << command;
    const std::string errors = directory.read("errors");
    expect_in(errors, "standard output cannot be written");
    EXPECT_EQ(count_in(errors, "\n"), 1u) << errors;
  }
  EXPECT_TRUE(directory.has("other/summary.json"));
  EXPECT_EQ(shell("subimpact keys >&- 2> errors", directory.path), 3);
}

TEST(ClosedStreams, AreNotTakenByTheFilesOfARun) {
  const TemporaryDirectory directory;
  directory.write("case.toml", read_file(SUBIMPACT_PAPER_CASE));
  const std::string run =
      "subimpact run case.toml --set time.end=1e-5 --set model.segments=21 --out ";
  EXPECT_EQ(shell(run + "out <&- >&- 2>&-", directory.path), 3);
  EXPECT_EQ(shell("subimpact report out > words 2> errors", directory.path), 0)
      << directory.read("errors");
}

TEST(AReaderOfStandardOutput, MayLeaveEarly) {
  const TemporaryDirectory directory;
  EXPECT_EQ(shell("subimpact keys 2> errors | head -c 1 > first", directory.path), 0);
  EXPECT_EQ(directory.read("errors"), "");
}

}  // namespace
}  // namespace subimpact
