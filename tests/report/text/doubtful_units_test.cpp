#include "subimpact/case/case_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <random>

#include "case_with.h"
#include "subimpact/case/simulate.h"
#include "subimpact/io/results.h"
#include "subimpact/report/text.h"
#include "testing.h"

namespace subimpact {
namespace {

// README's case, of an aluminium-like beam.
constexpr const char* readme_case =
    "beam = { length = 0.7112, width = 0.0163, thickness = 0.0075, density = 2600, youngs_modulus "
    "= 71.96e9, yield_stress = 150e6 }\n"
    "striker = { mass = 0.201, nose_radius = 0.01, velocity = 15.9 }\n"
    "time = { end = 8e-3 }\n";

Case readme_with(const std::vector<std::string>& settings) {
  std::vector<Override> all = overrides(settings);
  all.insert(all.begin(), parse_override("output.interval=0"));
  return read_case_text(readme_case, "readme.toml", all).value;
}

/// Values as someone would give them in another unit; what the warnings must then say, one by one.
struct Slip {
  std::vector<std::string> settings;
  std::vector<std::string> doubts;  // pieces of each, as expect_all_in takes them
};

constexpr const char* length_in_mm = "beam.length is 711.2 m|if mm was meant|write 0.7112";
constexpr const char* width_in_mm = "beam.width is 16.3 m|write 0.0163";
constexpr const char* thickness_in_mm = "beam.thickness is 7.5 m|write 0.0075";
constexpr const char* nose_in_mm = "striker.nose_radius is 10 m|write 0.01";
constexpr const char* mass_of_226000_t = "beam.length is 711.2 m|weighs 226055 t";

const Slip slips[] = {
    {{"beam.length=711.2", "beam.width=16.3", "beam.thickness=7.5"},
     {mass_of_226000_t, width_in_mm, thickness_in_mm}},
    {{"beam.length=711.2", "beam.width=16.3", "beam.thickness=7.5", "striker.nose_radius=10"},
     {length_in_mm, width_in_mm, thickness_in_mm, nose_in_mm}},
    {{"beam.length=711.2"}, {length_in_mm}},
    {{"beam.width=16.3"}, {width_in_mm}},
    {{"beam.thickness=7.5"}, {thickness_in_mm}},
    {{"beam.width=16.3", "beam.thickness=7.5"}, {width_in_mm, thickness_in_mm}},
    {{"beam.length=711.2", "beam.thickness=7.5"}, {length_in_mm, thickness_in_mm}},
    {{"striker.nose_radius=10"}, {nose_in_mm}},
    {{"beam.youngs_modulus=71960"},
     {"beam.youngs_modulus is 71960 Pa|soft rubber|if MPa was meant, write 7.196e+10"}},
    {{"beam.youngs_modulus=71.96"},
     {"beam.youngs_modulus is 71.96 Pa|if GPa was meant, write 7.196e+10"}},
    {{"beam.youngs_modulus=71.96e12"}, {"beam.youngs_modulus is 7.196e+13 Pa|diamond"}},
    {{"beam.yield_stress=150"}, {"beam.yield_stress is 150 Pa|if MPa was meant, write 1.5e+08"}},
    {{"beam.yield_stress=0.15"}, {"beam.yield_stress is 0.15 Pa|if GPa was meant, write 1.5e+08"}},
    {{"beam.youngs_modulus=150e6", "beam.yield_stress=71.96e9"},
     {"beam.yield_stress is 7.196e+10 Pa|reached at a strain of 4.8e+02|swapped"}},
    {{"beam.yield_stress=150e9"},
     {"beam.yield_stress is 1.5e+11 Pa|if kPa was meant, write 1.5e+08"}},
    {{"beam.youngs_modulus=71960", "beam.yield_stress=150"},
     {"beam.youngs_modulus|write 7.196e+10", "beam.yield_stress|write 1.5e+08"}},
    {{"beam.density=2.6"},
     {"beam.density is 2.6 kg/m3|packing foam|if g/cm3 was meant, write 2600"}},
    {{"beam.density=2.6e-9"}, {"beam.density is 2.6e-09 kg/m3|if t/mm3 was meant, write 2600"}},
    {{"beam.density=2.6e6"},
     {"beam.density is 2.6e+06 kg/m3|osmium|if g/m3 was meant, write 2600"}},
    {{"striker.velocity=15900"},
     {"striker.velocity is 15900 m/s|rifle bullet|if mm/s was meant, write 15.9"}},
    {{"striker.velocity=default", "striker.drop_height=60000"},
     {"striker.drop_height is 60000 m|rifle bullet|if mm was meant, write 60"}},
    {{"striker.mass=201"}, {"striker.mass is 201 kg|889 times the beam's 0.226 kg|write 0.201"}},
    {{"time.end=8"},
     {"time.end is 8 s|periods of the beam's slowest vibration|if ms was meant, write 0.008"}},
    {{"time.end=8000"}, {"time.end is 8000 s|if us was meant, write 0.008"}},
    {{"solver.step=0.1"},
     {"solver.step is 0.1 s|longer than the whole run|if us was meant, write 1e-07"}},
    {{"accuracy.event_times=1"},
     {"accuracy.event_times is 1 s|longer than the whole run|if us was meant, write 1e-06"}},
    {{"contact.law=hertz", "contact.striker_modulus=210", "contact.striker_poisson=0.3",
      "contact.beam_poisson=0.3"},
     {"contact.striker_modulus is 210 Pa|if GPa was, 2.1e+11"}},
};

TEST(UnitSlips, AreDoubtedForEachKeyAndOnlyForThose) {
  for (const Slip& slip : slips) {
    const std::vector<std::string> doubts = doubtful_units(readme_with(slip.settings));
    ASSERT_EQ(doubts.size(), slip.doubts.size()) << fmt::format("{}", fmt::join(doubts, "\n"));
    for (std::size_t i = 0; i < doubts.size(); ++i) expect_all_in(doubts[i], slip.doubts[i]);
  }
}

/// Scenes far from README's that are all the same plausible.
const std::pair<const char*, std::vector<std::string>> plausible_scenes[] = {
    {"OfReadme", {}},
    {"SiliconMicrobeam",
     {"beam.length=100e-6", "beam.width=10e-6", "beam.thickness=2e-6", "beam.density=2330",
      "beam.youngs_modulus=1.6e11", "beam.yield_stress=inf", "striker.mass=1e-9",
      "striker.nose_radius=1e-3", "striker.velocity=0.1", "time.end=1e-4"}},
    {"ConcreteSleeper",
     {"beam.length=2.6", "beam.width=0.26", "beam.thickness=0.22", "beam.density=2400",
      "beam.youngs_modulus=3.5e10", "beam.yield_stress=3e7", "striker.mass=600",
      "striker.nose_radius=0.46", "striker.velocity=2", "time.end=0.1"}},
    {"SteelBridgeGirder",
     {"beam.length=30", "beam.width=0.5", "beam.thickness=2", "beam.density=7850",
      "beam.youngs_modulus=2.1e11", "beam.yield_stress=355e6", "beam.ends=pinned,pinned",
      "striker.mass=40000", "striker.nose_radius=0.5", "striker.velocity=20", "time.end=10"}},
    {"GuardRailAndLorry",
     {"beam.length=4", "beam.width=0.3", "beam.thickness=3e-3", "beam.density=7850",
      "beam.youngs_modulus=2.1e11", "beam.yield_stress=235e6", "striker.mass=38000",
      "striker.nose_radius=0.5", "striker.velocity=20", "time.end=0.5"}},
    {"DropTowerOnASmallSpecimen",
     {"beam.length=0.15", "beam.width=0.02", "beam.thickness=0.01", "beam.density=1800",
      "beam.youngs_modulus=2e10", "striker.mass=20", "striker.velocity=4"}},
    {"RubberStrip",
     {"beam.youngs_modulus=5e6", "beam.density=1100", "beam.yield_stress=inf",
      "striker.velocity=0.5"}},
    {"BalsaBeam",
     {"beam.youngs_modulus=3e9", "beam.density=120", "beam.yield_stress=1e7", "striker.mass=0.01"}},
    {"ShotAtATungstenBeam",
     {"beam.youngs_modulus=4.1e11", "beam.density=19300", "beam.yield_stress=7.5e8",
      "striker.mass=1e-4", "striker.velocity=800"}},
    {"WideStrip", {"beam.width=1.5"}},
    {"NearlyFlatNose", {"striker.nose_radius=2"}},
    {"RunUntilNoMoreContact", {"time.end=1000", "time.stop=no-more-contact"}},
    {"RigidBodyOfAnyShape", {"model.mesh=rigid", "beam.thickness=5", "beam.density=1e9"}}};

TEST(PlausibleScenes, AreNotDoubted) {
  for (const auto& [name, settings] : plausible_scenes) {
    const auto doubts = doubtful_units(readme_with(settings));
    EXPECT_TRUE(doubts.empty()) << name << ": " << fmt::format("{}", fmt::join(doubts, "\n"));
  }
}

TEST(DoubtfulUnits, AreNoneInRandomPlausibleScenes) {
  std::mt19937 generator(20240607);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, share(generator));
  };
  for (int i = 0; i < 2000; ++i) {
    Case input = readme_with({});
    Beam& beam = input.scene.beam;
    beam.length = between(0.1, 1.3);
    beam.thickness = between(1e-3, 60e-3);
    beam.width = between(2e-3, 0.2);
    beam.youngs_modulus = between(1e8, 7e11);
    beam.yield_stress = between(5e-4, 5e-2) * beam.youngs_modulus;
    beam.density = between(900.0, 23000.0);
    input.scene.striker.mass = between(1e-6, 100.0);
    input.scene.striker.velocity = between(0.01, 300.0);
    input.scene.striker.nose_radius = between(1e-3, 0.1);
    input.end_time = between(1e-4, 0.1);
    const auto doubts = doubtful_units(input);
    ASSERT_TRUE(doubts.empty()) << doubts.front();
  }
}

TEST(DoubtfulUnits, AreWarningsOfTheResultAndNotRefused) {
  const Result result = simulate(readme_with({"beam.density=2.6", "time.end=1e-6"}));
  ASSERT_EQ(result.warnings.size(), 1u);
  expect_in(summary_json(readme_with({}), result), "if g/cm3 was meant");
}

TEST(DoubtfulUnits, AreNamedWhereAnEndTimeAsksForTooManyRows) {
  expect_in(message_of<CaseFileError>([&] {
              readme_with({"time.end=8", "output.interval=1e-6"});
            }),
            "if ms was meant, write 0.008");
}

TEST(DoubtfulUnits, AreNamedWhereTheSceneLeavesTheModelsValidity) {
  const Case input = readme_with({"beam.youngs_modulus=71960"});
  Result result;
  result.outcome = {OutcomeKind::left_validity, 5e-4, "the indentation reached the thickness", {}};
  expect_in(failure_message(input, result), "check the unit: beam.youngs_modulus is 71960 Pa");
  result.outcome.kind = OutcomeKind::solver_failed;
  expect_not_in(failure_message(input, result), "check the unit");
}

}  // namespace
}  // namespace subimpact
