#include "naive_central_difference.h"

#include <algorithm>
#include <cmath>

namespace subimpact::benchmarks {
namespace {

// Symmetric tridiagonal matrix, factored once by the Thomas algorithm.
class Tridiagonal {
 public:
  Tridiagonal(const std::vector<double>& diagonal, double beside)
      : beside_(beside), inverse_pivot_(diagonal.size()), multiplier_(diagonal.size()) {
    double pivot = diagonal[0];
    for (std::size_t i = 0; i < diagonal.size(); ++i) {
      if (i > 0) pivot = diagonal[i] - beside * multiplier_[i - 1];
      inverse_pivot_[i] = 1.0 / pivot;
      multiplier_[i] = beside / pivot;
    }
  }

  void solve(std::vector<double>& x) const {
    const std::size_t n = x.size();
    x[0] *= inverse_pivot_[0];
    for (std::size_t i = 1; i < n; ++i) x[i] = (x[i] - beside_ * x[i - 1]) * inverse_pivot_[i];
    for (std::size_t i = n - 1; i-- > 0;) x[i] -= multiplier_[i] * x[i + 1];
  }

 private:
  double beside_;
  std::vector<double> inverse_pivot_, multiplier_;
};

// Contact force for an indentation, and the memory of the largest one.
class Contact {
 public:
  explicit Contact(const Scene& scene)
      : stiffness_(4.0 * std::sqrt(2.0 * scene.striker.nose_radius.value()) *
                   scene.beam.youngs_modulus * scene.beam.width / (3.0 * scene.beam.thickness)),
        yield_(scene.beam.yield_stress * scene.beam.thickness / scene.beam.youngs_modulus) {}

  double residual() const { return std::max(largest_ - yield_, 0.0); }

  double force(double indentation) const {
    if (indentation <= residual()) return 0.0;
    const double whole = indentation * std::sqrt(indentation);
    if (indentation <= std::max(largest_, yield_)) {
      return stiffness_ * (whole - residual() * std::sqrt(residual()));
    }
    const double flowing = indentation - yield_;
    return stiffness_ * (whole - flowing * std::sqrt(flowing));
  }

  void remember(double indentation) { largest_ = std::max(largest_, indentation); }

 private:
  double stiffness_;
  double yield_;
  double largest_ = 0.0;
};

// The layers of every cell, and the return map in each of them.
class Sections {
 public:
  Sections(const Beam& beam, std::size_t n_cells, std::size_t n_layers)
      : n_cells_(n_cells),
        youngs_modulus_(beam.youngs_modulus),
        yield_stress_(beam.yield_stress),
        height_(n_layers),
        lever_(n_layers),
        stress_(n_cells * n_layers, 0.0) {
    const double layer_thickness = beam.thickness / static_cast<double>(n_layers);
    for (std::size_t k = 0; k < n_layers; ++k) {
      height_[k] = (static_cast<double>(k) + 0.5) * layer_thickness - 0.5 * beam.thickness;
      lever_[k] = height_[k] * beam.width * layer_thickness;
    }
  }

  // Moments after a change of every cell's curvature, layers in the inner loop.
  void bend_cell_by_cell(const std::vector<double>& change, std::vector<double>& moment) {
    const std::size_t n_layers = height_.size();
    for (std::size_t i = 0; i < n_cells_; ++i) {
      double* stress = stress_.data() + i * n_layers;
      double sum = 0.0;
      for (std::size_t k = 0; k < n_layers; ++k) {
        const double trial = stress[k] - youngs_modulus_ * height_[k] * change[i];
        stress[k] = std::clamp(trial, -yield_stress_, yield_stress_);
        sum += lever_[k] * stress[k];
      }
      moment[i] = sum;
    }
  }

  // The same with the cells in the inner loop. A run uses one of the two throughout.
  void bend_layer_by_layer(const std::vector<double>& change, std::vector<double>& moment) {
    std::fill(moment.begin(), moment.end(), 0.0);
    const double* d = change.data();
    double* m = moment.data();
    for (std::size_t k = 0; k < height_.size(); ++k) {
      double* stress = stress_.data() + k * n_cells_;
      const double stiffness = youngs_modulus_ * height_[k];
      const double lever = lever_[k];
      const double limit = yield_stress_;
#pragma GCC ivdep
      for (std::size_t i = 0; i < n_cells_; ++i) {
        const double trial = stress[i] - stiffness * d[i];
        const double below = trial < limit ? trial : limit;
        stress[i] = below > -limit ? below : -limit;
        m[i] += lever * stress[i];
      }
    }
  }

