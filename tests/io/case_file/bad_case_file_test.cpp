#include "small_case.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"
#include "testing.h"

namespace subimpact {
namespace {

std::string refusal_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  return answer_of<CaseFileError>([&] { read_case_text(text, "bad.toml", overrides); });
}

std::string refusal_with(const std::string& setting) {
  return refusal_of(small_case_text(), {parse_override(setting)});
}

/// Ways to spoil the small case, and what the message must then contain: place, key, what was found
/// and what is allowed, after the name of the file.
constexpr const char* spoilt_cases[][3] = {
    {"length = 0.7112", "lenght = 0.7112",
     R"(2:1: |unknown key "beam.lenght"|width, thickness|did you mean "beam.length"?)"},
    {"youngs", "rtol = 1e-9\nyoungs",
     R"(6:1: |unknown key "beam.rtol"|did you mean "solver.rtol"?)"},
    {"youngs", "end = 8e-3\nyoungs", R"(6:1: |did you mean "time.end" or "beam.ends"?)"},
    {"length = 0.7112", "length = 711.2 mm", "2:|not valid TOML|a value with its unit in quotes"},
    {"length = 0.7112", "length = '711.2 kg'",
     R"(2:1: |("711.2 kg")|"kg" is none of its units: m, mm)"},
    {"mass = 0.201", "mass = 0.201\nposition = '0.8 m'",
     "9:1: |striker.position is 1.12|or a length such as|beam.length is 0.7112 m"},
    {"density = 2600\nyoungs_modulus = 71.96e9", "material = 'S275'", "|did you mean \"S235\"?"},
    {"length = 0.7112", "length = '711,2 mm'",
     R"(|("711,2 mm")|in m; numbers have a decimal point)"},
    {"mass = 0.201", "mass = 0.201\nposition = '0.5 kg'", R"(|"kg" is none of its units: m, mm)"},
    {"", "[model]\nsegments = '501 cells'", R"(14:1: |("501 cells")|a whole number)"},
    {"velocity = 15.9", "velocity = '15.9 M/S'", R"(|"M/S" is none of its units: m/s, mm/s)"},
    {"mass = 0.201", "mass = '-201 g'", "|striker.mass is -0.201|above 0 (kg)"},
    {"length = 0.7112", "length = '28 yd'", R"(|"yd" is none of its units: m, mm, um, cm, km)"},
    {"length = 0.7112", "length = '0.7 0.1'", R"(|("0.7 0.1")|none of its units)"},
    {"length = 0.7112", "length = 'mm'", R"(|("mm")|above 0 (m))"},
    {"youngs", "position = 0.5\nyoungs", R"(|did you mean "striker.position"?)"},
    {"mass = 0.201", "mass = 0.201\nlaw = 'hertz'", R"(|did you mean "contact.law"?)"},
    {"", "[solver]\nmesh = 'cells'", R"(|did you mean "model.mesh"?)"},
    {"[beam]", "lengt = 1\n[beam]", R"(1:1: |unknown key "lengt"|outside all tables|title)"},
    {"[time]", "[tiem]",
     "11:2: |unknown table [tiem]|[beam], [beam.damping], [beam.section], [striker]|did you mean "
     "[time]?"},
    {"mass = 0.201\n", "", "7:2: |striker.mass is missing|above 0 (kg)|under [striker]"},
    {"[time]\nend = 2e-5\n", "", " |table [time] is missing|at least: end"},
    {"length = 0.7112", "length = '0.7112'",
     R"(2:1: |beam.length is a text ("0.7112")|a number, finite and above 0 (m)|without quotes)"},
    {"", "[model]\nmesh = 'hermite'\nspacing = 'points'",
     R"(15:1: model.spacing is "points"|only cells have a spacing|allowed with this mesh: "cells"|leave it out)"},
    {"", "[model]\nmesh = 'rigid'\nspacing = 'points'",
     R"(15:1: model.spacing is "points"|allowed with this mesh: "cells")"},
    {"[striker]", "ends = ['pinned', 'free']\n[model]\nspacing = 'points'\n[striker]",
     R"(|: model.spacing is "points", which is for free ends|allowed with supports: "cells"|leave it out)"},
    {"nose_radius = 0.01\n", "", R"( striker.nose_radius is missing|"foundation" needs it|(m))"},
    {"", "[contact]\nstiffness = 1e7",
     R"(14:1: contact.stiffness is given|"foundation" derives its stiffness|leave it out)"},
    {"", "[contact]\nlaw = 'linear'",
     R"( contact.stiffness is missing|"linear" needs it|give it in N/m)"},
    {"", "[contact]\nlaw = 'linear'\nstiffness = 1e6\nstriker_modulus = 2e11",
     R"(16:1: contact.striker_modulus is given|"linear" does not use it)"},
    {"", "[contact]\nlaw = 'hertz'",
     " contact.striker_modulus is missing|contact.stiffness in N/m^1.5"},
    {"", "[contact]\nlaw = 'hertz'\nstiffness = 1e10\nbeam_poisson = 0.3",
     "16:1: contact.beam_poisson is given|already sets the stiffness"},
    {"", "[output]\nsections = [0.5, 1.5]",
     "14:1: output.sections is [0.5, 1.5]|a list of numbers, each from 0 to 1"},
    {"", "[output]\nsections = ['middle']",
     R"(14:1: output.sections is a list (["middle"])|a list of numbers)"},
    {"", "[output]\nsections = [0.5]\ninterval = 0",
     "14:1: output.sections is given|output.interval = 0"},
    {"", "[output]\npoints = [0.5]\ninterval = 0",
     "14:1: output.points is given|output.interval = 0"},
    {"", "[output]\nshapes = 1e-15", "14:1: |output.shapes is 1e-15 s|at most 2e+07 rows"},
    {"", "[contact]\nlaw = 3", R"(14:1: |contact.law is a whole number (3)|"foundation")"},
    {"", "[model]\nsegments = 501.0",
     "14:1: |model.segments is a floating-point number|a whole number, from 5 to 100001|without "
     "decimal point"},
    {"end = 2e-5", "end = 2024-01-31", "12:1: |time.end is a date|above 0 (s)"},
    {"", "[study]\nbeyond_critical = 1",
     "14:1: |study.beyond_critical is a whole number (1)|true or false"},
    {"end = 2e-5", "end.value = 2e-5", "12:1: |time.end is a table|a number"},
    {"[time]", "[[time]]", R"(11:3: |"time" is a list|allowed: a table)"},
    {"width = 0.0163", "width = -0.0163", "3:1: |beam.width is -0.0163|above 0 (m)"},
    {"mass = 0.201", "mass = 0", "8:1: |striker.mass is 0|above 0 (kg)"},
    {"density = 2600", "density = nan", "5:1: |beam.density is nan|finite and above 0 (kg/m3)"},
    {"youngs_modulus = 71.96e9", "youngs_modulus = inf",
     "6:1: |beam.youngs_modulus is inf|finite and above 0 (Pa)"},
    {"youngs", "yield_stress = -inf\nyoungs",
     "6:1: |beam.yield_stress is -inf|above 0, or inf (Pa)"},
    {"[time]", "position = 1.5\n[time]", "11:1: |striker.position is 1.5|from 0 to 1"},
    {"[time]", "position = 0.0005\n[model]\nsegments = 501\n[time]",
     "11:1: |striker.position is 0.0005|501 segments|0.000998"},
    {"", "[model]\nsegments = 1000000000000",
     "14:1: |model.segments is 1000000000000|from 5 to 100001"},
    {"", "[model]\nlayers = 41", "14:1: |model.layers is 41|even, from 2 to 10000"},
    {"", "[contact]\nlaw = 'foundaton'",
     R"(14:1: |contact.law is "foundaton"|"foundation"|did you mean "foundation"?)"},
    {"", "[solver]\nmethod = 'leapfrog'",
     R"(14:1: |solver.method is "leapfrog"|"central-difference", "erk")"},
    {"", "[solver]\ntable = 'dop54'",
     R"(14:1: |solver.table is "dop54"|"dop853", "dormand-prince")"},
    {"youngs", "ends = ['free', 'glued']\nyoungs",
     R"(6:1: |beam.ends is "glued"|a list of two out of "free")"},
    {"youngs", "ends = ['free', 'clampt']\nyoungs",
     R"(6:1: |beam.ends is "clampt"|did you mean "clamped"?)"},
    {"youngs", "ends = 'clamped'\nyoungs",
     R"(6:1: |beam.ends is a text ("clamped")|did you mean ["clamped", "clamped"]?)"},
    {"youngs", "ends = ['pined']\nyoungs", R"(6:1: |did you mean ["pinned", "pinned"]?)"},
    {"mass = 0.201", "mass = 0,201", "8:|not valid TOML|a number with a decimal point"},
    {"youngs", "ends = ['free']\nyoungs", R"(6:1: |beam.ends is ["free"]|a list of two)"},
    {"youngs", "ends = [1, 2]\nyoungs",
     "6:1: |beam.ends is a list of numbers ([1, 2])|a list of two"},
    {"", "[solver]\nrtol = 1e-20", "14:1: |solver.rtol is 1e-20|from 1e-14 to 0.1"},
    {"", "[output]\ninterval = 1e-15", "14:1: |output.interval is 1e-15 s|at most 5e+06 rows"},
    {"", "[output]\nsubzone_gap = 0.2", "14:1: |output.subzone_gap is 0.2|output.zone_gap = 0.1"},
    {"[beam]", "title = \"open\n[beam]", "1:|not valid TOML"},
    {"length = 0.7112", "length = 0.7112\nlength = 0.8", "3:|not valid TOML|length"},
    {"[beam]", "\xff\xfe[beam]", "1:1: |not valid TOML"},
};

TEST(BadCaseFile, IsRefusedWithPlaceKeyFindingAndAllowedValues) {
  for (const auto& [from, to, message] : spoilt_cases) {
    // Without what is replaced it is added at the end, from line 13 on.
    const std::string text = *from == '\0' ? small_case_text() + to : small_case_with(from, to);
    expect_all_in(refusal_of(text), std::string("bad.toml:") + message);
  }
}

TEST(BadCaseFile, EveryProblemIsReportedOnALineOfItsOwn) {
  std::string text = small_case_with("width = 0.0163", "width = -1");
  text.replace(text.find("mass = 0.201"), 12, "mass = true ");
  const std::string message = refusal_of(text);
  expect_in(message, "bad.toml:3:1: beam.width", "\nbad.toml:8:1: striker.mass");
}

TEST(BadCaseFile, AnEmptyFileNamesTheTablesItNeeds) {
  expect_in(refusal_of(""), "[beam]", "[striker]", "[time]");
}

TEST(BadCaseFile, AFileThatIsNotThereIsNamed) {
  expect_in(message_of<CaseFileError>([&] { read_case_file("/nowhere/case.toml"); }),
            "/nowhere/case.toml", "cannot be read", "No such file");
}

TEST(BadCaseFile, ADirectoryIsNoCaseFile) {
  expect_in(message_of<CaseFileError>([&] { read_case_file("/tmp"); }), "/tmp", "is a directory");
}

TEST(BadCaseFile, OfDoubtfulUnitsIsToldThemFirst) {
  std::string text = small_case_with("youngs_modulus = 71.96e9", "youngs_modulus = 71960");
  text += "[output]\ninterval = 1e-15\n";
  const std::string message = refusal_of(text);
  const auto doubt = message.find("check the unit first: beam.youngs_modulus is 71960 Pa");
  ASSERT_NE(doubt, std::string::npos) << message;
  EXPECT_LT(doubt, message.find("history rows")) << message;
  expect_not_in(refusal_of(small_case_text() + "[output]\ninterval = 1e-15\n"), "check the unit");
}

TEST(Units, StandForTheSameDoublesAsNumbersInSI) {
  struct Written {
    const char* key;
    std::string number, with_unit;
  };
  for (const auto& [key, number, with_unit] : {Written{"beam.length", "0.7112", "711.2 mm"},
                                               {"beam.length", "0.7112", "71.12cm"},
                                               {"beam.length", "0.7112", " 7.112e2  mm "},
                                               {"beam.length", "0.7112", "0.7112 m"},
                                               {"beam.length", "0.7112", "28 in"},
                                               {"beam.length", "0.7112", "28 inch"},
                                               {"beam.length", "0.7112", "711200000 nm"},
                                               {"beam.length", "0.7112", "711200 \u00b5m"},
                                               {"beam.length", "0.7112", "711200 \u03bcm"},
                                               {"beam.youngs_modulus", "71.96e9", "71960 N/mm^2"},
                                               {"striker.mass", "0.201", "201000 mg"},
                                               {"striker.mass", "0.201", "201 g"},
                                               {"beam.youngs_modulus", "71.96e9", "71.96 GPa"},
                                               {"beam.density", "2600", "2.6 g/cm3"},
                                               {"striker.velocity", "15.9", "15900 mm/s"}}) {
    const CaseKey& found = *find_case_key(key);
    const auto value_of = [&](const LoadedCase& loaded) {
      return std::get<double>(*found.get(loaded.value));
    };
    const std::string line = found.leaf() + " = ", quoted = '"' + with_unit + '"';
    EXPECT_EQ(value_of(read_case_text(small_case_with(line + number, line + quoted), "case.toml")),
              std::stod(number))
        << with_unit;
    EXPECT_EQ(value_of(read_case_text(small_case_text(), "case.toml",
                                      {parse_override(found.name + "=" + quoted)})),
              std::stod(number))
        << with_unit;
  }
  const LoadedCase bare =
      read_case_text(small_case_text(), "case.toml", {parse_override("time.end=8 ms")});
  EXPECT_EQ(bare.value.end_time, 8e-3);
}

TEST(UnitsOfOtherHabits, AreThoseOfTheInternationalYardAndPoundOfSiAndOfSuperscripts) {
  for (const auto& [setting, value] : {std::pair{"striker.velocity=18 km/h", 5.0},
                                       {"striker.mass=1 lb", 0.45359237},
                                       {"striker.velocity=50 ft/s", 15.24},
                                       {"striker.velocity=10 in/s", 0.254},
                                       {"striker.velocity=1590 cm/s", 15.9},
                                       {"beam.length=1 ft", 0.3048},
                                       {"scene.gravity=1 g", 9.80665},
                                       {"beam.density=2600 kg/m\u00b3", 2600.0},
                                       {"beam.density=2.6 kg/dm3", 2600.0},
                                       {"beam.density=2.6 t/m3", 2600.0},
                                       {"beam.density=2.6e-9 t/mm3", 2600.0},
                                       {"beam.yield_stress=150 N/mm\u00b2", 150e6},
                                       {"beam.yield_stress=1500 bar", 150e6},
                                       {"beam.yield_stress=1 psi", 6894.757293168361},
                                       {"beam.youngs_modulus=10000 ksi", 68947572931.68361},
                                       {"beam.load=1 kN/mm", 1e6}}) {
    const Override given = parse_override(setting);
    const LoadedCase read = read_case_text(small_case_text(), "case.toml", {given});
    const KeyValue found =
        *find_case_key(std::string(setting).substr(0, std::string_view(setting).find('=')))
             ->get(read.value);
    EXPECT_DOUBLE_EQ(std::get<double>(found), value) << setting;
  }
}

TEST(AList, TakesUnitsAsASingleNumberDoes) {
  const LoadedCase read = read_case_text(
      small_case_text(), "case.toml",
      {parse_override("striker.nose_radius=default"), parse_override("contact.law=curve"),
       parse_override(R"(contact.curve_indentation=["0 mm", "0.1 mm"])"),
       parse_override(R"(contact.curve_force=["0 N", "2 kN"])")});
  EXPECT_EQ(read.value.scene.contact.curve_force, (std::vector<double>{0.0, 2000.0}));
  EXPECT_EQ(read.value.scene.contact.curve_indentation, (std::vector<double>{0.0, 1e-4}));
}

TEST(AContactStiffness, HasTheUnitOfItsLaw) {
  const auto read = [](const char* law, const char* stiffness) {
    return read_case_text(small_case_text(), "case.toml",
                          {parse_override("striker.nose_radius=default"),
                           parse_override(std::string("contact.law=") + law),
                           parse_override(std::string("contact.stiffness=") + stiffness)})
        .value.scene.contact.stiffness;
  };
  EXPECT_EQ(read("linear", "60 MN/m"), 60e6);
  EXPECT_EQ(read("hertz", "30 GN/m^1.5"), 30e9);
  EXPECT_EQ(read("hertz", "3e10"), 3e10);
  for (const auto& [law, stiffness, allowed] :
       {std::tuple("hertz", "60 MN/m", "N/m^1.5"), {"linear", "30 GN/m^1.5", "kN/m"}}) {
    try {
      read(law, stiffness);
      ADD_FAILURE() << law;
    } catch (const CaseFileError& error) {
      expect_in(error.what(), "contact.stiffness is in", law, "allows", allowed);
    }
  }
}

TEST(BadOverride, IsNamedAsTheCommandLineGaveIt) {
  for (const auto& [setting, message] :
       {std::pair("striker.mass=-1", "striker.mass is -1|above 0 (kg)"),
        {"striker.mas=1", R"(unknown key|did you mean "striker.mass"?)"},
        {"striler.mass=1", "unknown table [striler]|did you mean [striker]?"},
        {"mass=1", R"(did you mean "striker.mass" or "beam.damping.mass"?)"},
        {"beam.damping=1", R"(unknown key "beam.damping"|it is a table)"},
        {"time.end=", "time.end is ''|above 0 (s)"},
        {"time.end=8 mm", R"("mm" is none of its units: s, ms, us, ns)"},
        {"striker.mass=0,201", "kg; numbers have a decimal point"},
        {"solver.pair_detection=false", R"(did you mean "study.pair_detection"?)"},
        {"time.end=1\nother=2", "time.end is|above 0 (s)"}}) {
    const std::string refusal = refusal_with(setting);
    expect_all_in(refusal, message);
    expect_in(refusal, std::string("--set ") + std::string(setting).substr(0, 8));
  }
}

TEST(BadOverride, WithoutAnEqualsSignIsNoSetting) {
  EXPECT_THROW(parse_override("striker.mass"), CaseFileError);
  EXPECT_THROW(parse_override("=3"), CaseFileError);
}

TEST(BadOverride, HidesTheFilesOwnMistakeInThatKey) {
  const std::string text = small_case_with("end = 2e-5", "end = \"soon\"");
  EXPECT_EQ(refusal_of(text, {parse_override("time.end=1e-3")}), "(accepted)");
}

}  // namespace
}  // namespace subimpact
