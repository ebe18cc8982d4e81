#include "system/section_event.h"

#include <cassert>

#include "numerics/bracketed_root.h"

namespace subimpact {
namespace {

// Gauss' rule of five points on [0, 1].
constexpr std::array<double, 5> gauss_points{0.046910077030668, 0.2307653449471585, 0.5,
                                             0.7692346550528415, 0.953089922969332};
constexpr std::array<double, 5> gauss_weights{0.1184634425280945, 0.239314335249683,
                                              0.2844444444444444, 0.239314335249683,
                                              0.1184634425280945};

// The defect of a section's moment along its path, for a history and a tangent of its own.
class MomentDefect {
 public:
  MomentDefect(const SectionField& sections, const SectionInStep& in, const SectionPath& path,
               double length)
      : sections_(sections), in_(in), path_(path), length_(length) {}

  // Calls add(s, d ds) at the points of a quadrature over a stretch of the step.
  template <class Add>
  void integrate(double from, double to, const SectionHistory& history, double tangent,
                 Add add) const {
    for (std::size_t g = 0; g < gauss_points.size(); ++g) {
      const double s = from + (to - from) * gauss_points[g];
      add(s, gauss_weights[g] * (to - from) * length_ * at(s, history, tangent));
    }
  }

 private:
  double at(double s, const SectionHistory& history, double tangent) const {
    const SectionLaw& law = sections_.law();
    const double kappa = path_.undisturbed(s);
    const double change = path_.change(s).value;
    const double piece = in_.branch != nullptr ? law.moment_on(*in_.branch, kappa)
                                               : sections_.resting_moment(in_.section, kappa);
    return law.moment(history, kappa + change) - tangent * change - piece;
  }

  const SectionField& sections_;
  const SectionInStep& in_;
  const SectionPath& path_;
  double length_;
};

// The section's own flow on its undisturbed path, as a change of that path.
void add_own_flow(const SectionField& sections, const SectionInStep& in, SectionPath& path,
                  double own_coupling, double length) {
  const double end = in.reverses.value_or(1.0);
  const SectionHistory& history = sections.history(in.section);
  const double tangent = sections.law().tangent(history, path.undisturbed(end));
  double amount = 0.0;
  double next_amount = 0.0;
  MomentDefect(sections, in, path, length)
      .integrate(in.leaves, end, history, tangent, [&](double s, double part) {
        amount += part;
        next_amount += (end - s) * length * part;
      });
  if (next_amount == 0.0) return;
  path.set_own({in.leaves, end - in.leaves, length, own_coupling, amount, next_amount});
}

// When the path, no sooner than at `begin`, reverses.
std::optional<double> find_reversal(const SectionPath& path, double sense, double begin) {
  const auto speed = [&](double s) { return sense * path.slope(s); };
  if (!(speed(1.0) < 0.0)) return std::nullopt;
  return speed(begin) > 0.0 ? root_in(speed, begin, 1.0) : begin;
}

bool is_in_window(const SectionField& sections, std::size_t section, double curvature) {
  return curvature >= sections.window_low()[section] &&
         curvature <= sections.window_high()[section];
}

}  // namespace

std::optional<SectionEvent> SectionFollower::follow(const SectionInStep& in, SectionPath& path,
                                                    double own_coupling, double first_event,
                                                    double t0, double length) {
  assert(in.leaves >= 0.0 && in.leaves <= in.reverses.value_or(1.0));
  const SectionLaw& law = sections_.law();
  const SectionHistory& before = sections_.history(in.section);
  const bool flows_on = in.leaves < in.reverses.value_or(1.0);
  if (flows_on) add_own_flow(sections_, in, path, own_coupling, length);
  const std::optional<double> reversal = find_reversal(path, in.sense, flows_on ? in.leaves : 0.0);
  if (!flows_on && !reversal) return std::nullopt;
  const double start = flows_on ? in.leaves : *reversal;

  SectionEvent event{in.section, t0 + start * length, {}, 0.0, {}};
  event.tangent = reversal ? sections_.stiffness() : law.tangent(before, path.value(1.0));
  const MomentDefect defect(sections_, in, path, length);
  const auto integrate = [&](double from, double to, const SectionHistory& history) {
    if (!(from < to)) return;
    defect.integrate(from, to, history, event.tangent, [&](double s, double part) {
      for (std::size_t k = 0; k < event.defect_moments.size(); ++k) {
        event.defect_moments[k] += part;
        part *= (1.0 - s) * length / static_cast<double>(k + 1);
      }
    });
  };
  // Disturbed by earlier events it answered with another tangent until its own.
  integrate(first_event, start, before);
  integrate(start, reversal.value_or(1.0), before);
  if (!reversal) return event;

  path.stop_own_at(*reversal);
  const double farthest = path.value(*reversal);
  // Disturbed by earlier events it may have stayed in its window.
  if (in.branch == nullptr && is_in_window(sections_, in.section, farthest)) return std::nullopt;
  after_reversal_ = before;
  law.commit(after_reversal_, farthest);
  integrate(*reversal, 1.0, after_reversal_);
  event.reversal = {t0 + *reversal * length, farthest};
  return event;
}

}  // namespace subimpact
