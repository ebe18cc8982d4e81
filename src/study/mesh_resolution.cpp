#include "study/mesh_resolution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "subimpact/study/mesh_error_bars.h"

namespace subimpact {
namespace {

constexpr double cells_per_wave = 8.0;
constexpr double fewest_cells = 64.0;
constexpr double us = 1e6;  // per second

double cells_of_a_part(const Case& input) {
  switch (input.model.mesh) {
    case MeshKind::hermite:
      return 2.0;
    case MeshKind::spectral:
      return 8.0;
    default:
      return 1.0;
  }
}

double refinement_at_strike(const Case& input) {
  return input.model.mesh == MeshKind::hermite ? input.model.strike_refinement : 1.0;
}

// sqrt(E I/(rho A)), m2/s.
double wave_constant(const Beam& beam) {
  return std::sqrt(beam.bending_stiffness() / beam.mass_per_length());
}

struct Doubt {
  std::size_t first;
  std::string reason;
};

std::optional<Doubt> short_contact(const Result& result, const Case& input) {
  const double shortest = shortest_contact_shown(input);
  const auto& all = result.sub_impacts;
  for (std::size_t i = 0; i < all.size() && all[i].end; ++i) {
    const double contact = *all[i].end - all[i].start;
    const double separation = i + 1 < all.size() ? all[i + 1].start - *all[i].end : shortest;
    if (contact >= shortest && separation >= shortest) continue;
    return Doubt{
        i, fmt::format("{} {:.2g} us, and the mesh shows none shorter than {:.2g} us: it "
                       "does not resolve the bending waves",
                       contact < shortest ? "its contact lasts" : "the separation after it lasts",
                       us * std::min(contact, separation), us * shortest)};
  }
  return std::nullopt;
}

std::optional<Doubt> open_contact(const Result& result, const Case& input) {
  if (result.sub_impacts.empty() || result.sub_impacts.back().end) return std::nullopt;
  const double needed =
      parts_that_resolve(input, result.used.contact_time) / refinement_at_strike(input);
  if (mesh_count(input) >= needed) return std::nullopt;
  return Doubt{result.sub_impacts.size() - 1,
               fmt::format("it lasts to the end, and {} parts of the mesh do not resolve the "
                           "bending waves of contacts as short as {:.2g} us, as {:.0f} would",
                           mesh_count(input), us * result.used.contact_time, std::ceil(needed))};
}

// Of the first n sub-impacts, s.
double largest_error(const Result& result, std::size_t n) {
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const SubImpact& s = result.sub_impacts[i];
    largest = std::max({largest, s.start_error.value_or(0.0), s.end_error.value_or(0.0)});
  }
  return largest;
}

}  // namespace

int parts_that_resolve(const Case& input, double contact_time, double most_cells) {
  const Beam& beam = input.scene.beam;
  const double wave = 2.0 * std::sqrt(M_PI * wave_constant(beam) * contact_time);
  const double cells = std::clamp(cells_per_wave * beam.length / wave, fewest_cells, most_cells);
  return static_cast<int>(cells / cells_of_a_part(input));
}

double shortest_contact_shown(const Case& input) {
  if (!mesh_order(input)) return 0.0;
  const Beam& beam = input.scene.beam;
  const double cells = refinement_at_strike(input) * cells_of_a_part(input) * mesh_count(input);
  return std::pow(beam.length / cells, 2) / wave_constant(beam);
}

void doubt_unresolved_contacts(Result& result, const Case& input) {
  if (!mesh_order(input)) return;
  ErrorEstimate& estimate = *result.error_estimate;
  for (const std::optional<Doubt>& doubt :
       {short_contact(result, input), open_contact(result, input)}) {
    if (!doubt || estimate.first_unresolved.value_or(doubt->first + 1) <= doubt->first) continue;
    estimate.first_unresolved = doubt->first;
    estimate.reason = doubt->reason;
    estimate.largest_error = largest_error(result, doubt->first);
    for (ErrorEstimate::Part& part : estimate.parts) {
      if (!part.name.starts_with("mesh")) continue;
      part.first_unresolved = doubt->first;
      part.reason = doubt->reason;
      part.largest_error = std::min(part.largest_error, estimate.largest_error);
    }
  }
}

}  // namespace subimpact
