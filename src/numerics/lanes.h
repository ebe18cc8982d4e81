#pragma once

#include <algorithm>
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

}  // namespace subimpact
