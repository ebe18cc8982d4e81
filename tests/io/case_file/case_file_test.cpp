#include <fmt/format.h>

#include "case_with.h"
#include "paper_scene.h"
#include "print.h"
#include "small_case.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

// The values of all keys of a case, as texts.
std::vector<std::string> texts_of(const Case& input) {
  std::vector<std::string> texts;
  for (const CaseKey& key : case_keys()) {
    const auto value = key.get(input);
    texts.push_back(value ? to_text(*value) : "none");
  }
  return texts;
}

TEST(CaseFileText, IsReadBackAsTheSameCase) {
  const std::vector<std::vector<std::string>> all = {
      {},
      {"beam.yield_stress=inf", "output.sections=0.5,0.25"},
      {"output.gauges=[{position='0.3 m', face='front'}, {position=1}]"},
      {"model.mesh=hermite", "model.elements=40", "beam.damping.ratio=0.01",
       "model.section=elastic"},
      {"contact.law=hertz", "contact.stiffness=1.1e9"},
      {"beam.ends=rests,free", "scene.gravity=9.81",
       "beam.springs=[{position=0.5, stiffness=1e3, one_sided=true, gap='0.1 mm', side='before', "
       "damping=0.1}]"}};
  for (const auto& settings : all) {
    Case input = paper_case_with(settings);
    input.title = "\"quoted\" \\ <b> 'x' `y`\nsecond line \x01\x7f \xc3\xbc = [a]";
    const std::string text = case_file_text(input);
    EXPECT_EQ(texts_of(read_case_text(text, "copy").value), texts_of(input)) << text;
  }
}

TEST(CaseFileText, HasAssumedValuesInCommentsSoThatACopyAssumesThemToo) {
  const auto read = [](const std::string& text) { return read_case_text(text, "copy").value; };
  for (const std::string given : {"", "[scene]\ngravity = 0\n"}) {
    Case input = read(small_case_text() + given);
    input.scene.beam.poisson = 0.3;  // as chosen for a theory that needs it
    const std::string text = case_file_text(input);
    const auto has = [&](const char* line) { return text.find(line) != std::string::npos; };
    EXPECT_TRUE(has("\n# assumed: poisson = 0.3\n")) << text;
    EXPECT_EQ(has("\ngravity = 0  # m/s2\n"), !given.empty()) << text;
    EXPECT_EQ(has("\n# assumed: gravity = 0  # m/s2\n"), given.empty()) << text;
    const Case copy = read(text);
    EXPECT_EQ(copy.assumed, input.assumed);
    EXPECT_FALSE(copy.scene.beam.poisson);
  }
}

TEST(CaseFile, PlacesThingsByFractionsAndByLengths) {
  const std::string gauges =
      "output.gauges=[{position=0.25}, {position=\"300 mm\", face=\"front\"}]";
  for (const double length : {0.7112, 0.4}) {
    const std::string of_beam = fmt::format("beam.length={}", length);
    const Case read =
        paper_case_with({gauges, "beam.springs=[{position='0.1 m', stiffness=1e3}]", of_beam,
                         "striker.position=100 mm", "output.points=['0.1 m', '200 mm']"});
    EXPECT_EQ(read.scene.striker.position, 0.1 / length);
    EXPECT_EQ(read.output.points, (std::vector{0.1 / length, 0.2 / length}));
    const Case by_setting = paper_case_with({of_beam, "output.sections=10 cm, 0.2 m"});
    EXPECT_EQ(by_setting.output.sections, read.output.points);
    ASSERT_EQ(read.output.gauges.size(), 2u);
    EXPECT_EQ(read.output.gauges[0].position, 0.25);
    EXPECT_EQ(read.output.gauges[0].face, Face::back);
    EXPECT_EQ(read.output.gauges[1].position, 0.3 / length);
    EXPECT_EQ(read.output.gauges[1].face, Face::front);
    EXPECT_EQ(read.scene.beam.springs[0].position, 0.1 / length);
  }
}

TEST(CaseFile, RefusesSpringsThatPushInNoWayThatIsKnown) {
  for (const char* fault :
       {"one_sided=true, gap=-1e-3", "gap=1e-3", "one_sided=false, side='before'",
        "one_sided=true, side='left'", "one_sided=true, damping=-1", "one_sided=1"}) {
    const std::string setting =
        fmt::format("beam.springs=[{{position=0.1, stiffness=1e3, {}}}]", fault);
    const std::string message = answer_of<CaseFileError>([&] { paper_case_with({setting}); });
    EXPECT_NE(message.find("perhaps with one_sided = true"), std::string::npos) << message;
  }
  const Case read = paper_case_with(
      {"beam.springs=[{position=0.1, stiffness=1e3, one_sided=true, gap='0.2 mm'}]"});
  EXPECT_EQ(read.scene.beam.springs[0].one_sided, (OneSided{2e-4}));
}

