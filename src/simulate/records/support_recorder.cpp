#include "simulate/records/support_recorder.h"

#include <algorithm>
#include <tuple>

#include "numerics/hermite.h"

namespace subimpact {
namespace {

// Forces below this part of the run's largest are none: the end of a beam trembles before waves
// arrive there.
constexpr double least_force = 1e-9;

// Where f has its maximum in [low, high], if it has one local maximum there: by golden section.
template <class Function>
double maximum_in(const Function& f, double low, double high) {
  constexpr double golden = 0.6180339887498949;
  constexpr int n_sections = 24;
  for (int i = 0; i < n_sections; ++i) {
    const double a = high - golden * (high - low);
    const double b = low + golden * (high - low);
    (f(a) < f(b) ? low : high) = f(a) < f(b) ? a : b;
  }
  return 0.5 * (low + high);
}

}  // namespace

std::pair<double, double> largest_force(const ObservedStep& step, const StruckBeam& beam,
                                        std::size_t contact, double so_far, State& state) {
  const auto [t0, t1, lambda0, rate0, lambda1, rate1] =
      contact == 0 ? step.indentation()
                   : indentation_step(beam, contact, step.t0(), step.t1(), step.y0(), step.y1());
  const double h = step.length();
  if (!(h > 0.0)) return {t0, 0.0};
  const HermiteCubic path(lambda0, rate0, lambda1, rate1, h);
  const ContactState& law = beam.contact(contact);
  const auto force = [&](double s) { return law.force(path(s), path.slope(s) / h); };
  double peak = std::max(force(0.0), force(1.0));
  double time = force(0.0) > force(1.0) ? t0 : t1;
  const double at = maximum_in(force, 0.0, 1.0);
  // The force is stationary there, so that its time need not be exact.
  if (force(at) > peak && force(at) > (1.0 - 1e-3) * so_far) {
    step.state_at(t0 + at * h, state);
    const double there =
        law.force(beam.indentation(state, contact), beam.indentation_rate(state, contact));
    if (there > peak) {
      time = t0 + at * h;
      peak = there;
    }
  }
  return {time, peak};
}

void SupportRecorder::on_step(const ObservedStep& step, const StruckBeam& beam, Result& result) {
  for (std::size_t i = 0; i < open_.size(); ++i) {
    const LiftingSupport& support = beam.supports()[i];
    if (!support.contact.is_closed()) continue;
    auto& all = result.support_contacts;
    if (!open_[i]) {
      open_[i] = Open{all.size(), support.impulse};
      all.push_back({support.spring, support.position, step.t0(), {}, 0.0, 0.0});
    }
    double& peak = all[open_[i]->contact].peak_force;
    peak = std::max(peak, largest_force(step, beam, i + 1, peak, state_).second);
  }
}

void SupportRecorder::lift(const Transition& event, const StruckBeam& beam, Result& result) {
  for (std::size_t i = 0; i < open_.size(); ++i) {
    if (beam.supports()[i].spring != event.spring || !open_[i]) continue;
    SupportContact& contact = result.support_contacts[open_[i]->contact];
    contact.end = event.time;
    contact.impulse = beam.supports()[i].impulse - open_[i]->impulse;
    open_[i].reset();
  }
}

void SupportRecorder::finish(const StruckBeam& beam, double length, Result& result) {
  auto& all = result.support_contacts;
  double largest = result.max_force;
  for (const SupportContact& contact : all) largest = std::max(largest, contact.peak_force);
  for (std::size_t i = 0; i < open_.size(); ++i) {
    if (!open_[i]) continue;
    all[open_[i]->contact].impulse = beam.supports()[i].impulse - open_[i]->impulse;
  }
  const auto none = std::stable_partition(all.begin(), all.end(), [&](const SupportContact& s) {
    return s.peak_force >= least_force * largest;
  });
  std::erase_if(result.transitions, [&](const Transition& event) {
    return event.spring && std::any_of(none, all.end(), [&](const SupportContact& contact) {
             return contact.spring == *event.spring &&
                    (contact.start == event.time || contact.end == event.time);
           });
  });
  all.erase(none, all.end());
  if (beam.mesh().symmetric()) {
    for (std::size_t i = all.size(); i-- > 0;) {
      if (all[i].position == 0.5 * length) continue;
      all.push_back(all[i]);
      all.back().position = length - all[i].position;
    }
  }
  std::ranges::sort(all, {}, [](const SupportContact& contact) {
    return std::tuple(contact.start, contact.position);
  });
}

}  // namespace subimpact
