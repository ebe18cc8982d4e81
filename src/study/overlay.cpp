#include "subimpact/study/overlay.h"

#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include "numerics/median.h"
#include "subimpact/simulate/error.h"

namespace subimpact {
namespace {

using Complex = std::complex<double>;

/// A signal read at times that never decrease; zero before its first sample, its last one after it.
class Reader {
 public:
  explicit Reader(const Signal& signal) : signal_(signal) {}
  double at(double time) {
    const auto& [t, f] = signal_;
    while (next_ < t.size() && t[next_] <= time) ++next_;
    if (next_ == 0) return 0.0;
    if (next_ == t.size()) return f.back();
    return std::lerp(f[next_ - 1], f[next_], (time - t[next_ - 1]) / (t[next_] - t[next_ - 1]));
  }

 private:
  const Signal& signal_;
  std::size_t next_ = 0;
};

// Calls use(t0, f0, t1, f1) with the linear pieces of a signal within [from, to].
template <class Use>
void for_each_piece(const Signal& signal, double from, double to, Use use) {
  const auto& t = signal.times;
  Reader reader(signal);
  double t0 = from, f0 = reader.at(from);
  for (auto next = std::ranges::upper_bound(t, from); next != t.end() && *next < to; ++next) {
    const double f1 = signal.forces[static_cast<std::size_t>(next - t.begin())];
    use(t0, f0, *next, f1);
    t0 = *next;
    f0 = f1;
  }
  use(t0, f0, to, reader.at(to));
}

Overlay::Side side_of(Signal force, double from, double to) {
  Overlay::Side side{.force = std::move(force)};
  for_each_piece(side.force, from, to, [&](double t0, double f0, double t1, double f1) {
    side.impulse += 0.5 * (t1 - t0) * (f0 + f1);
    if (f0 > side.peak) std::tie(side.peak, side.peak_time) = std::pair(f0, t0);
  });
  return side;
}

/// Means over equal bins from the first sample on.
std::vector<double> binned(const Signal& signal, double width) {
  const double begin = signal.times.front(), end = signal.times.back();
  std::vector<double> bins;
  for (double t = begin; t + width <= end; t = begin + width * static_cast<double>(bins.size())) {
    double integral = 0.0;
    for_each_piece(signal, t, t + width, [&](double t0, double f0, double t1, double f1) {
      integral += 0.5 * (t1 - t0) * (f0 + f1);
    });
    bins.push_back(integral / width);
  }
  return bins;
}

/// Searches for the shift, and the cut-off, at which a measured force resembles a computed one
/// most.
class Search {
 public:
  Search(const Signal& computed, const Signal& measured) : raw_(computed), measured_(measured) {
    std::vector<double> intervals;
    for (std::size_t i = 1; i < measured.times.size(); ++i) {
      intervals.push_back(measured.times[i] - measured.times[i - 1]);
    }
    interval_ = median(intervals);
    const double record = measured.times.back() - measured.times.front();
    width_ = std::max({interval_, duration() / 2048, record / 200'000});
    measured_bins_ = binned(measured, width_);
  }

  double interval() const { return interval_; }
  double duration() const { return raw_.times.back() - raw_.times.front(); }
  Signal filtered(std::optional<double> cutoff) const {
    return cutoff ? low_passed(raw_, *cutoff) : raw_;
  }

  /// How many measured samples lie before the end of the run.
  std::size_t n_before_end(double shift) const {
    return static_cast<std::size_t>(
        std::ranges::upper_bound(measured_.times, raw_.times.back() + shift) -
        measured_.times.begin());
  }

  /// Correlation of the first n samples, from a time of the run on. Near a maximum n must not
  /// change: one more sample changes the correlation more than a small shift does.
  double correlation(const Signal& computed, double shift, std::size_t n,
                     double from = -std::numeric_limits<double>::infinity()) const {
    double products = 0.0, squares = 0.0, measured_squares = 0.0;
    Reader reader(computed);
    for (std::size_t i = 0; i < n; ++i) {
      const double time = measured_.times[i] - shift, force = measured_.forces[i];
      if (time < from) continue;
      const double other = reader.at(time);
      products += force * other;
      squares += other * other;
      measured_squares += force * force;
    }
    return squares > 0.0 && measured_squares > 0.0
               ? products / std::sqrt(squares * measured_squares)
               : -1.0;
  }

  /// Over all shifts: by bins, then by samples.
  double shift_of(const Signal& computed) const {
    const std::vector<double> bins = binned(computed, width_);
    const auto n = static_cast<std::ptrdiff_t>(bins.size());
    const auto n_measured = static_cast<std::ptrdiff_t>(measured_bins_.size());
    double best = -1.0;
    std::ptrdiff_t best_lag = 0;
    for (std::ptrdiff_t lag = 1 - n; lag < n_measured; ++lag) {
      double products = 0.0;
      for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(0, -lag); i < std::min(n, n_measured - lag);
           ++i) {
        products +=
            bins[static_cast<std::size_t>(i)] * measured_bins_[static_cast<std::size_t>(i + lag)];
      }
      if (products > best) std::tie(best, best_lag) = std::pair(products, lag);
    }
    const double shift =
        measured_.times.front() - computed.times.front() + width_ * static_cast<double>(best_lag);
    return shift_near(computed, shift, 1.5 * width_, n_before_end(shift - 1.5 * width_));
  }

  double shift_near(const Signal& computed, double shift, double half, std::size_t n) const {
    return argmax_near([&](double s) { return correlation(computed, s, n); }, shift, half,
                       1e-4 * interval_);
  }

  /// The logarithm of the cut-off with the largest correlation, each at its own best shift or at
  /// the one given; its bounds.
  struct Cutoff {
    double log_cutoff, from, to;
  };
  Cutoff find_cutoff(const std::optional<double>& given_shift) const {
    const double record = std::min(duration(), measured_.times.back() - measured_.times.front());
    const double from = std::log(2.0 / record), to = std::log(0.5 / interval_);
    double best = -1.0, found = to, shift = 0.0;
    constexpr double step = std::numbers::ln2 / 3.0;
    for (double x = to; x >= from; x -= step) {
      const Signal computed = filtered(std::exp(x));
      const double s = given_shift ? *given_shift : shift_of(computed);
      const double r = correlation(computed, s, n_before_end(s));
      if (r > best) std::tie(best, found, shift) = std::tuple(r, x, s);
    }
    const std::size_t n = n_before_end(shift - 8.0 * interval_);
    const auto at = [&](double x) {
      const Signal computed = filtered(std::exp(std::clamp(x, from, to)));
      const double delay = 0.42 * (std::exp(-x) - std::exp(-found));  // of a low frequency
      const double s = given_shift.value_or(shift - delay);
      return correlation(computed, given_shift ? s : shift_near(computed, s, 4.0 * interval_, n),
                         n);
    };
    return {std::clamp(argmax_near(at, found, step, 1e-4), from, to), from, to};
  }

  /// Standard errors of shift and of the logarithm of the cut-off by linear least squares together
  /// with a factor of the force; a given value has no error.
  void add_errors(Overlay& overlay, bool has_found_shift, bool has_found_cutoff) const {
    const double s = overlay.shift.value, ds = 0.5 * interval_, dx = 1e-3;
    const Signal& computed = overlay.computed.force;
    const double cutoff = has_found_cutoff ? overlay.low_pass->value : 0.0;
    const Signal lower = has_found_cutoff ? filtered(cutoff * std::exp(-dx)) : Signal{};
    const Signal upper = has_found_cutoff ? filtered(cutoff * std::exp(dx)) : Signal{};
    Reader here(computed), before(computed), after(computed), below(lower), above(upper);
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    double products = 0.0, measured_squares = 0.0;
    const std::size_t n = n_before_end(s + ds);
    for (std::size_t i = 0; i < n; ++i) {
      const double t = measured_.times[i] - s, force = measured_.forces[i];
      const Eigen::Vector3d row(
          here.at(t), has_found_shift ? (after.at(t + ds) - before.at(t - ds)) / (2.0 * ds) : 0.0,
          has_found_cutoff ? (above.at(t) - below.at(t)) / (2.0 * dx) : 0.0);
      normal += row * row.transpose();
      products += force * row[0];
      measured_squares += force * force;
    }
    const double variance =
        (measured_squares - products * products / normal(0, 0)) / static_cast<double>(n);
    if (!has_found_shift) normal(1, 1) = 1.0;
    if (!has_found_cutoff) normal(2, 2) = 1.0;
    const Eigen::Vector3d scale = normal.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::Matrix3d scaled = scale.asDiagonal() * normal * scale.asDiagonal();
    const Eigen::Vector3d covariance =
        scaled.inverse().diagonal().cwiseProduct(scale).cwiseProduct(scale);
    if (has_found_shift) overlay.shift.error = std::sqrt(variance * covariance[1]);
    if (has_found_cutoff) overlay.low_pass->error = cutoff * std::sqrt(variance * covariance[2]);
  }

 private:
  // The largest value near x, by grids ever finer about the best point.
  template <class F>
  static double argmax_near(F f, double x, double half, double smallest) {
    constexpr int n = 8;
    for (; half > smallest; half *= 2.0 / n) {
      const double centre = x;
      double best = -1.0;
      for (int k = -n / 2; k <= n / 2; ++k) {
        const double at = centre + half * k / (0.5 * n);
        const double value = f(at);
        if (value > best) std::tie(best, x) = std::pair(value, at);
      }
    }
    return x;
  }

  const Signal& raw_;
  const Signal& measured_;
  double interval_ = 0.0, width_ = 0.0;
  std::vector<double> measured_bins_;
};

void refuse_flat(const Signal& signal, const char* whose, const char* remedy) {
  const auto [low, high] = std::ranges::minmax(signal.forces);
  if (high > 0.0 && high >= -low) return;
  throw ResultsError(
      fmt::format("the {} force lies between {:.4g} and {:.4g} N; {}", whose, low, high, remedy));
}

}  // namespace

Signal low_passed(const Signal& force, double cutoff) {
  const double omega = 2.0 * std::numbers::pi * cutoff;
  // One pole of each of the two pairs; the others add the conjugate.
  constexpr int n_poles = 4;
  Complex poles[n_poles];
  for (int k = 0; k < n_poles; ++k) {
    poles[k] = std::polar(omega, std::numbers::pi * (5 + 2 * k) / 8.0);
  }
  Signal result{force.times, std::vector<double>(force.times.size(), 0.0)};
  for (const int k : {0, 1}) {
    const Complex p = poles[k];
    Complex residue = -p;
    for (int j = 0; j < n_poles; ++j) {
      if (j != k) residue *= poles[j] / (poles[j] - p);
    }
    Complex state = 0.0;
    for (std::size_t i = 1; i < force.times.size(); ++i) {
      const double h = force.times[i] - force.times[i - 1];
      if (h > 0.0) {
        const Complex growth = std::exp(p * h), phi = (growth - 1.0) / p;
        const double slope = (force.forces[i] - force.forces[i - 1]) / h;
        state = growth * state + force.forces[i - 1] * phi + slope * (phi - h) / p;
      }
      result.forces[i] += 2.0 * (residue * state).real();
    }
  }
  return result;
}

Overlay overlay_of(const std::vector<HistoryRow>& history, const Signal& measured,
                   const OverlayOptions& options) {
  Signal computed;
  for (const HistoryRow& row : history) {
    computed.times.push_back(row.time);
    computed.forces.push_back(row.force);
  }
  if (history.size() < 2) {
    throw ResultsError("the run kept no history; run it again with output.interval above 0");
  }
  refuse_flat(computed, "computed",
              "a run without contact has no force to compare with a measurement");
  refuse_flat(measured, "measured",
              "contact pushes, and its force is positive here: change the sign of the column");
  const Search search(computed, measured);
  Overlay overlay;
  overlay.sampling_interval = search.interval();
  if (options.find_low_pass) {
    const Search::Cutoff cutoff = search.find_cutoff(options.shift);
    overlay.low_pass = Fitted{std::exp(cutoff.log_cutoff), {}};
    overlay.low_pass_at_bound =
        std::min(cutoff.log_cutoff - cutoff.from, cutoff.to - cutoff.log_cutoff) < 1e-2;
  } else if (options.low_pass) {
    overlay.low_pass = Fitted{*options.low_pass, {}};
  }
  Signal filtered =
      search.filtered(overlay.low_pass ? std::optional(overlay.low_pass->value) : std::nullopt);
  const double shift = options.shift ? *options.shift : search.shift_of(filtered);
  overlay.shift.value = shift;
  overlay.correlation =
      search.correlation(filtered, shift, search.n_before_end(shift), computed.times.front());
  overlay.from = std::max(measured.times.front() - shift, computed.times.front());
  overlay.to = std::min(measured.times.back() - shift, computed.times.back());
  if (!(overlay.from < overlay.to)) {
    throw ResultsError(fmt::format(
        "with a shift of {:.6g} s the measurement, from {:.6g} to {:.6g} s, and the run, from 0 to "
        "{:.6g} s, have no time in common; leave the shift out, or change it",
        shift, measured.times.front(), measured.times.back(), computed.times.back()));
  }
  Signal aligned = measured;
  for (double& time : aligned.times) time -= shift;
  Reader reader(filtered);
  for (std::size_t i = 0; i < aligned.times.size(); ++i) {
    const double time = aligned.times[i];
    if (time < overlay.from || time > overlay.to) continue;
    overlay.difference.times.push_back(time);
    overlay.difference.forces.push_back(reader.at(time) - aligned.forces[i]);
  }
  overlay.computed = side_of(std::move(filtered), overlay.from, overlay.to);
  overlay.measured = side_of(std::move(aligned), overlay.from, overlay.to);
  if (overlay.correlation > 0.0) {
    search.add_errors(overlay, !options.shift, options.find_low_pass);
  }
  return overlay;
}

}  // namespace subimpact
