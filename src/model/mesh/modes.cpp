#include "model/mesh/modes.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "numerics/bracketed_root.h"
#include "numerics/dense.h"
#include "numerics/lanes.h"

namespace subimpact {
namespace {

// The determinant of the end conditions, continuous in beta; rows are scaled to a size near one.
double end_determinant(double beta, double slenderness, const std::array<EndSupport, 2>& ends) {
  const double b4 = std::pow(beta, 4);
  const double inertia = b4 * slenderness * slenderness;  // B r^2 = a^2 - b^2
  const double a = std::sqrt(0.5 * (inertia + std::sqrt(inertia * inertia + 4.0 * b4)));
  const double b = beta * beta / a;
  Eigen::Matrix4d conditions;
  for (int side = 0; side < 2; ++side) {
    const double c = std::cos(side * a);
    const double s = std::sin(side * a);
    const double near = std::exp(-b * side);       // of exp(-b xi)
    const double far = std::exp(-b * (1 - side));  // of exp(-b (1 - xi))
    Eigen::Matrix4d values;  // phi, phi', phi'' and phi''' + B r^2 phi' of the four functions
    values.row(0) << c, s, near, far;
    values.row(1) << -a * s, a * c, -b * near, b * far;
    values.row(2) << -a * a * c, -a * a * s, b * b * near, b * b * far;
    // phi''' + (a^2 - b^2) phi'
    values.row(3) << a * b * b * s, -a * b * b * c, -a * a * b * near, a * a * b * far;
    const EndSupport end = ends[static_cast<std::size_t>(side)];
    const int first = end == EndSupport::free ? 2 : 0;
    const int second = end == EndSupport::free ? 3 : end == EndSupport::pinned ? 2 : 1;
    conditions.row(Eigen::Index{2} * side) = values.row(first) / std::pow(beta, first);
    conditions.row(Eigen::Index{2} * side + 1) = values.row(second) / std::pow(beta, second);
  }
  return conditions.determinant();
}

}  // namespace

std::vector<double> flexural_wave_numbers(double slenderness, const std::array<EndSupport, 2>& ends,
                                          std::size_t n) {
  const auto f = [&](double beta) { return end_determinant(beta, slenderness, ends); };
  std::vector<double> roots;
  double low = 1.0;  // well below the first root of any ends, well above the rigid modes
  double at_low = f(low);
  while (roots.size() < n) {
    const double high = low + 0.05;
    const double at_high = f(high);
    if (at_low * at_high <= 0.0) roots.push_back(root_in(f, low, high));
    low = high;
    at_low = at_high;
  }
  return roots;
}

std::vector<double> flexural_frequencies(const Beam& beam, std::size_t n) {
  double slenderness =
      beam.theory == BeamTheory::euler_bernoulli ? 0.0 : beam.radius_of_gyration() / beam.length;
  if (beam.shears()) {
    slenderness *= std::sqrt(1.0 + beam.youngs_modulus * beam.area() / beam.shear_stiffness());
  }
  const double unit =
      std::sqrt(beam.bending_stiffness() / beam.mass_per_length()) / (beam.length * beam.length);
  std::vector<double> frequencies;
  for (const double beta : flexural_wave_numbers(slenderness, beam.ends, n)) {
    frequencies.push_back(unit * beta * beta);
  }
  return frequencies;
}

namespace {

using std::numbers::pi;
constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();

// What a wave number theta brings with it.
struct Wave {
  double s, sigma, phi, sinh_phi;
  double stretch;  // 1 + rho s

