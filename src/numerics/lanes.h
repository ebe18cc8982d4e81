#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <vector>

namespace subimpact {

/// Eight numbers at once, at any address; the compiler maps them to the vector registers that the
/// processor has. For the few inner loops that the compiler does not vectorise.
///
/// Written in the vector extensions of GCC and Clang (GCC 12 and Clang 14 are tested), which are
/// not standard C++; other compilers are refused.
#ifndef __GNUC__
#error "numerics/lanes.h needs the vector extensions of GCC or Clang"
#endif
constexpr std::size_t n_lanes = 8;
#ifdef __clang__
// No alignment of 8 here: Clang forgets it at the first reference, and would then read at any
// address with instructions for aligned memory. It aligns variables as it needs.
using Lanes = double __attribute__((vector_size(n_lanes * sizeof(double)), may_alias));
#else
using Lanes = double __attribute__((vector_size(n_lanes * sizeof(double)), aligned(8), may_alias));
#endif
/// What comparing two Lanes gives: all bits set or none, lane by lane.
using LaneMask = decltype(Lanes{} < Lanes{});

/// A vector that begins on a cache line, so that Lanes read from its start never straddle two.
template <class T>
struct LineAllocator {
  using value_type = T;
  static constexpr std::align_val_t line{64};
  LineAllocator() = default;
  template <class U>
  LineAllocator(const LineAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), line)); }
  void deallocate(T* at, std::size_t) { ::operator delete(at, line); }
  template <class U>
  bool operator==(const LineAllocator<U>&) const {
    return true;
  }
};
using AlignedVector = std::vector<double, LineAllocator<double>>;

/// Lanes at any address. Reading through it is one instruction with both compilers; GCC 12 makes a
/// memcpy of this size go through the stack.
struct __attribute__((packed, aligned(8), may_alias)) LanesAnywhere {
  Lanes values;
};
inline Lanes lanes_at(const double* at) {
  return reinterpret_cast<const LanesAnywhere*>(at)->values;
}
inline void store(const Lanes& values, double* at) {
  reinterpret_cast<LanesAnywhere*>(at)->values = values;
}

/// even, odd, even, odd ...
inline Lanes alternating(double even, double odd) {
  Lanes result;
  for (std::size_t i = 0; i < n_lanes; ++i) result[i] = i % 2 == 0 ? even : odd;
  return result;
}

/// result[i] = value of i, eight at a time from the first cache line on that begins in `result`: a
/// store that straddles two lines is slow, if they are not in the nearest cache more so.
/// `value(at)` is written with at(x) for x[i], which is one number or Lanes:
///
///     assign_by_lines(y, n, [=](auto at) { return at(x) + factor * at(z); });
template <class Value>
void assign_by_lines(double* result, std::size_t n, Value value) {
  constexpr std::size_t line = n_lanes * sizeof(double);
  const std::size_t past = reinterpret_cast<std::uintptr_t>(result) % line;
  const std::size_t head = past == 0 ? 0 : std::min(n, (line - past) / sizeof(double));
  std::size_t i = 0;
  const auto one = [&i](const double* x) { return x[i]; };
  const auto eight = [&i](const double* x) { return lanes_at(x + i); };
  for (; i < head; ++i) result[i] = value(one);
  for (; i + n_lanes <= n; i += n_lanes) store(value(eight), result + i);
  for (; i < n; ++i) result[i] = value(one);
}

/// The square root of each; of one number too, so that a formula serves for both.
inline Lanes sqrt_of(const Lanes& x) {
  Lanes result;
  for (std::size_t i = 0; i < n_lanes; ++i) result[i] = std::sqrt(x[i]);
  return result;
}
inline double sqrt_of(double x) { return std::sqrt(x); }

inline double sum(const Lanes& values) {
  using Half = double __attribute__((vector_size(n_lanes * sizeof(double) / 2)));
  Half halves[2];
  static_assert(sizeof(halves) == sizeof(values));
  std::memcpy(halves, &values, sizeof(values));
  const Half joined = halves[0] + halves[1];
  return (joined[0] + joined[2]) + (joined[1] + joined[3]);
}

