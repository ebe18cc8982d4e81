#pragma once

#include <array>
#include <cstddef>

namespace subimpact {

/// Points and weights of a quadrature rule on [0, 1]: integral of f = sum weights[i] f(points[i]).
template <std::size_t n>
struct QuadratureRule {
  std::array<double, n> points;
  std::array<double, n> weights;
};

/// The rule that is symmetric about 1/2, from its points up to 1/2 and their weights.
template <std::size_t n>
constexpr QuadratureRule<n> symmetric_rule(const std::array<double, (n + 1) / 2>& points,
                                           const std::array<double, (n + 1) / 2>& weights) {
  QuadratureRule<n> rule{};
  for (std::size_t i = 0; i < (n + 1) / 2; ++i) {
    rule.points[n - 1 - i] = 1.0 - points[i];
    rule.points[i] = points[i];
    rule.weights[i] = rule.weights[n - 1 - i] = weights[i];
  }
  return rule;
}

/// The Gauss-Legendre rule of n points, exact for polynomials of degree 2n - 1. Its error is
/// (n!)^4/((2n + 1) (2n)!^3) times the 2n-th derivative of f somewhere in (0, 1).
template <std::size_t n>
requires(n >= 2 && n <= 5) inline constexpr QuadratureRule<n> gauss{};
template <>
inline constexpr auto gauss<2> = symmetric_rule<2>({0.2113248654051871177454}, {0.5});
template <>
inline constexpr auto gauss<3> = symmetric_rule<3>({0.1127016653792583114821, 0.5},
                                                   {5.0 / 18.0, 8.0 / 18.0});
template <>
inline constexpr auto gauss<4> =
    symmetric_rule<4>({0.0694318442029737123880, 0.3300094782075718675987},
                      {0.1739274225687269286865, 0.3260725774312730713135});
template <>
inline constexpr auto gauss<5> = symmetric_rule<5>(
    {0.0469100770306680036012, 0.2307653449471584544818, 0.5},
    {0.1184634425280945437571, 0.2393143352496832340206, 0.2844444444444444444444});

}  // namespace subimpact