 private:
  std::size_t n_cells_;
  double youngs_modulus_, yield_stress_;
  std::vector<double> height_;  // of each layer's middle, from -h/2 to h/2
  std::vector<double> lever_;   // moment of 1 Pa in the layer
  std::vector<double> stress_;
};

// Where in the step the gap g passes through zero, by bisection on the cubic through its values and
// rates at the step's ends; a fraction of the step.
double crossing(double g0, double rate0, double g1, double rate1, double step) {
  const double d0 = step * rate0;
  const double d1 = step * rate1;
  const auto cubic = [&](double s) {
    const double r = 1.0 - s;
    return r * r * ((1.0 + 2.0 * s) * g0 + s * d0) + s * s * ((3.0 - 2.0 * s) * g1 - r * d1);
  };
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((cubic(middle) > 0.0) == (g1 > 0.0) ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

std::vector<NaiveSubImpact> naive_central_difference(const Scene& scene,
                                                     const NaiveOptions& options) {
  const Beam& beam = scene.beam;
  const std::size_t n = options.n_cells;
  const std::size_t struck = n / 2;
  const double dt = options.step;
  const double dx = beam.length / static_cast<double>(n);

  const double coupling = beam.rotary_inertia() / dx;
  std::vector<double> diagonal(n, beam.mass_per_length() * dx + 2.0 * coupling);
  diagonal.front() -= coupling;
  diagonal.back() -= coupling;
  const Tridiagonal mass(diagonal, -coupling);

  Sections sections(beam, n, options.n_layers);
  std::vector<double> w(n), v(n), a(n), moment(n), curvature(n), change(n);
  double striker_w = 0.0;
  double striker_v = scene.striker.velocity;
  double striker_a = 0.0;

  Contact contact(scene);
  bool touching = true;
  std::vector<NaiveSubImpact> sub_impacts{{0.0, 0.0}};
  double indentation = 0.0;

  const auto n_steps = static_cast<long>(std::llround(options.end_time / dt));
  for (long step = 0; step < n_steps; ++step) {
    const double rate_before = striker_v - v[struck];
    const double before = indentation;
    for (std::size_t i = 0; i < n; ++i) {
      v[i] += 0.5 * dt * a[i];
      w[i] += dt * v[i];
    }
    striker_v += 0.5 * dt * striker_a;
    striker_w += dt * striker_v;

    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double now = (w[i + 1] - 2.0 * w[i] + w[i - 1]) / (dx * dx);
      change[i] = now - curvature[i];
      curvature[i] = now;
    }
    if (options.layers_outside) {
      sections.bend_layer_by_layer(change, moment);
    } else {
      sections.bend_cell_by_cell(change, moment);
    }

    indentation = striker_w - w[struck];
    const double residual = contact.residual();
    const double force = contact.force(indentation);

    a[0] = (moment[1] - moment[0]) / dx;
    for (std::size_t i = 1; i + 1 < n; ++i) {
      a[i] = (moment[i + 1] - 2.0 * moment[i] + moment[i - 1]) / dx;
    }
    a[n - 1] = (moment[n - 2] - moment[n - 1]) / dx;
    a[struck] += force;
    mass.solve(a);
    striker_a = -force / scene.striker.mass;

    for (std::size_t i = 0; i < n; ++i) v[i] += 0.5 * dt * a[i];
    striker_v += 0.5 * dt * striker_a;

    const bool touches = indentation > residual;
    if (touches != touching) {
      const double part = crossing(before - residual, rate_before, indentation - residual,
                                   striker_v - v[struck], dt);
      const double time = (static_cast<double>(step) + part) * dt;
      if (touches) {
        sub_impacts.push_back({time, 0.0});
      } else {
        sub_impacts.back().end = time;
      }
      touching = touches;
    }
    contact.remember(indentation);
  }
  return sub_impacts;
}

}  // namespace subimpact::benchmarks
