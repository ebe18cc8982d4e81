#pragma once

namespace subimpact {

/// How the fibres of one half of a rectangular section are spread over zeta = 2 z/h in (0, 1]:
/// continuously, or as p equal layers whose stress is taken at mid-layer, zeta_k = (k - 1/2)/p.
///
/// Every fibre is linear elastic-perfectly plastic. All that a bending law needs of the
/// distribution are its cumulative moments S_i(zeta) = integral (or layer sum / p) of zeta^i from 0
/// to zeta: with the curvature x = kappa/kappa_y and the moment m = |M|/M_y, the virgin curve is
///
///     m(x) = 3 [x S_2(z_e) + S_1(1) - S_1(z_e)],  z_e = min(1, 1/x)
///
/// (fibres below z_e are elastic, the others carry the yield stress). Continuous fibres give the
/// exact curve, m = x up to 1 and 1.5 - 0.5/x^2 above. Layers give the slope 1 - 1/(2p)^2 and a
/// first yield at x = 2p/(2p - 1): properties of that law, not errors of this code.
class Fibres {
 public:
  struct Moments {
    double s0, s1, s2;
  };

  static Fibres continuous();
  /// `layers` over the whole thickness: even, at least 2; throws std::invalid_argument otherwise.
  static Fibres layered(int layers);

  /// S_0, S_1, S_2 up to and including zeta >= 0 (constant above 1).
  Moments up_to(double zeta) const;

  double slope() const { return slope_; }              ///< dm/dx while elastic
  double first_yield() const { return first_yield_; }  ///< x at which the first fibre yields
  double outermost() const { return outermost_; }      ///< zeta of the outermost fibre

  double moment(double x) const;   ///< virgin curve, odd in x
  double tangent(double x) const;  ///< dm/dx of the virgin curve
  double work(double x) const;     ///< integral of the virgin curve from 0 to x

  /// Elastic energy, in units of M_y kappa_y per length, of the fibres from zeta `a` to `b` whose
  /// stress is (constant + slope * zeta) Y: 3/2 the integral of its square.
  double energy(double a, double b, double constant, double slope) const;

 private:
  explicit Fibres(int half_layers);  // 0: continuous

  double half_layers_;
  Moments whole_;
  double slope_;
  double first_yield_;
  double outermost_;
};

}  // namespace subimpact
