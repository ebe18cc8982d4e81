#include "subimpact/model/contact/contact_law.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/rules.h"
#include "numerics/bracketed_root.h"
#include "numerics/gauss.h"

namespace subimpact {
namespace {

constexpr int n_histories = 8;
constexpr int n_panels = 16;   // of the integral of what may not be smooth
constexpr int n_samples = 64;  // of a force that must push
constexpr int most_bisections = 40;
constexpr double tolerance = 1e-3;
constexpr double slope_tolerance = 2e-2;  // a slope may begin as the square root of the indentation

// By Gauss's rule on panels in s, x = from + (to - from) s^2: exact for powers of half an integer
// of the distance from `from`, where forces change fastest.
template <class F>
double integral(F f, double from, double to, int panels = 4) {
  double sum = 0.0;
  for (int panel = 0; panel < panels; ++panel) {
    for (std::size_t i = 0; i < gauss<5>.points.size(); ++i) {
      const double s = (panel + gauss<5>.points[i]) / panels;
      sum += gauss<5>.weights[i] * 2.0 * s * f(from + (to - from) * s * s);
    }
  }
  return (to - from) * sum / panels;
}

// The rules one by one, each for indentations up to `depth`.
class Rules {
 public:
  Rules(const ContactLaw& law, double depth) : law_(law), depth_(depth) {
    first_yield_ = law.yield_threshold({});
    force_ = std::abs(law.contact_force({}, depth));
    energy_ = force_ * depth;
    require(depth > 0.0 && std::isfinite(energy_) && energy_ > 0.0,
            "its force at an indentation of {:.4g} m is {:.4g} N, which is not above zero and "
            "finite",
            depth, law.contact_force({}, depth));
  }

  void check_history(double largest) {
    const ContactHistory history{largest};
    const double residual = law_.residual_indentation(history);
    const double threshold = law_.yield_threshold(history);
    require(residual >= 0.0 && residual <= threshold,
            "its residual indentation {:.4g} m is not between 0 and its yield threshold {:.4g} m, "
            "{}",
            residual, threshold, words(history));
    require(residual >= last_residual_ && threshold >= last_threshold_,
            "its residual indentation or its yield threshold falls while the largest indentation "
            "grows, {}",
            words(history));
    last_residual_ = residual;
    last_threshold_ = threshold;
    const double end = std::min(threshold, depth_);
    if (!(end > residual)) return;
    check_same_force(law_.force(history, residual), 0.0, residual, "at the residual indentation");
    if (threshold < depth_) {
      check_same_force(law_.force(history, end), law_.plastic_force(end), end,
                       "where yielding begins");
    }
    const auto force = [&](double x) { return law_.force(history, x); };
    const auto slope = [&](double x) { return law_.slope(history, x); };
    check_branch("elastic", residual, end, force, slope,
                 law_.recoverable_energy(history, end) - law_.recoverable_energy(history, residual),
                 history);
  }

  void check_plastic() {
    if (!(first_yield_ < depth_)) return;
    const auto force = [this](double x) { return law_.plastic_force(x); };
    const auto slope = [this](double x) { return law_.plastic_slope(x); };
    check_branch("plastic", first_yield_, depth_, force, slope,
                 law_.work_up_to(depth_) - law_.work_up_to(first_yield_), {});
    double dissipated = law_.dissipated_energy({first_yield_});
    for (int i = 1; i <= n_histories; ++i) {
      const double x = first_yield_ + (depth_ - first_yield_) * i / n_histories;
      check_same_force(law_.force({x}, x), law_.plastic_force(x), x, "where unloading begins");
      const double more = law_.dissipated_energy({x});
      require(more >= dissipated - tolerance * energy_,
              "its dissipated energy falls while the largest indentation grows");
      dissipated = more;
    }
  }

 private:
  static std::string words(ContactHistory history) {
    return fmt::format("where the largest indentation was {:.4g} m", history.max_indentation);
  }

  template <class Force, class Slope>
  void check_branch(const char* branch, double from, double to, Force force, Slope slope,
                    double energy, ContactHistory history) const {
    double before = from;
    for (int i = 1; i <= n_samples; ++i) {
      const double x = from + (to - from) * i / n_samples;
      require(force(x) >= -tolerance * force_,
              "its {} force at {:.4g} m is {:.4g} N, {}: contact pushes", branch, x, force(x),
              words(history));
      check_continuity(branch, std::exchange(before, x), x, force, history);
    }
    const double work = integral(force, from, to, n_panels);
    require(std::abs(work - energy) <= tolerance * energy_,
            "from {:.4g} to {:.4g} m the work of its {} force is {:.4g} J, but its energies grow "
            "by {:.4g} J, {}",
            from, to, branch, work, energy, words(history));
    const double growth = force(to) - force(from);
    const double rise = integral(slope, from, to, n_panels);
    require(std::abs(rise - growth) <= slope_tolerance * force_,
            "from {:.4g} to {:.4g} m its {} force grows by {:.4g} N, but the integral of its slope "
            "is {:.4g} N, {}",
            from, to, branch, growth, rise, words(history));
  }

