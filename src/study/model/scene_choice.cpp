#include "subimpact/study/model.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <utility>

#include "case/meshes.h"
#include "case/problem.h"
#include "study/model/coarse_strike.h"

namespace subimpact {
namespace {

constexpr int cells_to_choose = 121;
constexpr double most_work = 5e5;       // of a run: some 2 ms
constexpr double first_horizon = 32.0;  // in ResolvedSettings::contact_time
constexpr double growth_of_horizon = 4.0;
constexpr double longest_horizon = 512.0;  // of a test of the law alone
constexpr double least_move = 5e-6;        // s, of the first parting
constexpr double least_change = 0.01;      // of the other figures
constexpr double scale_of_velocity = 0.1;  // of that of the first touch, at least

bool is_allowed(const Case& input, void (*rules)(const Case&) = check) {
  try {
    rules(input);
    return true;
  } catch (const InvalidCase&) {
    return false;
  }
}

struct LawChoice {
  ContactKind kind;
  std::optional<IndentationFrom> from;  // of laws that can be measured from either
  const char* reason;
};

constexpr auto mid = IndentationFrom::mid_plane, half = IndentationFrom::half_space;
constexpr LawChoice across[] = {
    {ContactKind::line, {}, "a cylinder across a solid beam"},
    {ContactKind::foundation, {}, "no better law for a cylinder on this section"}};
constexpr LawChoice ball[] = {{ContactKind::sphere, mid, "a ball on a solid beam that bends"},
                              {ContactKind::sphere, half, nullptr},
                              {ContactKind::hertz, mid, "a ball on a solid beam"},
                              {ContactKind::hertz, half, nullptr}};
constexpr LawChoice others[] = {
    {ContactKind::foundation, {}, "no better law for a ball on this section"},
    {ContactKind::linear, {}, "as given"},
    {ContactKind::curve, {}, "as measured"}};

const char* why_half_space(const Case& input) {
  const Beam& beam = input.scene.beam;
  if (beam.gap().area() > 0.0) return "a ball; the half-space knows nothing of bending walls";
  if (!descriptor_of(input.model.mesh).bends) return "a ball on a body that does not bend";
  return beam.is_round() ? "nose and surface touch in an ellipse" : "a ball";
}

// The case with the law, by depth where that goes; nothing if given keys name another.
std::optional<Case> with_law(const Case& input, const GivenKeys& given, const LawChoice& choice) {
  Case chosen = input;
  Contact& contact = chosen.scene.contact;
  const bool measures = choice.from.has_value() && !contact.stiffness;
  if (given.contain("contact.law") && contact.kind != choice.kind) return std::nullopt;
  if (given.contain("contact.indentation") && measures && contact.indentation != choice.from) {
    return std::nullopt;
  }
  contact.kind = choice.kind;
  if (measures) contact.indentation = choice.from;
  if (!given.contain("contact.yield_pressure")) {
    const bool yields = choice.kind == ContactKind::line || choice.kind == ContactKind::sphere;
    contact.pressure_by_depth = yields && std::isfinite(input.scene.beam.yield_stress);
  }
  return chosen;
}

struct PossibleLaw {
  Case input;
  const char* reason;
};

// All laws for the nose that the case allows, the best first.
std::vector<PossibleLaw> possible_laws(const Case& input, const GivenKeys& given) {
  std::vector<PossibleLaw> found;
  const auto add = [&](std::span<const LawChoice> laws) {
    for (const LawChoice& law : laws) {
      if (law.from == mid && !descriptor_of(input.model.mesh).bends) continue;
      const bool is_there = std::ranges::any_of(found, [&](const PossibleLaw& other) {
        return other.input.scene.contact.kind == law.kind && !law.from;
      });
      if (is_there) continue;
      const auto chosen = with_law(input, given, law);
      if (chosen && is_allowed(*chosen))
        found.push_back({*chosen, law.reason ? law.reason : why_half_space(input)});
    }
  };
  const auto& nose = input.scene.striker.nose;
  const bool is_round = input.scene.beam.is_round();  // so that any nose touches at a point
  if (nose != NoseShape::sphere && !is_round) add(across);
  if (nose != NoseShape::cylinder || is_round) add(ball);
  add(others);
  return found;
}

// Whether a damping ratio and an open section leave the beam elastic.
bool has_damped_modes_alone(const Case& input, const GivenKeys& given) {
  return input.scene.beam.damping.ratio > 0.0 && !input.parts.section &&
         !given.contain("model.section") && may_yield(input);
}

// Where no law takes the moduli of the nose, what the usual one misses.
void check_nose_moduli(const Case& input, const GivenKeys& given) {
  if (!given.contain("contact.striker_modulus") && !given.contain("contact.striker_poisson"))
    return;
  const bool is_ball = input.scene.striker.nose == NoseShape::sphere;
  if (const auto usual = with_law(input, given, is_ball ? ball[0] : across[0])) check(*usual);
}

// The scene on the mesh that it has if the case names none.
Case on_default_mesh(const Case& input) {
  if (input.parts.mesh || !descriptor_of(input.model.mesh).bends) return input;
  Case usual = input;
  usual.model = {};
  usual.model.section = input.model.section;
  usual.model.layers = input.model.layers;
  usual.model.mesh = default_mesh(usual);
  make_room_for_strike(usual);
  return usual;
}

std::optional<Case> with_shear(const Case& input) {
  Case sheared = input;
  sheared.scene.beam.theory = BeamTheory::timoshenko;
  sheared = on_default_mesh(sheared);
  return is_allowed(sheared) ? std::optional(sheared) : std::nullopt;
}

// In place of a mesh that the case does not name, the one of the same size for the theory. Throws
// InvalidCase where a mesh does not have the theory that was chosen.
void set_mesh(Case& chosen, const Case& input, const GivenKeys& given, const std::string& why) {
  MeshKind& mesh = chosen.model.mesh;
  const auto& size = descriptor_of(mesh).refinement;
  const bool is_by_size = !given.contain("model.mesh") && size;
  for (const MeshDescriptor& other : meshes()) {
    if (!is_by_size || descriptor_of(mesh).suits(chosen.scene.beam)) break;
    if (other.refinement && other.refinement->count == size->count) mesh = other.kind;
  }
  try {
    check_mesh(chosen);
  } catch (const InvalidCase& error) {
    Case otherwise = input;
    otherwise.scene.beam.poisson = chosen.scene.beam.poisson;
    const bool shears = chosen.scene.beam.shears();
    otherwise.scene.beam.theory = shears ? BeamTheory::rayleigh : BeamTheory::timoshenko;
    if (!is_allowed(otherwise, check_mesh)) throw;
    throw InvalidCase(
        error.key,
        fmt::format("{} (beam.theory is open, and this scene {} shear: {}; to {}, write "
                    "beam.theory = \"{}\")",
                    error.message, shears ? "needs" : "does not need", why,
                    shears ? "leave it out" : "have it", shears ? "rayleigh" : "timoshenko"));
  }
}

enum class Shear { moves, does_not, not_tested, law_ends };

struct ShearTest {
  Shear shear;
  std::string words;
};

double relative(double one, double other, double scale = 0.0) {
  const double size = std::max({std::abs(one), std::abs(other), scale});
  return size > 0.0 ? std::abs(one - other) / size : 0.0;
}

std::string microseconds(double time) { return fmt::format("{:.3g} us", 1e6 * time); }

// Whether shear moves the parting, or, in runs to the end, another figure; in words.
std::optional<std::string> moved(const Case& input, const Result& without, const Result& with,
                                 bool at_end) {
  const StrikeFigures a = figures_of(without), b = figures_of(with);
  const double least = std::min(least_move, input.accuracy.event_times.value_or(least_move));
  const double first = a.parting.value_or(without.outcome.time);
  const double second = b.parting.value_or(with.outcome.time);
  if ((a.parting || b.parting) && std::abs(first - second) >= least) {
    return fmt::format(
        "without shear the first contact parted by more than 1 um ends {} on a coarse mesh, with "
        "shear {}",
        (a.parting ? "at " : "after ") + microseconds(first),
        (b.parting ? "at " : "after ") + microseconds(second));
  }
  const double touch = scale_of_velocity * std::abs(with.first_touch.striker);
  const auto change = [&](const char* what, double by) -> std::optional<std::string> {
    if (by < least_change) return std::nullopt;
    return fmt::format("shear changes the {} by {:.2g} % on a coarse mesh", what, 100.0 * by);
  };
  auto found = change("largest force", relative(*a.peak_force, *b.peak_force));
  if (found || !at_end) return found;
  found = change("final velocity", relative(*a.striker_velocity, *b.striker_velocity, touch));
  if (found) return found;
  return change("permanent set",
                relative(a.permanent_set.value_or(0.0), b.permanent_set.value_or(0.0), 1e-9));
}

// The end of a run over the first contacts, s: so many times their time scale after the touch. None
// where the case cannot be run.
std::optional<double> end_after(double contact_times, const Case& input) {
  const double touch = input.scene.striker.first_touch();
  try {
    const Case coarse = coarse_case(input, cells_to_choose, input.end_time);
    const double span = contact_times * resolve(coarse).settings().contact_time;
    return std::min(input.end_time, span + (std::isfinite(touch) ? touch : 0.0));
  } catch (const InvalidCase&) {
    return std::nullopt;
  }
}

bool left_validity(const std::optional<Result>& run) {
  return run && run->outcome.kind == OutcomeKind::left_validity;
}

// Whether a law ends within the first contacts of a coarse run.
bool law_ends(const Case& input) {
  const std::optional<double> end = end_after(longest_horizon, input);
  const int cells = end ? affordable_cells(input, *end, cells_to_choose, most_work) : 0;
  return cells > 0 && left_validity(coarse_run(coarse_case(input, cells, *end)));
}

// Two runs, without and with shear, over longer and longer times until a difference shows.
ShearTest test_shear(const Case& without, const Case& with) {
  ShearTest not_tested{Shear::not_tested, "a coarse mesh cannot test whether shear matters"};
  const std::optional<double> first = end_after(first_horizon, with);
  if (!first) return not_tested;
  for (double end = *first;; end = std::min(growth_of_horizon * end, with.end_time)) {
    const int cells = affordable_cells(with, end, cells_to_choose, most_work);
    if (cells == 0) return not_tested;
    const auto a = coarse_run(coarse_case(without, cells, end));
    const auto b = coarse_run(coarse_case(with, cells, end));
    if (left_validity(a) || left_validity(b)) return {Shear::law_ends, {}};
    if (!a || !b || !a->outcome.completed() || !b->outcome.completed()) return not_tested;
    const bool at_end = end == with.end_time;
    if (const auto words = moved(with, *a, *b, at_end)) return {Shear::moves, *words};
    if (at_end) break;
  }
  return {Shear::does_not,
          "on a coarse mesh shear moves the first parting by less than 5 us, and force, final "
          "velocity and set by less than 1 %"};
}

// The law, where it is measured from and when it yields, as far as they were chosen.
std::vector<std::string> law_words(const Case& chosen, const PossibleLaw& law,
                                   const GivenKeys& given) {
  std::vector<std::string> words;
  const Scene& scene = chosen.scene;
  if (!given.contain("contact.law")) {
    const bool is_ball = scene.nose() == NoseShape::sphere;
    const char* nose = scene.striker.nose ? ""
                       : is_ball ? " (for a nose not given, since none has a cylinder here)"
                                 : " (a nose not given is a cylinder)";
    words.push_back(
        fmt::format("contact.law = {}: {}{}", value_text(chosen, "contact.law"), law.reason, nose));
  }
  const auto add = [&](const char* key) {
    if (!given.contain(key)) words.push_back(fmt::format("{} = {}", key, value_text(chosen, key)));
  };
  if (scene.contact.indentation) add("contact.indentation");
  if (scene.contact.pressure_by_depth) add("contact.yield_pressure");
  return words;
}

}  // namespace

std::vector<std::string> choose_scene(Case& input, const GivenKeys& given) {
  const bool open_law = !input.parts.contact_law;
  const bool keeps_modes = has_damped_modes_alone(input, given);
  if (keeps_modes) input.model.section = SectionKind::elastic;
  const bool open_theory =
      !given.contain("beam.theory") && !input.parts.mesh && descriptor_of(input.model.mesh).bends;
  Case base = on_default_mesh(input);
  const bool knows_poisson = input.scene.beam_poisson().has_value();
  if (!knows_poisson) base.scene.beam.poisson = usual_poisson;
  std::vector<PossibleLaw> laws = {{base, nullptr}};
  if (open_law) laws = possible_laws(base, given);
  if (laws.empty()) check_nose_moduli(base, given);
  if (laws.empty()) return {};
  const PossibleLaw* law = &laws.front();
  ShearTest test{Shear::not_tested, "no mesh with shear takes this scene"};
  Case chosen;
  for (const PossibleLaw& candidate : laws) {
    law = &candidate;
    chosen = candidate.input;
    const auto sheared = open_theory ? with_shear(chosen) : std::nullopt;
    const bool is_last = law == &laws.back();
    if (!sheared) {
      if (is_last || !law_ends(chosen)) break;
      continue;
    }
    test = test_shear(chosen, *sheared);
    if (test.shear != Shear::does_not) chosen = *sheared;
    if (test.shear != Shear::law_ends) break;
    test.words = "not tested, for the indentation leaves the law's validity";
  }
  const auto law_uses = [&](const char* key) {
    const BuiltInContactLaw& used = built_in_contact_law(chosen.scene.contact.kind);
    return open_law && uses_key(constants_given(chosen, used), key);
  };
  const bool needs_poisson = chosen.scene.beam.shears() || law_uses("contact.beam_poisson");
  if (!knows_poisson && !needs_poisson) chosen.scene.beam.poisson.reset();

  std::vector<std::string> words, keys;
  if (open_theory) {
    words.push_back(
        fmt::format("beam.theory = {}: {}", value_text(chosen, "beam.theory"), test.words));
  }
  if (open_law) std::ranges::copy(law_words(chosen, *law, given), std::back_inserter(words));
  if (!knows_poisson && needs_poisson) words.push_back("beam.poisson = 0.3: none is given");
  if (keeps_modes) {
    words.push_back("model.section = \"elastic\": damping ratios are of natural modes");
    keys.emplace_back("model.section");
  }
  for (const char* key : {"beam.theory", "beam.poisson", "contact.law", "contact.indentation",
                          "contact.yield_pressure"}) {
    if (!given.contain(key) && find_case_key(key)->get(chosen)) keys.emplace_back(key);
  }
  chosen.model = input.model;
  if (open_theory) set_mesh(chosen, input, given, test.words);
  input = std::move(chosen);
  input.theory_is_chosen = open_theory;
  input.model_choice = fmt::format("{}", fmt::join(words, "; "));
  return keys;
}

}  // namespace subimpact
