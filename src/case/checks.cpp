#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "case/meshes.h"
#include "case/problem.h"
#include "simulate/settings/refuse.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

// Squares and quotients of two such numbers are finite, on the finest mesh too.
constexpr double most_decades = 60.0;

// log10 of a key's value; 0 for a value that is not given, zero or infinite.
double decades_of(const Case& input, const char* name) {
  const std::optional<KeyValue> value = find_case_key(name)->get(input);
  const double* given = value ? std::get_if<double>(&*value) : nullptr;
  const double number = given != nullptr ? std::abs(*given) : 1.0;
  return number > 0.0 && std::isfinite(number) ? std::log10(number) : 0.0;
}

[[noreturn]] void refuse_scale(const Case& input, const char* name,
                               const std::string& consequence) {
  const CaseKey& key = *find_case_key(name);
  refuse(name, "is {}{}{}{}; allowed: from 1e-{:.0f} to 1e{:.0f}; check the units",
         value_text(input, name), key.unit.empty() ? "" : " ", key.unit, consequence, most_decades,
         most_decades);
}

// Refuses, for the key that is farthest from one, numbers whose products overflow, vanish or lose
// all digits: each number of a case, and mass, stiffness, frequency and energy of its bodies.
void check_scales(const Case& input) {
  for (const CaseKey& key : case_keys()) {
    if (key.type != KeyType::number || !key.get(input)) continue;
    if (std::abs(decades_of(input, key.name.c_str())) > most_decades) {
      refuse_scale(input, key.name.c_str(), ", beyond what a run can follow");
    }
  }
  const Beam& beam = input.scene.beam;
  const std::array keys = {"beam.length",  width_key(beam),       height_key(beam),
                           "beam.density", "beam.youngs_modulus", "beam.yield_stress",
                           "striker.mass", "striker.velocity"};
  struct Quantity {
    const char *name, *unit;
    std::array<double, 8> powers;  // of the keys
  };
  for (const Quantity& of : {Quantity{"mass of the beam", " kg", {1, 1, 1, 1}},
                             {"moment of inertia of the beam", " kg m2", {3, 1, 1, 1}},
                             {"rotary inertia of the sections", " kg m", {0, 1, 3, 1}},
                             {"bending stiffness", " N m2", {0, 1, 3, 0, 1}},
                             {"stiffness of the beam", " N/m", {-3, 1, 3, 0, 1}},
                             {"square of the beam's lowest frequency", " 1/s2", {-4, 0, 2, -1, 1}},
                             {"slenderness of the beam", "", {-1, 0, 1}},
                             {"yield curvature", " 1/m", {0, 0, -1, 0, -1, 1}},
                             {"yield moment", " N m", {0, 1, 2, 0, 0, 1}},
                             {"energy of the strike", " J", {0, 0, 0, 0, 0, 0, 1, 2}}}) {
    double sum = 0.0, largest = 0.0;
    const char* farthest = "";
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const double decades = of.powers[i] * decades_of(input, keys[i]);
      sum += decades;
      if (std::abs(decades) > largest) {
        largest = std::abs(decades);
        farthest = keys[i];
      }
    }
    if (std::abs(sum) <= most_decades) continue;
    refuse_scale(input, farthest,
                 fmt::format(", with which the {} is some 1e{:+.0f}{}", of.name, sum, of.unit));
  }
}

bool is_given(const Case& input, const char* key) {
  return find_case_key(key)->get(input).has_value();
}

// Whether a key is given, under its own name or another one.
bool is_known(const Case& input, std::string_view key) {
  if (key == "contact.beam_poisson" && input.scene.beam.poisson) return true;
  return is_given(input, key.data());
}