  // Bisects towards the larger change of the force.
  template <class Force>
  void check_continuity(const char* branch, double a, double b, Force force,
                        ContactHistory history) const {
    double at_a = force(a), at_b = force(b);
    for (int i = 0; i < most_bisections && std::abs(at_b - at_a) > tolerance * force_; ++i) {
      const double x = 0.5 * (a + b), here = force(x);
      const bool is_first = std::abs(here - at_a) > std::abs(at_b - here);
      (is_first ? b : a) = x;
      (is_first ? at_b : at_a) = here;
    }
    require(std::abs(at_b - at_a) <= tolerance * force_,
            "its {} force jumps from {:.4g} to {:.4g} N at {:.6g} m, {}", branch, at_a, at_b, b,
            words(history));
  }

  void check_same_force(double one, double other, double x, const char* place) const {
    require(std::abs(one - other) <= tolerance * force_,
            "its force jumps from {:.4g} to {:.4g} N {}, at {:.4g} m", one, other, place, x);
  }

  const ContactLaw& law_;
  double depth_;
  double first_yield_;
  double force_, energy_;  // scales, N and J
  double last_residual_ = 0.0, last_threshold_ = 0.0;
};

template <class F>
double difference(F force, double x, double size) {
  const double h = 1e-5 * std::max({std::abs(x), size, 1e-7});
  return (force(x + h) - force(x - h)) / (2.0 * h);
}

}  // namespace

ContactScales ContactLaw::scales() const {
  constexpr double um = 1e-6;
  const double force_there = contact_force({}, um);
  const double exponent = std::max(std::log2(contact_force({}, 2.0 * um) / force_there), 1.0);
  return {force_there / std::pow(um, exponent), exponent};
}

double ContactLaw::slope(ContactHistory history, double indentation) const {
  return difference([&](double x) { return force(history, x); }, indentation,
                    history.max_indentation);
}

double ContactLaw::plastic_slope(double indentation) const {
  return difference([&](double x) { return plastic_force(x); }, indentation, 0.0);
}

double ContactLaw::recoverable_energy(ContactHistory history, double indentation) const {
  const double residual = residual_indentation(history);
  if (!(indentation > residual)) return 0.0;
  return integral([&](double x) { return force(history, x); }, residual, indentation);
}

double ContactLaw::dissipated_energy(ContactHistory history) const {
  const double reached = history.max_indentation, first_yield = yield_threshold({});
  if (!(reached > first_yield)) return 0.0;
  return integral([&](double x) { return force({}, x); }, 0.0, first_yield) +
         integral([&](double x) { return plastic_force(x); }, first_yield, reached) -
         recoverable_energy(history, reached);
}

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
  return branch == ContactBranch::elastic ? force(history, indentation)
                                          : plastic_force(indentation);
}

double ContactLaw::branch_slope(ContactBranch branch, ContactHistory history,
                                double indentation) const {
  if (branch == ContactBranch::separated) return 0.0;
  return branch == ContactBranch::elastic ? slope(history, indentation)
                                          : plastic_slope(indentation);
}

double ContactLaw::indentation_at(double energy) const {
  constexpr double rounding = 1e-9;
  constexpr int most_doublings = 200;
  // Exact for a power law without yielding.
  const auto [stiffness, exponent] = scales();
  const double of_power_law =
      std::pow((exponent + 1.0) * energy / stiffness, 1.0 / (exponent + 1.0));
  const auto too_little = [&](double indentation) { return work_up_to(indentation) < energy; };
  double low = of_power_law;
  double high = 2.0 * of_power_law;
  if (!too_little(low)) {
    if (!(work_up_to(low) > (1.0 + rounding) * energy)) return low;
    for (int i = 0; i < most_doublings && !too_little(low); ++i) low *= 0.5;
    high = 2.0 * low;
  }
  for (int i = 0; i < most_doublings && too_little(high); ++i) high *= 2.0;
  return root_in([&](double x) { return work_up_to(x) - energy; }, low, high);
}

std::optional<std::string> broken_rule(const ContactLaw& law, double largest_indentation) {
  try {
    Rules rules(law, largest_indentation);
    for (int i = 0; i <= n_histories; ++i) {
      rules.check_history(largest_indentation * i / n_histories);
    }
    rules.check_plastic();
  } catch (const BrokenRule& broken) {
    return fmt::format("the contact law \"{}\" breaks a rule of ContactLaw: {}", law.name(),
                       broken.what());
  }
  return std::nullopt;
}

}  // namespace subimpact
