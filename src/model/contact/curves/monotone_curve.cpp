#include "model/contact/curves/monotone_curve.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace subimpact {

MonotoneCurve::MonotoneCurve(std::span<const double> x, std::span<const double> y) {
  const std::size_t n = x.size();
  if (n < 2 || y.size() != n) throw std::invalid_argument("a curve has at least two points");
  std::vector<double> chords(n - 1), slopes(n);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (!(x[i + 1] > x[i]) || !(y[i + 1] > y[i])) throw std::invalid_argument("a curve rises");
    chords[i] = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
  }
  slopes.front() = chords.front();
  slopes.back() = chords.back();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double left = x[i] - x[i - 1], right = x[i + 1] - x[i];
    const double a = 2.0 * right + left, b = right + 2.0 * left;
    slopes[i] = (a + b) / (a / chords[i - 1] + b / chords[i]);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double h = x[i + 1] - x[i];
    pieces_.push_back({x[i], h, y[i], slopes[i],
                       (3.0 * chords[i] - 2.0 * slopes[i] - slopes[i + 1]) / h,
                       (slopes[i] + slopes[i + 1] - 2.0 * chords[i]) / (h * h), sum});
    sum += pieces_.back().integral_to(h);
  }
  pieces_.push_back({x[n - 1], HUGE_VAL, y[n - 1], slopes[n - 1], 0.0, 0.0, sum});
}

const MonotoneCurve::Piece& MonotoneCurve::piece_at(double x) const {
  const auto after = std::ranges::upper_bound(pieces_, x, {}, &Piece::start);
  return after == pieces_.begin() ? *after : *std::prev(after);
}

double MonotoneCurve::value(double x) const {
  const Piece& piece = piece_at(x);
  const double t = x - piece.start;
  return t < 0.0 ? piece.value + t * piece.slope : piece.at(t);
}

double MonotoneCurve::slope(double x) const {
  const Piece& piece = piece_at(x);
  return piece.slope_at(std::max(x - piece.start, 0.0));
}

double MonotoneCurve::integral(double x) const {
  const Piece& piece = piece_at(x);
  const double t = x - piece.start;
  return t < 0.0 ? t * (piece.value + 0.5 * t * piece.slope) : piece.before + piece.integral_to(t);
}

double MonotoneCurve::largest_slope() const {
  double largest = 0.0;
  for (const Piece& piece : pieces_) {
    largest = std::max(largest, piece.slope);
    const double t = piece.cube < 0.0 ? -piece.square / (3.0 * piece.cube) : 0.0;
    if (t > 0.0 && t < piece.length) largest = std::max(largest, piece.slope_at(t));
  }
  return largest;
}

}  // namespace subimpact
