#include "stability/coefficients.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>
#include <stdexcept>
#include <vector>

#include "integrate/nystrom.h"

namespace subimpact {

using Complex = std::complex<double>;

double spectral_radius(const std::array<std::array<double, 2>, 2>& m) {
  const double half_trace = 0.5 * (m[0][0] + m[1][1]);
  const double determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
  const Complex root = std::sqrt(Complex(half_trace * half_trace - determinant, 0.0));
  return std::max(std::abs(half_trace + root), std::abs(half_trace - root));
}

double nystrom_growth(const std::string& name, double y) {
  const NystromTable& table = nystrom_table(name);
  std::array<std::array<double, 2>, 2> step;
  for (std::size_t column = 0; column < 2; ++column) {
    const double u = column == 0 ? 1.0 : 0.0;  // omega q
    const double v = 1.0 - u;
    std::vector<double> k(table.n_stages());  // a/omega
    for (std::size_t i = 0; i < k.size(); ++i) {
      double stage = u + table.c[i] * y * v;
      for (std::size_t j = 0; j < table.a[i].size(); ++j) stage += y * y * table.a[i][j] * k[j];
      k[i] = -stage;
    }
    step[0][column] = u + y * v;
    step[1][column] = v;
    for (std::size_t i = 0; i < k.size(); ++i) {
      step[0][column] += y * y * table.position[i] * k[i];
      step[1][column] += y * table.velocity[i] * k[i];
    }
  }
  return spectral_radius(step);
}

double bdf_growth(int order, double y) {
  // sum_{m=1}^{k} (1/m) (backward difference)^m y_n = h f_n, coefficients of y_n, y_{n-1}, ...
  if (order < 1 || order > 5) throw std::invalid_argument("bdf_growth: orders are 1 to 5");
  std::vector<double> alpha(static_cast<std::size_t>(order) + 1, 0.0);
  for (int m = 1; m <= order; ++m) {
    double binomial = 1.0;
    for (int j = 0; j <= m; ++j) {
      alpha[static_cast<std::size_t>(j)] += (j % 2 == 0 ? 1.0 : -1.0) * binomial / m;
      binomial *= static_cast<double>(m - j) / (j + 1);
    }
  }
  // Companion matrix of (alpha_0 - i y) zeta^k + alpha_1 zeta^(k-1) + ...
  Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(order, order);
  for (int j = 0; j < order; ++j) {
    companion(0, j) = -alpha[static_cast<std::size_t>(j) + 1] / Complex(alpha[0], -y);
    if (j + 1 < order) companion(j + 1, j) = 1.0;
  }
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(companion, false);
  return solver.eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace subimpact
