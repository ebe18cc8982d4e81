#include "model/mesh/modes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "model/mesh/hermite/hermite_chain.h"
#include "numerics/bracketed_root.h"
#include "numerics/lanes.h"

namespace subimpact {
namespace {

using namespace chain;
using std::numbers::pi;

double square_of_half(double number, Band band) {
  const double half = band == Band::above ? std::sinh(0.5 * number) : std::sin(0.5 * number);
  return band == Band::above ? -2.0 * half * half : 2.0 * half * half;
}

// Finds the modes of one parity of a chain with equal ends, m elements from its middle.
class Finder {
 public:
  Finder(const Element& element, EndSupport end, double m)
      : element_(element), end_(end), m_(m), felt_(largest_decay_felt(m)) {}

  // False if there is a mode that could not be found.
  bool add_modes(Parity parity, std::vector<Mode>& modes) const {
    for (const Band band : {Band::acoustic, Band::optical}) {
      if (end_ == EndSupport::pinned) {
        add_pinned(parity, band, modes);
      } else {
        add_phases(parity, band, modes);
      }
    }
    if (end_ != EndSupport::free) return true;
    return add_highest(parity, modes);
  }

 private:
  Waves waves(double number, Band band) const {
    return waves_at<One>(square_of_half(number, band), band, element_, end_ == EndSupport::clamped);
  }
  double decay_over(const Waves& waves) const {
    return waves.decay > felt_ ? 1.0 : std::tanh(phi_of(waves) * m_);
  }

  void add_pinned(Parity parity, Band band, std::vector<Mode>& modes) const {
    const double least = parity == Parity::even ? 0.5 : band == Band::acoustic ? 1.0 : 0.0;
    for (double number = least; number <= m_; number += 1.0) {
      if (band == Band::acoustic && number == m_) break;
      const double theta = pi * (number / m_);
      modes.push_back({band, parity, theta, waves(theta, band), 0.0});
    }
  }

  Lanes decay_over(const WavesOf<Eight>& waves) const {
    Lanes decay = Lanes{} + 1.0;
    if (!any(waves.decay <= felt_)) return decay;
    for (std::size_t i = 0; i < n_lanes; ++i) decay[i] = decay_over(waves[i]);
    return decay;
  }

  // The waves of eight theta, and sine and cosine of theta m.
  struct Trial {
    WavesOf<Eight> waves;
    SinCos turn;
  };
  Trial trial_at(const Lanes& theta, Band band) const {
    const Lanes half = sin_cos(0.5 * theta).sine;
    return {waves_at<Eight>(2.0 * half * half, band, element_, end_ == EndSupport::clamped),
            sin_cos(theta * m_)};
  }
  // Sine of theta m - k pi - phase, `sign` that of cos(k pi).
  Lanes sine_of_error(const Trial& at, const Lanes& sign, Parity parity) const {
    const bool even = parity == Parity::even;
    const Lanes decay = decay_over(at.waves);
    const Lanes rise = even ? decay * at.waves.rise() : -decay * at.waves.run();
    const Lanes run = even ? at.waves.run() : at.waves.rise();
    const Lanes sine =
        sign * (at.turn.sine * run - at.turn.cosine * rise) / sqrt_of(rise * rise + run * run);
    return run < 0.0 ? -sine : sine;
  }

  // Eight roots at a time: secants from a guess, halving where they leave the bracket.
  void add_phases(Parity parity, Band band, std::vector<Mode>& modes) const {
    const bool below = (parity == Parity::even) == (band == Band::acoustic);  // k pi
    const double last = below ? std::floor(m_) : std::ceil(m_) - 1.0;
    // Earlier roots give estimates of the next one and of the slope of the phase there.
    double phase_before = below ? -0.25 * pi : 0.25 * pi;
    double change = 0.0;
    for (double first = 1.0; first <= last; first += static_cast<double>(n_lanes)) {
      Lanes k{};
      Lanes sign{};
      Lanes x{};
      for (std::size_t i = 0; i < n_lanes; ++i) {
        const auto ahead = static_cast<double>(i);
        k[i] = std::min(first + ahead, last);
        sign[i] = std::fmod(k[i], 2.0) == 0.0 ? 1.0 : -1.0;
        x[i] = (k[i] * pi + phase_before + change * (ahead + 1.0)) / m_;
      }
      Lanes low = (below ? k - 0.5 : k) * (pi / m_);
      Lanes high = low + 0.5 * pi / m_;
      high = high > pi ? Lanes{} + pi : high;
      x = ((x > low) & (x < high)) ? x : 0.5 * (low + high);
      Lanes slope = Lanes{} + m_ * pi / (pi + change);
      Lanes before{};
      Lanes value_before{};
      LaneMask open = k > 0.0;
      for (int i = 0; i < 200 && any(open); ++i) {
        const Lanes value = sine_of_error(trial_at(x, band), sign, parity);
        low = value < 0.0 ? x : low;
        high = value < 0.0 ? high : x;
        const Lanes secant = (value - value_before) / (x - before);
        if (i > 0) slope = (open & (secant > 0.0)) ? secant : slope;
        before = x;
        value_before = value;
        const Lanes next = x - value / slope;
        const LaneMask inside = (next > low) & (next < high);
        const Lanes step = next < x ? x - next : next - x;
        x = open ? (inside ? next : 0.5 * (low + high)) : x;
        // A secant's error is the product of the last two.
        open &= ~((inside & (step <= 1e-12 * x)) | (high - low <= 4e-16 * x));
      }
      const Trial found = trial_at(x, band);
      const auto count = std::min(n_lanes, static_cast<std::size_t>(last - first) + 1);
      for (std::size_t i = 0; i < count; ++i) {
        add(parity, band, x[i], found.waves[i], found.turn.sine[i], found.turn.cosine[i], modes);
      }
      phase_before = x[count - 1] * m_ - k[count - 1] * pi;
      if (count > 1) change = (x[count - 1] - x[count - 2]) * m_ - pi;
    }
  }

