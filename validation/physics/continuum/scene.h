#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

namespace continuum {

// A beam struck by a rigid nose, as the options of both programs describe it. SI units.
//
// Coordinates of a material point: X along the beam from the struck section, Y across the
// thickness, from -h/2 on the struck side to h/2, Z across the width from the middle. The nose
// moves along +Y only and is free of friction.
struct Scene {
  double length = 0.7112, thickness = 0.0075, width = 0.0163;
  double density = 2600.0, modulus = 71.96e9, poisson = 0.33;
  double yield = 150e6;  // 0: elastic
  double mass = 0.201, radius = 0.01, speed = 15.9;
  double position = 0.5;  // of the strike, over the length
  bool clamped = false;   // the end X = -position * length
  std::string state = "stress", nose = "cylinder";

  int layers = 15, across = 8;  // elements over h, and over half of b
  double element = 0.5e-3, coarsest = 1e-3,
         fine = 15e-3;  // length at the nose, far away; how far from it
  double penalty = 1.5, courant = 0.42, hourglass = 0.05;
  double end = 8e-3, interval = 0.5e-6, bounce = 0.5e-6;
  int mode = 0;  // of free vibration instead of a strike
  std::string out = ".";

  double shear_modulus() const { return modulus / (2.0 * (1.0 + poisson)); }
  double lame() const { return modulus * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson)); }
  double yield_squared() const { return yield > 0.0 ? yield * yield : 1e300; }
  double contact_stiffness(double node_mass, double dt) const {
    return penalty * node_mass * std::pow(courant / (0.6 * dt), 2);
  }
  bool is_symmetric() const { return position == 0.5 && !clamped; }
};

// Reads the options, or ends the program with CLI11's message.
inline Scene scene_of(int argc, char** argv, const char* what) {
  Scene s;
  CLI::App app(what);
  app.add_option("--length", s.length, "of the beam, m");
  app.add_option("--thickness", s.thickness, "m");
  app.add_option("--width", s.width, "m");
  app.add_option("--density", s.density, "kg/m3");
  app.add_option("--modulus", s.modulus, "Young's modulus, Pa");
  app.add_option("--poisson", s.poisson, "Poisson's ratio");
  app.add_option("--yield", s.yield, "yield stress, Pa; 0: elastic");
  app.add_option("--mass", s.mass, "of the striker, kg");
  app.add_option("--radius", s.radius, "of its nose, m");
  app.add_option("--speed", s.speed, "m/s");
  app.add_option("--position", s.position, "of the strike, over the length")
      ->check(CLI::Range(0.0, 1.0));
  app.add_flag("--clamped", s.clamped, "holds the left end");
  app.add_option("--state", s.state, "plane stress or strain")
      ->check(CLI::IsMember({"stress", "strain"}));
  app.add_option("--nose", s.nose, "of bricks only")->check(CLI::IsMember({"cylinder", "ball"}));
  app.add_option("--layers", s.layers, "elements over the thickness")->check(CLI::Range(2, 200));
  app.add_option("--across", s.across, "bricks over half the width")->check(CLI::Range(2, 200));
  app.add_option("--element", s.element, "length of the elements at the nose, m");
  app.add_option("--coarsest", s.coarsest, "length of the longest, m");
  app.add_option("--fine", s.fine, "how far from the nose they stay short, m");
  app.add_option("--penalty", s.penalty,
                 "contact stiffness of a node, m/dt0^2, dt0 = 0.6 of the critical step");
  app.add_option("--courant", s.courant, "step over the critical one")
      ->check(CLI::Range(0.01, 1.0));
  app.add_option("--hourglass", s.hourglass,
                 "stiffness against hourglassing, over the shear modulus");
  app.add_option("--end", s.end, "s");
  app.add_option("--interval", s.interval, "of history.csv, s");
  app.add_option("--bounce", s.bounce, "separations shorter than this are not counted, s");
  app.add_option("--ring", s.mode, "free vibration in this mode instead of a strike");
  app.add_option("--out", s.out, "folder for contacts.csv and history.csv");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::exit(app.exit(error) == 0 ? 0 : 2);
  }
  return s;
}

// Lengths of elements from a point outwards: `element` as far as `fine`, then growing by 5 % each
// up to `coarsest`, scaled so that they fill `distance`. They shrink again towards a clamped end,
// where a hinge may form.
inline std::vector<double> lengths(const Scene& s, double distance, bool towards_clamp) {
  const auto wanted = [&](double x) {
    const double away = towards_clamp ? std::min(x, distance - x) : x;
    return std::min(s.coarsest, s.element + 0.05 * std::max(0.0, away - s.fine));
  };
  std::vector<double> found;
  for (double x = 0.0; x < distance;) {
    found.push_back(wanted(x));
    x += found.back();
  }
  double sum = 0.0;
  for (double d : found) sum += d;
  for (double& d : found) d *= distance / sum;
  return found;
}

// Nodes along the beam, with one at the struck section X = 0; symmetric scenes have X >= 0 only.
inline std::vector<double> stations(const Scene& s) {
  std::vector<double> x{0.0};
  if (!s.is_symmetric()) {
    for (double d : lengths(s, s.position * s.length, s.clamped)) x.push_back(x.back() - d);
    std::reverse(x.begin(), x.end());
    x.back() = 0.0;
  }
  for (double d : lengths(s, (1.0 - s.position) * s.length, false)) x.push_back(x.back() + d);
  return x;
}

// Deflection of a free beam without shear in its mode n at a distance from the middle; largest 1 or
// so.
inline double free_mode(int n, double length, double x) {
  static constexpr double beta[] = {4.7300407449, 7.8532046241, 10.9956078380, 14.1371654913,
                                    17.2787596574};
  const double b = n <= 5 ? beta[n - 1] : (n + 0.5) * std::numbers::pi;
  const double y = b * x / length;
  return n % 2 == 1 ? std::cos(y) + std::cos(b / 2) / std::cosh(b / 2) * std::cosh(y)
                    : std::sin(y) + std::sin(b / 2) / std::sinh(b / 2) * std::sinh(y);
}

}  // namespace continuum
