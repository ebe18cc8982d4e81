#include "subimpact/case/case_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "case/counted.h"
#include "case/problem.h"
#include "model/contact/contact_laws.h"
#include "model/mesh/modes.h"
#include "numerics/units.h"

namespace subimpact {
namespace {

// Beyond these a value is doubtful. They lie well outside the values of real beams, strikers and
// materials, so that no plausible scene gets a warning.
constexpr double softest = 1e6;            // Pa: soft rubber
constexpr double stiffest = 2e12;          // Pa: diamond has 1.2e12
constexpr double weakest = 1e4;            // Pa: lead yields at some 1e7
constexpr double smallest_yield = 1e-6;    // strain at yield: soft metals have 1e-5
constexpr double lightest = 25.0;          // kg/m3: packing foam
constexpr double largest_yield = 0.05;     // yield stress over Young's modulus
constexpr double heaviest = 3e4;           // kg/m3: osmium has 22600
constexpr double heaviest_beam = 1e6;      // kg
constexpr double longest = 500.0;          // m
constexpr double most_slender = 1e4;       // length over thickness
constexpr double widest = 10.0;            // width over length
constexpr double largest_nose = 5.0;       // its radius over the length
constexpr double fastest = 1e3;            // m/s: a rifle bullet
constexpr double most_periods = 300.0;     // end time over the beam's first period
constexpr double long_run = 0.5;           // s
constexpr double heavy_striker = 100.0;    // kg
constexpr double heaviest_in_grams = 1e4;  // kg: heavier strikers are not given in g
constexpr double most_beam_masses = 500.0;
constexpr double one_metre = 1.0;

struct OtherUnit {
  const char* name;
  double factor;  ///< to the case file's unit
};

// "; if MPa was meant, write 7.196e+10", for each unit in which the value is usual: `low` to
// `high`.
std::string proposal(double value, std::initializer_list<OtherUnit> units, double low,
                     double high) {
  std::string text;
  for (const OtherUnit& unit : units) {
    const double meant = value * unit.factor;
    if (meant < low || meant > high) continue;
    text += text.empty() ? fmt::format("; if {} was meant, write {:.6g}", unit.name, meant)
                         : fmt::format(", if {} was, {:.6g}", unit.name, meant);
  }
  return text;
}

class Doubts {
 public:
  explicit Doubts(const Case& input)
      : case_(input), beam_(input.scene.beam), is_rigid_(input.model.mesh == MeshKind::rigid) {
    if (!is_rigid_) {  // a rigid body may have any shape and mass
      lengths();
      times();
    }
    materials();
    striker();
  }

  std::vector<std::pair<const char*, std::string>> found;  // by key

 private:
  // "beam.length is 201 m", the reason and what to write if one of the units was meant.
  void doubt(const char* name, const std::string& reason, std::initializer_list<OtherUnit> units,
             double low = 0.0, double high = INFINITY) {
    const CaseKey& key = *find_case_key(name);
    const double value = std::get<double>(*key.get(case_));
    found.emplace_back(name, fmt::format("{} is {:.6g} {}{}{}", name, value, key.unit, reason,
                                         proposal(value, units, low, high)));
  }

  // Doubts a length: out of proportion to another one, or one of lengths that are all doubtful.
  void length(const char* key, double value, bool out_of_proportion, double other,
              const char* other_name, bool because_of_all) {
    if (out_of_proportion) {
      doubt(key, fmt::format(", {:.3g} times the beam's {}", value / other, other_name),
            {{"mm", 1e-3}});
    } else if (because_of_all) {
      doubt(key, ": " + size_and_mass(), {{"mm", 1e-3}});
    }
  }

  std::string size_and_mass() const {
    const double mass = beam_.mass();
    return fmt::format(
        "a beam of {:.4g} m x {:.4g} m x {:.4g} m weighs {}", beam_.length,
        beam_.outer_solid().width, beam_.height(),
        mass >= 1e4 ? fmt::format("{:.0f} t", 1e-3 * mass) : fmt::format("{:.3g} kg", mass));
  }

  // The density is kept within usual values: lengths are not doubtful where it is wrong.
  bool is_too_large() const {
    const double volume = beam_.length * beam_.area();
    return volume * std::clamp(beam_.density, 1e3, heaviest) > heaviest_beam;
  }

  void lengths() {
    const double l = beam_.length, b = beam_.outer_solid().width, h = beam_.height();
    const bool large = is_too_large();
    const bool slender = h > 0.0 && l > most_slender * h;
    const bool deep = h > l;
    const bool wide = b > widest * l;
    const bool any = large || l > longest || slender || deep || wide;
    // Where one length seems to be in mm, another one above a metre is probably in mm too.
    const auto doubtful_beside = [&](double value) { return any && value > one_metre; };
    length("beam.length", l, slender, h, "thickness", large || l > longest);
    if (!beam_.is_round()) {
      length(width_key(beam_), b, wide, l, "length", large || doubtful_beside(b));
    }
    length(height_key(beam_), h, deep, l, "length", large || doubtful_beside(h));
    const double nose = case_.scene.striker.nose_radius.value_or(0.0);
    const bool blunt = nose > largest_nose * l && nose > one_metre;
    length("striker.nose_radius", nose, blunt, l, "length", false);
    if (!blunt && doubtful_beside(nose)) {
      doubt("striker.nose_radius", ", like the lengths of the beam", {{"mm", 1e-3}});
    }
  }

