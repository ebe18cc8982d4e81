#include "model/hermite_modes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "numerics/bracketed_root.h"
#include "numerics/lanes.h"
#include "numerics/sin_cos.h"

namespace subimpact {
namespace {

using std::numbers::pi;

enum class Band { acoustic, optical, above };
enum class Parity { even, odd };  // of W about the middle; Theta has the other

// An element's dynamic stiffness in units of E I/a^3 (slopes times a): what multiplies -lambda in
// its entries and in sums of them. With w_0, t_0, w_1, t_1 for its unknowns C is entry (w_0, w_1),
// D (w_0, t_1), E (t_0, t_1), F (w_0, t_0); A and B are (w_0, w_0) and (t_0, t_0).
struct Element {
  double rho;  // J/(rho A a^2)
  double of_c, of_d, of_e, of_b_and_e, of_f_and_d;

  explicit Element(double ratio)
      : rho(ratio),
        of_c(54.0 / 420.0 - 1.2 * rho),
        of_d(-13.0 / 420.0 + 0.1 * rho),
        of_e(-3.0 / 420.0 - rho / 30.0),
        of_b_and_e(1.0 / 420.0 + 0.1 * rho),
        of_f_and_d(9.0 / 420.0 + 0.2 * rho) {}
};

// Numbers one by one, or eight at a time.
struct One {
  using Number = double;
};
struct Eight {
  using Number = Lanes;
};

// One wave: w cos(theta d), slope sin(theta d) at a distance d from the middle, or with cosh and
// sinh; in an odd mode sin, -cos or sinh, cosh. An end has two conditions: one in which an even
// mode's sin (or sinh) remains, with this coefficient, and one in which its cos (or cosh) remains.
template <class Kind>
struct WaveOf {
  using Number = typename Kind::Number;
  Number turn;  // sin(theta) or sinh(phi)
  Number w, slope;
  Number with_sin, with_cos;
};

// The two waves of one frequency.
template <class Kind>
struct WavesOf {
  using Number = typename Kind::Number;
  Number lambda;
  Number decay;  // 2 sinh^2(phi/2) of the second
  WaveOf<Kind> first, second;

  // tan(theta m) = ratio tanh(phi m) in an even mode.
  Number ratio() const { return rise() / run(); }
  WavesOf<One> operator[](std::size_t lane) const {
    const auto one = [lane](const WaveOf<Kind>& w) {
      return WaveOf<One>{w.turn[lane], w.w[lane], w.slope[lane], w.with_sin[lane],
                         w.with_cos[lane]};
    };
    return {lambda[lane], decay[lane], one(first), one(second)};
  }
  Number rise() const { return first.with_cos * second.with_sin; }
  Number run() const { return first.with_sin * second.with_cos; }
};

using Wave = WaveOf<One>;
using Waves = WavesOf<One>;

Lanes sqrt_of(const Lanes& x) {
  Lanes result;
  for (std::size_t i = 0; i < n_lanes; ++i) result[i] = std::sqrt(x[i]);
  return result;
}
double sqrt_of(double x) { return std::sqrt(x); }

// p = 2 sin^2(theta/2), or -2 sinh^2(psi/2) above the bands. Written so that long waves, and
// those near the ends of the optical branch, keep their digits.
template <class Kind>
WavesOf<Kind> waves_at(const typename Kind::Number& p, Band band, const Element& k, bool clamped) {
  using Number = typename Kind::Number;
  const bool acoustic = band == Band::acoustic;
  const Number q = p * (2.0 - p);
  const Number u = 0.5 - k.of_c * p;
  const Number v = k.of_b_and_e - k.of_e * p;
  const Number gamma = 12.0 * p * p;
  const Number beta = 12.0 * p * v + u * (6.0 - 2.0 * p) - 12.0 * k.of_d * q;
  const Number alpha = u * v - k.of_d * k.of_d * q;
  const Number root = sqrt_of(beta * beta - 4.0 * alpha * gamma);
  const Number lambda = acoustic ? 2.0 * gamma / (beta + root) : (beta + root) / (2.0 * alpha);
  const Number c = -12.0 - lambda * k.of_c;
  const Number d = 6.0 - lambda * k.of_d;
  const Number e = 2.0 - lambda * k.of_e;
  const Number leading = c * e + d * d;
  // A + C cos(theta) and B + E cos(theta); what may be small of them comes from their product.
  const Number of_w = 12.0 * p - lambda * u;
  const Number of_slope = acoustic ? 6.0 - 2.0 * p - lambda * v : d * d * q / of_w;
  const Number decay = acoustic ? lambda * (6.0 - lambda * k.of_b_and_e) / (2.0 * leading * p)
                                : lambda * (d * d * (2.0 - p) / of_w + e) / (2.0 * leading);
  const Number s = sqrt_of(band == Band::above ? -q : q);
  const Number sinh_phi = sqrt_of(decay * (2.0 + decay));
  WaveOf<Kind> first{s, acoustic ? of_slope : d * s, acoustic ? -d * s : -of_w, {}, {}};
  WaveOf<Kind> second{sinh_phi, of_slope + e * (p + decay), d * sinh_phi, {}, {}};
  if (clamped) {  // no slope, no displacement
    for (WaveOf<Kind>* wave : {&first, &second}) {
      wave->with_sin = wave->slope;
      wave->with_cos = wave->w;
    }
    return {lambda, decay, first, second};
  }
  // No force on, no couple on an element that would go on beyond the end.
  const auto force = [&](const Number& x) {  // -D (F + D cos) - C (B + E cos), x = 1 - cos
    return 12.0 * x + lambda * (0.5 - 6.0 * k.rho + x * (12.0 * (k.of_e - k.of_d) - 2.0 * k.of_c)) -
           lambda * lambda *
               (k.of_d * (k.of_f_and_d - k.of_d * x) + k.of_c * (k.of_b_and_e - k.of_e * x));
  };
  const auto couple = [&](const Number& x) {  // F - D cos
    return 6.0 * x - lambda * (1.0 / 12.0 + k.of_d * x);
  };
  first.with_sin = acoustic ? s * force(p) : force(p) * of_w / d;
  first.with_cos = acoustic ? couple(p) * of_slope - e * d * q : s * (couple(p) * d - e * of_w);
  second.with_sin = -sinh_phi * force(-decay);
  second.with_cos = couple(-decay) * second.w + e * d * sinh_phi * sinh_phi;
  return {lambda, decay, first, second};
}

// What a mode is made of: amplitudes of the two waves, the second counted at the ends.
struct Mode {
  Band band;
  Parity parity;
  double number;  // theta, or psi above the bands
  Waves waves;
  double second;
};

double phi_of(const Waves& waves) { return std::log1p(waves.decay + waves.second.turn); }

// Up to which decay waves from the ends, of the size 1 there, meet in the middle with more than
// rounding, e^-phi m.
double largest_decay_felt(double m) {
  const double half = std::sinh(20.0 / m);
  return 2.0 * half * half;
}

double square_of_half(double number, Band band) {
  const double half = band == Band::above ? std::sinh(0.5 * number) : std::sin(0.5 * number);
  return band == Band::above ? -2.0 * half * half : 2.0 * half * half;
}

// The modes of one parity of a chain whose ends, alike, are m elements from its middle.
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

