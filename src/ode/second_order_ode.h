#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace subimpact {

/// Positions and velocities in one array, [q, v], both of n entries.
using State = std::vector<double>;

/// q'' = a(q), autonomous: all that an explicit integrator needs. Between two events, and with the
/// memory of the laws frozen, the acceleration depends on positions alone.
class SecondOrderOde {
 public:
  virtual ~SecondOrderOde() = default;

  /// n, the number of positions.
  virtual std::size_t n_positions() const = 0;
  /// a(q) for q of n entries; changes no history.
  virtual void acceleration(std::span<const double> positions, std::span<double> result) = 0;
  /// Typical sizes of a position and of a velocity in this problem, from which absolute tolerances
  /// are derived.
  struct Scales {
    double position, velocity;
  };
  virtual Scales scales() const = 0;
};

/// Which entries of a square sparse matrix exist, column by column: column j has the rows
/// rows[column_starts[j]] to rows[column_starts[j + 1] - 1], ascending.
struct SparsityPattern {
  std::vector<std::size_t> column_starts{0};
  std::vector<std::size_t> rows;

  std::size_t size() const { return column_starts.size() - 1; }
  std::size_t n_entries() const { return rows.size(); }
};

/// Mass q'' = f(q): what implicit integrators need besides the acceleration. Mass and the tangent
/// stiffness K = -df/dq share one pattern, which never changes; their entries are arrays in the
/// order of that pattern.
class MechanicalSystem : public SecondOrderOde {
 public:
  /// f is the sum of a stiff part, which only implicit methods can take with long steps, and the
  /// rest.
  enum class Part { all, stiff, rest };

  /// f(q), or one part of it; changes no history.
  virtual void force(std::span<const double> positions, Part part, std::span<double> result) = 0;
  virtual const SparsityPattern& pattern() const = 0;
  virtual void mass_entries(std::span<double> values) const = 0;
  /// -d(part of f)/dq at q.
  virtual void stiffness_entries(std::span<const double> positions, Part part,
                                 std::span<double> values) = 0;
};

}  // namespace subimpact