  Wave(double theta, double rho) {
    const double half = 2.0 * std::sin(0.5 * theta);
    s = half * half;
    stretch = 1.0 + rho * s;
    sigma = s / stretch;
    phi = 2.0 * std::asinh(0.5 * std::sqrt(sigma));
    sinh_phi = std::sqrt(sigma + 0.25 * sigma * sigma);
  }
};

// Free-end condition, as a function of y = theta c.
double end_condition(double y, double c, double rho, bool symmetric) {
  const double theta = y / c;
  const Wave wave(theta, rho);
  const double decay = std::tanh(wave.phi * c);
  const double bracket =
      wave.stretch * wave.stretch *
          (0.5 * wave.sigma + wave.sinh_phi * (symmetric ? decay : 1.0 / decay)) +
      0.5 * wave.s;
  return symmetric ? std::sin(y) * std::sin(theta) + bracket * std::cos(y)
                   : std::cos(y) * std::sin(theta) - bracket * std::sin(y);
}

// Shape at distances d = c, c - 1, ... >= 0 from the middle.
void fill_shape(double theta, double c, double rho, bool symmetric, std::span<double> shape) {
  const Wave wave(theta, rho);
  const double step = std::exp(-wave.phi);
  const double full = std::exp(-2.0 * wave.phi * c);
  const double sign = symmetric ? 1.0 : -1.0;
  const double at_end = symmetric ? std::cos(theta * c) : std::sin(theta * c);
  const double amplitude = wave.stretch * at_end / (1.0 + sign * full);
  const double cosine = std::cos(theta);
  const double sine = std::sin(theta);
  // Rotated inwards from the end, cell by cell: cos and sin of theta d, e^-phi(c - d), e^-phi(c +
  // d).
  double x = std::cos(theta * c);
  double y = std::sin(theta * c);
  double near = 1.0;
  for (double& value : shape) {
    const double far = near > 0.0 ? full / near : 0.0;
    value = (symmetric ? x : y) + amplitude * (near + sign * far);
    const double turned = x * cosine + y * sine;
    y = y * cosine - x * sine;
    x = turned;
    near *= step;
    if (near < 1e-300) near = 0.0;
  }
}

}  // namespace

NaturalModes free_cell_modes(const CellChain& chain, bool symmetric_only, std::size_t n_kept) {
  const double c = 0.5 * (static_cast<double>(chain.n_cells) - 1.0);
  const double dx2 = chain.spacing * chain.spacing;
  const double rho = chain.rotary_inertia / (chain.mass_per_length * dx2);
  const double unit = std::sqrt(chain.bending_stiffness / chain.mass_per_length) / dx2;
  const std::size_t n_modes = symmetric_only ? (chain.n_cells + 1) / 2 : chain.n_cells;
  NaturalModes modes;
  modes.frequencies.assign(n_modes, 0.0);
  modes.shapes.assign(n_modes * n_kept, 1.0);
  std::size_t next = 1;
  if (!symmetric_only) {
    for (std::size_t i = 0; i < n_kept; ++i) {
      modes.shapes[n_kept + i] = static_cast<double>(i) - c;
    }
    next = 2;
  }
  for (std::size_t number = 1; next < n_modes; ++number, ++next) {
    const bool symmetric = symmetric_only || number % 2 == 1;
    const double k = static_cast<double>(symmetric_only ? number : (number + 1) / 2);
    const double low = symmetric ? (k - 0.5) * pi : k * pi;
    // Where rotary inertia outweighs all else, the root is at the lower end to rounding.
    const double y = root_in([&](double at) { return end_condition(at, c, rho, symmetric); },
                             (1.0 - rounding) * low, low + 0.5 * pi);
    const Wave wave(y / c, rho);
    modes.frequencies[next] = unit * wave.s / std::sqrt(wave.stretch);
    const std::span<double> shape(modes.shapes.data() + next * n_kept, n_kept);
    const std::size_t n_half = (chain.n_cells + 1) / 2;
    fill_shape(y / c, c, rho, symmetric, shape.first(std::min(n_half, n_kept)));
    for (std::size_t i = n_half; i < n_kept; ++i) {
      shape[i] = (symmetric ? 1.0 : -1.0) * shape[chain.n_cells - 1 - i];
    }
  }
  return modes;
}

namespace {

// s, in units of the first frequency squared.
constexpr double shift_share = 0.1;
constexpr double rigid_share = 0.02;  // of s: below this omega^2 is that of a rigid mode
// Vectors beyond the modes wanted, and iterations: the last mode is then right to 1e-5.
constexpr std::size_t n_spare = 4;
constexpr int n_iterations = 12;

using Vector = std::vector<double>;
using Matrix = Eigen::MatrixXd;

std::span<double> column(Matrix& matrix, std::size_t k) {
  return {matrix.col(index(k)).data(), static_cast<std::size_t>(matrix.rows())};
}

void add(Vector& sum, double factor, std::span<const double> other) {
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += factor * other[i];
}

// Where the unknowns are modes: stiffness and mass are diagonal.
SlowMotion from_unknowns(const BeamMesh& mesh, std::size_t n_modes) {
  const std::span<const double> stiffness = mesh.modal_stiffness();
  SlowMotion found{{}, {}, Vector(stiffness.size(), 0.0)};
  mesh.struck_point().add_to(found.response, 1.0);
  for (std::size_t k = 0; k < stiffness.size(); ++k) {
    found.response[k] = stiffness[k] > 0.0 ? found.response[k] / stiffness[k] : 0.0;
    if (k >= n_modes) continue;
    const double mass = mesh.mass().at(k, k);
    found.frequencies.push_back(std::sqrt(stiffness[k] / mass));
    found.shapes.emplace_back(stiffness.size(), 0.0)[k] = 1.0 / std::sqrt(mass);
  }
  return found;
}

class SlowMotionByBands {
 public:
  SlowMotionByBands(const BeamMesh& mesh, double bending_stiffness, double first_period)
      : mesh_(mesh),
        n_(mesh.n_unknowns()),
        shift_(shift_share * std::pow(2.0 * std::numbers::pi / first_period, 2)),
        stiffness_(elastic_stiffness(mesh, bending_stiffness)) {
    BandedMatrix shifted = stiffness_;
    shifted.add(shift_, mesh.mass());
    factor_ = shifted.cholesky_factor();
  }

