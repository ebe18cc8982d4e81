#include "model/rules.h"

#include <algorithm>
#include <cmath>

namespace subimpact {
namespace {

constexpr double rounding = 1e-9;      // of sums
constexpr double tolerated = 0.05;     // of mass, length and frequency
constexpr double least_weights = 0.5;  // over the length; sections may leave out the ends

double abs_sum(std::span<const double> row) {
  double sum = 0.0;
  for (const double x : row) sum += std::abs(x);
  return sum;
}

void check_sections(const BeamMesh& mesh, double length) {
  const auto weights = mesh.section_weights(), places = mesh.section_positions();
  const std::size_t n = weights.size();
  require(n > 0 && n == places.size(), "it has {} weights and {} positions of sections", n,
          places.size());
  require(mesh.struck_section() < n, "its struck section is {}, and it has only {}, from 0",
          mesh.struck_section(), n);
  for (std::size_t i = 0; i < n; ++i) {
    require(weights[i] > 0.0 && std::isfinite(weights[i]),
            "the weight of section {} is {:.6g} m; allowed: above 0", i, weights[i]);
    require(places[i] >= -rounding * length && places[i] <= (1.0 + rounding) * length,
            "section {} lies at {:.6g} m; allowed: from 0 to {:.6g} m, the length of the beam", i,
            places[i], length);
    check_row(i, mesh.section_stencil(i).first, mesh.section_stencil(i).coefficients,
              mesh.n_unknowns());
  }
  const double sum = abs_sum(weights);
  require(sum >= least_weights * length && sum <= (1.0 + tolerated) * length,
          "the weights of its sections add up to {:.6g} m; allowed: from {} to {} times the length "
          "of the beam, {:.6g} m",
          sum, least_weights, 1.0 + tolerated, length);
}

void check_mass(const BeamMesh& mesh, double beam_mass) {
  require(mesh.mass().cholesky_factor().has_value(),
          "its mass matrix of {} unknowns is not positive definite", mesh.n_unknowns());
  require(std::abs(mesh.beam_mass() - beam_mass) <= tolerated * beam_mass,
          "its mass is {:.6g} kg, and that of the beam of the case {:.6g} kg; allowed: within 5 % "
          "(give the beam the density that the mesh has)",
          mesh.beam_mass(), beam_mass);
  require(mesh.momentum_functional().size() == mesh.n_unknowns(),
          "its momentum has {} coefficients for {} unknowns", mesh.momentum_functional().size(),
          mesh.n_unknowns());
}

void check_translation(const BeamMesh& mesh) {
  const auto t = mesh.translation();
  if (t.empty()) return;
  require(t.size() == mesh.n_unknowns(), "its translation has {} entries for {} unknowns", t.size(),
          mesh.n_unknowns());
  const double struck = mesh.struck_point()(t);
  const double first = mesh.first_end().is_zero() ? 1.0 : mesh.first_end()(t);
  require(std::abs(struck - 1.0) <= rounding && std::abs(first - 1.0) <= rounding,
          "a translation by 1 m moves its struck point by {:.6g} m and its first end by {:.6g} m",
          struck, first);
  for (std::size_t i = 0; i < mesh.n_sections(); ++i) {
    const double size = abs_sum(mesh.section_stencil(i).coefficients), bent = mesh.curvature(i, t);
    require(std::abs(bent) <= rounding * size,
            "a translation by 1 m bends its section {} by {:.6g} 1/m", i, bent);
  }
}

// All functions have one B, and no unknown alone swings faster than the highest frequency.
void check_operator(const BeamMesh& mesh, double stiffness) {
  const std::size_t n = mesh.n_unknowns(), n_sections = mesh.n_sections();
  std::vector<double> q(n), forces(n), by_rows(n), own(n), kappa(n_sections), moments(n_sections);
  for (std::size_t i = 0; i < n; ++i) q[i] = std::sin(1.0 + 0.7 * static_cast<double>(i));
  mesh.curvatures(q, kappa);
  for (std::size_t i = 0; i < n_sections; ++i) {
    const auto [first, row] = mesh.section_stencil(i);
    moments[i] = std::cos(0.3 * static_cast<double>(i));
    for (std::size_t k = 0; k < row.size(); ++k) {
      by_rows[first + k] -= mesh.section_weights()[i] * row[k] * moments[i];
      own[first + k] += stiffness * mesh.section_weights()[i] * row[k] * row[k];
    }
    require(std::abs(kappa[i] - mesh.curvature(i, q)) <= rounding * abs_sum(row),
            "curvatures() gives {:.6g} 1/m where section_stencil() gives {:.6g}, in section {}",
            kappa[i], mesh.curvature(i, q), i);
  }
  mesh.bending_forces(moments, forces);
  const double highest = mesh.highest_frequency(stiffness), size = abs_sum(by_rows);
  for (std::size_t i = 0; i < n; ++i) {
    require(std::abs(forces[i] - by_rows[i]) <= rounding * size,
            "bending_forces() gives {:.6g} N where -B^T W M is {:.6g} N, at the unknown {}",
            forces[i], by_rows[i], i);
    const double omega = std::sqrt(own[i] / mesh.mass().at(i, i));
    require(std::isfinite(highest) && highest >= (1.0 - tolerated) * omega,
            "its highest frequency is {:.6g} rad/s, and the unknown {} alone swings at {:.6g}",
            highest, i, omega);
  }
}

}  // namespace

void check_functional(const char* name, const SparseFunctional& functional, std::size_t n) {
  require(functional.dense.empty() || functional.dense.size() == n,
          "its {} has {} dense coefficients for {} unknowns", name, functional.dense.size(), n);
  require(std::ranges::all_of(functional.dense, [](double x) { return std::isfinite(x); }),
          "its {} has a dense coefficient that is not finite", name);
  for (const auto& [unknown, coefficient] : functional.terms) {
    require(unknown < n && std::isfinite(coefficient),
            "its {} has the coefficient {} at the unknown {}; allowed: finite ones, at 0 to {}",
            name, coefficient, unknown, n - 1);
  }
}

void check_row(std::size_t section, std::size_t first, std::span<const double> row, std::size_t n) {
  require(!row.empty() && row.size() <= n && first <= n - row.size(),
          "the curvature of section {} has {} coefficients from the unknown {} on; allowed: some, "
          "at 0 to {}",
          section, row.size(), first, n - 1);
  require(std::isfinite(abs_sum(row)),
          "the curvature of section {} has a coefficient that is not "
          "finite",
          section);
}

std::optional<std::string> broken_rule(const BeamMesh& mesh, const Beam& beam) {
  try {
    require(mesh.n_unknowns() > 0, "it has {} unknowns", mesh.n_unknowns());
    require(!mesh.struck_point().is_zero(), "its struck point has no coefficient");
    check_functional("struck point", mesh.struck_point(), mesh.n_unknowns());
    check_functional("first end", mesh.first_end(), mesh.n_unknowns());
    check_sections(mesh, beam.length);
    check_mass(mesh, beam.mass());
    check_translation(mesh);
    check_operator(mesh, beam.bending_stiffness());
  } catch (const BrokenRule& broken) {
    return fmt::format("\"{}\" breaks a rule of BeamMesh: {}", mesh.description(), broken.what());
  }
  return std::nullopt;
}

}  // namespace subimpact
