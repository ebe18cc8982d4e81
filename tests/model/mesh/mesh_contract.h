#pragma once

#include "dense.h"
#include "model/mesh/modes.h"
#include "numerics/mass_solver.h"
#include "order_table.h"
#include "paper_scene.h"

namespace subimpact {

inline Beam shearing_beam(Ends ends = free_ends) {
  Beam beam = paper_beam(BeamTheory::timoshenko, ends);
  beam.poisson = 0.33;
  beam.shear_coefficient = 5.0 / 6.0;
  return beam;
}

inline std::size_t n_rigid_modes(const Beam& beam) {
  const auto has = [&](EndSupport end) { return beam.ends[0] == end || beam.ends[1] == end; };
  return beam.is_free() ? 2 : has(free_end) && has(pinned) ? 1 : 0;
}

inline std::vector<OrderTable> tables_of_modes(std::size_t n_modes) {
  std::vector<OrderTable> tables;
  for (std::size_t mode = 1; mode <= n_modes; ++mode) {
    tables.emplace_back("mode " + std::to_string(mode) + ": relative error of the frequency");
  }
  return tables;
}

/// The lowest natural frequencies of a mesh of n parts, found(n), tend to the beam's at an order
/// within a band.
template <class Found>
void expect_order_of_frequencies(const Beam& beam, std::size_t n_modes,
                                 std::span<const std::size_t> sizes, const Found& found, double low,
                                 double high) {
  const std::vector<double> exact = flexural_frequencies(beam, n_modes);
  std::vector<OrderTable> tables = tables_of_modes(n_modes);
  for (const std::size_t n : sizes) {
    const std::vector<double> all = found(n);
    for (std::size_t mode = 0; mode < n_modes; ++mode) {
      const double frequency = all[mode + n_rigid_modes(beam)];
      tables[mode].add(static_cast<double>(n), std::abs(frequency / exact[mode] - 1.0));
    }
  }
  for (const OrderTable& table : tables) table.expect_every_order_within(low, high);
}

inline double dot(std::span<const double> a, std::span<const double> b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// What every mesh promises: bending forces are the exact transpose of curvatures; the stencil of a
/// section is its row of curvatures, to `rounding` of the sum of its terms' sizes; internal forces
/// are those of bending and shear, which have the energy of shear; nothing beside the unknowns is
/// read; a translation neither bends nor shears, and has the mass and momentum of the beam; the
/// struck point takes force as it gives displacement; sections stand in order; the band of the mass
/// can be solved with.
inline void expect_mesh_contract(const BeamMesh& mesh, double rounding = 1e-13) {
  SCOPED_TRACE(mesh.description());
  const std::size_t n = mesh.n_unknowns();
  const std::span<const double> translation = mesh.translation();
  for (unsigned seed = 0; seed < 10; ++seed) {
    constexpr std::size_t beside = 16;
    std::vector<double> surrounded(n + 2 * beside, NAN);
    const std::span<double> w{surrounded.data() + beside, n};
    std::ranges::copy(random_numbers(seed, n), w.begin());
    const std::vector<double> moments = random_numbers(seed + 50, mesh.n_sections());
    std::vector<double> kappa(mesh.n_sections()), forces(n, 7.0);
    mesh.curvatures(w, kappa);
    mesh.bending_forces(moments, forces);
    double internal = 0.0, size = 0.0, force_size = 0.0;
    for (std::size_t i = 0; i < kappa.size(); ++i) {
      const double work = mesh.section_weights()[i] * moments[i] * kappa[i];
      internal += work;
      size += std::abs(work);
    }
    EXPECT_NEAR(internal + dot(forces, w), 0.0, 1e-13 * size);
    for (const double f : forces) force_size += std::abs(f);
    if (!translation.empty()) {
      EXPECT_NEAR(dot(forces, translation), 0.0, 1e-14 * force_size);
    }
    std::vector<double> shear(n, 0.0), by_matrix(n, 0.0);
    mesh.add_shear_forces(w, shear);
    mesh.BeamMesh::add_shear_forces(w, by_matrix);
    expect_near(shear, by_matrix, 1e-13 * std::sqrt(dot(by_matrix, by_matrix)));
    EXPECT_NEAR(mesh.shear_energy(w), -0.5 * dot(shear, w), 1e-12 * mesh.shear_energy(w));
    std::vector<double> tiny(w.begin(), w.end()), both(n, 7.0), added = forces;
    for (double& x : tiny) x *= 1e-8;  // for forces of either kind that are about alike
    mesh.internal_forces(tiny, moments, both);
    mesh.add_shear_forces(tiny, added);
    expect_near(both, added, 1e-13 * largest_of(added));
    if (seed > 0) continue;
    for (std::size_t i = 0; i < kappa.size(); ++i) {
      const BeamMesh::SectionStencil row = mesh.section_stencil(i);
      double sum = 0.0, terms = 0.0;
      for (std::size_t j = 0; j < row.coefficients.size(); ++j) {
        sum += row.coefficients[j] * w[row.first + j];
        terms += std::abs(row.coefficients[j] * w[row.first + j]);
      }
      EXPECT_NEAR(kappa[i], sum, rounding * terms) << "section " << i;
      EXPECT_NEAR(kappa[i], mesh.curvature(i, w), rounding * terms) << "section " << i;
    }
    EXPECT_TRUE(std::ranges::is_sorted(mesh.section_positions(), std::ranges::less_equal()));
    std::fill(forces.begin(), forces.end(), 0.0);
    mesh.struck_point().add_to(forces, 5.0);
    EXPECT_NEAR(dot(forces, w), 5.0 * mesh.struck_point()(w), 1e-14);
    std::vector<double> solved = times(mesh.mass(), w);
    BandedSolver(mesh.mass()).solve(solved);
    expect_near(solved, w, 1e-10);
    if (translation.empty()) continue;
    EXPECT_NEAR(dot(forces, translation), 5.0, 1e-14);
    EXPECT_EQ(largest_of(curvatures_of(mesh, translation)), 0.0);
    EXPECT_NEAR(mesh.shear_energy(translation), 0.0, 1e-18);
    expect_near(times(mesh.mass(), translation), mesh.momentum_functional(), 1e-14);
    EXPECT_NEAR(dot(mesh.momentum_functional(), translation), mesh.beam_mass(), 1e-13);
  }
}

/// Natural modes are orthonormal in the mass matrix, Phi^T Mass Phi = I, and satisfy the equations
/// of motion, K phi = omega^2 Mass phi, to `rounding` of the size of the highest mode's terms.
inline void expect_modes(const BeamMesh& mesh, double stiffness, double rounding,
                         double orthogonality = 1e-12) {
  const NaturalModes modes = mesh.natural_modes(stiffness);
  std::vector<double> kappa(mesh.n_sections()), force(modes.size()), inertia(modes.size());
  const double highest = modes.frequencies.back() * modes.frequencies.back();
  for (std::size_t k = 0; k < modes.size(); ++k) {
    mesh.mass().multiply(modes.shape(k), inertia);
    for (std::size_t j = 0; j <= k; ++j) {
      EXPECT_NEAR(dot(inertia, modes.shape(j)), j == k ? 1.0 : 0.0, orthogonality)
          << j << ", " << k;
    }
    mesh.curvatures(modes.shape(k), kappa);
    for (double& x : kappa) x *= stiffness;
    mesh.internal_forces(modes.shape(k), kappa, force);
    const double w2 = modes.frequencies[k] * modes.frequencies[k];
    double residual = 0.0, size = 0.0;
    for (std::size_t i = 0; i < modes.size(); ++i) {
      residual = std::max(residual, std::abs(force[i] + w2 * inertia[i]));
      size = std::max(size, std::abs(inertia[i]));
    }
    EXPECT_LT(residual, rounding * highest * size) << k;
  }
}

}  // namespace subimpact
