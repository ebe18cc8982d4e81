#include <gtest/gtest.h>

#include <array>

#include "process.h"

namespace subimpact {
namespace {

/// One way to spoil the paper's case file, and what stderr must then say.
struct Spoilt {
  const char* claim;
  const char* from;
  const char* to;
  std::vector<std::string> message;
};

void PrintTo(const Spoilt& spoilt, std::ostream* out) { *out << spoilt.claim; }

class BadCaseFile : public testing::TestWithParam<Spoilt> {};

TEST_P(BadCaseFile, EndsEveryCommandWithStatus2AndAMessageThatNamesFileAndKey) {
  const Spoilt& spoilt = GetParam();
  std::string text = read_file(SUBIMPACT_PAPER_CASE);
  const auto at = text.find(spoilt.from);
  ASSERT_NE(at, std::string::npos) << spoilt.from;
  text.replace(at, std::string(spoilt.from).size(), spoilt.to);
  const TemporaryDirectory directory;
  directory.write("bad.toml", text);
  for (const char* command : {"run", "explain"}) {
    const Finished finished = run_program({command, "bad.toml"}, directory.path);
    EXPECT_EQ(finished.status, 2) << command;
    EXPECT_EQ(finished.output, "") << command;
    EXPECT_EQ(finished.errors.find("bad.toml:"), 0u) << finished.errors;
    for (const std::string& piece : spoilt.message) {
      EXPECT_NE(finished.errors.find(piece), std::string::npos)
          << command << ": \"" << piece << "\" is not in: " << finished.errors;
    }
  }
  EXPECT_FALSE(std::filesystem::exists(directory.path / "bad-results"))
      << "a refused case left a directory behind";
}

const Spoilt spoilt_cases[] = {
    {"UnknownKey",
     "\nlength",
     "\nlenght",
     {"unknown key \"beam.lenght\"", "did you mean \"beam.length\""}},
    {"UnknownTable",
     "[striker]",
     "[stricker]",
     {"unknown table [stricker]", "did you mean [striker]"}},
    {"WrongType",
     "mass = 0.201",
     "mass = \"heavy\"",
     {"striker.mass is a text (\"heavy\")", "a number"}},
    {"Negative", "width = 0.0163", "width = -0.0163", {"beam.width is -0.0163", "above 0 (m)"}},
    {"NotANumber", "density = 2600.0", "density = nan", {"beam.density is nan", "finite"}},
    {"ZeroMass", "mass = 0.201", "mass = 0.0", {"striker.mass is 0", "above 0 (kg)"}},
    {"EvenSegments",
     "segments = 501",
     "segments = 500",
     {"bad.toml:26:1: model.segments is 500", "odd", "499 or 501", "symmetry = \"off\""}},
    {"MixedCellsOfLayers",
     "mesh = \"cells\"",
     "mesh = \"mixed\"",
     {"model.section is \"layers\"", "closed form", "\"exact\", \"elastic\""}},
    {"MixedCellsByRungeKutta",
     "mesh = \"cells\"\nsegments = 501\nsection = \"layers\"",
     "mesh = \"mixed\"\nsegments = 500\nsection = \"exact\"",
     {"solver.method is \"erk\"", "allowed with model.mesh = \"mixed\"", "\"central-difference\""}},
    {"OddLayers", "layers = 40", "layers = 39", {"model.layers is 39", "even"}},
    {"HugeSegments",
     "segments = 501",
     "segments = 2000000001",
     {"model.segments is 2000000001", "100001"}},
    {"MissingTable", "[time]\nend = 8e-3", "", {"table [time] is missing", "end"}},
    {"MissingKey", "\nvelocity = 15.9", "\n", {"striker.velocity is missing", "m/s"}},
    {"MalformedToml", "[striker]", "[striker", {"not valid TOML"}},
    {"StepTooLarge",
     "method = \"erk\"",
     "method = \"central-difference\"\nstep = 1e-6",
     {"solver.step is 1 us", "stability limit", "0.284"}},
    {"TableOfAnotherMethod",
     "method = \"erk\"",
     "method = \"nystrom\"\ntable = \"dop853\"",
     {"solver.table is \"dop853\"", "nystrom", "dprkn8"}},
    {"UnknownMethod",
     "method = \"erk\"",
     "method = \"euler\"",
     {"solver.method is \"euler\"", "\"central-difference\", \"erk\""}},
};

INSTANTIATE_TEST_SUITE_P(OfEveryKind, BadCaseFile, testing::ValuesIn(spoilt_cases),
                         [](const auto& info) { return std::string(info.param.claim); });

struct BadLine {
  const char* claim;
  std::vector<std::string> arguments;
  std::vector<std::string> message;
};

void PrintTo(const BadLine& line, std::ostream* out) { *out << line.claim; }

class BadCommandLine : public testing::TestWithParam<BadLine> {};

TEST_P(BadCommandLine, EndsWithStatus2AndSaysWhy) {
  const TemporaryDirectory directory;
  const Finished finished = run_program(GetParam().arguments, directory.path);
  EXPECT_EQ(finished.status, 2);
  for (const std::string& piece : GetParam().message) {
    EXPECT_NE(finished.errors.find(piece), std::string::npos)
        << '"' << piece << "\" is not in: " << finished.errors;
  }
  EXPECT_TRUE(std::filesystem::is_empty(directory.path));
}

const BadLine bad_lines[] = {
    {"NoCommand", {}, {"--help"}},
    {"UnknownCommand",
     {"rnu", "case.toml"},
     {"unknown command \"rnu\"", "explain", "did you mean \"run\"?"}},
    {"NoCase", {"run"}, {"CASE is required", "subimpact run --help"}},
    {"UnknownOption", {"run", SUBIMPACT_PAPER_CASE, "--fast"}, {"--fast"}},
    {"OptionWithoutACommand", {"--fast"}, {"unknown option \"--fast\""}},
    {"EmptyDirectory", {"run", SUBIMPACT_PAPER_CASE, "--out", ""}, {"--out: is empty"}},
    {"EmptyMethod", {"run", SUBIMPACT_PAPER_CASE, "--method", ""}, {"--method: is empty"}},
    {"MethodOfACommandThatChoosesItself",
     {"plan", SUBIMPACT_PAPER_CASE, "--within", "1us", "--method", "bdf"},
     {"--method"}},
    {"MethodBesideMethods",
     {"compare", SUBIMPACT_PAPER_CASE, "--methods", "erk", "--method", "bdf"},
     {"--method excludes --methods"}},
    {"DirectoryForTheoriesThatWriteNothing",
     {"compare", SUBIMPACT_PAPER_CASE, "--theories", "rayleigh", "--out", "here"},
     {"excludes"}},
    {"OptionWithoutItsValue", {"run", SUBIMPACT_PAPER_CASE, "--out"}, {"--out"}},
    {"FileThatIsNotThere", {"run", "nowhere.toml"}, {"nowhere.toml", "No such file"}},
    {"SettingWithoutValue",
     {"run", SUBIMPACT_PAPER_CASE, "--set", "beam.length"},
     {"--set beam.length", "table.key=value"}},
    {"SettingOfAnUnknownKey",
     {"run", SUBIMPACT_PAPER_CASE, "--set", "beam.lenght=1"},
     {"--set beam.lenght=1", "did you mean \"beam.length\"?"}},
    {"SettingOutOfRange",
     {"run", SUBIMPACT_PAPER_CASE, "--set", "striker.mass=-1"},
     {"--set striker.mass=-1: striker.mass is -1", "above 0 (kg)"}},
    {"SettingThatTheMeshRefuses",
     {"run", SUBIMPACT_PAPER_CASE, "--set", "model.segments=500"},
     {"--set model.segments=500: model.segments is 500", "odd"}},
    {"SceneThatIsNotThere", {"new", "bell"}, {"bell", "hammer", "ball-drop", "cantilever"}},
    {"ErrorBarsThatAreNotThere",
     {"run", SUBIMPACT_PAPER_CASE, "--error-bars=none"},
     {"none", "off"}},
    {"ToleranceWithoutAUnit", {"explain", SUBIMPACT_PAPER_CASE, "--within", "1"}, {"unit"}},
    {"UnknownMethod",
     {"run", SUBIMPACT_PAPER_CASE, "--method", "nystron"},
     {"--method nystron: solver.method", "did you mean \"nystrom\"?"}},
    {"OutputWhereNothingCanBe",
     {"run", SUBIMPACT_PAPER_CASE, "--out", "/dev/null/results"},
     {"/dev/null/results", "choose another with --out"}},
};

INSTANTIATE_TEST_SUITE_P(OfEveryKind, BadCommandLine, testing::ValuesIn(bad_lines),
                         [](const auto& info) { return std::string(info.param.claim); });

}  // namespace
}  // namespace subimpact
