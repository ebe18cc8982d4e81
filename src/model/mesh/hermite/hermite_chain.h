#pragma once

#include <cstddef>
#include <vector>

#include "model/mesh/modes.h"
#include "numerics/lanes.h"

/// Waves in a chain of equal Hermite elements, and the shapes of the natural modes that are made of
/// them; equations and symbols are those of docs/theory.md, "Hermite elements".
namespace subimpact::chain {

enum class Band { acoustic, optical, above };
enum class Parity { even, odd };  ///< of W about the middle; Theta has the other

/// An element's dynamic stiffness in units of E I/a^3 (slopes times a): what multiplies -lambda in
/// its entries and in sums of them. With w_0, t_0, w_1, t_1 for its unknowns C is entry (w_0, w_1),
/// D (w_0, t_1), E (t_0, t_1), F (w_0, t_0); A and B are (w_0, w_0) and (t_0, t_0).
struct Element {
  double rho;  ///< J/(rho A a^2)
  double of_c, of_d, of_e, of_b_and_e, of_f_and_d;

  explicit Element(double ratio)
      : rho(ratio),
        of_c(54.0 / 420.0 - 1.2 * rho),
        of_d(-13.0 / 420.0 + 0.1 * rho),
        of_e(-3.0 / 420.0 - rho / 30.0),
        of_b_and_e(1.0 / 420.0 + 0.1 * rho),
        of_f_and_d(9.0 / 420.0 + 0.2 * rho) {}
};

/// Numbers one by one, or eight at a time.
struct One {
  using Number = double;
};
struct Eight {
  using Number = Lanes;
};

/// One wave: w cos(theta d), slope sin(theta d) at a distance d from the middle, or with cosh and
/// sinh; in an odd mode sin, -cos or sinh, cosh. An end has two conditions: one in which an even
/// mode's sin (or sinh) remains, with this coefficient, and one in which its cos (or cosh) remains.
template <class Kind>
struct WaveOf {
  using Number = typename Kind::Number;
  Number turn;  ///< sin(theta) or sinh(phi)
  Number w, slope;
  Number with_sin, with_cos;
};

template <class Kind>
struct WavesOf {
  using Number = typename Kind::Number;
  Number lambda;
  Number decay;  ///< 2 sinh^2(phi/2) of the second
  WaveOf<Kind> first, second;

  /// tan(theta m) = ratio tanh(phi m) in an even mode.
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

/// What a mode is made of: amplitudes of the two waves, the second counted at the ends.
struct Mode {
  Band band;
  Parity parity;
  double number;  ///< theta, or psi above the bands
  Waves waves;
  double second;
};

/// The two waves of a wave number with p = 2 sin^2(theta/2), or -2 sinh^2(psi/2) above the bands,
/// and an end's conditions on them.
template <class Kind>
WavesOf<Kind> waves_at(const typename Kind::Number& p, Band band, const Element& k, bool clamped);

double phi_of(const Waves& waves);

/// Up to which decay waves from the ends, of the size 1 there, meet in the middle, m elements away,
/// with more than rounding, e^-phi m.
double largest_decay_felt(double m);

/// W and Theta at the distances m, m - 1, ... from the middle.
struct Columns {
  std::vector<double> w, slope;  ///< of whole groups of lanes

  explicit Columns(std::size_t n) : w((n + n_lanes - 1) / n_lanes * n_lanes), slope(w.size()) {}
};

/// Writes shapes of modes and rigid motion: one side of the middle is computed, the other mirrored.
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
