#pragma once

#include <cstddef>
#include <vector>

#include "subimpact/model/scene.h"

namespace subimpact::benchmarks {

struct NaiveOptions {
  std::size_t n_cells = 501;
  std::size_t n_layers = 40;
  double step = 1e-7;      ///< s
  double end_time = 2e-3;  ///< s
  /// Loops over the layers outside and the cells inside, which the compiler vectorises whole.
  bool layers_outside = false;
};

/// From the instant contact begins to the instant its force returns to zero, s; an end of zero:
/// still in contact.
struct NaiveSubImpact {
  double start = 0.0;
  double end = 0.0;
};

/// The central-difference scheme as one would write it down from its equations, in one plain loop
/// that shares no code with the library: every cell of the whole beam, the return map in every
/// layer of every cell at every step, the tridiagonal mass matrix by the Thomas algorithm (factored
/// once), the contact law on the step's own indentation. Event times are interpolated in the step
/// by the cubic through indentation and its rate. Nothing is recorded but the sub-impacts.
std::vector<NaiveSubImpact> naive_central_difference(const Scene& scene,
                                                     const NaiveOptions& options);

}  // namespace subimpact::benchmarks
