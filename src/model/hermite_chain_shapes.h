#pragma once

#include <cstddef>
#include <vector>

#include "model/hermite_chain_waves.h"
#include "model/hermite_modes.h"

namespace subimpact::chain {

/// W and Theta at the distances m, m - 1, ... from the middle.
struct Columns {
  std::vector<double> w, slope;  ///< of whole groups of lanes

  explicit Columns(std::size_t n) : w((n + n_lanes - 1) / n_lanes * n_lanes), slope(w.size()) {}
};

/// Writes shapes of modes and rigid motion: computed for the nodes on one side of the middle, which
/// the other side mirrors.
class Shapes {
 public:
  /// `about_last` or `about_first`: the last or first end, pinned, is the middle of odd modes.
  Shapes(const HermiteChain& chain, bool about_last, bool about_first);

  /// Elements from the middle to the ends.
  double m() const;
  std::size_t n_unknowns() const;

  /// n_unknowns numbers.
  void write(const Mode& mode, double* shape);
  void write_rigid(Parity parity, double* shape);

 private:
  void write(Parity parity, double* shape);

  std::size_t n_nodes_;
  bool one_sided_, backwards_;
  std::size_t first_, last_;  // unknowns held at the ends
  bool half_;
  std::size_t n_inwards_;
  Columns inwards_;
  double largest_decay_;
  std::vector<double> nodal_;
};

}  // namespace subimpact::chain
