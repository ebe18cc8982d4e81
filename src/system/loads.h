#pragma once

#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "subimpact/model/mesh/beam_mesh.h"
#include "subimpact/model/scene.h"
#include "subimpact/numerics/banded_matrix.h"

namespace subimpact {

/// The loads f on a beam that do not depend on its motion, as generalised forces of a mesh, N
/// (docs/theory/beam.md, "Scenes"). Between two corners of the tables f is linear in t; it is
/// continued linearly beyond the piece in force, and begin_piece() goes on to the next one.
class Loads {
 public:
  Loads() = default;
  /// Throws std::invalid_argument for a mesh without displacements where a force acts.
  Loads(const BeamMesh& mesh, const Beam& beam, double gravity);

  bool is_empty() const { return value_.empty(); }
  /// Whether f changes within the piece in force.
  bool varies() const { return varies_; }
  /// Whether f changes after the piece in force.
  bool will_change() const {
    return varies_ || next_corner_ < std::numeric_limits<double>::infinity();
  }
  /// g, m/s2.
  double gravity() const { return gravity_; }
  /// Chooses the piece that holds from t on.
  void begin_piece(double t);
  /// The end of the piece in force, s; infinite for the last.
  double next_corner() const { return next_corner_; }

  std::span<const double> value() const { return value_; }  ///< f at start(), N
  std::span<const double> rate() const { return rate_; }    ///< df/dt, N/s
  double start() const { return start_; }                   ///< of the piece in force, s
  /// forces += f(t).
  void add_to(std::span<double> forces, double t) const;
  /// f(t) times q, J.
  double potential(std::span<const double> unknowns, double t) const;
  /// (df/dt) times q, W.
  double power_of_change(std::span<const double> unknowns) const;

  /// Force (N) and moment about x = 0 (N m) of all loads.
  struct Resultant {
    double force = 0.0, moment = 0.0;
  };
  Resultant resultant(double t) const;
  /// Integral of the force from 0 to t, N s; t within the piece in force.
  double impulse(double t) const;

 private:
  struct Point {
    double x;                        // m
    std::vector<double> functional;  // S, of every unknown
    std::vector<std::pair<double, double>> table;
    std::size_t next = 0;            // of the table, the first entry after the piece's start
    double value = 0.0, rate = 0.0;  // at the piece's start
  };

  double gravity_ = 0.0;
  double uniform_force_ = 0.0, length_ = 0.0;
  std::vector<double> uniform_;
  std::vector<Point> points_;
  std::vector<double> value_, rate_;
  bool varies_ = false;
  double start_ = 0.0, next_corner_ = std::numeric_limits<double>::infinity();
  double impulse_before_ = 0.0;  // the piece
};

/// The tension N of a beam whose ends are held along it (docs/theory/beam.md, "Ends held along the
/// beam"): it resists the elongation q^T G q/2 of the axis, elastically up to Y A and perfectly
/// plastically there. commit() alone advances the plastic elongation e_p; between two calls N is a
/// function of q, so that forces and energies belong together.
class Tension {
 public:
  /// `form`: G, 1/m. `limit`: Y A, N; infinite where the beam does not yield.
  Tension(BandedMatrix form, const Beam& beam, double limit);

  const BandedMatrix& form() const { return form_; }
  double limit() const { return limit_; }  ///< Y A, N
  /// N, in N.
  double at(std::span<const double> unknowns) const {
    return response(form_.quadratic_form(unknowns)).tension;
  }
  /// forces -= N G q, or its rate of change.
  void add_to(std::span<double> forces, std::span<const double> unknowns) const;
  void add_rate_to(std::span<double> forces, std::span<const double> unknowns,
                   std::span<const double> velocities) const;

  struct Energies {
    double elastic, plastic;  ///< J
  };
  Energies energies(std::span<const double> unknowns) const;

  void commit(std::span<const double> unknowns);

 private:
  // To q^T G q: N, the change of e_p (m) and its work (J).
  struct Response {
    double tension, flow, work;
  };
  Response response(double square) const;

  BandedMatrix form_;
  double stiffness_;  // E A/l, N/m
  double limit_;
  double plastic_ = 0.0, work_ = 0.0;    // e_p, m; plastic work, J
  mutable std::vector<double> product_;  // G q
};

}  // namespace subimpact
