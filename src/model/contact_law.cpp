#include "subimpact/model/contact_law.h"

#include <cmath>

#include "numerics/bracketed_root.h"

namespace subimpact {
namespace {

// The work that a contact on its first loading takes up to an indentation, J.
double work_up_to(const ContactLaw& law, double indentation) {
  const ContactHistory reached{indentation};
  return law.recoverable_energy(reached, indentation) + law.dissipated_energy(reached);
}

}  // namespace

ContactBranch ContactLaw::branch(ContactHistory history, double indentation) const {
  if (indentation <= residual_indentation(history)) return ContactBranch::separated;
  if (indentation <= yield_threshold(history)) return ContactBranch::elastic;
  return ContactBranch::plastic;
}

ContactBranch ContactLaw::first_branch(ContactHistory history) const {
  return yield_threshold(history) > residual_indentation(history) ? ContactBranch::elastic
                                                                  : ContactBranch::plastic;
}

double ContactLaw::branch_force(ContactBranch branch, ContactHistory history,
                                double indentation) const {
  if (branch == ContactBranch::separated) return 0.0;
  return branch == ContactBranch::elastic ? elastic_force(history, indentation)
                                          : plastic_force(indentation);
}

double ContactLaw::branch_slope(ContactBranch branch, ContactHistory history,
                                double indentation) const {
  if (branch == ContactBranch::separated) return 0.0;
  return branch == ContactBranch::elastic ? elastic_slope(history, indentation)
                                          : plastic_slope(indentation);
}

double ContactLaw::indentation_at(double energy) const {
  constexpr double rounding = 1e-9;
  constexpr int most_doublings = 200;
  // Exact for a power law without yielding.
  const auto [stiffness, exponent] = scales();
  const double of_power_law =
      std::pow((exponent + 1.0) * energy / stiffness, 1.0 / (exponent + 1.0));
  const auto too_little = [&](double indentation) {
    return work_up_to(*this, indentation) < energy;
  };
  double low = of_power_law;
  double high = 2.0 * of_power_law;
  if (!too_little(low)) {
    if (!(work_up_to(*this, low) > (1.0 + rounding) * energy)) return low;
    for (int i = 0; i < most_doublings && !too_little(low); ++i) low *= 0.5;
    high = 2.0 * low;
  }
  for (int i = 0; i < most_doublings && too_little(high); ++i) high *= 2.0;
  return root_in([&](double x) { return work_up_to(*this, x) - energy; }, low, high);
}

}  // namespace subimpact
