#pragma once

#include <string>
#include <vector>

#include "integrate/options.h"

namespace subimpact {

/// An embedded Runge-Kutta-Nystroem table for q'' = a(q): stages
///
///     q_i = q + c_i h v + h^2 sum_j a_ij k_j,   k_i = a(q_i),
///     q' = q + h v + h^2 sum position_i k_i,    v' = v + h sum velocity_i k_i,
///
/// and differences to the embedded method (order `embedded_order`) for the error estimate.
struct NystromTable : CoefficientTable {
  std::vector<double> c;
  std::vector<std::vector<double>> a;  ///< a[i] has i entries
  std::vector<double> position, velocity;
  std::vector<double> position_error, velocity_error;

  std::size_t n_stages() const { return c.size(); }
  /// Whether the last stage is the acceleration at the step's end, and so the next step's first.
  bool first_same_as_last() const;
};

/// All tables; the first is the default.
const std::vector<NystromTable>& nystrom_tables();

/// The first for an empty name. Throws std::invalid_argument for an unknown one.
const NystromTable& nystrom_table(const std::string& name);

}  // namespace subimpact