TEST(CaseFile, RefusesGaugesBeyondTheBeamAndOnNoFace) {
  const std::string allowed =
      "allowed: a list of { position = x, face = f }, x from 0 to 1, or a length such as \"0.3 m\" "
      "up to the beam's, f one of \"front\", \"back\"";
  const std::pair<const char*, const char*> faults[] = {
      {"[{position=1.01}]", "position 1.01"},
      {"[{position=\"0.8 m\"}]", "position 1.12"},
      {"[{position=\"-1 mm\"}]", "position -0.001"},
      {"[{position=0.3, face=\"top\"}]", "face \"top\""},
      {"[{position=0.3, face=\"\"}]", "face \"\""},
      {"[{position=0.3, face=2}]", "face=2"},
      {"[{position=\"0.3 N\"}]", "0.3 N"},
      {"[{face=\"back\"}]", "back"},
      {"[{position=0.3, face=\"back\", length=2}]", "length=2"},
      {"[0.3]", "0.3"}};
  for (const auto& [value, found] : faults) {
    const std::string message =
        answer_of<CaseFileError>([&] { paper_case_with({std::string("output.gauges=") + value}); });
    EXPECT_NE(message.find(found), std::string::npos) << message;
    EXPECT_NE(message.find(allowed), std::string::npos) << message;
  }
}

TEST(CaseFile, KeysLeftOutKeepTheirDefaults) {
  const Case read = read_case_text(small_case_text(), "small.toml").value;
  EXPECT_TRUE(std::isinf(read.scene.beam.yield_stress));
  EXPECT_EQ(read.model.segments, Case{}.model.segments);
  EXPECT_EQ(read.solver.rtol, Case{}.solver.rtol);
  EXPECT_FALSE(read.solver.step.has_value());
}

// The small case with settings.
LoadedCase with(const std::vector<std::string>& settings,
                const std::string& text = small_case_text()) {
  return read_case_text(text, "small.toml", overrides(settings));
}

TEST(CaseFile, TakesSettingsBeforeItsOwnLinesAndTheLastOfTwo) {
  const Case read =
      with({"beam.length=0.5", "model.segments = 101", "time.end=1", "time.end=2", "title=a=b"})
          .value;
  EXPECT_EQ(read.scene.beam.length, 0.5);
  EXPECT_EQ(read.scene.beam.density, 2600.0) << "a whole number in the file";
  EXPECT_EQ(read.model.segments, 101);
  EXPECT_EQ(read.end_time, 2.0);
  EXPECT_EQ(read.title, "a=b");
  const std::string without_mass = small_case_with("mass = 0.201\n", "");
  EXPECT_EQ(with({"striker.mass=0.3"}, without_mass).value.scene.striker.mass, 0.3);
  for (const char* setting : {"model.section=elastic", "model.section=\"elastic\""}) {
    EXPECT_EQ(with({setting}).value.model.section, SectionKind::elastic) << setting;
  }
  for (const char* setting : {"beam.ends=free,pinned", "beam.ends=[\"free\", \"pinned\"]"}) {
    EXPECT_EQ(with({setting}).value.scene.beam.ends[1], pinned) << setting;
  }
}

TEST(CaseFile, AMaterialGivesTheValuesThatTheCaseDoesNot) {
  const std::string text =
      "[beam]\nmaterial = \"S355\"\nlength = 1\nwidth = 0.02\n"
      "thickness = 0.01\nyield_stress = 4e8\n[striker]\nmass = 1\n"
      "velocity = 1\nnose_radius = 0.01\n[time]\nend = 1e-3\n";
  const Beam beam = read_case_text(text, "steel.toml").value.scene.beam;
  EXPECT_EQ(beam.density, 7850.0);
  EXPECT_EQ(beam.youngs_modulus, 210e9);
  EXPECT_EQ(*beam.poisson, 0.3);
  EXPECT_EQ(beam.yield_stress, 4e8) << "the case's own";
  const Beam other = with({"beam.material=6061-T6"}, text).value.scene.beam;
  EXPECT_EQ(other.density, 2700.0);
  EXPECT_EQ(other.yield_stress, 240e6) << "a setting goes before the file";
  EXPECT_EQ(with({"beam.material=6061-T6", "beam.density=1"}, text).value.scene.beam.density, 1.0);
}

TEST(CaseFile, ASettingCanTakeAKeyBackToItsDefault) {
  const LoadedCase loaded = with({"solver.step=1e-7", "model.segments=101", "solver.step=default"});
  EXPECT_FALSE(loaded.value.solver.step);
  EXPECT_FALSE(loaded.given.in_settings.contains("solver.step"));
  EXPECT_TRUE(loaded.given.in_settings.contains("model.segments"));
}