inline double dot(const double* a, const double* b, std::size_t n) {
  // Four running sums, so that additions do not wait for each other.
  Lanes running[4] = {};
  std::size_t i = 0;
  for (; i + 4 * n_lanes <= n; i += 4 * n_lanes) {
    for (std::size_t k = 0; k < 4; ++k) {
      running[k] += lanes_at(a + i + k * n_lanes) * lanes_at(b + i + k * n_lanes);
    }
  }
  for (; i + n_lanes <= n; i += n_lanes) running[0] += lanes_at(a + i) * lanes_at(b + i);
  double total = sum((running[0] + running[1]) + (running[2] + running[3]));
  for (; i < n; ++i) total += a[i] * b[i];
  return total;
}

/// Sum over i of a value, written with at(x) for x[i] as for assign_by_lines().
template <class Value>
double sum_of(std::size_t n, Value value) {
  Lanes running{};
  std::size_t i = 0;
  for (; i + n_lanes <= n; i += n_lanes) {
    running += value([i](const double* x) { return lanes_at(x + i); });
  }
  double total = sum(running);
  for (; i < n; ++i) total += value([i](const double* x) { return x[i]; });
  return total;
}

/// Sum of |a_i b_i|.
inline double dot_of_size(const double* a, const double* b, std::size_t n) {
  return sum_of(n, [=](auto at) {
    const auto term = at(a) * at(b);
    return term < 0.0 ? -term : term;
  });
}

inline bool any(const LaneMask& mask) {
  // As bytes: two halves are joined until one word is left.
  using Half = long long __attribute__((vector_size(n_lanes * sizeof(double) / 2)));
  Half halves[2];
  static_assert(sizeof(halves) == sizeof(mask));
  std::memcpy(halves, &mask, sizeof(mask));
  const Half joined = halves[0] | halves[1];
  return (joined[0] | joined[1] | joined[2] | joined[3]) != 0;
}

/// Visits every i in [0, n) for which `test(i)` holds. `suspect(i)`, a LaneMask for i..i+7, must
/// not miss any; it lets all but a few groups of eight be passed over at once.
template <class Suspect, class Test, class Visit>
void for_each_found(std::size_t n, Suspect suspect, Test test, Visit visit) {
  std::size_t start = 0;
  for (; start + 4 * n_lanes <= n; start += 4 * n_lanes) {
    const LaneMask first = suspect(start) | suspect(start + n_lanes);
    const LaneMask second = suspect(start + 2 * n_lanes) | suspect(start + 3 * n_lanes);
    if (!any(first | second)) continue;
    for (std::size_t i = start; i < start + 4 * n_lanes; ++i) {
      if (test(i)) visit(i);
    }
  }
  for (std::size_t i = start; i < n; ++i) {
    if (test(i)) visit(i);
  }
}

/// Whether this processor has the vector instructions that the library was compiled for, where
/// these are AVX2 and FMA (CMake: SUBIMPACT_BASELINE=x86-64-v3): without them it would end by a
/// signal.
inline bool is_processor_sufficient() {
#if defined(__AVX2__) && defined(__FMA__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return true;
#endif
}

inline constexpr const char* insufficient_processor =
    "subimpact: this processor lacks AVX2 or FMA, for which this build was compiled; build it from "
    "source with `cmake --preset release`\n";

struct SinCos {
  Lanes sine, cosine;
};

