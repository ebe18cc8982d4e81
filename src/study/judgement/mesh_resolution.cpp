#include "study/judgement/mesh_resolution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "case/meshes.h"
#include "case/problem.h"
#include "simulate/settings/methods.h"
#include "subimpact/study/judgement/judgement.h"

namespace subimpact {
namespace {

// The whole number nearest to x that is odd (or even), or just the nearest.
int nearest(double x, bool any, bool odd) {
  const int n = static_cast<int>(std::lround(x));
  if (any || (n % 2 != 0) == odd) return n;
  return x >= n ? n + 1 : n - 1;
}

// A mesh of the caller's own has no finer one.
std::optional<MeshDescriptor::Refinement> refinement_of(const Case& input) {
  if (input.parts.mesh) return std::nullopt;
  return descriptor_of(input.model.mesh).refinement;
}

constexpr double cells_per_wave = 8.0;
constexpr double fewest_cells = 64.0;
constexpr double ample = 6.0;  // of the parts that resolve contacts
constexpr int low_order = 2;

double cells_of_a_part(const Case& input) {
  const MeshKind mesh = input.model.mesh;
  return mesh == MeshKind::hermite ? 2.0 : mesh == MeshKind::spectral ? 8.0 : 1.0;
}

// sqrt(E I/(rho A)), m2/s.
double wave_constant(const Beam& beam) {
  return std::sqrt(beam.bending_stiffness() / beam.mass_per_length());
}

constexpr double largest_mass_ratio = 0.2;  // of a part of the mesh to the striker
constexpr double fewest_cells_to_end = 6.0;
constexpr double coarsest_beside = 0.7;  // over the parts of the first mesh
// For elements, whose modes with a node at the strike have no closed form: 800 take a second.
constexpr double most_cells_in_modes = 800.0;

// Distance of the strike from the nearest end, as a share of the length.
double distance_to_end(const Case& input) {
  return std::min(input.scene.striker.position, 1.0 - input.scene.striker.position);
}

double cells_over_length(const Case& input) { return cells_of_a_part(input) * mesh_count(input); }

// The effective mass (kg) of the beam itself at a blow: with rotary inertia and without shear an
// impulse at once moves the stretch e^(-|x|/r) about it, less or more by the reflection from the
// nearest end.
double mass_met_without_mesh(const Case& input) {
  const Beam& beam = input.scene.beam;
  if (beam.shears() || beam.rotary_inertia() == 0.0) return 0.0;
  const double r = beam.radius_of_gyration();
  const double reflected = std::exp(-2.0 * distance_to_end(input) * beam.length / r);
  const bool is_free = beam.ends[input.scene.striker.position < 0.5 ? 0 : 1] == EndSupport::free;
  return 2.0 * beam.mass_per_length() * r / (is_free ? 1.0 + reflected : 1.0 - reflected);
}

// The mass (kg) that the mesh adds to it.
double mass_of_mesh(const Case& input, const ResolvedSettings& used) {
  const double share = used.contact_mass_share;
  const double met = input.scene.bodies().moving_mass() * share / (1.0 - share);
  return std::max(met - mass_met_without_mesh(input), 0.0);
}

double parts_towards_end(const Case& input) {
  if (strikes_end(input)) return 0.0;
  const double parts = fewest_cells_to_end / cells_of_a_part(input);
  return std::max(parts, 1.0) / (coarsest_beside * distance_to_end(input));
}

// Cells of the length dx add rho A (sqrt(dx^2 + 4 r^2) - 2 r); elements of either kind nearly so,
// for which there is a margin.
double parts_beside_striker(const Case& input, const ResolvedSettings& used) {
  const double without_mesh = mass_met_without_mesh(input);
  const auto size = [&](double mass) { return std::sqrt(mass * (mass + 2.0 * without_mesh)); };
  return 1.05 * mesh_count(input) * size(mass_of_mesh(input, used)) /
         size(largest_mass_ratio * input.scene.bodies().moving_mass());
}

// Distance (m) of the strike from the nearest free end; infinite without one.
double distance_to_free_end(const Scene& scene) {
  double nearest = std::numeric_limits<double>::infinity();
  const double at = scene.striker.position;
  if (scene.beam.ends[0] == EndSupport::free) nearest = at * scene.beam.length;
  if (scene.beam.ends[1] == EndSupport::free) {
    nearest = std::min(nearest, (1.0 - at) * scene.beam.length);
  }
  return nearest;
}

// Parts of which half a one lies between the strike and the end, also on coarser meshes beside.
double fewest_parts(const Case& input) {
  return strikes_end(input) ? 0.0 : 0.5 / (coarsest_beside * distance_to_end(input));
}

// At least `parts`, although a symmetric mesh may have one part fewer than requested.
int chosen_parts(const Case& input, double parts) {
  const double most = std::max(1.0 * most_parts_at_first(input), std::ceil(fewest_parts(input)));
  return static_cast<int>(std::min({std::ceil(parts) + 1.0, most + 1.0, 1e6}));
}

}  // namespace

std::optional<int> mesh_order(const Case& input) {
  const auto refinement = refinement_of(input);
  return refinement ? std::optional(refinement->order(input)) : std::nullopt;
}

int mesh_count(const Case& input) {
  const auto refinement = refinement_of(input);
  return refinement ? input.model.*(refinement->count) : 1;
}

std::string mesh_words(const Case& input) {
  const auto refinement = refinement_of(input);
  if (!refinement) return input.parts.mesh ? "a mesh of its own" : "rigid";
  return fmt::format("{} {}", mesh_count(input), refinement->parts);
}

std::optional<Case> on_other_mesh(const Case& input, double factor) {
  const auto refinement = refinement_of(input);
  if (!refinement) return {};
  Case other = input;
  other.output.keep_no_rows();
  int& count = other.model.*(refinement->count);
  // An even number of elements has a node at mid-span: equal elements, with modes in closed form.
  const bool any = !uses_symmetry(input) && refinement->odd_in_half;
  count = nearest(factor * mesh_count(input), any, refinement->odd_in_half);
  if (count < refinement->fewest) return {};
  if (descriptor_of(input.solver.method).has_fixed_steps() && input.solver.step) {
    other.solver.step = std::min(*input.solver.step, largest_stable_step(other));
  }
  return other;
}

int most_parts_at_first(const Case& input) {
  const bool in_cells = input.model.mesh == MeshKind::cells;
  const double cells = in_cells ? most_cells_at_first : most_cells_in_modes;
  return static_cast<int>(cells / cells_of_a_part(input));
}

bool takes_strike(const Case& input) { return fewest_parts(input) <= most_parts_at_first(input); }

int parts_that_resolve(const Case& input, double contact_time, double most_cells) {
  const Beam& beam = input.scene.beam;
  const double wave = 2.0 * std::sqrt(M_PI * wave_constant(beam) * contact_time);
  const double cells = std::clamp(cells_per_wave * beam.length / wave, fewest_cells, most_cells);
  return static_cast<int>(cells / cells_of_a_part(input));
}

bool resolves_amply(const Case& input, double contact_time) {
  const std::optional<int> order = mesh_order(input);
  return order && *order <= low_order &&
         mesh_count(input) >= ample * parts_that_resolve(input, contact_time);
}

double shortest_contact_shown(const Case& input) {
  if (!mesh_order(input)) return 0.0;
  const Beam& beam = input.scene.beam;
  return std::pow(beam.length / cells_over_length(input), 2) / wave_constant(beam);
}

std::optional<Reason> unresolved_contact(const Case& input, const Result& result, std::size_t i) {
  if (!mesh_order(input)) return {};
  const auto& all = result.sub_impacts;
  const SubImpact& here = all[i];
  const bool has_yielded =
      result.first_section_yield && result.end_of(here) > *result.first_section_yield;
  if (has_yielded && input.model.mesh == MeshKind::hermite && !strikes_end(input)) {
    return Reason{.kind = Reason::Kind::yielding_elements};
  }
  if (!here.end) {
    const double needed = parts_that_resolve(input, result.used.contact_time);
    if (mesh_count(input) >= needed) return {};
    return Reason{.kind = Reason::Kind::unended_contact,
                  .value = 1.0 * mesh_count(input),
                  .limit = std::ceil(needed),
                  .time = result.used.contact_time};
  }
  const double shortest = shortest_contact_shown(input);
  const double contact = *here.end - here.start;
  const double separation = i + 1 < all.size() ? all[i + 1].start - *here.end : shortest;
  if (contact >= shortest && separation >= shortest) return {};
  using enum Reason::Kind;
  return Reason{.kind = contact < shortest ? short_contact : short_separation,
                .value = std::min(contact, separation),
                .limit = shortest};
}

int parts_that_take_strike(const Case& input) {
  return std::max(mesh_count(input), chosen_parts(input, parts_towards_end(input)));
}

int parts_at_first(const Case& input, const ResolvedSettings& used) {
  const double parts = std::max(parts_towards_end(input), parts_beside_striker(input, used));
  return std::max(parts_that_resolve(input, used.contact_time, most_cells_at_first),
                  chosen_parts(input, parts));
}

std::optional<Reason> mesh_doubt(const Case& input, const ResolvedSettings& used) {
  if (!mesh_order(input)) return {};
  const double mass_ratio = mass_of_mesh(input, used) / input.scene.bodies().moving_mass();
  if (mass_ratio > largest_mass_ratio) {
    return Reason{Reason::Kind::heavy_part, {}, mass_ratio};
  }
  const double to_end = distance_to_end(input) * cells_over_length(input);
  if (strikes_end(input) || to_end >= fewest_cells_to_end) return {};
  return Reason{Reason::Kind::near_end, {}, to_end};
}

double free_end_error(const Case& input, double contact_time, double time) {
  const Beam& beam = input.scene.beam;
  const bool cells = input.model.mesh == MeshKind::cells && !input.parts.mesh &&
                     input.model.spacing != CellSpacing::whole;
  if (!cells || beam.theory != BeamTheory::rayleigh) return 0.0;
  const auto n_free = std::count(beam.ends.begin(), beam.ends.end(), EndSupport::free);
  if (n_free == 0) return 0.0;
  const double speed = std::sqrt(beam.youngs_modulus / beam.density);
  const double y2 = std::pow(beam.radius_of_gyration() / (speed * contact_time), 2);
  const double x = 0.5 * (y2 + std::sqrt(y2 * (y2 + 4.0)));
  const double stretch = 1.0 + x;
  const double group_velocity = speed * std::sqrt(x) * (2.0 + x) / (stretch * std::sqrt(stretch));
  const double round_trip = 2.0 * beam.length / group_velocity;
  const double nearest = distance_to_free_end(input.scene);
  const double reflected =
      std::min(static_cast<double>(n_free) * time + round_trip, time * beam.length / nearest);
  return reflected / input.model.segments * x / stretch;
}

}  // namespace subimpact