  // The extra mode of a free end: in the optical band if even and long enough, else above.
  bool add_highest(Parity parity, std::vector<Mode>& modes) const {
    const double least = 1e-6 / m_;
    const auto in_band = [&](double theta) {
      const Waves at = waves(theta, Band::optical);
      return theta * m_ - std::atan(decay_over(at) * at.ratio());
    };
    if (parity == Parity::even && in_band(least) < 0.0) {
      const double theta = root_in(in_band, least, 0.5 * pi / m_);
      add(parity, Band::optical, theta, waves(theta, Band::optical), std::sin(theta * m_),
          std::cos(theta * m_), modes);
      return true;
    }
    const auto above = [&](double psi) {
      const Waves at = waves(psi, Band::above);
      const double first = std::tanh(psi * m_);
      const double second = decay_over(at);
      return parity == Parity::even ? second * at.ratio() - first : first * at.ratio() - second;
    };
    double low = least;
    double high = 0.01;
    if (!(above(low) < 0.0)) return false;
    while (!(above(high) > 0.0)) {
      low = high;
      high *= 1.5;
      if (high > 20.0) return false;
    }
    const double psi = root_in(above, low, high);
    add(parity, Band::above, psi, waves(psi, Band::above), std::tanh(psi * m_), 1.0, modes);
    return true;
  }

  // `sine` and `cosine` are those of theta m; above the bands tanh(psi m) and 1.
  void add(Parity parity, Band band, double number, const Waves& at, double sine, double cosine,
           std::vector<Mode>& modes) const {
    const double decay = decay_over(at);
    const bool above = band == Band::above;
    const bool even = parity == Parity::even;
    // Uses the one of an end's two conditions in which the second wave has the larger weight.
    double second = 0.0;
    if (std::abs(at.ratio()) > 1.0) {
      const double share = at.first.with_sin / at.second.with_sin;
      second = even ? -share * sine / decay : (above ? -share : share * cosine);
    } else {
      const double share = at.first.with_cos / at.second.with_cos;
      second = even ? -share * cosine : -share * sine / decay;
    }
    modes.push_back({band, parity, number, at, second});
  }

  const Element& element_;
  EndSupport end_;
  double m_;
  double felt_;
};

}  // namespace

std::optional<NaturalModes> hermite_chain_modes(const HermiteChain& chain) {
  if (!has_closed_modes(chain.ends)) return std::nullopt;
  const auto [first, last] = chain.ends;
  const bool alike = first == last;
  const bool about_first = !alike && first == EndSupport::pinned;
  const bool about_last = !alike && last == EndSupport::pinned;
  const EndSupport end = about_first ? last : first;
  const double a = chain.length;
  const Element element(chain.rotary_inertia / (chain.mass_per_length * a * a));
  Shapes shapes(chain, about_last, about_first);
  const Finder finder(element, end, shapes.m());

  std::vector<Mode> modes;
  std::vector<Parity> rigid;
  modes.reserve(shapes.n_unknowns());
  for (const Parity parity : {Parity::even, Parity::odd}) {
    if (parity == Parity::even ? about_first || about_last : chain.half) continue;
    if (!finder.add_modes(parity, modes)) return std::nullopt;
    if (end == EndSupport::free) rigid.push_back(parity);
  }
  const std::size_t n = shapes.n_unknowns();
  if (modes.size() + rigid.size() != n) return std::nullopt;

  std::ranges::sort(modes, {}, [](const Mode& mode) { return mode.waves.lambda; });
  const double unit = std::sqrt(chain.bending_stiffness / chain.mass_per_length) / (a * a);
  NaturalModes result;
  result.frequencies.assign(rigid.size(), 0.0);
  result.shapes.reserve(n * n);
  std::vector<double> shape(n);
  for (const Parity parity : rigid) {
    shapes.write_rigid(parity, shape.data());
    result.shapes.insert(result.shapes.end(), shape.begin(), shape.end());
  }
  for (const Mode& mode : modes) {
    result.frequencies.push_back(unit * std::sqrt(mode.waves.lambda));
    shapes.write(mode, shape.data());
    result.shapes.insert(result.shapes.end(), shape.begin(), shape.end());
  }
  return result;
}

}  // namespace subimpact
