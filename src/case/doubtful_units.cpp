#include "subimpact/case/doubtful_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "model/flexural_frequencies.h"

namespace subimpact {
namespace {

// Beyond these a value is doubtful. They lie well outside the values of real beams, strikers and
// materials, so that no plausible scene gets a warning.
constexpr double softest = 1e6;            // Pa: soft rubber
constexpr double stiffest = 2e12;          // Pa: diamond has 1.2e12
constexpr double weakest = 1e4;            // Pa: lead yields at some 1e7
constexpr double smallest_yield = 1e-6;    // strain at yield: soft metals have 1e-5
constexpr double lightest = 25.0;          // kg/m3: packing foam
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

/// A unit that the value may have been given in.
struct OtherUnit {
  const char* name;
  double factor;  ///< to the case file's unit
};

/// Values a key usually has: units that lead there are proposed.
struct UsualRange {
  double low = 0.0, high = INFINITY;
};

// "; if MPa was meant, write 7.196e+10".
std::string proposal(double value, std::initializer_list<OtherUnit> units, UsualRange usual) {
  std::string text;
  for (const OtherUnit& unit : units) {
    const double meant = value * unit.factor;
    if (meant < usual.low || meant > usual.high) continue;
    text += text.empty() ? fmt::format("; if {} was meant, write {:.6g}", unit.name, meant)
                         : fmt::format(", if {} was, {:.6g}", unit.name, meant);
  }
  return text;
}

std::string given(const char* key, double value, const char* unit) {
  return fmt::format("{} is {:.6g} {}", key, value, unit);
}

class Doubts {
 public:
  explicit Doubts(const Case& input)
      : case_(input), beam_(input.scene.beam), striker_(input.scene.striker) {}

  std::vector<std::string> all() {
    if (case_.model.mesh != MeshKind::rigid) {  // a rigid body may have any shape and mass
      lengths();
      times();
    }
    density();
    modulus("beam.youngs_modulus", beam_.youngs_modulus);
    if (const auto& E = case_.scene.contact.striker_modulus; E && std::isfinite(*E)) {
      modulus("contact.striker_modulus", *E);
    }
    yield_stress();
    mass();
    velocity();
    return std::move(sentences_);
  }

 private:
  void add(std::string sentence) { sentences_.push_back(std::move(sentence)); }

  void add_length(const char* key, double value, const std::string& reason) {
    add(given(key, value, "m") + reason + proposal(value, {{"mm", 1e-3}}, {}));
  }

  // A length that is out of proportion to another length of the beam, or doubtful because all
  // lengths are.
  void length(const char* key, double value, bool out_of_proportion, double other,
              const char* other_name, bool because_of_all) {
    if (out_of_proportion) {
      add_length(key, value,
                 fmt::format(", {:.3g} times the beam's {}", value / other, other_name));
    } else if (because_of_all) {
      add_length(key, value, ": " + size_and_mass());
    }
  }

  std::string size_and_mass() const {
    const double mass = beam_.mass();
    return fmt::format(
        "a beam of {:.4g} m x {:.4g} m x {:.4g} m weighs {}", beam_.length, beam_.width,
        beam_.thickness,
        mass >= 1e4 ? fmt::format("{:.0f} t", 1e-3 * mass) : fmt::format("{:.3g} kg", mass));
  }

  // A wrong density gives no information about lengths.
  bool is_too_large() const {
    const double volume = beam_.length * beam_.width * beam_.thickness;
    return volume * std::clamp(beam_.density, 1e3, heaviest) > heaviest_beam;
  }

  void lengths() {
    const double l = beam_.length, b = beam_.width, h = beam_.thickness;
    const bool large = is_too_large();
    const bool slender = l > most_slender * h;
    const bool deep = h > l;
    const bool wide = b > widest * l;
    const bool any = large || l > longest || slender || deep || wide;
    // Beside one length in mm, another one above a metre is probably in mm too.
    const auto doubtful_beside = [&](double value) { return any && value > one_metre; };
    length("beam.length", l, slender, h, "thickness", large || l > longest);
    length("beam.width", b, wide, l, "length", large || doubtful_beside(b));
    length("beam.thickness", h, deep, l, "length", large || doubtful_beside(h));
    const double nose = striker_.nose_radius.value_or(0.0);
    const bool blunt = nose > largest_nose * l && nose > one_metre;
    if (blunt || !doubtful_beside(nose)) {
      length("striker.nose_radius", nose, blunt, l, "length", false);
    } else {
      add_length("striker.nose_radius", nose, ", like the lengths of the beam");
    }
  }

