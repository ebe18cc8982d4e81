#include "system/section/section_events.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <limits>

#include "numerics/bracketed_root.h"
#include "numerics/gauss.h"
#include "numerics/lanes.h"

namespace subimpact {
namespace {

// Entries of an influence below this share of the largest are left out.
constexpr double negligible = 0.01 * std::numeric_limits<double>::epsilon();

}  // namespace

SectionInfluence::SectionInfluence(const BeamMesh& mesh, const BandedSolver& mass_solver)
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

namespace {

constexpr std::size_t n_gauss = 5;

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
    for (std::size_t g = 0; g < n_gauss; ++g) {
      const double s = from + (to - from) * gauss<n_gauss>.points[g];
      add(s, gauss<n_gauss>.weights[g] * (to - from) * length_ * at(s, history, tangent));
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

std::optional<SectionEvent> follow_section(const SectionField& sections, const SectionInStep& in,
                                           SectionPath& path, double own_coupling,
                                           double first_event, double t0, double length) {
  assert(in.leaves >= 0.0 && in.leaves <= in.reverses.value_or(1.0));
  const SectionLaw& law = sections.law();
  const SectionHistory& before = sections.history(in.section);
  const bool flows_on = in.leaves < in.reverses.value_or(1.0);
  if (flows_on) add_own_flow(sections, in, path, own_coupling, length);
  const std::optional<double> reversal = find_reversal(path, in.sense, flows_on ? in.leaves : 0.0);
  if (!flows_on && !reversal) return std::nullopt;
  const double start = flows_on ? in.leaves : *reversal;

  SectionEvent event{in.section, t0 + start * length, {}, 0.0, {}};
  event.tangent = reversal ? sections.stiffness() : law.tangent(before, path.value(1.0));
  const MomentDefect defect(sections, in, path, length);
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
  if (in.branch == nullptr && is_in_window(sections, in.section, farthest)) return std::nullopt;
  SectionHistory after_reversal = before;
  law.commit(after_reversal, farthest);
  integrate(*reversal, 1.0, after_reversal);
  event.reversal = {t0 + *reversal * length, farthest};
  return event;
}

// A cubic exceeds its ends by at most this part of the step times each end's rate.
constexpr double cubic_excess = 4.0 / 27.0;

// The earlier events of a step whose disturbance of a section is followed, the strongest: a step
// with more of them is far too long to be resolved so finely.
constexpr std::size_t most_disturbances = 12;

bool SectionEvents::find_candidates(const SectionMotion& start, const SectionMotion& end,
                                    double length) {
  const double* k0 = start.curvatures.data();
  const double* k1 = end.curvatures.data();
  const double* r0 = start.rates.data();
  const double* r1 = end.rates.data();
  const double* low = sections_.window_low().data();
  const double* high = sections_.window_high().data();
  const double excess = cubic_excess * length;
  candidates_.clear();
  cut_.reset();
  for_each_found(
      sections_.size(),
      [=](std::size_t i) {
        const Lanes a = lanes_at(k0 + i);
        const Lanes b = lanes_at(k1 + i);
        const Lanes s = lanes_at(r0 + i);
        const Lanes e = lanes_at(r1 + i);
        const Lanes margin = excess * ((s > 0.0 ? s : -s) + (e > 0.0 ? e : -e));
        const Lanes upper = a > b ? a : b;
        const Lanes lower = a > b ? b : a;
        return (upper + margin > lanes_at(high + i)) | (lower - margin < lanes_at(low + i));
      },
      [=](std::size_t i) {
        const double margin = excess * (std::abs(r0[i]) + std::abs(r1[i]));
        return std::max(k0[i], k1[i]) + margin > high[i] ||
               std::min(k0[i], k1[i]) - margin < low[i];
      },
      [&](std::size_t i) { consider(i, start, end, length); });
  return !candidates_.empty();
}

void SectionEvents::consider(std::size_t i, const SectionMotion& start, const SectionMotion& end,
                             double length) {
  const double low = sections_.window_low()[i];
  const double high = sections_.window_high()[i];
  const double k1 = end.curvatures[i];
  const double r0 = start.rates[i];
  const double r1 = end.rates[i];
  const HermiteCubic path(start.curvatures[i], r0, k1, r1, length);
  const std::optional<double> back = path.reversed_at();
  if (const SectionBranch* branch = sections_.flowing_branch(i)) {
    const bool stays = branch->sense * r1 > 0.0 && branch->sense * (k1 - branch->limit) <= 0.0;
    if (!back && stays) return;
  } else if (k1 >= low && k1 <= high) {
    if (!back && r0 * r1 >= 0.0) return;  // it stayed between its ends
    if (back) {
      const double farthest = path(path.extrema().first);
      if (farthest >= low && farthest <= high) return;
    }
  } else {
    candidates_.push_back(i);
    return;
  }
  if (back) cut_ = std::min(cut_.value_or(1.0), *back);
  candidates_.push_back(i);
}

void SectionEvents::find(const End& start, const End& end, double t0, double t1,
                         std::vector<SectionEvent>& events) {
  t0_ = t0;
  length_ = t1 - t0;
  events.clear();
  coupling_ = {};
  traced_.clear();
  for (const std::size_t section : candidates_) {
    if (auto candidate = trace(section, start, end)) traced_.push_back(*candidate);
  }
  std::ranges::sort(traced_, {}, [](const Candidate& one) { return one.in.leaves; });
  for (const Candidate& candidate : traced_) follow(candidate, events);
  if (!events.empty()) find_reversals_by_others(start, end, events);
}

// Sections that would flow to the end if undisturbed, but are reversed by these events.
void SectionEvents::find_reversals_by_others(const End& start, const End& end,
                                             std::vector<SectionEvent>& events) {
  for (const SectionField::Flow& flow : sections_.flowing()) {
    const std::size_t i = flow.section;
    const double sense = flow.branch.sense;
    const double slope = length_ * end.motion.rates[i];
    if (sense * slope <= 0.0) continue;
    if (std::ranges::count(candidates_, i) > 0) continue;
    path_.reset({{}, {}, 1.0});
    disturb(i, events);
    if (sense * (slope + path_.change_by_others(1.0).slope) >= 0.0) continue;
    follow({{i, &flow.branch, sense, 1.0, 1.0}, path_of(i, start, end)}, events);
  }
}

HermiteSeptic SectionEvents::path_of(std::size_t section, const End& start, const End& end) const {
  const auto derivatives_at = [&](const End& at) -> HermiteSeptic::End {
    const SectionLoads& loads = at.loads;
    return {at.motion.curvatures[section], at.motion.rates[section],
            influence_.curvature_acceleration(section, loads.weighted_moments, loads.force,
                                              loads.shear_forces),
            influence_.curvature_acceleration(section, loads.weighted_moment_rates,
                                              loads.force_rate, loads.shear_force_rates)};
  };
  return {derivatives_at(start), derivatives_at(end), length_};
}

std::optional<SectionEvents::Candidate> SectionEvents::trace(std::size_t i, const End& start,
                                                             const End& end) const {
  const double k0 = start.motion.curvatures[i];
  const double k1 = end.motion.curvatures[i];
  const double r0 = start.motion.rates[i];
  const double r1 = end.motion.rates[i];
  const double low = sections_.window_low()[i];
  const double high = sections_.window_high()[i];
  const SectionBranch* branch = sections_.flowing_branch(i);
  double sense = r0 > 0.0 ? 1.0 : -1.0;
  if (branch != nullptr) {
    sense = branch->sense;
  } else if (k1 > high || k1 < low) {
    sense = k1 > high ? 1.0 : -1.0;
  }
  const HermiteSeptic path = path_of(i, start, end);
  std::optional<double> reverses;
  double farthest = k1;
  if (sense * r0 > 0.0 && sense * r1 < 0.0) {
    reverses =
        path.extremum(HermiteCubic(sense * k0, sense * r0, sense * k1, sense * r1, length_).peak());
    farthest = path(*reverses);
  }
  double leaves = reverses.value_or(1.0);
  const double edge = branch != nullptr ? branch->limit : sense > 0.0 ? high : low;
  if (sense * (farthest - edge) > 0.0) {
    const HermiteCubic rise(sense * (k0 - edge), sense * r0, sense * (k1 - edge), sense * r1,
                            length_);
    leaves = sense * (k0 - edge) >= 0.0 ? 0.0 : rise.rise(0.0, leaves);
  } else if (branch == nullptr || !reverses) {
    return std::nullopt;
  }
  return Candidate{{i, branch, sense, leaves, reverses}, path};
}

// Adds to path_ what earlier events of the step do to one section.
void SectionEvents::disturb(std::size_t section, const std::vector<SectionEvent>& events) {
  disturbances_.clear();
  for (const SectionEvent& event : events) {
    const double coupling = influence_.curvature_acceleration_at(section, event.section);
    const double from = (event.start - t0_) / length_;
    const double strength = std::abs(coupling * event.defect_moments[1]);
    if (strength == 0.0 || from >= 1.0) continue;
    disturbances_.push_back(
        {strength, DefectResponse(from, 1.0 - from, length_, coupling, event.defect_moments[0],
                                  event.defect_moments[1])});
  }
  if (disturbances_.size() > most_disturbances) {
    const auto kept = disturbances_.begin() + most_disturbances;
    std::ranges::nth_element(disturbances_, kept, std::greater(), &Disturbance::strength);
    disturbances_.erase(kept, disturbances_.end());
  }
  for (const Disturbance& by : disturbances_) path_.add_other(by.response);
}

void SectionEvents::follow(const Candidate& candidate, std::vector<SectionEvent>& events) {
  const std::size_t i = candidate.in.section;
  path_.reset(candidate.path);
  disturb(i, events);
  const double first = events.empty() ? 1.0 : (events.front().start - t0_) / length_;
  const double own_coupling = influence_.curvature_acceleration_at(i, i);
  const std::optional<SectionEvent> event =
      follow_section(sections_, candidate.in, path_, own_coupling, first, t0_, length_);
  if (!event) return;
  const double until = event->reversal ? (event->reversal->time - t0_) / length_ : 1.0;
  const double remaining = t0_ + length_ - event->start;
  const double disturbed = std::abs(path_.change_by_others(until).value) * sections_.stiffness() *
                           remaining * influence_.strength(i);
  if (disturbed > coupling_.velocity) coupling_ = {disturbed, event->start};
  events.push_back(*event);
}

}  // namespace subimpact