void check_contact(const Case& input) {
  if (input.parts.contact_law) return;
  const BuiltInContactLaw& law = built_in_contact_law(input.scene.contact.kind);
  const Contact& contact = input.scene.contact;
  if ((contact.damping > 0.0 || contact.restitution) && law.yields) {
    refuse(contact.restitution ? "contact.restitution" : "contact.damping",
           "is given, but contact.law = \"{}\" loses its energy by yielding; leave it out, or "
           "choose \"hertz\" or \"linear\"",
           law.name);
  }
  if (contact.damping > 0.0 && contact.restitution) {
    refuse("contact.restitution",
           "is given, and contact.damping too, but each gives the loss of the contact; leave one "
           "out");
  }
  if (contact.restitution && input.scene.striker.gap == 0.0 &&
      input.scene.bodies().approach() == 0.0) {
    refuse("contact.restitution",
           "is given, but striker and beam meet at rest; give contact.damping instead");
  }
  const ContactConstants& way = constants_given(input, law);
  for (const char* name : way.keys) {
    if (is_known(input, name)) continue;
    const CaseKey& key = *find_case_key(name);
    refuse(name, "is missing, and contact.law = \"{}\" needs it: {}; allowed: {}; {}", law.name,
           key.meaning, allowed_values(key), way.remedy);
  }
  for (const CaseKey& key : case_keys()) {
    const bool is_number =
        key.table() == "contact" && (key.type == KeyType::number || key.type == KeyType::numbers);
    const char* name = key.name.c_str();
    if (!is_number || key.name == "contact.damping" || key.name == "contact.restitution" ||
        uses_key(way, name) || !key.get(input))
      continue;
    refuse(name, "is given, but {}; leave it out, or choose another contact.law",
           key.name == "contact.yield_pressure" ? "only \"sphere\" and \"line\" yield at it"
                                                : way.why_unused);
  }
  const std::string why_not =
      law.why_not != nullptr ? law.why_not(input.scene, gap_radii(input.scene)) : "";
  if (!why_not.empty()) refuse("contact.law", "is \"{}\", but {}", law.name, why_not);
}

// A row takes about 345 bytes in the file.
constexpr double most_history_rows = 5e6;
constexpr double most_shape_rows = 2e7;

// Refuses an interval at which a run writes more rows than a file should hold.
void check_rows(const Case& input, const char* key, double interval, double rows_each, double most,
                const std::string& what, const char* remedy) {
  const double rows = input.end_time / interval * rows_each;
  if (interval == 0.0 || rows <= most) return;
  refuse(key,
         "is {} s, which gives {:.2g} {}; allowed: at most {:.0e} rows, so {:.2g} s or more, or 0 "
         "for none; use a longer interval{}",
         interval, rows, what, most, input.end_time * rows_each / most, remedy);
}

void check_output(const Case& input) {
  const OutputOptions& output = input.output;
  const std::string to_end = fmt::format("rows up to time.end = {} s", input.end_time);
  check_rows(input, "output.interval", output.history_interval(input.end_time), 1.0,
             most_history_rows, "history " + to_end, "");
  if (output.subzone_gap > output.zone_gap) {
    refuse("output.subzone_gap",
           "is {}, above output.zone_gap = {}, but sub-zones divide zones; allowed: above 0, up to "
           "output.zone_gap; reduce it",
           output.subzone_gap, output.zone_gap);
  }
  const char* no_rows =
      "is given, but output.interval = 0 keeps no rows of them; leave it out, or set an "
      "output.interval above 0";
  check_rules({{!output.has_history() && !output.sections.empty(), "output.sections", no_rows},
               {!output.has_history() && !output.points.empty(), "output.points", no_rows},
               {!output.has_history() && !output.gauges.empty(), "output.gauges", no_rows}});
  check_rows(input, "output.shapes", output.shapes.value_or(0.0), output.shape_points,
             most_shape_rows, fmt::format("{}, up to {} per shape", to_end, output.shape_points),
             " or a smaller output.shape_points");
}