/// Sine and cosine of eight numbers at once, to two units in the last place.
///
/// The multiple k pi/2 nearest to y is subtracted in three parts of pi/2, the first two of 33 bits,
/// so that their products with k are exact; then come the polynomials of fdlibm (Sun Microsystems
/// 1993) for angles up to pi/4. Beyond 1e6 the standard library is used.
inline SinCos sin_cos(const Lanes& y) {
  constexpr double largest = 1e6;
  constexpr double to_integer = 0x1.8p52;  // added: the sum's last bits are the nearest integer's
  const Lanes shifted = y * 6.36619772367581382433e-01 + to_integer;
  const Lanes turns = shifted - to_integer;
  LaneMask quarter;
  std::memcpy(&quarter, &shifted, sizeof(quarter));
  Lanes r = y - turns * 1.57079632673412561417e+00;
  r -= turns * 6.07710050630396597660e-11;
  r -= turns * 2.02226624879595063154e-21;
  const Lanes z = r * r;
  const Lanes s =
      r + r * z *
              (-1.66666666666666324348e-01 +
               z * (8.33333333332248946124e-03 +
                    z * (-1.98412698298579493134e-04 +
                         z * (2.75573137070700676789e-06 + z * (-2.50507602534068634195e-08 +
                                                                z * 1.58969099521155010221e-10)))));
  const Lanes c =
      1.0 - 0.5 * z +
      z * z *
          (4.16666666666666019037e-02 +
           z * (-1.38888888888741095749e-03 +
                z * (2.48015872894767294178e-05 +
                     z * (-2.75573143513906633035e-07 +
                          z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
  const LaneMask odd = (quarter & 1) != 0;
  SinCos result{odd ? c : s, odd ? s : c};
  result.sine = (quarter & 2) != 0 ? -result.sine : result.sine;
  result.cosine = ((quarter + 1) & 2) != 0 ? -result.cosine : result.cosine;
  if (any((y > largest) | (y < -largest))) {
    for (std::size_t i = 0; i < n_lanes; ++i) {
      if (std::abs(y[i]) <= largest) continue;
      result.sine[i] = std::sin(y[i]);
      result.cosine[i] = std::cos(y[i]);
    }
  }
  return result;
}

/// Stumpff's functions C_k(y) = sum_p (-y^2)^p/(2p + k)!, k = 0..5: cos y, sin y/y, (1 - cos y)/y^2
/// ...
///
/// They are the response of an oscillator to polynomial forces: with y = omega t,
///
///     integral_0^t sin(omega (t - s))/omega s^m ds = m! t^(m+2) C_{m+2}(y),
///     integral_0^t cos(omega (t - s))       s^m ds = m! t^(m+1) C_{m+1}(y),
///
/// for every y >= 0, here eight at once: by their series below 1 and by C_{k+2} = (1/k! - C_k)/y^2
/// above, where that recurrence loses at most the last two digits.
struct StumpffLanes {
  Lanes values[6];
  const Lanes& operator[](std::size_t k) const { return values[k]; }
};

inline StumpffLanes stumpff(const Lanes& y) {
  assert(!any(y < 0.0));
  const Lanes y2 = y * y;
  const LaneMask small = y < 1.0;
  const Lanes inverse = 1.0 / (small ? Lanes{} + 1.0 : y2);
  const SinCos at = sin_cos(y);
  Lanes c[6];
  c[0] = at.cosine;
  c[1] = at.sine * (y * inverse);
  c[2] = (1.0 - c[0]) * inverse;
  c[3] = (1.0 - c[1]) * inverse;
  c[4] = (0.5 - c[2]) * inverse;
  c[5] = (1.0 / 6.0 - c[3]) * inverse;
  if (any(small)) {
    // Horner's rule on the series of C_4 and C_5, then the recurrence downwards.
    Lanes fourth = Lanes{} + 1.0;
    Lanes fifth = fourth;
    for (int k = 18; k >= 6; k -= 2) {
      fourth = 1.0 - y2 * fourth * (1.0 / (k * (k - 1.0)));
      fifth = 1.0 - y2 * fifth * (1.0 / (k * (k + 1.0)));
    }
    fourth /= 24.0;
    fifth /= 120.0;
    const Lanes second = 0.5 - y2 * fourth;
    const Lanes third = 1.0 / 6.0 - y2 * fifth;
    c[0] = small ? 1.0 - y2 * second : c[0];
    c[1] = small ? 1.0 - y2 * third : c[1];
    c[2] = small ? second : c[2];
    c[3] = small ? third : c[3];
    c[4] = small ? fourth : c[4];
    c[5] = small ? fifth : c[5];
  }
  return {{c[0], c[1], c[2], c[3], c[4], c[5]}};
}

}  // namespace subimpact
