#pragma once

#include <limits>
#include <span>
#include <vector>

#include "subimpact/model/scene.h"
#include "subimpact/numerics/banded_matrix.h"

namespace subimpact {

/// The tension of a beam whose ends are held along it, one number for all sections: it resists the
/// elongation e of the axis, elastically up to Y A and perfectly plastically there,
///
///     e = 1/2 integral of w'^2 dx = q^T G q/2,   N = E A (e - e_p)/l,   |N| <= Y A,
///
/// with the plastic elongation e_p, which commit() alone advances. It adds the forces -N G q, the
/// elastic energy N^2 l/(2 E A) and the plastic work Y A |de_p|; between two calls of commit() N is
/// a function of e, so that forces and energies belong together. Yield of the sections in bending
/// is not affected. Source: S. Woinowsky-Krieger, J. Appl. Mech. 17 (1950) 35, while elastic.
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