  // The mode of a free end's own: in the optical band if it is even and long enough, else above.
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
    // Of an end's two conditions the one in which the second wave weighs more.
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

// W and Theta at the distances m, m - 1, ... from the middle.
struct Columns {
  std::vector<double> w, slope;  // of whole groups of lanes

  explicit Columns(std::size_t n) : w((n + n_lanes - 1) / n_lanes * n_lanes), slope(w.size()) {}
};

Lanes powers_of(double step) {
  Lanes values{};
  double power = 1.0;
  for (std::size_t i = 0; i < n_lanes; ++i, power *= step) values[i] = power;
  return values;
}

// Adds w cosh(phi d)/cosh(phi m), slope sinh(phi d)/cosh(phi m), or sinh and cosh in an odd mode;
// `step` is e^-phi, `full` e^-2 phi m.
void add_decaying(double w, double slope, double step, double full, bool even, Columns& to) {
  constexpr double negligible = 1e-30;
  const double norm = 1.0 / (1.0 + full);
  (even ? slope : w) *= norm;
  (even ? w : slope) *= norm;
  Lanes near = powers_of(step);
  const double group = near[n_lanes - 1] * step;
  for (std::size_t i = 0; i < to.w.size() && near[0] > negligible; i += n_lanes) {
    store(lanes_at(&to.w[i]) + w * near, &to.w[i]);
    store(lanes_at(&to.slope[i]) + slope * near, &to.slope[i]);
    near *= group;
  }
  if (full < negligible) return;
  (even ? slope : w) *= -1.0;
  Lanes far = full * powers_of(1.0 / step);
  for (std::size_t i = 0; i < to.w.size(); i += n_lanes) {
    store(lanes_at(&to.w[i]) + w * far, &to.w[i]);
    store(lanes_at(&to.slope[i]) + slope * far, &to.slope[i]);
    far *= 1.0 / group;
  }
}

void fill_inwards(const Mode& mode, double m, double largest_decay, Columns& to) {
  const bool even = mode.parity == Parity::even;
  const Wave& first = mode.waves.first;
  const Wave& second = mode.waves.second;
  if (mode.band == Band::above) {
    std::fill(to.w.begin(), to.w.end(), 0.0);
    std::fill(to.slope.begin(), to.slope.end(), 0.0);
    add_decaying(first.w, first.slope, std::exp(-mode.number), std::exp(-2.0 * mode.number * m),
                 even, to);
  } else {
    Lanes d{};
    for (std::size_t i = 0; i < n_lanes; ++i) d[i] = m - static_cast<double>(i);
    const SinCos start = sin_cos(mode.number * d);
    const double turn = static_cast<double>(n_lanes) * mode.number;
    const double cosine = std::cos(turn);
    const double sine = std::sin(turn);
    Lanes w = even ? start.cosine : start.sine;
    Lanes slope = even ? start.sine : -start.cosine;
    for (std::size_t i = 0; i < to.w.size(); i += n_lanes) {
      store(first.w * w, &to.w[i]);
      store(first.slope * slope, &to.slope[i]);
      const Lanes turned = w * cosine + slope * sine;
      slope = slope * cosine - w * sine;
      w = turned;
    }
  }
  const double step = 1.0 / (1.0 + mode.waves.decay + second.turn);
  const double full =
      mode.waves.decay > largest_decay ? 0.0 : std::exp(-2.0 * m * phi_of(mode.waves));
  add_decaying(mode.second * second.w, mode.second * second.slope, step, full, even, to);
}

// Mode and rigid motion alike, for nodes on one side of the middle; the other side mirrors them.
class Layout {
 public:
  Layout(const HermiteChain& chain, bool about_last, bool about_first)
      : n_nodes_((chain.half ? chain.n_elements / 2 : chain.n_elements) + 1),
        one_sided_(chain.half || about_last || about_first),
        backwards_(about_first),
        first_(held(chain.ends[0])),
        last_(chain.half ? 0 : held(chain.ends[1])),
        half_(chain.half),
        n_inwards_(one_sided_ ? n_nodes_ : (n_nodes_ + 1) / 2),
        inwards_(n_inwards_),
        largest_decay_(largest_decay_felt(m())),
        nodal_(2 * n_nodes_) {}

