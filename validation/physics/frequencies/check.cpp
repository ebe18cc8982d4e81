// Natural frequencies of free, pinned and clamped beams.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "model/mesh/cell_mesh.h"
#include "model/mesh/modes.h"
#include "outcome.h"

namespace subimpact::validation {
namespace {

using Ends = std::array<EndSupport, 2>;
constexpr Ends free_free{EndSupport::free, EndSupport::free};
constexpr Ends pinned{EndSupport::pinned, EndSupport::pinned};
constexpr Ends clamped{EndSupport::clamped, EndSupport::clamped};

// Mode k (from 1) of the mesh, Hz; rigid modes left out.
double mesh_frequency(const Beam& beam, std::size_t n_cells, std::size_t mode) {
  const CellMesh mesh(beam, 0.5, n_cells, CellMesh::Extent::whole);
  const NaturalModes modes = dense_natural_modes(mesh, beam.bending_stiffness());
  std::size_t rigid = 0;
  while (modes.frequencies[rigid] == 0.0) ++rigid;
  return modes.frequencies[rigid + mode - 1] / (2.0 * std::numbers::pi);
}

void add_closed_forms(Outcome& outcome, Beam beam) {
  const struct {
    double slenderness;
    std::array<double, 5> beta;
  } wave_numbers[] = {
      {0.003044240, {4.7294986445, 7.8512239742, 10.9908523965, 14.1278561451, 17.2626944721}},
      {0.0, {4.7300407449, 7.8532046241, 10.9956078380, 14.1371654913, 17.2787596574}},
      {0.05, {4.5937950806, 7.3924333414, 9.9896525818, 12.3640608084, 14.5370373882}}};
  for (const auto& [r, published] : wave_numbers) {
    const std::vector<double> beta = flexural_wave_numbers(r, free_free, 5);
    for (std::size_t k = 0; k < 5; ++k) {
      outcome.rows.push_back({fmt::format("free, β_{} at r = {}", k + 1, r), published[k], beta[k],
                              Bound::absolute, 1e-9});
    }
  }
  const struct {
    BeamTheory theory;
    const char* name;
    std::array<double, 5> hertz;
  } closed[] = {{BeamTheory::rayleigh,
                 "Rayleigh",
                 {80.167140, 220.922990, 432.941214, 715.350208, 1068.029744}},
                {BeamTheory::euler_bernoulli,
                 "Euler-Bernoulli",
                 {80.185519, 221.034470, 433.315938, 716.293258, 1070.018551}}};
  for (const auto& [theory, name, hertz] : closed) {
    beam.theory = theory;
    const std::vector<double> ours = flexural_frequencies(beam, 5);
    for (std::size_t k = 0; k < 5; ++k) {
      outcome.rows.push_back({fmt::format("free, {}, mode {}, Hz (closed form)", name, k + 1),
                              hertz[k], ours[k] / (2.0 * std::numbers::pi), Bound::absolute,
                              0.6e-6});
    }
  }
}

// The cells: extrapolated from two meshes at second order, and the order seen on three. Without
// rotary inertia, of which the cells of a free end leave out a half cell: a first-order term.
void add_cells(Outcome& outcome, Beam beam) {
  beam.theory = BeamTheory::euler_bernoulli;
  const double scale = std::sqrt(beam.bending_stiffness() / beam.mass_per_length()) /
                       (2.0 * std::numbers::pi * beam.length * beam.length);
  const struct {
    const char* name;
    Ends ends;
    std::array<double, 3> beta;
  } supports[] = {
      {"free", free_free, {4.7300407449, 7.8532046241, 10.9956078380}},
      {"pinned", pinned, {std::numbers::pi, 2.0 * std::numbers::pi, 3.0 * std::numbers::pi}},
      {"clamped", clamped, {4.7300407449, 7.8532046241, 10.9956078380}}};
  for (const auto& [name, ends, beta] : supports) {
    beam.ends = ends;
    for (std::size_t k = 0; k < 3; ++k) {
      const double exact = scale * beta[k] * beta[k];
      const double coarse = mesh_frequency(beam, 51, k + 1);
      const double middle = mesh_frequency(beam, 101, k + 1);
      const double fine = mesh_frequency(beam, 201, k + 1);
      const double ratio = 201.0 / 101.0;
      const double limit = fine + (fine - middle) / (ratio * ratio - 1.0);
      outcome.rows.push_back({fmt::format("{}, mode {}, Hz (cells, extrapolated)", name, k + 1),
                              exact, limit, Bound::relative, 1e-5});
      const double order = std::log((coarse - exact) / (fine - exact)) / std::log(201.0 / 51.0);
      outcome.rows.push_back({fmt::format("{}, mode {}, order of the cells", name, k + 1), 2.0,
                              order, Bound::absolute, 0.2});
    }
  }
}

}  // namespace

Outcome check_frequencies() {
  Outcome outcome{"closed form", {}, {}};
  const Beam beam = case_of("frequencies").scene.beam;
  add_closed_forms(outcome, beam);
  add_cells(outcome, beam);
  return outcome;
}

}  // namespace subimpact::validation