  void times() {
    const double end = case_.end_time;
    const auto longer_than_run = [&](const char* key, const std::optional<double>& time) {
      if (!time || *time <= end) return;
      doubt(key, ", longer than the whole run", {{"ms", 1e-3}, {"us", 1e-6}}, 0.0, 1e-2 * end);
    };
    longer_than_run("solver.step", case_.solver.step);
    longer_than_run("accuracy.event_times", case_.accuracy.event_times);
    if (case_.stop != StopRule::end_time || end <= long_run) return;  // only a limit, or short
    const double period = 2.0 * M_PI / flexural_frequencies(beam_, 1).front();
    if (end <= most_periods * period) return;
    doubt("time.end",
          fmt::format(", {:.3g} periods of the beam's slowest vibration, {:.3g} s each",
                      end / period, period),
          {{"ms", 1e-3}, {"us", 1e-6}}, 1e-2 * period, most_periods * period);
  }

  void modulus(const char* key, double E) {
    if (E == 0.0 || (E >= softest && E <= stiffest)) return;  // 0: a rigid plane
    doubt(key,
          E < softest ? ", softer than soft rubber (some 1e6 Pa)"
                      : ", stiffer than diamond (1.2e12 Pa)",
          {{"MPa", 1e6}, {"GPa", 1e9}, {"mPa", 1e-3}}, 1e8, stiffest);
  }

  void materials() {
    const double rho = beam_.density, E = beam_.youngs_modulus, Y = beam_.yield_stress;
    if ((rho > 0.0 && rho < lightest) || (rho > heaviest && !is_rigid_)) {
      doubt("beam.density",
            rho < lightest ? ", lighter than packing foam (some 25 kg/m3)"
                           : ", heavier than osmium (22600 kg/m3)",
            {{"g/cm3", 1e3}, {"t/mm3", 1e12}, {"g/m3", 1e-3}}, 50.0, heaviest);
    }
    modulus("beam.youngs_modulus", E);
    const double striker = case_.scene.contact.striker_modulus.value_or(INFINITY);
    if (std::isfinite(striker)) modulus("contact.striker_modulus", striker);
    if (Y < weakest || (E <= stiffest && Y < smallest_yield * E)) {
      doubt("beam.yield_stress",
            Y < weakest ? std::string(", far weaker than lead (some 1e7 Pa)")
                        : fmt::format(", reached at a strain of {:.1e} (metals: some 1e-3)", Y / E),
            {{"MPa", 1e6}, {"GPa", 1e9}}, 1e6, 2e10);
    } else if (std::isfinite(Y) && E >= softest && Y > largest_yield * E) {
      doubt("beam.yield_stress",
            fmt::format(", reached at a strain of {:.2g} (metals: some 1e-3){}", Y / E,
                        Y > E ? "; are beam.youngs_modulus and beam.yield_stress swapped?" : ""),
            {{"kPa", 1e-3}, {"Pa", 1e-6}}, 1e6, largest_yield * E);
    }
  }

  void striker() {
    const double m = case_.scene.striker.mass;
    const bool is_heavy = m > std::max(heavy_striker, most_beam_masses * beam_.mass());
    if (!is_rigid_ && is_heavy && m <= heaviest_in_grams) {
      doubt("striker.mass",
            fmt::format(", {:.3g} times the beam's {:.3g} kg", m / beam_.mass(), beam_.mass()),
            {{"g", 1e-3}});
    }
    if (case_.scene.bodies().striker_velocity() <= fastest) return;
    if (case_.scene.striker.drop_height) {
      doubt("striker.drop_height", ", a fall that ends faster than a rifle bullet", {{"mm", 1e-3}});
    } else {
      doubt("striker.velocity", ", faster than a rifle bullet", {{"mm/s", 1e-3}});
    }
  }

