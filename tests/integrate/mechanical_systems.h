#pragma once

#include <Eigen/Core>

#include "numerics/dense.h"
#include "test_systems.h"

namespace subimpact {

/// Mass q'' = f(q) of known motion, small enough to be written as full matrices.
class KnownSystem : public Known<MechanicalSystem> {
 public:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;

  std::size_t n_positions() const override { return static_cast<std::size_t>(mass_.rows()); }
  Scales scales() const override { return {1.0, 1.0}; }
  void acceleration(std::span<const double> q, std::span<double> a) override {
    write(inverse_ * force_at(read(q)), a);
  }
  void force(std::span<const double> y, std::span<double> result) override {
    write(force_at(read(y.first(n_positions()))), result);
  }
  const SparsityPattern& pattern() const override { return pattern_; }
  void mass_entries(std::span<double> values) const override { write(mass_.reshaped(), values); }
  void stiffness_entries(std::span<const double> y, std::span<double> values) override {
    write(stiffness_at(read(y.first(n_positions()))).reshaped(), values);
  }

 protected:
  explicit KnownSystem(Matrix mass) : mass_(std::move(mass)) {
    const auto [values, vectors] = eigen_pairs(mass_);
    inverse_ = vectors * values.cwiseInverse().asDiagonal() * vectors.transpose();
    const std::size_t n = n_positions();
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = 0; i < n; ++i) pattern_.rows.push_back(i);
      pattern_.column_starts.push_back(pattern_.n_entries());
    }
  }
  virtual Vector force_at(const Vector& q) const = 0;
  virtual Matrix stiffness_at(const Vector& q) const = 0;

  Matrix mass_, inverse_;

 private:
  static Vector read(std::span<const double> q) {
    return Eigen::Map<const Vector>(q.data(), static_cast<Eigen::Index>(q.size()));
  }
  static void write(const Vector& from, std::span<double> to) {
    std::copy(from.begin(), from.end(), to.begin());
  }
  SparsityPattern pattern_;
};

/// Equal elements of a bar between two walls: tridiagonal stiffness and consistent mass, all modes
/// excited.
class ElasticBar final : public KnownSystem {
 public:
  explicit ElasticBar(std::size_t n) : KnownSystem(tridiagonal(n, 2.0 / 3.0, 1.0 / 6.0)) {}

  State exact(double t) const override {
    const std::size_t n = n_positions();
    State y(2 * n, 0.0);
    for (std::size_t k = 1; k <= n; ++k) {
      const double angle = static_cast<double>(k) * std::numbers::pi / static_cast<double>(n + 1);
      const double omega =
          std::sqrt((2.0 - 2.0 * std::cos(angle)) / ((2.0 + std::cos(angle)) / 3.0));
      for (std::size_t i = 0; i < n; ++i) {
        const double shape = std::sin(angle * static_cast<double>(i + 1)) / static_cast<double>(n);
        y[i] += shape * std::cos(omega * t + static_cast<double>(k));
        y[n + i] -= omega * shape * std::sin(omega * t + static_cast<double>(k));
      }
    }
    return y;
  }

 private:
  static Matrix tridiagonal(std::size_t size, double diagonal, double beside) {
    const auto n = static_cast<Eigen::Index>(size);
    Matrix matrix = Matrix::Zero(n, n);
    matrix.diagonal().setConstant(diagonal);
    matrix.diagonal(1).setConstant(beside);
    matrix.diagonal(-1).setConstant(beside);
    return matrix;
  }
  Matrix stiffness_at(const Vector&) const override {
    return tridiagonal(n_positions(), 2.0, -1.0);
  }
  Vector force_at(const Vector& q) const override { return -stiffness_at(q) * q; }
};

/// CurvedMotion under a mass matrix that couples all unknowns: f = Mass a(q).
class CurvedSystem final : public KnownSystem {
 public:
  CurvedSystem()
      : KnownSystem(Eigen::Matrix3d{{2.0, 0.5, -0.3}, {0.5, 1.5, 0.4}, {-0.3, 0.4, 1.0}}) {}
  State exact(double t) const override { return CurvedMotion().exact(t); }

 private:
  // Of the scalar oscillators: s'' = linear s + cubic s^3.
  inline static const Eigen::Vector3d linear{-1.0, 0.0, -1.3};
  inline static const Eigen::Vector3d cubic{-1.0, -1.0, 0.6};
  // Columns of CurvedMotion's rotation.
  inline static const Eigen::Matrix3d mix = Eigen::Matrix3d{{2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0},
                                                            {2.0 / 3.0, 2.0 / 3.0, -1.0 / 3.0},
                                                            {-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0}};