// The dimensions that each shape needs; a rectangle may have the short form instead.
const std::map<SectionShape, std::vector<std::string>> dimensions = {
    {SectionShape::rectangle, {"beam.section.height", "beam.section.width"}},
    {SectionShape::circle, {"beam.section.diameter"}},
    {SectionShape::tube, {"beam.section.diameter", "beam.section.wall"}},
    {SectionShape::box, {"beam.section.height", "beam.section.width", "beam.section.wall"}},
    {SectionShape::i,
     {"beam.section.height", "beam.section.width", "beam.section.flange", "beam.section.web"}}};

constexpr std::pair<const char*, const char*> short_forms[] = {
    {"beam.width", "beam.section.width"}, {"beam.thickness", "beam.section.height"}};

[[noreturn]] void refuse_section(const Case& input, const char* key, const std::string& why) {
  refuse(key, "{} (beam.section.shape = {})", why, value_text(input, "beam.section.shape"));
}

void check_dimensions(const Case& input) {
  const SectionShape shape = input.scene.beam.section.shape;
  const bool is_rectangle = shape == SectionShape::rectangle;
  const std::vector<std::string>& needed = dimensions.at(shape);
  const std::string all = fmt::format("{}", fmt::join(needed, ", "));
  const std::string surplus = "is given, but the shape has " + all + "; leave it out";
  for (const auto& [key, same] : short_forms) {
    const bool is_there = is_given(input, key);
    if (!is_rectangle && is_there) refuse_section(input, key, surplus);
    if (!is_rectangle || is_there != is_given(input, same)) continue;
    refuse_section(input, key,
                   is_there ? fmt::format("is given twice: {} is the same; leave one out", same)
                            : fmt::format("is missing; give it in m, or {}, or another "
                                          "beam.section.shape with its dimensions",
                                          same));
  }
  for (const CaseKey& key : case_keys()) {
    if (key.table() != "beam.section" || key.type != KeyType::number) continue;
    const bool is_needed = std::ranges::find(needed, key.name) != needed.end();
    const bool is_there = key.get(input).has_value();
    if (!is_needed && is_there) refuse_section(input, key.name.c_str(), surplus);
    if (!is_needed || is_there || is_rectangle) continue;
    refuse_section(
        input, key.name.c_str(),
        fmt::format("is missing: {}; the shape needs {}; give it in m", key.meaning, all));
  }
}

void check_section(const Case& input) {
  const Beam& beam = input.scene.beam;
  const SectionShape shape = beam.section.shape;
  const CrossSection::Solid outer = beam.outer_solid(), gap = beam.gap();
  const bool has_no_size = outer.height == 0.0 && outer.width == 0.0;
  if (beam.fixed && shape == SectionShape::rectangle && has_no_size) return;
  check_dimensions(input);
  const bool is_hollow =
      shape == SectionShape::tube || shape == SectionShape::box || shape == SectionShape::i;
  if (is_hollow && !(gap.height > 0.0 && gap.width > 0.0)) {
    const bool is_i = shape == SectionShape::i, too_wide = gap.height > 0.0;
    const double limit = !is_i      ? 0.5 * std::min(outer.height, outer.width)
                         : too_wide ? outer.width
                                    : 0.5 * outer.height;
    refuse_section(input,
                   !is_i      ? "beam.section.wall"
                   : too_wide ? "beam.section.web"
                              : "beam.section.flange",
                   fmt::format("leaves no gap in the section; allowed: below {:g} m; reduce it, or "
                               "use a solid shape",
                               limit));
  }
  if (input.parts.section && shape != SectionShape::rectangle) {
    refuse_section(input, "beam.section.shape",
                   "is given with Case::parts.section, whose strips are fractions of a "
                   "rectangle; allowed: \"rectangle\"");
  }
}

void check_shear(const Case& input) {
  const Beam& beam = input.scene.beam;
  const std::optional<double>& other = input.scene.contact.beam_poisson;
  if (beam.poisson && other && *beam.poisson != *other) {
    refuse("contact.beam_poisson",
           "is {}, but beam.poisson is {}; the beam has one Poisson's ratio: leave "
           "contact.beam_poisson out",
           *other, *beam.poisson);
  }
  check_rules({{beam.shears() && !beam.poisson, "beam.poisson",
                "is missing, and beam.theory = \"timoshenko\" needs it for the shear modulus E/(2 "
                "(1 + nu)); allowed: from 0 to 0.5; give it (metals: 0.25 to 0.35)"}});
}

