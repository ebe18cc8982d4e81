#pragma once

#include <algorithm>
#include <vector>

#include "subimpact/model/scene.h"

namespace subimpact {

/// A section as a stack of layers, each with the plain return map
/// sigma = clip(sigma_old + E d_eps, -Y, Y): what the section law's closed forms must add up to.
/// Stresses are those of the half in which a positive curvature pulls.
class LayeredSection {
 public:
  LayeredSection(const Beam& beam, int layers)
      : beam_(beam), layer_thickness_(beam.thickness / layers), stress_(half(layers), 0.0) {}

  void bend_to(double curvature) {
    const double change = curvature - curvature_;
    curvature_ = curvature;
    for (std::size_t k = 0; k < stress_.size(); ++k) {
      const double strain_change = change * height(k);
      const double trial = stress_[k] + beam_.youngs_modulus * strain_change;
      const double next = std::clamp(trial, -beam_.yield_stress, beam_.yield_stress);
      const double flow = (trial - next) / beam_.youngs_modulus;
      plastic_work_ += next * flow * area();
      stress_[k] = next;
    }
  }

  double moment() const {
    double sum = 0.0;
    for (std::size_t k = 0; k < stress_.size(); ++k) sum += stress_[k] * height(k) * area();
    return sum;
  }
  double elastic_energy() const {
    double sum = 0.0;
    for (const double s : stress_) sum += 0.5 * s * s / beam_.youngs_modulus * area();
    return sum;
  }
  double plastic_work() const { return plastic_work_; }
  /// Of the outermost layer on the side away from the striker, where a positive curvature
  /// compresses.
  double outer_stress() const { return -stress_.back(); }

 private:
  static std::size_t half(int layers) { return static_cast<std::size_t>(layers / 2); }
  double height(std::size_t k) const { return (static_cast<double>(k) + 0.5) * layer_thickness_; }
  double area() const { return 2.0 * beam_.width * layer_thickness_; }  // of a pair of layers

  Beam beam_;
  double layer_thickness_;
  std::vector<double> stress_;
  double curvature_ = 0.0, plastic_work_ = 0.0;
};

}  // namespace subimpact