  const Case& case_;
  const Beam& beam_;
  bool is_rigid_;
};

constexpr double thickest_without_shear = 0.1;  // thickness over length
constexpr double thickest_with_shear = 1.0 / 3.0;
constexpr double largest_rotation = 0.1;     // rad
constexpr double largest_deflection = 0.5;   // over the thickness, of a beam held at both ends
constexpr double deepest_indentation = 0.1;  // over the nose radius
constexpr double least_pull = 0.01;          // over the largest force of a support

// Supports that hold the beam down, where it may only rest on them.
void add_pulls(const Beam& beam, const Result& result, std::vector<Beyond>& found) {
  double largest = 0.0;
  for (const auto& forces : result.reactions) {
    if (forces) largest = std::max({largest, forces->largest.value, -forces->smallest.value});
  }
  std::optional<std::size_t> pulls;  // the end that does most
  for (const std::size_t end : {0, 1}) {
    const auto& forces = result.reactions[end];
    if (!forces || beam.ends[end] != EndSupport::pinned) continue;
    const double pull = forces->largest.value;
    const bool is_most = !pulls || pull > result.reactions[*pulls]->largest.value;
    if (pull > least_pull * largest && is_most) pulls = end;
  }
  if (!pulls) return;
  const auto& pull = result.reactions[*pulls]->largest;
  found.push_back(
      {"support_pulls",
       fmt::format("a support pulls the beam by up to {} N, at x = {} at {}: a beam that "
                   "only rests on it would lift off there: use beam.ends = [\"rests\", \"rests\"] "
                   "with scene.gravity, or beam.springs with one_sided = true",
                   with_significant(pull.value, 3), *pulls == 0 ? "0" : "length",
                   instant_text(pull.time, 4))});
}

}  // namespace

std::vector<std::string> doubtful_units(const Case& input) {
  std::vector<std::string> doubts;
  for (auto& [key, sentence] : Doubts(input).found) doubts.push_back(sentence);
  return doubts;
}

std::string doubtful_unit(const Case& input, std::string_view key) {
  for (auto& [of, sentence] : Doubts(input).found) {
    if (of == key) return sentence;
  }
  return {};
}

std::vector<Beyond> beyond_the_model(const Case& input, const Result& result) {
  const Beam& beam = input.scene.beam;
  const std::optional<double>& nose = input.scene.striker.nose_radius;
  const bool is_rigid = input.model.mesh == MeshKind::rigid;
  const bool is_held = !beam.stretches() && std::ranges::count(beam.ends, EndSupport::free) == 0;
  const double indentation = result.max_indentation, set = result.largest_displacement;
  std::vector<Beyond> found;
  const auto add = [&]<class... Values>(bool beyond, std::string_view kind,
                                        fmt::format_string<const Values&...> text,
                                        const Values&... values) {
    if (beyond) found.push_back({kind, fmt::format(text, values...)});
  };
  add(result.largest_rotation > largest_rotation, "rotations",
      "{} by up to {:.2g} rad: the model is for rotations below {} rad",
      is_rigid ? "the beam turns" : "sections turn", result.largest_rotation, largest_rotation);
  double strain = 0.0;
  for (const EnvelopeRow& row : result.envelope) {
    strain = std::max({strain, row.strain.largest.value, -row.strain.smallest.value});
  }
  const double first_yield = beam.yield_stress / beam.youngs_modulus;
  add(input.model.section == SectionKind::elastic && strain > first_yield, "section_yields",
      "sections are strained up to {:.2g} times as far as they stay elastic, which "
      "model.section = \"elastic\" leaves out",
      strain / first_yield);
  const double thickness = beam.height() / beam.length;
  add(!is_rigid && beam.shears() && thickness > thickest_with_shear, "thickness",
      "the beam's thickness is {:.2g} of its length: plane sections, as in every beam theory, do "
      "not describe so thick a body",
      thickness);
  const bool may_shear = is_rigid || beam.shears() || input.theory_is_chosen;
  add(!may_shear && thickness > thickest_without_shear, "no_shear",
      "the beam's thickness is {:.2g} of its length, and its theory leaves out shear; use "
      "beam.theory = \"timoshenko\"",
      thickness);
  add(!is_rigid && is_held && set / beam.height() > largest_deflection, "stretching",
      "the struck point moves by {} mm, {} times the thickness, on a beam held at both "
      "ends: if its supports cannot approach each other, it stretches, which stiffens it: set "
      "beam.axial = \"held\"",
      with_significant(mm * set, 3), with_significant(set / beam.height(), 2));
  add_pulls(beam, result, found);
  if (!nose) return found;
  add(indentation / *nose > deepest_indentation, "indentation",
      "the indentation reaches {:.3g} mm, {:.3g} of the nose radius: contact laws are for small "
      "indentations (below {} of it)",
      mm * indentation, indentation / *nose, deepest_indentation);
  const GapRadii radii = gap_radii(input.scene);
  double square = *nose * indentation;  // of Hertz's contact radius
  if (!input.parts.contact_law && input.scene.contact.is_from_mid_plane()) {
    const double stiffness = contact_law_of(input)->scales().stiffness;
    square = *nose * std::pow(result.max_force / stiffness, 2.0 / 3.0);
  }
  const double pressure = 1.5 * result.max_force / (M_PI * square);
  add(input.scene.contact.kind == ContactKind::hertz && radii.is_circle() &&
          pressure > yield_pressure_over_stress * beam.yield_stress,
      "contact_yields",
      "the contact pressure reaches {:.3g} MPa, {:.2g} times the beam's yield stress: a Hertz "
      "contact yields from {} on, which contact.law = \"hertz\" leaves out and \"sphere\" has",
      MPa * pressure, pressure / beam.yield_stress, yield_pressure_over_stress);
  return found;
}

}  // namespace subimpact
