#pragma once

#include <array>
#include <vector>

namespace continuum {

using Vector = std::vector<double>;

// Lumped masses, displacements u, velocities v (half a step behind) and forces f on the nodes, by
// direction.
struct Nodes {
  Vector mass;
  std::array<Vector, 3>
      free;  // 1 / mass; 0 where a clamp or a plane of symmetry holds the direction
  std::array<Vector, 3> u, v, f;

  explicit Nodes(std::size_t n) : mass(n, 0.0) {
    for (auto* set : {&free, &u, &v, &f})
      for (Vector& values : *set) values.assign(n, 0.0);
  }

  void release() {
    for (Vector& w : free)
      for (std::size_t n = 0; n < mass.size(); ++n) w[n] = 1.0 / mass[n];
  }

  // Central differences: v += dt f/m, u += dt v.
  void advance(double dt) {
    for (int d = 0; d < 3; ++d) {
      double* __restrict x = u[d].data(), * __restrict s = v[d].data();
      const double* __restrict g = f[d].data(), * __restrict w = free[d].data();
      for (std::size_t n = 0; n < mass.size(); ++n) {
        s[n] += dt * w[n] * g[n];
        x[n] += dt * s[n];
      }
    }
  }

  // At the time of the forces: v- v+ / 2 is what central differences of a linear system conserve.
  double kinetic_energy(double dt) const {
    double sum = 0.0;
    for (int d = 0; d < 3; ++d)
      for (std::size_t n = 0; n < mass.size(); ++n)
        sum += 0.5 * mass[n] * v[d][n] * (v[d][n] + dt * free[d][n] * f[d][n]);
    return sum;
  }

  double momentum() const {
    double sum = 0.0;
    for (std::size_t n = 0; n < mass.size(); ++n) sum += mass[n] * v[1][n];
    return sum;
  }
};

}  // namespace continuum
