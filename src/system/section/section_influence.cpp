#include "system/section/section_influence.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace subimpact {
namespace {

// Entries of an influence below this share of the largest are left out.
constexpr double negligible = 0.01 * std::numeric_limits<double>::epsilon();

}  // namespace

SectionInfluence::SectionInfluence(const BeamMesh& mesh, const MassSolver& mass_solver)
    : mesh_(mesh), mass_solver_(mass_solver), slot_(mesh.n_sections(), -1) {}

SectionInfluence::Stretch::Stretch(const std::vector<double>& whole) {
  double largest = 0.0;
  for (const double value : whole) largest = std::max(largest, std::abs(value));
  const auto counts = [&](double value) { return std::abs(value) > negligible * largest; };
  const auto begin = std::find_if(whole.begin(), whole.end(), counts);
  const auto end = std::find_if(whole.rbegin(), whole.rend(), counts).base();
  first = static_cast<std::size_t>(begin - whole.begin());
  if (begin < end) values.assign(begin, end);
}

const SectionInfluence::Influence& SectionInfluence::of(std::size_t section) {
  int& slot = slot_[section];
  if (slot < 0) {
    slot = static_cast<int>(known_.size());
    std::vector<double> moments(mesh_.n_sections(), 0.0);
    std::vector<double> accelerations(mesh_.n_unknowns());
    std::vector<double> curvatures(mesh_.n_sections());
    moments[section] = 1.0;
    mesh_.bending_forces(moments, accelerations);
    mass_solver_.solve(accelerations);
    mesh_.curvatures(accelerations, curvatures);
    const double sum = dot(accelerations.data(), accelerations.data(), accelerations.size());
    known_.push_back({Stretch(accelerations), Stretch(curvatures),
                      std::sqrt(sum / static_cast<double>(accelerations.size())),
                      mesh_.struck_point()(accelerations)});
  }
  return known_[static_cast<std::size_t>(slot)];
}

double SectionInfluence::curvature_acceleration(std::size_t section,
                                                const std::vector<double>& weighted_moments,
                                                double force,
                                                const std::vector<double>& shear_forces) {
  const Influence& influence = of(section);
  const Stretch& own = influence.curvatures;
  double sum = dot(own.values.data(), weighted_moments.data() + own.first, own.values.size());
  if (!shear_forces.empty()) {
    const Stretch& moved = influence.accelerations;
    sum -= dot(moved.values.data(), shear_forces.data() + moved.first, moved.values.size());
  }
  return (sum - force * influence.at_strike) / mesh_.section_weights()[section];
}

double SectionInfluence::curvature_acceleration_at(std::size_t other, std::size_t section) {
  const Stretch& own = of(section).curvatures;
  const std::size_t at = other - own.first;  // wraps around if before
  return at < own.values.size() ? own.values[at] : 0.0;
}

void SectionInfluence::add_accelerations(std::size_t section, double moment,
                                         std::vector<double>& accelerations) {
  const Stretch& own = of(section).accelerations;
  double* to = accelerations.data() + own.first;
  for (std::size_t i = 0; i < own.values.size(); ++i) to[i] += moment * own.values[i];
}

}  // namespace subimpact
