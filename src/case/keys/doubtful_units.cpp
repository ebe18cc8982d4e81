#include "subimpact/case/case_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

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
constexpr double strongest = 2e10;         // Pa
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

struct OtherUnit {
  const char* name;
  double factor;  ///< to the case file's unit
};

class Doubts {
 public:
  explicit Doubts(const Case& input) : case_(input), beam_(input.scene.beam) {
    const bool is_rigid = input.model.mesh == MeshKind::rigid;
    if (!is_rigid) {  // a rigid body may have any shape and mass
      lengths();
      times();
    }
    materials(is_rigid);
    striker(is_rigid);
  }

  std::vector<std::string> found;

 private:
  // "beam.length is 201 m", the reason, and what to write if a unit was meant in which the value is
  // usual: from `low` to `high`.
  template <class... Values>
  void doubt(bool is_doubtful, const char* name, std::initializer_list<OtherUnit> units, double low,
             double high, fmt::format_string<const Values&...> reason, const Values&... values) {
    if (!is_doubtful) return;
    const CaseKey& key = *find_case_key(name);
    const double value = std::get<double>(*key.get(case_));
    std::string text = fmt::format("{} is {:.6g} {}", name, value, key.unit) +
                       fmt::format(reason, values...),
                proposal;
    for (const OtherUnit& unit : units) {
      const double meant = value * unit.factor;
      if (meant < low || meant > high) continue;
      proposal += proposal.empty()
                      ? fmt::format("; if {} was meant, write {:.6g}", unit.name, meant)
                      : fmt::format(", if {} was, {:.6g}", unit.name, meant);
    }
    found.push_back(text + proposal);
  }

  void lengths() {
    const double l = beam_.length, b = beam_.outer_solid().width, h = beam_.height();
    const double nose = case_.scene.striker.nose_radius.value_or(0.0), mass = beam_.mass();
    // By a usual density: lengths are not doubtful where that is wrong.
    const double usual_mass = l * beam_.area() * std::clamp(beam_.density, 1e3, heaviest);
    const bool large = usual_mass > heaviest_beam;
    const bool is_long = large || l > longest || (h > 0.0 && l > most_slender * h);
    const bool wide = b > widest * l, deep = h > l;
    const auto length = [&](const char* key, bool is_doubtful) {
      doubt(is_doubtful, key, {{"mm", 1e-3}}, 0.0, INFINITY,
            ": a beam of {:.4g} m x {:.4g} m x {:.4g} m weighs {}", l, b, h,
            mass >= 1e4 ? fmt::format("{:.0f} t", 1e-3 * mass) : fmt::format("{:.3g} kg", mass));
    };
    // Where one length seems to be in mm, another one above a metre is probably in mm too.
    const bool any = is_long || wide || deep;
    length("beam.length", is_long);
    length(width_key(beam_), !beam_.is_round() && (large || wide || (any && b > 1.0)));
    length(height_key(beam_), large || deep || (any && h > 1.0));
    doubt(nose > 1.0 && (any || nose > largest_nose * l), "striker.nose_radius", {{"mm", 1e-3}},
          0.0, INFINITY, ", on a beam of {:.4g} m", l);
  }

  void times() {
    const double end = case_.end_time;
    const std::initializer_list<OtherUnit> units = {{"ms", 1e-3}, {"us", 1e-6}};
    for (const auto& [key, time] : {std::pair("solver.step", case_.solver.step),
                                    {"accuracy.event_times", case_.accuracy.event_times}}) {
      doubt(time > end, key, units, 0.0, 1e-2 * end, ", longer than the whole run");
    }
    if (case_.stop != StopRule::end_time || end <= long_run) return;  // only a limit, or short
    const double period = 2.0 * M_PI / flexural_frequencies(beam_, 1).front();
    doubt(end > most_periods * period, "time.end", units, 1e-2 * period, most_periods * period,
          ", {:.3g} periods of the beam's slowest vibration, {:.3g} s each", end / period, period);
  }

  void materials(bool is_rigid) {
    const double rho = beam_.density, E = beam_.youngs_modulus, Y = beam_.yield_stress;
    doubt((rho > 0.0 && rho < lightest) || (rho > heaviest && !is_rigid), "beam.density",
          {{"g/cm3", 1e3}, {"t/mm3", 1e12}, {"g/m3", 1e-3}}, 50.0, heaviest,
          ", not between packing foam (some 25 kg/m3) and osmium (22600 kg/m3)");
    const double nose = case_.scene.contact.striker_modulus.value_or(0.0);
    for (const auto& [key, modulus] :
         {std::pair("beam.youngs_modulus", E), {"contact.striker_modulus", nose}}) {
      const bool is_given = modulus > 0.0 && std::isfinite(modulus);  // 0: a rigid plane
      doubt(is_given && (modulus < softest || modulus > stiffest), key,
            {{"MPa", 1e6}, {"GPa", 1e9}, {"mPa", 1e-3}}, 1e8, stiffest,
            ", not between soft rubber (some 1e6 Pa) and diamond (1.2e12 Pa)");
    }
    const bool is_weak = Y < weakest || (E <= stiffest && Y < smallest_yield * E);
    const bool is_strong = std::isfinite(Y) && E >= softest && Y > largest_yield * E;
    doubt(is_weak || is_strong, "beam.yield_stress",
          {{"MPa", 1e6}, {"GPa", 1e9}, {"kPa", 1e-3}, {"Pa", 1e-6}}, 1e6,
          E >= softest ? std::min(strongest, largest_yield * E) : strongest,
          ", reached at a strain of {:.1e} (metals: some 1e-3){}", Y / E,
          is_strong && Y > E ? "; are beam.youngs_modulus and beam.yield_stress swapped?" : "");
  }

  void striker(bool is_rigid) {
    const double m = case_.scene.striker.mass;
    const bool is_heavy = m > std::max(heavy_striker, most_beam_masses * beam_.mass());
    doubt(!is_rigid && is_heavy && m <= heaviest_in_grams, "striker.mass", {{"g", 1e-3}}, 0.0,
          INFINITY, ", {:.3g} times the beam's {:.3g} kg", m / beam_.mass(), beam_.mass());
    const bool is_fast = case_.scene.bodies().striker_velocity() > fastest;
    const bool falls = case_.scene.striker.drop_height.has_value();
    doubt(is_fast && falls, "striker.drop_height", {{"mm", 1e-3}}, 0.0, INFINITY,
          ", a fall that ends faster than a rifle bullet");
    doubt(is_fast && !falls, "striker.velocity", {{"mm/s", 1e-3}}, 0.0, INFINITY,
          ", faster than a rifle bullet");
  }

  const Case& case_;
  const Beam& beam_;
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
    if (forces) largest = std::max(largest, forces->magnitude());
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

std::vector<std::string> doubtful_units(const Case& input) { return Doubts(input).found; }

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
  for (const EnvelopeRow& row : result.envelope) strain = std::max(strain, row.strain.magnitude());
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
