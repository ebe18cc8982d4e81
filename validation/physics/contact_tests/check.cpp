// Chung and Ooi's elastic normal impacts (2011, tests 1 and 2), by every method; and the states
// that the test suite of LAMMPS prints for the glass spheres.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "outcome.h"
#include "subimpact/case/simulate.h"

namespace subimpact::validation {
namespace {

struct Spheres {
  const char* material;
  double modulus, poisson, density, radius;  // Pa, -, kg/m3, m
  double velocity;                           // m/s, relative
  bool plane;                                // a sphere and a rigid plane, or two spheres

  double mass() const { return 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3) * density; }
  double reduced_mass() const { return plane ? mass() : 0.5 * mass(); }
  double relative_radius() const { return plane ? radius : 0.5 * radius; }
  // K of F = K d^1.5, N/m^1.5.
  double stiffness() const {
    const double relative = modulus / (1.0 - poisson * poisson) * (plane ? 1.0 : 0.5);
    return 4.0 / 3.0 * relative * std::sqrt(relative_radius());
  }
};
constexpr Spheres tests[] = {{"two spheres of glass", 48e9, 0.2, 2800.0, 0.01, 20.0, false},
                             {"two spheres of limestone", 20e9, 0.25, 2500.0, 0.01, 20.0, false},
                             {"aluminium alloy on a plane", 70e9, 0.3, 2699.0, 0.1, 0.2, true},
                             {"magnesium alloy on a plane", 40e9, 0.35, 1800.0, 0.1, 0.2, true}};

constexpr double plane_mass = 1e14;     // over the sphere's
constexpr double tolerance = 1e-8;      // of the method that is printed in full
constexpr double all_methods = 5e-6;    // of every method: six printed digits
constexpr double share_of_step = 1e-4;  // of the duration, for central differences

Case case_of_spheres(const Spheres& spheres) {
  Case input = case_of("contact_tests");
  Scene& scene = input.scene;
  // Volume 1 m3.
  scene.beam.density = spheres.mass() * (spheres.plane ? plane_mass : 1.0);
  scene.beam.youngs_modulus = spheres.modulus;
  scene.beam.poisson = spheres.poisson;
  scene.striker.mass = spheres.mass();
  scene.striker.nose_radius = spheres.relative_radius();
  scene.striker.velocity = spheres.velocity;
  if (!spheres.plane) {
    scene.contact.striker_modulus = spheres.modulus;
    scene.contact.striker_poisson = spheres.poisson;
  }
  return input;
}

struct Impact {
  double indentation, force, duration, restitution;  // m, N, s
};

// Hertz: energy gives indentation and force, a quadrature in closed form the duration.
Impact closed_form(const Spheres& spheres) {
  const double v = spheres.velocity;
  const double indentation =
      std::pow(1.25 * spheres.reduced_mass() * v * v / spheres.stiffness(), 0.4);
  const double constant = 2.0 * std::sqrt(std::numbers::pi) * std::tgamma(1.4) / std::tgamma(0.9);
  return {indentation, spheres.stiffness() * std::pow(indentation, 1.5), constant * indentation / v,
          1.0};
}

Impact impact_of(const Case& input) {
  const Result result = simulate(input);
  if (!result.outcome.completed()) throw std::runtime_error(result.outcome.message);
  if (result.sub_impacts.size() != 1) throw std::runtime_error("not one contact");
  const SubImpact& hit = result.sub_impacts[0];
  return {hit.max_indentation, hit.peak_force, hit.end.value() - hit.start,
          (result.beam_mean_velocity - result.striker_velocity) / input.scene.striker.velocity};
}

void add_full(Outcome& outcome, const Spheres& spheres) {
  const Impact published = closed_form(spheres);
  const Impact ours = impact_of(case_of_spheres(spheres));
  const auto add = [&](const char* quantity, double unit, double Impact::*of) {
    outcome.rows.push_back({fmt::format("{}: {}", spheres.material, quantity), unit * published.*of,
                            unit * ours.*of, Bound::relative, tolerance});
  };
  add("largest indentation, um", 1e6, &Impact::indentation);
  add("largest force, kN", 1e-3, &Impact::force);
  add("duration, us", 1e6, &Impact::duration);
  add("restitution", 1.0, &Impact::restitution);
}

// The largest relative difference in any of the four quantities of the four impacts.
void add_method(Outcome& outcome, Method method, const char* name) {
  double largest = 0.0;
  for (const Spheres& spheres : tests) {
    const Impact published = closed_form(spheres);
    Case input = case_of_spheres(spheres);
    input.solver.method = method;
    if (method == Method::central_difference) {
      input.solver.step = share_of_step * published.duration;
      input.end_time = 1.5 * published.duration;
    }
    const Impact ours = impact_of(input);
    for (double Impact::*of :
         {&Impact::indentation, &Impact::force, &Impact::duration, &Impact::restitution}) {
      largest = std::max(largest, std::abs(ours.*of / (published.*of) - 1.0));
    }
  }
  outcome.rows.push_back(
      {fmt::format("{}: largest relative difference in any quantity of the four", name),
       all_methods, largest, Bound::within, 0.0});
}

// States of the first glass sphere as unittest/granular/tests/dem02-hertz-twosphere-3d-si.yaml of
// LAMMPS prints them, after steps of velocity Verlet that begin at the touch: the same scheme as
// central differences with the same step and constants.
void add_lammps(Outcome& outcome) {
  constexpr double step = 2e-8;                     // s
  constexpr double contact_stiffness = 3.33333e10;  // Pa
  constexpr double radius = 0.01;  // m, also where the sphere's centre stands at the touch
  struct {
    int steps;
    double position, velocity;  // m, m/s
  } const printed[] = {{1008, -9.8629436218504573e-03, 8.8771553283535053e-03},
                       {2008, -9.9982053375566714e-03, -9.9999015425187849e+00}};
  Case input = case_of_spheres(tests[0]);
  Contact& contact = input.scene.contact;
  contact = {};
  contact.kind = ContactKind::hertz;
  contact.stiffness = contact_stiffness * std::sqrt(0.5 * radius);
  input.scene.beam.poisson.reset();
  input.solver.method = Method::central_difference;
  input.solver.step = step;
  input.output.interval = 8.0 * step;
  input.end_time = 2016.0 * step;
  const Result result = simulate(input);
  for (const auto& [steps, position, velocity] : printed) {
    const double time = steps * step;
    const auto row = std::min_element(result.history.begin(), result.history.end(),
                                      [&](const HistoryRow& a, const HistoryRow& b) {
                                        return std::abs(a.time - time) < std::abs(b.time - time);
                                      });
    if (row == result.history.end()) throw std::runtime_error("no history");
    // Each sphere moves by half of what brings them together.
    outcome.rows.push_back(
        {fmt::format("LAMMPS, glass, position of the centre after {} steps, mm", steps),
         1e3 * position, 1e3 * (0.5 * row->indentation - radius), Bound::relative, 1e-10});
    outcome.rows.push_back({fmt::format("LAMMPS, glass, velocity after {} steps, m/s", steps),
                            velocity, 0.5 * (row->striker_velocity - row->struck_velocity),
                            Bound::absolute, 1e-10 * tests[0].velocity});
  }
}

}  // namespace

Outcome check_contact_tests() {
  Outcome outcome{"Chung and Ooi 2011", {}, {}};
  for (const Spheres& spheres : tests) add_full(outcome, spheres);
  constexpr struct {
    Method method;
    const char* name;
  } methods[] = {{Method::nystrom, "nystrom"},
                 {Method::erk, "erk"},
                 {Method::exponential, "exponential"},
                 {Method::dirk, "dirk"},
                 {Method::adams, "adams"},
                 {Method::bdf, "bdf"},
                 {Method::central_difference, "central-difference"}};
  for (const auto& [method, name] : methods) add_method(outcome, method, name);
  add_lammps(outcome);
  return outcome;
}

}  // namespace subimpact::validation