  std::optional<SlowMotion> find(std::size_t n_modes) const {
    if (!factor_) return std::nullopt;
    SlowMotion found;
    find_modes(std::min(n_modes, n_), found);
    find_response(found);
    return found;
  }

 private:
  void find_modes(std::size_t n_modes, SlowMotion& found) const {
    const std::size_t m = std::min(n_modes + n_spare, n_);
    Matrix x(index(n_), index(m)), inertia(index(n_), index(m));
    for (std::size_t k = 0; k < m; ++k) {  // any vectors that are not alike
      for (std::size_t i = 0; i < n_; ++i) {
        column(x, k)[i] = std::cos(static_cast<double>((i + 1) * (i + k + 1)));
      }
    }
    EigenPairs ritz;
    for (int iteration = 0; iteration < n_iterations; ++iteration) {
      for (std::size_t k = 0; k < m; ++k) mesh_.mass().multiply(column(x, k), column(inertia, k));
      x = inertia;
      for (std::size_t k = 0; k < m; ++k) factor_->solve_as_factor(column(x, k));
      const Matrix stiffness = x.transpose() * inertia;  // X^T (K + s Mass) X
      for (std::size_t k = 0; k < m; ++k) mesh_.mass().multiply(column(x, k), column(inertia, k));
      ritz = eigen_pairs(stiffness, x.transpose() * inertia);
      x *= ritz.vectors;
    }
    for (std::size_t k = 0; k < n_modes; ++k) {
      const double squared = ritz.values[index(k)] - shift_;
      found.frequencies.push_back(squared > rigid_share * shift_ ? std::sqrt(squared) : 0.0);
      const std::span<double> phi = column(x, k);
      found.shapes.emplace_back(phi.begin(), phi.end());
    }
  }

  // Each iteration takes nine tenths of the error off, or more.
  void find_response(SlowMotion& found) const {
    Vector load(n_, 0.0), rest(n_);
    mesh_.struck_point().add_to(load, 1.0);
    balance(found, load);
    found.response.assign(n_, 0.0);
    for (int iteration = 0; iteration < n_iterations; ++iteration) {
      stiffness_.multiply(found.response, rest);
      for (std::size_t i = 0; i < n_; ++i) rest[i] = load[i] - rest[i];
      balance(found, rest);
      factor_->solve_as_factor(rest);
      add(found.response, 1.0, rest);
    }
  }

  // Takes from forces what moves the beam rigidly.
  void balance(const SlowMotion& motion, Vector& forces) const {
    Vector inertia(n_);
    for (std::size_t k = 0; k < motion.size() && motion.frequencies[k] == 0.0; ++k) {
      const Vector& phi = motion.shapes[k];
      mesh_.mass().multiply(phi, inertia);
      add(forces, -dot(phi.data(), forces.data(), n_), inertia);
    }
  }

  const BeamMesh& mesh_;
  std::size_t n_;
  double shift_;  // s, 1/s2
  BandedMatrix stiffness_;
  std::optional<BandedMatrix> factor_;  // of K + s Mass
};

}  // namespace

BandedMatrix elastic_stiffness(const BeamMesh& mesh, double bending_stiffness) {
  const std::size_t bandwidth = std::max(mesh.stiffness_bandwidth(), mesh.mass().half_bandwidth());
  BandedMatrix matrix(mesh.n_unknowns(), bandwidth);
  mesh.add_stiffness(Vector(mesh.n_sections(), bending_stiffness), matrix);
  return matrix;
}

// x Mass - K is positive definite above the largest eigenvalue x, and only there.
std::function<bool(double)> above_spectrum(const BeamMesh& mesh, double bending_stiffness) {
  return [&mesh, stiffness = elastic_stiffness(mesh, bending_stiffness)](double x) {
    BandedMatrix shifted(stiffness.size(), stiffness.half_bandwidth());
    shifted.add(-1.0, stiffness);
    shifted.add(x, mesh.mass());
    return shifted.cholesky_factor().has_value();
  };
}

std::optional<SlowMotion> slow_motion(const BeamMesh& mesh, double bending_stiffness,
                                      double first_period, std::size_t n_modes) {
  if (!mesh.modal_stiffness().empty()) return from_unknowns(mesh, n_modes);
  return SlowMotionByBands(mesh, bending_stiffness, first_period).find(n_modes);
}

}  // namespace subimpact
