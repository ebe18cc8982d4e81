// Two rigid bodies: durations of elastic contacts, restitution of an elasto-plastic surface.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "outcome.h"
#include "subimpact/case/simulate.h"

namespace subimpact::validation {
namespace {

double reduced_mass(const Case& input) {
  const double m = input.scene.striker.mass;
  const double beam = input.scene.beam.mass();
  return m * beam / (m + beam);
}

// Largest indentation and duration of an elastic contact, made dimensionless.
void add_power_law(Outcome& outcome, const char* law, double stiffness, double n, double constant) {
  const Case input = case_of("rigid_bodies", {fmt::format("contact.law={}", law),
                                              fmt::format("contact.stiffness={:.17g}", stiffness)});
  const double v = input.scene.striker.velocity;
  const double depth =
      std::pow((n + 1.0) * reduced_mass(input) * v * v / (2.0 * stiffness), 1.0 / (n + 1.0));
  const Result result = simulate(input);
  const SubImpact& hit = result.sub_impacts.at(0);
  outcome.rows.push_back({fmt::format("{}: largest indentation, mm", law), 1e3 * depth,
                          1e3 * hit.max_indentation, Bound::relative, 1e-8});
  outcome.rows.push_back({fmt::format("{}: duration v/d_max", law), constant,
                          hit.end.value() * v / depth, Bound::relative, 1e-8});
  outcome.rows.push_back({fmt::format("{}: restitution", law), 1.0,
                          (result.beam_mean_velocity - result.striker_velocity) / v,
                          Bound::relative, 1e-8});
}

}  // namespace

Outcome check_rigid_bodies() {
  Outcome outcome{"closed form", {}, {}};
  add_power_law(outcome, "hertz", 3e10, 1.5, 2.943275184);
  add_power_law(outcome, "linear", 2e7, 1.0, std::numbers::pi);
  const double table[][2] = {{1.1, 0.968271}, {1.5, 0.810718}, {2, 0.680556},  {3, 0.536678},
                             {5, 0.404029},   {10, 0.279676},  {20, 0.195686}, {50, 0.122987}};
  for (const auto& [x, e] : table) {
    Case input = case_of("rigid_bodies");
    const ResolvedSettings used = resolve(input).settings();
    // The speed whose energy indents to x lambda_s.
    const double work = 0.4 * used.contact_stiffness * std::pow(used.yield_indentation, 2.5) *
                        (std::pow(x, 2.5) - std::pow(x - 1.0, 2.5));
    input.scene.striker.velocity = std::sqrt(2.0 * work / reduced_mass(input));
    const Result result = simulate(input);
    outcome.rows.push_back(
        {fmt::format("elasto-plastic: restitution at λ_m/λ_s = {}", x), e,
         (result.beam_mean_velocity - result.striker_velocity) / input.scene.striker.velocity,
         Bound::absolute, 1e-6});
  }
  return outcome;
}

}  // namespace subimpact::validation
