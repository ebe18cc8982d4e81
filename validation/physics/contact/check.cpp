// The contact law against the bed of columns that it sums, each column with its own memory.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "model/contact/contact_laws.h"
#include "outcome.h"

namespace subimpact::validation {
namespace {

/// Columns along one half of the contact under the cylinder lambda - s^2/(2R).
class Columns {
 public:
  Columns(const Scene& scene, std::size_t n, double deepest)
      : scene_(scene),
        spacing_(std::sqrt(2.0 * scene.striker.nose_radius.value() * deepest) /
                 static_cast<double>(n)),
        flowed_(n, 0.0) {}

  double press(double indentation) {
    const Beam& beam = scene_.beam;
    const double modulus = beam.youngs_modulus / beam.thickness;
    double sum = 0.0;
    for (std::size_t i = 0; i < flowed_.size(); ++i) {
      const double s = (static_cast<double>(i) + 0.5) * spacing_;
      const double pressed = indentation - s * s / (2.0 * *scene_.striker.nose_radius);
      double stress = modulus * (pressed - flowed_[i]);
      if (stress > beam.yield_stress) {
        flowed_[i] += (stress - beam.yield_stress) / modulus;
        stress = beam.yield_stress;
      }
      sum += std::max(stress, 0.0);
    }
    return 2.0 * beam.width * spacing_ * sum;
  }

 private:
  Scene scene_;
  double spacing_;
  std::vector<double> flowed_;
};

// Largest difference over a walk between random turning points, of the largest force.
double difference(const Scene& scene, std::size_t n_columns) {
  const auto law_of_scene = make_contact_law(scene);
  const ContactLaw& law = *law_of_scene;
  const double deepest = 12.0 * law.yield_threshold({});
  Columns columns(scene, n_columns, deepest);
  ContactHistory history;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> turn(0.0, deepest);
  double at = 0.0, worst = 0.0, largest = 0.0;
  for (int k = 0; k < 40; ++k) {
    const double next = turn(random);
    for (int i = 1; i <= 50; ++i) {
      const double lambda = at + (next - at) * i / 50.0;
      const double force = law.contact_force(history, lambda);
      history = law.commit(history, lambda);
      worst = std::max(worst, std::abs(force - columns.press(lambda)));
      largest = std::max(largest, force);
    }
    at = next;
  }
  return worst / largest;
}

}  // namespace

Outcome check_contact() {
  const Scene scene = case_of("contact").scene;
  const auto law_of_scene = make_contact_law(scene);
  const ContactLaw& law = *law_of_scene;
  Outcome outcome{"sum over columns", {}, {}};
  outcome.rows = {
      {"stiffness K, N/m^1.5", 2.948976e10, law.scales().stiffness, Bound::relative, 2e-7},
      {"yield indentation, mm", 1.56337e-2, 1e3 * law.yield_threshold({}), Bound::relative, 3e-6},
      {"force at first yield, N", 1822.90, law.contact_force({}, law.yield_threshold({})),
       Bound::absolute, 0.005}};
  const double coarse = difference(scene, 1000);
  const double fine = difference(scene, 4000);
  outcome.rows.push_back({"largest difference from 1000 columns, of the largest force", 1e-4,
                          coarse, Bound::within, 0});
  outcome.rows.push_back({"order in the number of columns", 2.0,
                          std::log(coarse / fine) / std::log(4.0), Bound::absolute, 0.2});
  return outcome;
}

}  // namespace subimpact::validation
