#include <fmt/format.h>
#include <fmt/ranges.h>

#include "case_with.h"
#include "print.h"
#include "refusal.h"
#include "small_case.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

Case small_case() { return read_case_text(small_case_text(), "small.toml").value; }

std::string refused_key(const Case& input) {
  return refusal_of([&] { check(input); }).key;
}

TEST(CaseKeys, HaveNamesThatDiffer) {
  std::set<std::string> names;
  for (const CaseKey& key : case_keys()) {
    EXPECT_TRUE(names.insert(key.name).second) << key.name;
    EXPECT_EQ(find_case_key(key.name), &key);
    EXPECT_EQ(key.table().empty() ? key.leaf() : key.table() + "." + key.leaf(), key.name);
  }
}

TEST(CaseKeys, SayWhatTheyMeanAndEitherHaveADefaultOrAreRequired) {
  for (const CaseKey& key : case_keys()) {
    EXPECT_FALSE(key.meaning.empty()) << key.name;
    EXPECT_FALSE(allowed_values(key).empty()) << key.name;
    EXPECT_EQ(key.required, key.default_text.empty()) << key.name;
  }
}

TEST(CaseKeys, AcceptEachOfTheirOwnChoices) {
  for (const CaseKey& key : case_keys()) {
    for (const Choice& choice : key.choices) {
      Case target = small_case();
      KeyValue value = choice.name;
      if (key.type == KeyType::pair) value = std::vector<std::string>{choice.name, choice.name};
      if (key.type == KeyType::placed) value = PlacedValues{"face", {{0.5, {}, choice.name}}};
      assign(target, key, value);
      EXPECT_EQ(key.get(target), value) << key.name << " = " << choice.name;
    }
  }
}

TEST(CaseKeys, RefuseNotANumberEverywhereAndInfinityButForStressesAndModuliWithALimit) {
  // inf: never yields; rigid.
  const std::set<std::string> without_limit = {"beam.yield_stress", "contact.striker_modulus"};
  for (const CaseKey& key : case_keys()) {
    if (key.type != KeyType::number) continue;
    EXPECT_TRUE(problem_with(key, std::numeric_limits<double>::quiet_NaN())) << key.name;
    EXPECT_EQ(problem_with(key, std::numeric_limits<double>::infinity()).has_value(),
              !without_limit.contains(key.name))
        << key.name;
  }
}

TEST(CaseKeys, LeaveTheCaseAsItWasWhenTheyRefuse) {
  Case target = small_case();
  const CaseKey& key = *find_case_key("beam.length");
  EXPECT_THROW(assign(target, key, -1.0), InvalidCase);
  EXPECT_EQ(target.scene.beam.length, 0.7112);
}

TEST(CheckOfACase, NamesTheFirstKeyThatIsNotAllowed) {
  Case input = small_case();
  EXPECT_EQ(refused_key(input), "");
  input.solver.rtol = std::nan("");
  EXPECT_EQ(refused_key(input), "solver.rtol");
  input.model.segments = -501;
  EXPECT_EQ(refused_key(input), "model.segments");
  input.scene.striker.mass = 0.0;
  EXPECT_EQ(refused_key(input), "striker.mass");
}

TEST(NearestName, IsTheOneASlipAwayAndEmptyForAnotherWord) {
  const std::vector<std::string> names = {"length", "width", "thickness"};
  EXPECT_EQ(nearest_name("lenght", names), "length");
  EXPECT_EQ(nearest_name("widht", names), "width");
  EXPECT_EQ(nearest_name("thicknes", names), "thickness");
  EXPECT_EQ(nearest_name("colour", {"length", "width"}), "");
  EXPECT_EQ(nearest_name("", {"length"}), "");
}

std::string identity(const LoadedCase& loaded, const std::string& how = {}) {
  return case_identity(loaded.value, loaded.given, how);
}