  Vector force_at(const Vector& q) const override {
    const Eigen::Array3d s = (mix.transpose() * q).array();
    const Eigen::Array3d rate = linear.array() * s + cubic.array() * s.cube();
    return mass_ * (mix * rate.matrix());
  }
  Matrix stiffness_at(const Vector& q) const override {
    const Eigen::Array3d s = (mix.transpose() * q).array();
    const Eigen::Array3d slope = linear.array() + 3.0 * cubic.array() * s.square();
    return -mass_ * mix * slope.matrix().asDiagonal() * mix.transpose();
  }
};

/// Independent oscillators of given frequencies and amplitudes, all with unit mass.
class Oscillators final : public KnownSystem {
 public:
  Oscillators(Vector frequencies, Vector amplitudes)
      : KnownSystem(Matrix::Identity(frequencies.size(), frequencies.size())),
        frequencies_(std::move(frequencies)),
        amplitudes_(std::move(amplitudes)) {}
  State exact(double t) const override {
    const std::size_t n = n_positions();
    State y(2 * n);
    for (std::size_t i = 0; i < n; ++i) {
      const double omega = frequencies_(static_cast<Eigen::Index>(i));
      const double amplitude = amplitudes_(static_cast<Eigen::Index>(i));
      y[i] = amplitude * std::cos(omega * t);
      y[n + i] = -omega * amplitude * std::sin(omega * t);
    }
    return y;
  }
  /// Of oscillator i.
  double amplitude(const State& y, std::size_t i) const {
    return std::hypot(y[i], y[n_positions() + i] / frequencies_(static_cast<Eigen::Index>(i)));
  }

 private:
  Vector force_at(const Vector& q) const override { return -stiffness_at(q) * q; }
  Matrix stiffness_at(const Vector&) const override {
    return frequencies_.array().square().matrix().asDiagonal();
  }
  Vector frequencies_, amplitudes_;
};

/// The first step after a restart, which follows `n` steps, over the last one before it.
template <class Method>
double step_after_restart(const Method& method, int n) {
  ElasticBar bar(5);
  const auto integrator = method.with_tolerance(bar, 1e-8);
  integrator->restart(0.0, bar.initial());
  for (int i = 0; i < n; ++i) integrator->step();
  const double before = integrator->time() - integrator->start_time();
  integrator->restart(integrator->time(), State(integrator->state()));
  integrator->step();
  return (integrator->time() - integrator->start_time()) / before;
}

/// A bar of which one function throws at a call.
class ThrowingBar final : public MechanicalSystem {
 public:
  enum class In { acceleration, force, stiffness };
  struct Mishap {
    In place;
  };
  ThrowingBar(In place, int call) : place_(place), calls_left_(call) {}
  std::size_t n_positions() const override { return bar_.n_positions(); }
  Scales scales() const override { return bar_.scales(); }
  void acceleration(std::span<const double> q, std::span<double> a) override {
    count(In::acceleration);
    bar_.acceleration(q, a);
  }
  void force(std::span<const double> q, std::span<double> result) override {
    count(In::force);
    bar_.force(q, result);
  }
  const SparsityPattern& pattern() const override { return bar_.pattern(); }
  void mass_entries(std::span<double> values) const override { bar_.mass_entries(values); }
  void stiffness_entries(std::span<const double> q, std::span<double> values) override {
    count(In::stiffness);
    bar_.stiffness_entries(q, values);
  }
  State initial() const { return bar_.initial(); }

 private:
  void count(In place) {
    if (place == place_ && --calls_left_ == 0) throw Mishap{place};
  }
  ElasticBar bar_{4};
  In place_;
  int calls_left_;
};

/// What the bar throws comes out of a step whole, and the integrator can be used again.
template <class Method>
void expect_mishap(const Method& method, ThrowingBar::In place, int call) {
  ThrowingBar system(place, call);
  const auto integrator = method.with_tolerance(system, 1e-6);
  integrator->restart(0.0, system.initial());
  try {
    for (int i = 0; i < 50; ++i) integrator->step();
    ADD_FAILURE() << "nothing came out";
  } catch (const ThrowingBar::Mishap& mishap) {
    EXPECT_EQ(mishap.place, place);
  }
  integrator->restart(0.0, system.initial());
  integrator->step();
  EXPECT_GT(integrator->time(), 0.0);
}

}  // namespace subimpact
