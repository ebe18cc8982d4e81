#include "subimpact/case/case_keys.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "case/keys/case_choices.h"
#include "case/keys/materials.h"
#include "case/shifted_case.h"
#include "subimpact/simulate/options.h"

namespace subimpact {
namespace {

// How a member of a case of each type is a value of a key, and back.
template <class T>
struct Member {  // an enumeration
  static constexpr KeyType type = KeyType::choice;
  using Choices = T;
  static KeyValue to_value(T x) { return std::string(name_of(x)); }
  static T from_value(const KeyValue& v) { return value_of<T>(std::get<std::string>(v)); }
};
template <class T, KeyType key_type>
struct HeldMember {
  static constexpr KeyType type = key_type;
  static KeyValue to_value(const T& x) { return x; }
  static T from_value(const KeyValue& v) { return std::get<T>(v); }
};
template <>
struct Member<bool> : HeldMember<bool, KeyType::flag> {};
template <>
struct Member<std::string> : HeldMember<std::string, KeyType::text> {};
template <>
struct Member<double> : HeldMember<double, KeyType::number> {
  static double from_value(const KeyValue& v) {
    if (const auto* whole = std::get_if<std::int64_t>(&v)) return static_cast<double>(*whole);
    return std::get<double>(v);
  }
};
template <>
struct Member<int> : HeldMember<std::int64_t, KeyType::count> {
  static int from_value(const KeyValue& v) { return static_cast<int>(std::get<std::int64_t>(v)); }
};
template <>
struct Member<std::vector<double>> : HeldMember<std::vector<double>, KeyType::numbers> {
  static std::vector<double> from_value(const KeyValue& v) {
    // An empty list in a case file has no element type.
    const auto* numbers = std::get_if<std::vector<double>>(&v);
    return numbers != nullptr ? *numbers : std::vector<double>{};
  }
};
template <class T>
struct Member<std::array<T, 2>> {
  static constexpr KeyType type = KeyType::pair;
  using Choices = T;
  static KeyValue to_value(const std::array<T, 2>& x) {
    return std::vector<std::string>{name_of(x[0]), name_of(x[1])};
  }
  static std::array<T, 2> from_value(const KeyValue& v) {
    const auto& names = std::get<std::vector<std::string>>(v);
    return {value_of<T>(names[0]), value_of<T>(names[1])};
  }
};

// Things at points, each as an entry of a list and back.
using Entry = PlacedValues::Entry;
Entry entry_of(const Spring& x) {
  return {x.position, {{0.0, x.stiffness}}, {}, false, x.one_sided};
}
Entry entry_of(const PointForce& x) { return {x.position, x.table}; }
Entry entry_of(const Gauge& x) { return {x.position, {}, name_of(x.face)}; }
void read(const Entry& entry, Spring& x) {
  x = {entry.position, entry.table.front().second, entry.one_sided};
}
void read(const Entry& entry, PointForce& x) { x = {entry.position, entry.table}; }
void read(const Entry& entry, Gauge& x) { x = {entry.position, value_of<Face>(entry.word)}; }

const char* quantity_of(const Spring&) { return "stiffness"; }
const char* quantity_of(const PointForce&) { return "force"; }
const char* quantity_of(const Gauge&) { return "face"; }

template <class T>
struct PlacedMember {
  static constexpr KeyType type = KeyType::placed;
  static KeyValue to_value(const std::vector<T>& x) {
    PlacedValues value{quantity_of(T{}), {}};
    for (const T& one : x) value.entries.push_back(entry_of(one));
    return value;
  }
  static std::vector<T> from_value(const KeyValue& v) {
    std::vector<T> things;
    for (const Entry& entry : std::get<PlacedValues>(v).entries) read(entry, things.emplace_back());
    return things;
  }
};
template <>
struct Member<std::vector<Spring>> : PlacedMember<Spring> {};
template <>
struct Member<std::vector<PointForce>> : PlacedMember<PointForce> {};
template <>
struct Member<std::vector<Gauge>> : PlacedMember<Gauge> {
  using Choices = Face;
};

template <class T>
const T* held(const T& member) {
  return &member;
}
template <class T>
const T* held(const std::optional<T>& member) {
  return member ? &*member : nullptr;
}

struct Range {
  const char* words = "";
  Limits limits;
};

const Range any_value;
const Range positive{"finite and above 0", {.exclusive_minimum = 0.0}};
const Range positive_or_infinite{"above 0, or inf", {.exclusive_minimum = 0.0, .infinity = true}};
const Range not_negative{"finite, 0 or above", {.minimum = 0.0}};
const Range finite{"finite", {}};
const Range positive_share{"above 0, up to 1", {.exclusive_minimum = 0.0, .maximum = 1.0}};

Range between(const char* words, double low, double high) {
  return {words, {.minimum = low, .maximum = high}};
}

// A cell's second difference carries a rounding error of some 1e-16 N^2 of the curvature, and a
// run's cost grows as N^2: at the upper limit 1e-6 is lost and an 8 ms strike takes days.
const Range segment_range = between(
    "from 5 to 100001 (beyond that rounding in the second differences outweighs the error of the "
    "mesh)",
    5, 100001);
// Rounding of curvatures grows as the inverse square of an element's length.
const Range element_range = between("from 4 to 20000", 4, 20000);
// At 10000 layers the stiffness is within 1e-8 of that of the exact section.
const Range layer_range{"even, from 2 to 10000 (for more, section = \"exact\" is their limit)",
                        {.minimum = 2.0, .maximum = 10000.0, .multiple_of = 2}};

const std::optional<std::string> required;  // as a default: the key has none
const std::string as_in_case;               // as a default: that of the struct Case
const std::string by_scene = "what the scene needs; the run says which, and why";

template <class Field>
CaseKey row(const char* name, const char* unit, const Range& range, const char* meaning,
            const std::optional<std::string>& default_text, Field field) {
  using Value = std::remove_cvref_t<decltype(*held(field(std::declval<Case&>())))>;
  CaseKey key;
  key.name = name;
  key.type = Member<Value>::type;
  key.unit = unit;
  key.range = range.words;
  key.limits = range.limits;
  key.meaning = meaning;
  key.get = [field](const Case& from) -> std::optional<KeyValue> {
    const Value* value = held(field(from));
    if (value == nullptr) return std::nullopt;
    return Member<Value>::to_value(*value);
  };
  key.set = [field](Case& to, const KeyValue& value) {
    field(to) = Member<Value>::from_value(value);
  };
  if constexpr (requires { typename Member<Value>::Choices; }) {
    for (const auto& entry : names_of(typename Member<Value>::Choices{})) {
      key.choices.push_back({entry.name, entry.note});
    }
  }
  key.required = !default_text;
  if (!key.required) {
    key.default_text = *default_text;
    if (key.default_text.empty()) key.default_text = to_text(*key.get(Case{}));
  }
  return key;
}

// A number of which 0 stands for not given, in cases of that kind.
CaseKey not_zero(
    CaseKey key, bool (*where)(const Case&) = [](const Case&) { return true; }) {
  key.get = [get = key.get, where](const Case& from) {
    const std::optional<KeyValue> value = get(from);
    return value && where(from) && std::get<double>(*value) == 0.0 ? std::nullopt : value;
  };
  return key;
}

// A required key that other keys can take the place of.
CaseKey unless(bool (*is_needless)(const Case&), CaseKey key) {
  key.is_needless = is_needless;
  return not_zero(std::move(key), is_needless);
}

// A number in place of which a word may stand.
CaseKey or_word(CaseKey key, Choice word, bool Contact::*is_word) {
  key.get = [get = key.get, name = word.name, is_word](const Case& from) {
    return from.scene.contact.*is_word ? std::optional<KeyValue>(name) : get(from);
  };
  key.set = [set = key.set, is_word](Case& to, const KeyValue& value) {
    to.scene.contact.*is_word = std::holds_alternative<std::string>(value);
    if (!(to.scene.contact.*is_word)) set(to, value);
  };
  key.choices = {std::move(word)};
  return key;
}

// beam.ends, of which "rests" is a free end on a support that only pushes.
CaseKey or_rests(CaseKey key) {
  const std::string rests = "rests";
  key.get = [get = key.get, rests](const Case& from) {
    auto names = std::get<std::vector<std::string>>(*get(from));
    for (const std::size_t end : {0, 1}) {
      if (from.scene.beam.rests[end]) names[end] = rests;
    }
    return std::optional<KeyValue>(names);
  };
  key.set = [set = key.set, rests](Case& to, const KeyValue& value) {
    auto names = std::get<std::vector<std::string>>(value);
    for (const std::size_t end : {0, 1}) {
      to.scene.beam.rests[end] = names[end] == rests;
      if (names[end] == rests) names[end] = name_of(EndSupport::free);
    }
    set(to, names);
  };
  key.choices.push_back(
      {rests, "lies on a support that it can lift off, pressed by gravity or load"});
  return key;
}

CaseKey with_choices(CaseKey key, std::vector<Choice> choices) {
  key.type = KeyType::choice;
  key.choices = std::move(choices);
  return key;
}

std::vector<Choice> table_choices() {
  std::vector<Choice> choices;
  for (const MethodTable& table : method_tables()) {
    const auto same = std::ranges::find(choices, table.name, &Choice::name);
    if (same != choices.end()) {
      same->note = fmt::format("{}, {}", to_string(table.method), same->note);
      continue;
    }
    choices.push_back({table.name, fmt::format("{}: {}", to_string(table.method), table.note)});
  }
  return choices;
}

std::vector<Choice> material_choices() {
  std::vector<Choice> choices;
  for (const Material& material : materials) choices.push_back({material.name, material.source});
  return choices;
}

// "adams, bdf": the methods of which that holds.
std::string names_if(bool (*holds)(const MethodDescriptor&)) {
  std::vector<std::string> names;
  for (const MethodDescriptor& method : methods()) {
    if (holds(method)) names.emplace_back(method.name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string usual_orders() {
  std::vector<std::string> orders;
  for (const MethodDescriptor& method : methods()) {
    if (method.order) orders.push_back(fmt::format("{}: {}", method.name, method.order->usual));
  }
  return fmt::format("{}", fmt::join(orders, "; "));
}

CaseKey scatter_row(const CaseKey& of) {
  CaseKey key;
  key.name = "scatter." + of.name;
  key.type = KeyType::number;
  key.range = "from 0 to 0.5";
  key.limits = {.minimum = 0.0, .maximum = 0.5};
  key.required = false;
  key.default_text = "0";
  key.meaning = "relative standard deviation of " + of.name;
  key.get = [name = of.name](const Case& from) -> std::optional<KeyValue> {
    const auto found = from.scatter.find(name);
    if (found == from.scatter.end()) return std::nullopt;
    return found->second;
  };
  key.set = [name = of.name](Case& to, const KeyValue& value) {
    to.scatter[name] = Member<double>::from_value(value);
  };
  return key;
}

std::vector<CaseKey> with_scatter(std::vector<CaseKey> keys) {
  for (std::size_t i = 0, n = keys.size(); i < n; ++i) {
    if (is_number_of_scene(keys[i])) keys.push_back(scatter_row(keys[i]));
  }
  return keys;
}

// Only here: a lambda a row would hide the table behind its own punctuation.
#define AT(member) \
  [](auto& c) -> auto& { return c.member; }

// clang-format off
std::vector<CaseKey> make_case_keys() {
  const Range poisson = between("from 0 to 0.5", 0.0, 0.5), fraction = between("from 0 to 1, or a length such as \"0.3 m\" up to the beam's", 0.0, 1.0);
  const char* const none = "none; needed by shapes that name it";
  const auto of_plane = [](const Case& c) { return c.scene.beam.fixed; };
  return {
    row("title", "", any_value, "name of the case", "\"\"", AT(title)),

    with_choices(row("beam.material", "", any_value, "gives density, modulus, Poisson's ratio and yield stress, where their keys do not: nominal values, with the source of the yield stress", "none", AT(scene.beam.material)), material_choices()),
    unless(of_plane, row("beam.length", "m", positive, "length of the beam", required, AT(scene.beam.length))),
    not_zero(row("beam.width", "m", positive, "width of a rectangular section, across the strike", "none; needed without beam.section", AT(scene.beam.width))),
    not_zero(row("beam.thickness", "m", positive, "thickness of a rectangular section, in the direction of the strike", "none; needed without beam.section", AT(scene.beam.thickness))),
    unless(of_plane, row("beam.density", "kg/m3", positive, "density", required, AT(scene.beam.density))),
    unless(of_plane, row("beam.youngs_modulus", "Pa", positive, "Young's modulus; a plane without one is rigid", required, AT(scene.beam.youngs_modulus))),
    row("beam.yield_stress", "Pa", positive_or_infinite, "yield stress of beam and contact; inf: neither yields", as_in_case, AT(scene.beam.yield_stress)),
    row("beam.hardening", "", between("from 0 to 0.99", 0.0, 0.99), "linear kinematic hardening: modulus after yield over Young's modulus", as_in_case, AT(scene.beam.hardening)),
    row("beam.theory", "", any_value, "beam theory", by_scene, AT(scene.beam.theory)),
    row("beam.poisson", "", poisson, "Poisson's ratio, for theory = \"timoshenko\" and for contact.law = \"sphere\", \"line\", or \"hertz\" without stiffness", "0.3 where theory or contact law need it", AT(scene.beam.poisson)),
    row("beam.shear_coefficient", "", positive_share, "shear coefficient k of theory = \"timoshenko\": k G A is the shear stiffness", "Cowper's for the section; of a rectangle 10 (1 + nu)/(12 + 11 nu)", AT(scene.beam.shear_coefficient)),
    or_rests(row("beam.ends", "", any_value, "supports at x = 0 and x = length", as_in_case, AT(scene.beam.ends))),
    row("beam.axial", "", any_value, "what supports at both ends do along the beam", as_in_case, AT(scene.beam.axial)),
    row("beam.load", "N/m", finite, "uniform load along the strike, constant from t = 0", as_in_case, AT(scene.beam.load)),
    row("beam.forces", "N", finite, "forces at points along the strike, each constant or linear between the points (t, F) of a table", "[]", AT(scene.beam.forces)),
    row("beam.springs", "N/m", positive, "linear springs between points and the ground; with one_sided = true one that only pushes: a support, stop or bumper behind (or side = \"before\") the beam, at a gap (m), with a damping (s/m) as of contact.damping", "[]", AT(scene.beam.springs)),
    row("beam.foundation", "N/m2", not_negative, "elastic bedding: force per length over displacement", as_in_case, AT(scene.beam.foundation)),
    row("beam.start", "", any_value, "shape from which the beam starts; a beam whose end rests: equilibrium", as_in_case, AT(scene.beam.start)),
    row("beam.velocity", "m/s", finite, "velocity along the strike at t = 0, of the pivot where the beam turns", as_in_case, AT(scene.beam.velocity)),
    row("beam.angular_velocity", "rad/s", finite, "angular velocity at t = 0, positive where it turns points beyond the pivot along the strike", as_in_case, AT(scene.beam.angular_velocity)),
    row("beam.pivot", "", fraction, "point about which the beam turns, as a fraction of the length", "the pinned end; of other beams 0.5", AT(scene.beam.pivot)),
    row("beam.fixed", "", any_value, "whether a rigid beam does not move: a plane or wall, which needs neither size nor density", as_in_case, AT(scene.beam.fixed)),
    row("beam.damping.ratio", "", between("from 0 to 1", 0.0, 1.0), "damping ratio of all natural modes of a beam that stays elastic", as_in_case, AT(scene.beam.damping.ratio)),
    row("beam.damping.mass", "1/s", not_negative, "alpha of Rayleigh's damping: force over mass and velocity", as_in_case, AT(scene.beam.damping.mass)),
    row("beam.damping.stiffness", "s", not_negative, "beta of Rayleigh's damping: force over elastic stiffness and velocity", as_in_case, AT(scene.beam.damping.stiffness)),

    row("beam.section.shape", "", any_value, "shape of the cross-section; the dimensions that it needs follow", as_in_case, AT(scene.beam.section.shape)),
    row("beam.section.height", "m", positive, "height in the direction of the strike", none, AT(scene.beam.section.height)),
    row("beam.section.width", "m", positive, "width across the strike", none, AT(scene.beam.section.width)),
    row("beam.section.diameter", "m", positive, "outer diameter", none, AT(scene.beam.section.diameter)),
    row("beam.section.wall", "m", positive, "thickness of the walls of a tube or box", none, AT(scene.beam.section.wall)),
    row("beam.section.flange", "m", positive, "thickness of the flanges", none, AT(scene.beam.section.flange)),
    row("beam.section.web", "m", positive, "thickness of the web", none, AT(scene.beam.section.web)),

    unless([](const Case& c) { return c.scene.striker.fixed; }, row("striker.mass", "kg", positive, "mass of the striker", required, AT(scene.striker.mass))),
    row("striker.nose_radius", "m", positive, "radius of the nose", "none; \"foundation\", \"sphere\" and \"line\" need one", AT(scene.striker.nose_radius)),
    row("striker.nose", "", any_value, "shape of the nose", "foundation, line: \"cylinder\"; others: \"sphere\"", AT(scene.striker.nose)),
    unless([](const Case& c) { return c.scene.striker.fixed || c.scene.striker.drop_height; }, row("striker.velocity", "m/s", not_negative, "velocity at t = 0; without loads also that of the first touch", required, AT(scene.striker.velocity))),
    row("striker.drop_height", "m", positive, "height of a fall from rest that ends at the first touch, in place of velocity: v = sqrt(2 g h) with the size of scene.gravity, or 9.80665 m/s2", "none", AT(scene.striker.drop_height)),
    row("striker.fixed", "", any_value, "whether a rigid stop takes the striker's place: no mass, no velocity", as_in_case, AT(scene.striker.fixed)),
    row("striker.gap", "m", not_negative, "distance of the nose from the beam at t = 0", as_in_case, AT(scene.striker.gap)),
    row("striker.position", "", fraction, "struck point, as a fraction of the length", as_in_case, AT(scene.striker.position)),

    row("scene.gravity", "m/s2", finite, "gravity along the strike, on striker and beam", as_in_case, AT(scene.gravity)),

    row("contact.law", "", any_value, "relation of contact force and indentation", by_scene, AT(scene.contact.kind)),
    row("contact.stiffness", "N/m^1.5 or N/m", positive, "stiffness of the laws \"hertz\" (N/m^1.5) and \"linear\" (N/m)", "hertz: from the radius of the sphere and the moduli; linear: none, it needs one", AT(scene.contact.stiffness)),
    row("contact.striker_modulus", "Pa", positive_or_infinite, "Young's modulus of the nose, for \"sphere\", \"line\", or \"hertz\" without stiffness; inf: rigid", "none: a rigid nose; \"hertz\" without stiffness needs it", AT(scene.contact.striker_modulus)),
    row("contact.striker_poisson", "", poisson, "Poisson's ratio of the nose, given with its modulus", "none: a rigid nose; \"hertz\" without stiffness needs it", AT(scene.contact.striker_poisson)),
    row("contact.beam_poisson", "", poisson, "the same as beam.poisson", "beam.poisson", AT(scene.contact.beam_poisson)),
    row("contact.curve_indentation", "m", not_negative, "indentations of a measured loading, rising, for \"curve\"", "none", AT(scene.contact.curve_indentation)),
    row("contact.curve_force", "N", not_negative, "forces at these indentations, rising", "none", AT(scene.contact.curve_force)),
    row("contact.unloading_indentation", "m", not_negative, "indentations of a measured unloading from the last point of loading, rising from the one that remains", "none: elastic", AT(scene.contact.unloading_indentation)),
    row("contact.unloading_force", "N", not_negative, "forces at these indentations, rising from 0", "none: elastic", AT(scene.contact.unloading_force)),
    row("contact.damping", "s/m", not_negative, "damping chi of the laws \"hertz\" and \"linear\": the force is that of the law times 1 + chi times the rate of the indentation (Hunt and Crossley)", as_in_case, AT(scene.contact.damping)),
    row("contact.restitution", "", between("from 0.1 to 1", 0.1, 1.0), "coefficient of restitution of two rigid bodies, at each touch, for \"hertz\" and \"linear\": sets contact.damping by its velocity", "none", AT(scene.contact.restitution)),
    or_word(row("contact.yield_pressure", "Pa", positive, "contact pressure at which the softer body yields, for \"sphere\" and \"line\"", "\"by-depth\"; of simulate() 1.6 times beam.yield_stress, 1.67 times for \"line\"", AT(scene.contact.yield_pressure)),
            {"by-depth", "the mean pressure rises with the dent, up to 2.8 times beam.yield_stress"}, &Contact::pressure_by_depth),
    row("contact.indentation", "", any_value, "from where \"sphere\", and \"hertz\" without stiffness, measure the indentation", "\"mid-plane\" on solid beams that bend, else \"half-space\"", AT(scene.contact.indentation)),

    row("model.mesh", "", any_value, "discretisation of the beam", "\"cells\"; if model.elements is given, \"hermite\", with shear \"spectral\"", AT(model.mesh)),
    row("model.segments", "", segment_range, "number of cells over the whole length", as_in_case, AT(model.segments)),
    row("model.spacing", "", any_value, "length of the cells, with mesh = \"cells\"", as_in_case, AT(model.spacing)),
    row("model.elements", "", element_range, "number of elements over the whole length, with mesh = \"hermite\" or \"spectral\"", as_in_case, AT(model.elements)),
    row("model.section", "", any_value, "bending law of the sections", as_in_case, AT(model.section)),
    row("model.layers", "", layer_range, "number of layers over the thickness, with section = \"layers\"", as_in_case, AT(model.layers)),
    row("model.symmetry", "", any_value, "use of the scene's symmetry about mid-span", as_in_case, AT(model.symmetry)),

    row("strike.rest", "", any_value, "state of the beam before each strike but the first: true: at rest in its residual shape; false: as it moves", as_in_case, AT(at_rest)),
    row("repeat.strikes", "", between("from 1 to 100000", 1, 100000), "number of equal strikes that the beam receives, one after another", as_in_case, AT(strikes)),

    row("time.end", "s", positive, "time at which the simulation ends", required, AT(end_time)),
    row("time.stop", "", any_value, "when the run stops", as_in_case, AT(stop)),

    row("solver.method", "", any_value, "time integration method", as_in_case, AT(solver.method)),
    row("solver.rtol", "", between("from 1e-14 to 0.1", 1e-14, 0.1), "relative tolerance of adaptive methods", as_in_case, AT(solver.rtol)),
    row("solver.step", "s", positive, "fixed step", names_if([](auto& m) { return m.has_fixed_steps(); }) + fmt::format(": {} of the critical step; others: adaptive", default_part_of_critical), AT(solver.step)),
    row("solver.max_step", "s", positive, "largest step of adaptive methods", "no limit", AT(solver.max_step)),
    with_choices(row("solver.table", "", any_value, "coefficients of a Runge-Kutta method", "the method's first: see `subimpact methods`", AT(solver.table)), table_choices()),
    row("solver.events", "", any_value, "treatment of an event inside a step", names_if([](auto& m) { return m.events == EventHandling::interpolated; }) + ": \"interpolated\"; others: \"located\"", AT(solver.events)),
    row("solver.reversals", "", any_value, "treatment of section events (first flow, reversal, closing of a loop) inside a step; on damped beams that may yield always \"step-end\"", names_if([](auto& m) { return m.reversals == ReversalHandling::step_end; }) + ": \"step-end\"; others: \"located\"", AT(solver.reversals)),
    row("solver.max_order", "", between("from 1 to 12 (adams) or 5 (bdf)", 1, 12), "highest order of a multistep method", usual_orders(), AT(solver.max_order)),

    row("accuracy.event_times", "s", positive, "bound on the error of every event time: `subimpact run` chooses what the case leaves open of mesh, method and tolerance so that the bound holds", "none", AT(accuracy.event_times)),
    row("accuracy.work_limit", "", positive, "bound on the work of all runs made to meet accuracy.event_times, in evaluations of the right-hand side by central differences times unknowns (1 to 3 ns each); no effect without that key", as_in_case, AT(accuracy.work_limit)),
    row("accuracy.energy", "", positive_share, "largest error of the energy, relative to the initial energy, with which a run counts as completed", "from method and rtol, 1e-3 at most", AT(accuracy.energy)),

    row("output.interval", "s", not_negative, "time between history rows; 0: none", "time.end/2000, and during contact wherever the force has changed by 1 % of the largest so far", AT(output.interval)),
    row("output.zone_gap", "", positive, "separation that ends a zone, in first flexural periods", as_in_case, AT(output.zone_gap)),
    row("output.subzone_gap", "", positive, "separation that ends a sub-zone, in first flexural periods", as_in_case, AT(output.subzone_gap)),
    row("output.opening", "m", not_negative, "contacts between which striker and beam part by less are joined to one sub-impact; 0: none", as_in_case, AT(output.opening)),
    row("output.sections", "", fraction, "positions, as fractions of the length, of sections whose curvature and moment are kept", as_in_case, AT(output.sections)),
    row("output.points", "", fraction, "positions, as fractions of the length, of points whose displacement and velocity are kept", as_in_case, AT(output.points)),
    row("output.gauges", "", any_value, "strain gauges along the axis, on the struck face or on the back, whose strains are columns of history.csv", "[]", AT(output.gauges)),
    row("output.shapes", "s", not_negative, "time between shapes, the fields along the whole beam; 0: none, and no envelope", "time.end/400 in whole intervals; without history rows none", AT(output.shapes)),
    row("output.shape_points", "", between("from 5 to 200000", 5, 200000), "most points of a shape, along the whole beam", as_in_case, AT(output.shape_points)),

    row("study.vector_operations", "", any_value, "vector operations under SUNDIALS", as_in_case, AT(study.vector_operations)),
    row("study.pair_detection", "", any_value, "search for contacts that open and close within one step", as_in_case, AT(study.pair_detection)),
    row("study.beyond_critical", "", any_value, "allows a fixed step above the stability limit, to study how runs fail there", as_in_case, AT(study.beyond_critical)),
    row("study.striker_update", "", any_value, "how central differences advance the striker over a step", as_in_case, AT(study.striker_update)),
  };
}
// clang-format on
#undef AT

}  // namespace

bool Limits::hold(double x) const {
  if (std::isnan(x) || (std::isinf(x) && !infinity)) return false;
  if (minimum && x < *minimum) return false;
  if (exclusive_minimum && x <= *exclusive_minimum) return false;
  if (maximum && x > *maximum) return false;
  return !multiple_of || std::fmod(x, *multiple_of) == 0.0;
}

const std::vector<CaseKey>& case_keys() {
  static const std::vector<CaseKey> keys = with_scatter(make_case_keys());
  return keys;
}

const CaseKey* find_case_key(std::string_view name) {
  const auto found = std::ranges::find(case_keys(), name, &CaseKey::name);
  return found != case_keys().end() ? &*found : nullptr;
}

void assign(Case& target, const CaseKey& key, const KeyValue& value) {
  if (const auto problem = problem_with(key, value)) throw InvalidCase(key.name, *problem);
  key.set(target, value);
}

std::string_view to_string(Method method) { return name_of(method); }
std::string_view to_string(EventHandling events) { return name_of(events); }

}  // namespace subimpact