  void longer_than_run(const char* key, const std::optional<double>& time) {
    const double end = case_.end_time;
    if (!time || *time <= end) return;
    add(given(key, *time, "s") + ", longer than the whole run" +
        proposal(*time, {{"ms", 1e-3}, {"us", 1e-6}}, {0.0, 1e-2 * end}));
  }

  void times() {
    const double end = case_.end_time;
    longer_than_run("solver.step", case_.solver.step);
    longer_than_run("accuracy.event_times", case_.accuracy.event_times);
    if (case_.stop != StopRule::end_time) return;  // its end time is only a limit
    if (end <= long_run) return;
    const double period = 2.0 * M_PI / flexural_frequencies(beam_, 1).front();
    if (end <= most_periods * period) return;
    add(given("time.end", end, "s") +
        fmt::format(", {:.3g} periods of the beam's slowest vibration, {:.3g} s each", end / period,
                    period) +
        proposal(end, {{"ms", 1e-3}, {"us", 1e-6}}, {1e-2 * period, most_periods * period}));
  }

  void density() {
    const double rho = beam_.density;
    const bool light = rho < lightest;
    const bool heavy = rho > heaviest && case_.model.mesh != MeshKind::rigid;
    if (!light && !heavy) return;
    add(given("beam.density", rho, "kg/m3") +
        (light ? ", lighter than packing foam (some 25 kg/m3)"
               : ", heavier than osmium (22600 kg/m3)") +
        proposal(rho, {{"g/cm3", 1e3}, {"t/mm3", 1e12}, {"g/m3", 1e-3}}, {50.0, heaviest}));
  }

  void modulus(const char* key, double E) {
    if (E >= softest && E <= stiffest) return;
    add(given(key, E, "Pa") +
        (E < softest ? ", softer than soft rubber (some 1e6 Pa)"
                     : ", stiffer than diamond (1.2e12 Pa)") +
        proposal(E, {{"MPa", 1e6}, {"GPa", 1e9}, {"mPa", 1e-3}}, {1e8, stiffest}));
  }

  void yield_stress() {
    const double Y = beam_.yield_stress;
    const bool by_strain =
        beam_.youngs_modulus <= stiffest && Y < smallest_yield * beam_.youngs_modulus;
    if (Y >= weakest && !by_strain) return;
    add(given("beam.yield_stress", Y, "Pa") +
        (Y < weakest ? std::string(", far weaker than lead (some 1e7 Pa)")
                     : fmt::format(", reached at a strain of {:.1e} (metals: some 1e-3)",
                                   Y / beam_.youngs_modulus)) +
        proposal(Y, {{"MPa", 1e6}, {"GPa", 1e9}}, {1e6, 2e10}));
  }

  void mass() {
    const double m = striker_.mass;
    if (case_.model.mesh == MeshKind::rigid) return;
    if (m <= heavy_striker || m > heaviest_in_grams) return;
    if (m <= most_beam_masses * beam_.mass()) return;
    add(given("striker.mass", m, "kg") +
        fmt::format(", {:.3g} times the beam's {:.3g} kg", m / beam_.mass(), beam_.mass()) +
        proposal(m, {{"g", 1e-3}}, {}));
  }

  void velocity() {
    const double v = striker_.velocity;
    if (v <= fastest) return;
    add(given("striker.velocity", v, "m/s") + ", faster than a rifle bullet" +
        proposal(v, {{"mm/s", 1e-3}}, {}));
  }

  const Case& case_;
  const Beam& beam_;
  const Striker& striker_;
  std::vector<std::string> sentences_;
};

}  // namespace

std::vector<std::string> doubtful_units(const Case& input) { return Doubts(input).all(); }

}  // namespace subimpact