  double m() const {
    const double n = static_cast<double>(n_nodes_ - 1);
    return one_sided_ ? n : 0.5 * n;
  }
  std::size_t n_unknowns() const { return 2 * n_nodes_ - first_ - last_ - (half_ ? 1 : 0); }

  void write(const Mode& mode, double* shape) {
    fill_inwards(mode, m(), largest_decay_, inwards_);
    write(mode.parity, shape);
  }
  void write_rigid(Parity parity, double* shape) {
    for (std::size_t i = 0; i < n_inwards_; ++i) {
      const double d = m() - static_cast<double>(i);
      inwards_.w[i] = parity == Parity::even ? 1.0 : d;
      inwards_.slope[i] = parity == Parity::even ? 0.0 : 1.0;
    }
    write(parity, shape);
  }

 private:
  static std::size_t held(EndSupport end) {
    return end == EndSupport::free ? 0 : end == EndSupport::pinned ? 1 : 2;
  }

  void write(Parity parity, double* shape) {
    const std::size_t n = n_nodes_;
    const double sign = parity == Parity::even ? 1.0 : -1.0;
    const double* w = inwards_.w.data();
    const double* slope = inwards_.slope.data();
    if (!backwards_) {
      for (std::size_t i = 0; i < n_inwards_; ++i) {
        nodal_[2 * i] = w[i];
        nodal_[2 * i + 1] = -slope[i];
      }
    }
    const std::size_t n_mirrored = one_sided_ && !backwards_ ? 0 : backwards_ ? n : n / 2;
    for (std::size_t i = 0; i < n_mirrored; ++i) {
      nodal_[2 * (n - 1 - i)] = sign * w[i];
      nodal_[2 * (n - 1 - i) + 1] = sign * slope[i];
    }
    const auto values = nodal_.begin() + static_cast<std::ptrdiff_t>(first_);
    double* end = std::copy(values, nodal_.end() - (last_ > 0 ? 2 : half_ ? 1 : 0), shape);
    if (last_ == 1) *end = nodal_.back();
  }

  std::size_t n_nodes_;
  bool one_sided_, backwards_;
  std::size_t first_, last_;  // unknowns held at the ends
  bool half_;
  std::size_t n_inwards_;
  Columns inwards_;
  double largest_decay_;
  std::vector<double> nodal_;
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
  Layout layout(chain, about_last, about_first);
  const Finder finder(element, end, layout.m());

  std::vector<Mode> modes;
  std::vector<Parity> rigid;
  modes.reserve(layout.n_unknowns());
  for (const Parity parity : {Parity::even, Parity::odd}) {
    if (parity == Parity::even ? about_first || about_last : chain.half) continue;
    if (!finder.add_modes(parity, modes)) return std::nullopt;
    if (end == EndSupport::free) rigid.push_back(parity);
  }
  const std::size_t n = layout.n_unknowns();
  if (modes.size() + rigid.size() != n) return std::nullopt;

  std::vector<std::size_t> order(modes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return modes[i].waves.lambda < modes[j].waves.lambda;
  });
  const double unit = std::sqrt(chain.bending_stiffness / chain.mass_per_length) / (a * a);
  NaturalModes result;
  result.frequencies.assign(rigid.size(), 0.0);
  result.shapes.resize(n * n);
  double* shape = result.shapes.data();
  for (const Parity parity : rigid) {
    layout.write_rigid(parity, shape);
    shape += n;
  }
  for (const std::size_t i : order) {
    result.frequencies.push_back(unit * std::sqrt(modes[i].waves.lambda));
    layout.write(modes[i], shape);
    shape += n;
  }
  return result;
}

}  // namespace subimpact
