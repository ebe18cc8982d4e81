#include "system/beam_flight.h"

#include <Eigen/Core>
#include <algorithm>
#include <limits>

#include "numerics/lanes.h"

namespace subimpact {
namespace {

using Vector = Eigen::Map<Eigen::VectorXd>;
using ConstVector = Eigen::Map<const Eigen::VectorXd>;

Eigen::Map<const Eigen::MatrixXd> matrix(const NaturalModes& modes) {
  const auto n = static_cast<Eigen::Index>(modes.size());
  return {modes.shapes.data(), n, n};
}

ConstVector view(std::span<const double> values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

Vector writable(std::span<double> values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

}  // namespace

BeamFlight::BeamFlight(const StruckBeam& beam)
    : beam_(beam),
      modes_(beam.mesh().natural_modes(beam.sections().stiffness())),
      n_(modes_.size()),
      frequencies_{0.0},  // the striker
      guards_(n_guards() * (n_ + 1), 0.0),
      shape_(n_),
      equilibrium_(n_),
      moments_(beam.sections().size()),
      curvatures_(beam.sections().size()),
      curvature_rates_(beam.sections().size()),
      force_(n_) {
  frequencies_.insert(frequencies_.end(), modes_.frequencies.begin(), modes_.frequencies.end());
  const std::size_t stride = n_ + 1;
  double* indentation = guards_.data() + beam.sections().size() * stride;
  for (std::size_t k = 0; k < n_; ++k) {
    indentation[k + 1] = -beam.mesh().struck_point()(modes_.shape(k));
    if (modes_.frequencies[k] == 0.0) continue;
    beam.mesh().curvatures(modes_.shape(k), curvatures_);
    for (std::size_t i = 0; i < curvatures_.size(); ++i)
      guards_[i * stride + k + 1] = curvatures_[i];
  }
  indentation[0] = 1.0;
}

double BeamFlight::outlook(const State& y) {
  beam_.mesh().curvatures({y.data(), n_}, curvatures_);
  beam_.mesh().curvatures({y.data() + n_ + 1, n_}, curvature_rates_);
  const double* low = beam_.sections().window_low().data();
  const double* high = beam_.sections().window_high().data();
  // The highest rate at which a part of the way to a limit is covered, 1/s.
  double fastest =
      beam_.indentation_rate(y) / (beam_.contact().residual_indentation() - beam_.indentation(y));
  fastest = std::max(fastest, 0.0);
  const double* kappa = curvatures_.data();
  const double* rates = curvature_rates_.data();
  const std::size_t n = curvatures_.size();
  Lanes fastest_lanes{};
  std::size_t i = 0;
  for (; i + n_lanes <= n; i += n_lanes) {
    const Lanes rate = lanes_at(rates + i);
    const Lanes limit = rate > 0.0 ? lanes_at(high + i) : lanes_at(low + i);
    const Lanes speed = rate / (limit - lanes_at(kappa + i));
    fastest_lanes = speed > fastest_lanes ? speed : fastest_lanes;
  }
  for (std::size_t l = 0; l < n_lanes; ++l) fastest = std::max(fastest, fastest_lanes[l]);
  for (; i < n; ++i) {
    fastest = std::max(fastest, rates[i] / ((rates[i] > 0.0 ? high[i] : low[i]) - kappa[i]));
  }
  return 1.0 / fastest;
}

void BeamFlight::enter(const State& y, std::span<double> z, std::span<double> rates,
                       std::span<double> low, std::span<double> high) {
  const BeamMesh& mesh = beam_.mesh();
  const SectionField& sections = beam_.sections();
  // The constant part of -M, and the shape in which the linear part holds it.
  for (std::size_t i = 0; i < moments_.size(); ++i) moments_[i] = sections.resting_moment(i, 0.0);
  mesh.bending_forces(moments_, force_);
  writable(equilibrium_).noalias() = matrix(modes_).transpose() * view(force_);
  for (std::size_t k = 0; k < n_; ++k) {
    const double w = modes_.frequencies[k];
    equilibrium_[k] = w > 0.0 ? equilibrium_[k] / (w * w) : 0.0;
  }
  writable(shape_).noalias() = matrix(modes_) * view(equilibrium_);
  mesh.curvatures(shape_, curvatures_);

  const auto to_modal = [&](std::size_t first, std::span<double> modal) {
    mesh.mass().multiply({y.data() + first, n_}, force_);
    modal[0] = y[first + n_];
    writable(modal.last(n_)).noalias() = matrix(modes_).transpose() * view(force_);
  };
  to_modal(0, z);
  to_modal(n_ + 1, rates);
  for (std::size_t k = 0; k < n_; ++k) z[k + 1] -= equilibrium_[k];
  for (std::size_t i = 0; i < curvatures_.size(); ++i) {
    low[i] = sections.window_low()[i] - curvatures_[i];
    high[i] = sections.window_high()[i] - curvatures_[i];
  }
  low.back() = -std::numeric_limits<double>::infinity();
  high.back() = beam_.contact().residual_indentation() + mesh.struck_point()(shape_);
}

void BeamFlight::leave(std::span<const double> z, std::span<const double> rates, State& y) const {
  y.resize(2 * (n_ + 1));
  const std::span<double> positions{y.data(), n_};
  const std::span<double> velocities{y.data() + n_ + 1, n_};
  writable(positions).noalias() = matrix(modes_) * view(z.last(n_));
  writable(positions) += view(shape_);
  writable(velocities).noalias() = matrix(modes_) * view(rates.last(n_));
  y[n_] = z[0];
  y.back() = rates[0];
}

}  // namespace subimpact