// Checks a stop in place of the striker and a fixed beam.
void check_bodies(const Case& input) {
  const Striker& striker = input.scene.striker;
  const Beam& beam = input.scene.beam;
  const char* of_stop =
      "is given, but striker.fixed = true is a stop, which has neither mass nor velocity; leave it "
      "out, or striker.fixed";
  const char* of_fall =
      "is given, but striker.drop_height sets the velocity, and the run begins at the touch; leave "
      "one of them out";
  const char* of_wall = "is given, but beam.fixed = true: the beam does not move; leave it out";
  const bool bends = input.parts.mesh || input.model.mesh != MeshKind::rigid;
  const bool falls = striker.drop_height.has_value();
  check_rules({{striker.fixed && striker.mass != 0.0, "striker.mass", of_stop},
               {striker.fixed && striker.velocity != 0.0, "striker.velocity", of_stop},
               {striker.fixed && falls, "striker.drop_height", of_stop},
               {striker.fixed && beam.fixed, "striker.fixed",
                "is true, and beam.fixed too, so that nothing moves; leave one out"},
               {falls && striker.velocity != 0.0, "striker.velocity", of_fall},
               {falls && striker.gap != 0.0, "striker.gap", of_fall},
               {beam.fixed && bends, "beam.fixed",
                "is true, but only a rigid beam can be a plane or wall; set model.mesh = "
                "\"rigid\", or hold the ends of a beam that bends with beam.ends"},
               {beam.fixed && beam.foundation > 0.0, "beam.foundation", of_wall},
               {beam.fixed && !beam.springs.empty(), "beam.springs", of_wall},
               {beam.fixed && (beam.rests[0] || beam.rests[1]), "beam.ends", of_wall}});
  const bool rests = input.strikes > 1 && input.at_rest && may_yield(input);
  check_rules({{beam.stretches() && rests, "strike.rest",
                "is true, the default of repeated strikes, but the shape in which a beam with "
                "beam.axial = \"held\" that may yield comes to rest is not computed; set it to "
                "false, or beam.axial to \"free\""}});
}

// In a symmetric scene, first derivatives do not show the effect of a strike off the centre.
void check_scatter(const Case& input) {
  const auto scatter = input.scatter.find("striker.position");
  if (scatter == input.scatter.end() || scatter->second == 0.0 || !is_symmetric(input)) return;
  refuse(
      "scatter.striker.position",
      "is {}, but the scene is symmetric about striker.position = 0.5, and standard deviations "
      "follow from first derivatives, which are 0 or do not exist there; allowed: 0; leave it out",
      scatter->second);
}

}  // namespace

const ContactConstants& constants_given(const Case& input, const BuiltInContactLaw& law) {
  for (const ContactConstants& way : law.ways) {
    if (std::ranges::all_of(way.keys, [&](auto* key) { return is_known(input, key); })) return way;
  }
  return law.ways.back();
}

bool uses_key(const ContactConstants& way, const char* key) {
  return std::ranges::find(way.keys, std::string_view(key)) != way.keys.end() ||
         std::ranges::find(way.optional, std::string_view(key)) != way.optional.end();
}

void check(const Case& input) {
  for (const CaseKey& key : case_keys()) {
    const std::optional<KeyValue> value = key.get(input);
    if (!value) continue;
    if (const auto problem = problem_with(key, *value)) throw InvalidCase(key.name, *problem);
  }
  check_section(input);
  check_bodies(input);
  check_scales(input);
  check_contact(input);
  if (!input.parts.mesh) check_mesh(input);
  check_shear(input);
  check_output(input);
  check_scatter(input);
}

}  // namespace subimpact
