#pragma once

#include <span>
#include <vector>

namespace subimpact {

/// A smooth curve through points that rise: cubic pieces whose slopes at the points keep it from
/// overshooting, so that it rises everywhere, with its exact integral. Beyond its ends it goes on
/// straight.
///
/// Source: F. N. Fritsch and R. E. Carlson, Monotone piecewise cubic interpolation, SIAM J. Numer.
/// Anal. 17 (1980); the slopes are weighted harmonic means of the neighbouring chords.
class MonotoneCurve {
 public:
  MonotoneCurve() = default;
  /// At least two points; `x` and `y` rise. Throws std::invalid_argument otherwise.
  MonotoneCurve(std::span<const double> x, std::span<const double> y);

  double value(double x) const;
  double slope(double x) const;
  double integral(double x) const;  ///< from the first point on
  double largest_slope() const;     ///< between the ends

 private:
  // y = value + t (slope + t (square + t cube)), t = x - start.
  struct Piece {
    double start, length;
    double value, slope, square, cube;
    double before;  // integral up to its start
    double at(double t) const { return value + t * (slope + t * (square + t * cube)); }
    double slope_at(double t) const { return slope + t * (2.0 * square + 3.0 * t * cube); }
    double integral_to(double t) const {
      return t * (value + t * (slope / 2.0 + t * (square / 3.0 + t * cube / 4.0)));
    }
  };
  const Piece& piece_at(double x) const;

  std::vector<Piece> pieces_;  // the last one is straight, and so is the line before the first
};

}  // namespace subimpact
