// Laws that measure the indentation from the mid-plane, as a case asks for them: what is accepted,
// refused and noted, and what a run makes of them.

#include "model/contact/contact_laws.h"
#include "paper_case.h"
#include "settings.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

Case with(const Settings& settings, double end = 1e-4) {
  return changed(paper_case(SectionKind::exact, end, 101), settings);
}

const Settings poisson{{"beam.poisson", 0.33}};
const Settings line = poisson + Settings{{"contact.law", "line"}};
const Settings ball = poisson + Settings{{"contact.law", "sphere"}};
const Settings mid_plane{{"contact.indentation", "mid-plane"}};
const Settings by_depth{{"contact.yield_pressure", "by-depth"}};
const Settings steel{{"contact.striker_modulus", 2.1e11}, {"contact.striker_poisson", 0.3}};

TEST(MidPlane, LawsTakeARigidNoseOrOneWithBothConstants) {
  for (const Settings& law : {line, ball, ball + mid_plane}) {
    EXPECT_NO_THROW(check(with(law)));
    EXPECT_NO_THROW(check(with(law + steel)));
    for (const auto& [key, value] :
         {std::pair("contact.striker_modulus", 2.1e11), {"contact.striker_poisson", 0.3}}) {
      expect_refused(with(law + Settings{{key, value}}), key, "only where both");
    }
  }
  // The stiffer the nose, the more it is like a rigid one.
  const auto force = [](const Settings& settings) {
    return make_contact_law(with(settings).scene)->contact_force({}, 1e-7);  // elastic
  };
  for (const Settings& law : {line, ball, ball + mid_plane}) {
    Settings hard{{"contact.striker_modulus", 2.1e17}, {"contact.striker_poisson", 0.3}};
    EXPECT_LT(force(law + steel), 0.95 * force(law));
    EXPECT_NEAR(force(law + hard), force(law), 1e-5 * force(law));
  }
}

TEST(MidPlane, LawsAreRefusedWhereTheyDoNotHold) {
  const Settings half_space{{"contact.indentation", "half-space"}};
  expect_refused(with(line + half_space), "contact.law", "leave it out");
  expect_refused(with(line + Settings{{"striker.nose", "sphere"}}), "contact.law",
                 "a sphere does not touch along a line");
  EXPECT_NO_THROW(check(with(ball + by_depth)));  // from the half-space
  expect_refused(with(poisson + by_depth), "contact.yield_pressure",
                 "only \"sphere\" and \"line\" yield at it");
  expect_refused(with({{"contact.law", "line"}}), "contact.beam_poisson", "is missing");
  expect_refused(with(line + Settings{{"contact.stiffness", 1e9}}), "contact.stiffness",
                 "the contact's stiffness follows");
  const Settings tube{{"beam.section.shape", "tube"},
                      {"beam.section.diameter", 0.03},
                      {"beam.section.wall", 0.002}};
  const Settings circle{{"beam.section.shape", "circle"}, {"beam.section.diameter", 0.01}};
  for (const Settings& law : {line, ball + mid_plane}) {
    Case hollow = with(law), round = with(law);
    for (Case* input : {&hollow, &round}) {
      input->scene.beam.width = input->scene.beam.thickness = 0.0;
    }
    expect_refused(changed(hollow, tube), "contact.law", "this section is hollow");
    expect_refused(changed(round, circle), "contact.law", "touch in an ellipse");
  }
}

TEST(MidPlane, KeysWithoutEffectAreNoted) {
  const auto notes = [](const Settings& settings) {
    std::string text;
    for (const std::string& note : keys_without_effect(
             with(settings), {{"contact.indentation", "contact.yield_pressure"}, {}})) {
      text += note;
    }
    return text;
  };
  EXPECT_EQ(notes(ball + mid_plane), "");
  EXPECT_EQ(notes(line + by_depth), "");
  expect_in(notes(mid_plane), "no effect with contact.law = \"foundation\"");
  expect_in(notes(mid_plane + Settings{{"contact.law", "hertz"}, {"contact.stiffness", 2e10}}),
            "no effect with contact.stiffness = ");
  expect_in(notes(line + by_depth + Settings{{"beam.yield_stress", INFINITY}}),
            "contact.yield_pressure = \"by-depth\" has no effect");
}