TEST(CaseFile, ATableWithinATableIsWrittenAsOneOrAsDottedKeysOrInline) {
  for (const char* damping : {"[beam.damping]\nratio = 0.01\nmass = 20\n[striker]\n",
                              "damping.ratio = 0.01\ndamping.mass = 20\n[striker]\n",
                              "damping = { ratio = 0.01, mass = 20 }\n[striker]\n"}) {
    const Case read =
        with({"beam.damping.stiffness=1e-7"}, small_case_with("[striker]\n", damping)).value;
    EXPECT_EQ(read.scene.beam.damping.ratio, 0.01);
    EXPECT_EQ(read.scene.beam.damping.mass, 20.0);
    EXPECT_EQ(read.scene.beam.damping.stiffness, 1e-7);
  }
  const std::string wrong =
      small_case_with("[striker]\n", "[beam.damping]\nratoi = 0.01\n[striker]\n");
  expect_in(message_of<CaseFileError>([&] { with({}, wrong); }),
            "unknown key \"beam.damping.ratoi\"", "did you mean \"beam.damping.ratio\"");
}

TEST(CaseFile, AnErrorFoundLaterIsGivenThePlaceOfItsKey) {
  const LoadedCase loaded = with({"model.segments=501"});
  EXPECT_EQ(loaded.message(InvalidCase("beam.length", "is odd")),
            "small.toml:2:1: beam.length is odd");
  EXPECT_EQ(loaded.message(InvalidCase("model.segments", "is odd")),
            "--set model.segments=501: model.segments is odd");
  EXPECT_EQ(loaded.message(InvalidCase("model.layers", "is odd")),
            "small.toml: model.layers (the default) is odd");
}

TEST(CaseFile, EveryKeyOfTheTableCanBeReadBackFromItsOwnText) {
  Case foundation = read_case_file(SUBIMPACT_PAPER_CASE).value;
  foundation.solver.step = 1e-7;
  foundation.accuracy.energy = 1e-4;
  foundation.accuracy.event_times = 1e-6;
  foundation.solver.max_step = 2e-7;
  foundation.solver.table = "dormand-prince";
  foundation.output.points = {0.5};
  foundation.output.shapes = 1e-5;
  foundation.solver.events = EventHandling::located;
  for (const CaseKey& key : case_keys()) {
    if (key.name.starts_with("scatter.")) key.set(foundation, 0.0);
  }
  Case linear = foundation;
  linear.scene.contact = {ContactKind::linear, 1e7, {}, {}, {}};
  linear.scene.contact.restitution = 0.7;
  Case sphere = foundation;
  sphere.scene.contact = {ContactKind::hertz, {}, 2e11, 0.3, 0.25};
  Case sheared = foundation;
  sheared.scene.beam.theory = BeamTheory::timoshenko;
  sheared.scene.beam.poisson = 0.3;
  sheared.scene.beam.shear_coefficient = 0.85;
  Case box = linear;
  box.scene.beam.width = box.scene.beam.thickness = 0.0;
  box.scene.beam.section = {
      .shape = SectionShape::box, .height = 0.02, .width = 0.03, .wall = 0.002};
  Case tube = box;
  tube.scene.beam.section = {.shape = SectionShape::tube, .diameter = 0.02, .wall = 0.002};
  Case beam_i = box;
  beam_i.scene.beam.section = {
      .shape = SectionShape::i, .height = 0.04, .width = 0.03, .flange = 0.004, .web = 0.003};
  Case yielding = sphere;
  yielding.scene.contact.kind = ContactKind::sphere;
  yielding.scene.contact.yield_pressure = 4e8;
  yielding.scene.striker.nose = NoseShape::sphere;
  yielding.scene.beam.pivot = 0.5;
  yielding.at_rest = false;
  yielding.scene.beam.material = "S355";
  Case line = sheared;
  Contact& contact = line.scene.contact;
  contact.kind = ContactKind::line;
  contact.pressure_by_depth = true;
  contact.indentation = IndentationFrom::mid_plane;
  Case curved = foundation;
  Contact& measured = curved.scene.contact;
  measured.kind = ContactKind::curve;
  measured.curve_indentation = {2e-5, 1e-4};
  measured.curve_force = {100.0, 1000.0};
  measured.unloading_indentation = {3e-5, 1e-4};
  measured.unloading_force = {0.0, 1000.0};
  std::set<std::string> covered;
  for (const Case& original :
       {foundation, linear, sphere, sheared, box, tube, beam_i, yielding, line, curved}) {
    std::vector<Override> all;
    for (const CaseKey& key : case_keys()) {
      const std::optional<KeyValue> value = key.get(original);
      if (!value) continue;
      all.push_back(parse_override(key.name + "=" + to_text(*value)));
      covered.insert(key.name);
    }
    const Case copy = read_case_text("", "empty.toml", all).value;
    for (const CaseKey& key : case_keys()) EXPECT_EQ(key.get(copy), key.get(original)) << key.name;
  }
  // These go with one method, or in place of another key: solver.reversals, solver.max_order,
  // striker.drop_height.
  EXPECT_GE(covered.size(), case_keys().size() - 3);
}

}  // namespace
}  // namespace subimpact