TEST(CaseIdentity, ChangesWithEveryNumberButTheTitle) {
  const LoadedCase base = read_case_text(small_case_text(), "case");
  std::set<std::string> seen = {identity(base)};
  for (const CaseKey& key : case_keys()) {
    const std::optional<KeyValue> value = key.get(base.value);
    if (!value || !std::holds_alternative<double>(*value)) continue;
    LoadedCase other = base;
    key.set(other.value, std::nextafter(std::get<double>(*value), 0.0) + 1e-300);
    EXPECT_TRUE(seen.insert(identity(other)).second) << key.name;
  }
  LoadedCase titled = base;
  titled.value.title = "another";
  EXPECT_EQ(identity(titled), identity(base));
}

TEST(CaseIdentity, ChangesWithWhatIsLeftToTheProgramAndHowACaseIsRun) {
  const LoadedCase open = read_case_text(small_case_text(), "case");
  LoadedCase fixed = read_case_text(small_case_text() + "[model]\nsegments = 501\n", "case");
  EXPECT_EQ(fixed.value.model.segments, open.value.model.segments);
  EXPECT_NE(identity(fixed), identity(open));
  EXPECT_NE(identity(open, "without error bars"), identity(open));
  EXPECT_EQ(identity(open).size(), 32u);
}

using Notes = std::vector<std::string>;

Notes notes_on(const std::string& more, const std::vector<std::string>& settings = {}) {
  return read_case_text(small_case_text() + more, "small.toml", overrides(settings)).notes();
}

TEST(KeysWithoutEffect, AreNoneInACaseOfRequiredKeys) { EXPECT_EQ(notes_on(""), Notes{}); }

// After the small case, and the notes on it: each names the key that makes another one idle.
const std::pair<const char*, Notes> idle_cases[] = {
    {"[model]\nsection = \"exact\"\nlayers = 40\n",
     {"model.section = \"exact\" has no effect with beam.yield_stress = inf",
      "model.layers = 40 has no effect with model.section = \"exact\""}},
    {"[model]\nlayers = 40\n", {"model.layers = 40 has no effect with model.section = \"exact\""}},
    {"[model]\nmesh = \"cells\"\nelements = 100\n",
     {"model.elements = 100 has no effect with model.mesh = \"cells\""}},
    {"[model]\nmesh = \"hermite\"\nsegments = 501\n",
     {"model.segments = 501 has no effect with model.mesh = \"hermite\""}},
    {"[model]\nmesh = \"hermite\"\nspacing = \"cells\"\n",
     {"model.spacing = \"cells\" has no effect with model.mesh = \"hermite\""}},
    {"[solver]\nmethod = \"nystrom\"\n[study]\nstriker_update = \"constant-force\"\n",
     {"study.striker_update = \"constant-force\" has no effect with solver.method = "
      "\"nystrom\""}},
    {"[model]\nmesh = \"rigid\"\nsegments = 501\nsection = \"elastic\"\nsymmetry = \"off\"\n",
     {"model.segments = 501 has no effect with model.mesh = \"rigid\"",
      "model.section = \"elastic\" has no effect with model.mesh = \"rigid\"",
      "model.symmetry = \"off\" has no effect with model.mesh = \"rigid\""}},
    {"[model]\nsection = \"layers\"\nlayers = 20\n",
     {"model.section = \"layers\" has no effect with beam.yield_stress = inf",
      "model.layers = 20 has no effect with beam.yield_stress = inf"}},
    {"[solver]\nmethod = \"central-difference\"\nrtol = 1e-9\nmax_step = 1e-7\n",
     {"solver.rtol = 1e-09 has no effect with solver.method = \"central-difference\"",
      "solver.max_step = 1e-07 has no effect with solver.method = \"central-difference\""}},
    {"[solver]\nmethod = \"nystrom\"\nrtol = 1e-9\nstep = 1e-7\n",
     {"solver.rtol = 1e-09 has no effect with solver.step = 1e-07"}},
    {"[model]\nsection = \"elastic\"\n[solver]\nreversals = \"located\"\n",
     {"solver.reversals = \"located\" has no effect with model.section = \"elastic\""}},
    {"[solver]\nevents = \"interpolated\"\n[study]\npair_detection = true\n",
     {"study.pair_detection = true has no effect with solver.events = \"interpolated\""}},
    {"[solver]\nmethod = \"nystrom\"\n[study]\nvector_operations = \"library\"\nbeyond_critical = "
     "true\n",
     {"study.vector_operations = \"library\" has no effect with solver.method = \"nystrom\"",
      "study.beyond_critical = true has no effect with solver.method = \"nystrom\""}},
    {"[contact]\nlaw = \"linear\"\nstiffness = 1e7\n",
     {"striker.nose_radius = 0.01 has no effect with contact.law = \"linear\""}},
    {"[contact]\nlaw = \"hertz\"\nstiffness = 1e10\n",
     {"striker.nose_radius = 0.01 has no effect with contact.stiffness = 10000000000"}},
};