TEST(MidPlane, HertzWithAStiffnessIsThatPowerAsWritten) {
  const Settings hertz{{"contact.law", "hertz"}, {"contact.stiffness", 2e10}};
  EXPECT_DOUBLE_EQ(make_contact_law(with(hertz + mid_plane).scene)->contact_force({}, 1e-4), 2e4);
}

TEST(MidPlane, AYieldPressureIsANumberOrAWord) {
  const CaseKey& key = *find_case_key("contact.yield_pressure");
  Case input = with(line + by_depth);
  EXPECT_EQ(to_text(*key.get(input)), "\"by-depth\"");
  input = changed(input, {{"contact.yield_pressure", 4e8}});
  EXPECT_FALSE(input.scene.contact.pressure_by_depth);
  EXPECT_EQ(to_text(*key.get(input)), "400000000");
  expect_in(*problem_with(key, KeyValue("by-dept")), "did you mean \"by-depth\"?");
  expect_in(allowed_values(key), "a number", "or \"by-depth\"");
}

TEST(MidPlane, ARunEndsWhereTheLineContactDoes) {
  const Result result = simulate(with(line + Settings{{"striker.velocity", 120.0}}, 1e-3));
  EXPECT_EQ(result.outcome.kind, OutcomeKind::left_validity);
  expect_in(result.outcome.message, "as wide as the law \"line\" allows");
}

// On a round bar a ball touches in an ellipse, and so does a cylinder across.
TEST(MidPlane, ABallThatYieldsByDepthOnARoundBarIsHertzsEllipseBelow) {
  const Settings circle{{"beam.section.shape", "circle"}, {"beam.section.diameter", 0.03}};
  const auto law_of = [&](const Settings& settings) {
    Case input = with(settings);
    input.scene.beam.width = input.scene.beam.thickness = 0.0;
    return make_contact_law(changed(input, circle).scene);
  };
  for (const char* nose : {"sphere", "cylinder"}) {
    const Settings of_nose = steel + Settings{{"striker.nose", nose}};
    const auto elastic = law_of(poisson + of_nose + Settings{{"contact.law", "hertz"}});
    const auto yields = law_of(ball + of_nose + by_depth);
    const double first = yields->yield_threshold({});
    for (const double part : {0.01, 0.3, 1.0}) {
      const double force = elastic->contact_force({}, part * first);
      EXPECT_NEAR(yields->contact_force({}, part * first), force, 1e-9 * force) << nose;
    }
    EXPECT_LT(yields->contact_force({}, 1e-4), 0.5 * elastic->contact_force({}, 1e-4));
  }
  Case input = with(ball);
  input.scene.beam.width = input.scene.beam.thickness = 0.0;
  expect_refused(changed(input, circle + Settings{{"contact.yield_pressure", 4e8}}), "contact.law",
                 "\"sphere\" with contact.yield_pressure = \"by-depth\"");
}

// From the mid-plane a contact is stiffer; from the axis of a very thick beam as from a half-space.
TEST(MidPlane, IsTheHalfSpaceOnAThickBeam) {
  const auto force = [](const Settings& settings) {
    return make_contact_law(with(settings).scene)->contact_force({}, 2e-7);
  };
  EXPECT_GT(force(ball + mid_plane), 1.001 * force(ball));
  const Settings thick{{"beam.thickness", 7.5}};
  EXPECT_NEAR(force(ball + mid_plane + thick), force(ball + thick), 2e-5 * force(ball));
}

}  // namespace
}  // namespace subimpact