TEST(IdleKeys, AreNamedWithTheKeyThatMakesThemIdle) {
  for (const auto& [more, notes] : idle_cases) EXPECT_EQ(notes_on(more), notes) << more;
}

TEST(KeysWithoutEffect, OfTheFileNeedNoNoteIfASettingMadeThemIdle) {
  const std::string file = "[model]\nsection = \"layers\"\nlayers = 40\n[solver]\nrtol = 1e-9\n";
  const std::vector<std::string> yields = {"beam.yield_stress=150e6"};
  EXPECT_EQ(notes_on(file, yields), Notes{});
  EXPECT_EQ(notes_on(file, {yields[0], "model.section=exact"}), Notes{});
  EXPECT_EQ(notes_on(file, {yields[0], "solver.method=central-difference"}), Notes{});
  EXPECT_EQ(notes_on(file, {yields[0], "model.section=exact", "model.layers=20"}),
            Notes{"model.layers = 20 has no effect with model.section = \"exact\""});
}

TEST(KeysWithoutEffect, LeaveAloneAToleranceToWhichSectionsAreFollowed) {
  EXPECT_EQ(notes_on("[solver]\nmethod = \"nystrom\"\nrtol = 1e-9\nstep = 1e-7\n",
                     {"beam.yield_stress=150e6"}),
            Notes{});
}

TEST(MeshSize, ChoosesTheMeshWhereNoneIsNamed) {
  const auto mesh_of = [](const std::string& more, const std::vector<Override>& settings = {}) {
    return read_case_text(small_case_text() + more, "small.toml", settings).value.model.mesh;
  };
  EXPECT_EQ(mesh_of(""), MeshKind::cells);
  EXPECT_EQ(mesh_of("[model]\nelements = 100\n"), MeshKind::hermite);
  EXPECT_EQ(mesh_of("[model]\nsegments = 101\n"), MeshKind::cells);
  EXPECT_EQ(mesh_of("", {parse_override("model.elements=100")}), MeshKind::hermite);
  EXPECT_EQ(mesh_of("[model]\nmesh = \"cells\"\nelements = 100\n"), MeshKind::cells);
}

TEST(MeshSize, OfASettingGoesBeforeThatOfTheFile) {
  const LoadedCase loaded = read_case_text(small_case_text() + "[model]\nsegments = 101\n",
                                           "small.toml", {parse_override("model.elements=100")});
  EXPECT_EQ(loaded.value.model.mesh, MeshKind::hermite);
  EXPECT_EQ(loaded.notes(), Notes{});
}

TEST(MeshSize, OfTwoMeshesIsRefusedUnlessOneIsNamed) {
  const std::string both = "[model]\nsegments = 101\nelements = 100\n";
  expect_in(message_of<CaseFileError>([&] { notes_on(both); }),
            "small.toml:15:1: model.elements is given, and model.segments too", "leave one out",
            "model.mesh = \"hermite\"");
  EXPECT_NO_THROW(read_case_text(small_case_text() + both + "mesh = \"hermite\"\n", "small.toml"));
}

}  // namespace
}  // namespace subimpact
