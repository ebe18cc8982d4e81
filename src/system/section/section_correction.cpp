#include "system/section/section_correction.h"

#include <cassert>
#include <cmath>

#include "numerics/hermite.h"

namespace subimpact {
namespace {

// A step that must be cut ends after its first event, by this part of what seems tolerable.
constexpr double cut_safety = 0.8;
// The coupling of events is followed to first order. This share of the coupling is assumed to
// remain: with it steps of the paper's beam at rtol 1e-11 are off by 0.7 of the tolerance (root
// mean square), without it single ones by 600 times the tolerance.
constexpr double coupling_left = 0.03;
// Steps are not cut shorter than this, in radians of the highest frequency: in a very short step
// curvatures reverse by rounding, and a step that ends where a section begins to flow may end
// before that by rounding, the next one too.
constexpr double shortest_cut = 1e-3;

bool has_other_forces(const StruckBeam& beam) {
  return !beam.loads().is_empty() || beam.tension() != nullptr || !beam.supports().empty();
}

#ifndef NDEBUG
bool is_committed(const StruckBeam& beam, const State& y) {
  const std::size_t section = beam.mesh().struck_section();
  SectionMotion motion(beam.sections().size());  // as at the commit, to the last digit
  beam.read_motion(y, motion);
  const double kappa = motion.curvatures[section];
  const double committed = beam.committed_motion().curvatures[section];
  return std::abs(kappa - committed) <= 1e-9 * (std::abs(kappa) + std::abs(committed)) + 1e-12;
}
#endif

}  // namespace

void SectionCorrection::add_to(State& y) const {
  if (events.empty()) return;
  const std::size_t n = position_change.size();
  for (std::size_t i = 0; i < n; ++i) {
    y[i] += position_change[i];
    y[n + 1 + i] += velocity_change[i];
  }
}

SectionField SectionCorrection::reversed(const SectionField& sections) const {
  SectionField after = sections;
  for (const SectionEvent& event : events) {
    if (event.reversal) after.commit_reversal(event.section, event.reversal->curvature);
  }
  return after;
}

SectionCorrector::SectionCorrector(const StruckBeam& beam, double tolerance)
    : beam_(beam),
      tolerance_(tolerance),
      shortest_step_(shortest_cut / beam.highest_frequency()),
      influence_(beam.mesh(), beam.mass_solver()),
      finder_(beam.sections(), influence_),
      end_(beam.sections().size()),
      start_loads_(beam.mesh(), has_other_forces(beam)),
      end_loads_(beam.mesh(), has_other_forces(beam)),
      curvatures_(beam.sections().size()),
      moments_(beam.sections().size()),
      forces_(beam.mesh().n_unknowns()) {}

void SectionCorrector::correct(const StepEnds& step, SectionCorrection& correction) {
  correction.events.clear();
  correction.valid_until = step.t1;
  if (step.event_free || beam_.section_evaluation() != Evaluation::smooth ||
      !beam_.sections().can_yield()) {
    return;
  }
  assert(is_committed(beam_, step.y0));
  const SectionMotion& start = beam_.committed_motion();
  beam_.read_motion(step.y1, end_);
  if (!finder_.find_candidates(start, end_, step.length())) return;
  if (finder_.cut() && step.length() > shortest_step_) {
    correction.valid_until = cut_at(step.t0 + *finder_.cut() * step.length(), step);
    return;
  }
  read_loads(step.t0, step.y0, start, start_loads_);
  read_loads(step.t1, step.y1, end_, end_loads_);
  finder_.find({start, start_loads_}, {end_, end_loads_}, step.t0, step.t1, correction.events);
  if (correction.events.empty()) return;
  read_response(step, correction);
  const SectionEvents::Coupling& coupling = finder_.coupling();
  if (step.length() > shortest_step_ && coupling_left * coupling.velocity > tolerance_ &&
      coupling.time > step.t0) {
    correction.valid_until = cut_at(coupling.time, step);
  }
}

void SectionCorrector::read_response(const StepEnds& step, SectionCorrection& correction) {
  const std::vector<SectionEvent>& events = correction.events;
  std::size_t last = 0;
  while (last + 2 < SectionEvent::most_terms && bound_of_term(events, last + 1) > tolerance_) {
    ++last;
  }
  sum_terms(events, 0, last, correction.velocity_change);
  sum_terms(events, 1, last, correction.position_change);
  const double left_out = bound_of_term(events, last + 1);
  if (left_out <= tolerance_) return;
  double start = step.t1;
  for (const SectionEvent& event : events) start = std::min(start, event.start);
  // The term grows as this power of the time since the event, or faster.
  const double power = static_cast<double>(2 * (last + 1) + 3);
  const double tolerable = (step.t1 - start) * std::pow(tolerance_ / left_out, 1.0 / power);
  correction.valid_until = cut_at(std::max(start, step.t0) + cut_safety * tolerable, step);
}

void SectionCorrector::read_loads(double t, const State& y, const SectionMotion& motion,
                                  SectionLoads& loads) {
  const std::span<const double> weights = beam_.mesh().section_weights();
  beam_.sections().smooth_moments(motion.curvatures, loads.weighted_moments);
  linear_moments(motion.rates, motion.curvatures, loads.weighted_moment_rates);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    loads.weighted_moments[i] *= weights[i];
    loads.weighted_moment_rates[i] *= weights[i];
  }
  const ContactState& contact = beam_.contact();
  const double indentation = beam_.indentation(y);
  loads.force = contact.force(indentation);
  loads.force_rate =
      contact.is_closed() ? contact.slope(indentation) * beam_.indentation_rate(y) : 0.0;
  std::fill(loads.shear_forces.begin(), loads.shear_forces.end(), 0.0);
  std::fill(loads.shear_force_rates.begin(), loads.shear_force_rates.end(), 0.0);
  beam_.mesh().add_shear_forces(beam_.beam_positions(y), loads.shear_forces);
  beam_.mesh().add_shear_forces(beam_.beam_velocities(y), loads.shear_force_rates);
  if (const Tension* tension = beam_.tension()) {
    tension->add_to(loads.shear_forces, beam_.beam_positions(y));
    tension->add_rate_to(loads.shear_force_rates, beam_.beam_positions(y),
                         beam_.beam_velocities(y));
  }
  for (std::size_t i = 1; i < beam_.n_contacts(); ++i) {
    const LiftingSupport& support = beam_.supports()[i - 1];
    if (!support.contact.is_closed()) continue;
    const double depth = beam_.indentation(y, i), rate = beam_.indentation_rate(y, i);
    support.approach.add_to(loads.shear_forces, -support.copies * support.contact.force(depth));
    support.approach.add_to(loads.shear_force_rates,
                            -support.copies * support.contact.slope(depth) * rate);
  }
  if (beam_.loads().is_empty()) return;
  beam_.loads().add_to(loads.shear_forces, t);
  for (std::size_t i = 0; i < loads.shear_force_rates.size(); ++i) {
    loads.shear_force_rates[i] += beam_.loads().rate()[i];
  }
}

void SectionCorrector::linear_moments(std::span<const double> changes,
                                      std::span<const double> curvatures,
                                      std::span<double> moments) const {
  const SectionField& sections = beam_.sections();
  for (std::size_t i = 0; i < moments.size(); ++i) moments[i] = sections.stiffness() * changes[i];
  for (const SectionField::Flow& flow : sections.flowing()) {
    const std::size_t i = flow.section;
    moments[i] = sections.law().tangent_on(flow.branch, curvatures[i]) * changes[i];
  }
}

void SectionCorrector::sum_terms(const std::vector<SectionEvent>& events, std::size_t order,
                                 std::size_t last, std::vector<double>& sum) {
  sum.assign(beam_.mesh().n_unknowns(), 0.0);
  for (std::size_t k = last + 1; k-- > 0;) {
    if (k < last) {
      beam_.mesh().curvatures(sum, curvatures_);
      linear_moments(curvatures_, end_.curvatures, moments_);
      for (const SectionEvent& event : events) {
        moments_[event.section] = event.tangent * curvatures_[event.section];
      }
      beam_.mesh().internal_forces(sum, moments_, forces_);
      sum.swap(forces_);
      beam_.mass_solver().solve(sum);
      ++n_mass_solves_;
    }
    for (const SectionEvent& event : events) {
      influence_.add_accelerations(event.section, event.defect_moments[2 * k + order], sum);
    }
  }
}

double SectionCorrector::bound_of_term(const std::vector<SectionEvent>& events, std::size_t k) {
  double sum = 0.0;
  for (const SectionEvent& event : events) {
    sum += std::abs(event.defect_moments[2 * k]) * influence_.strength(event.section);
  }
  const double squared = beam_.highest_frequency() * beam_.highest_frequency();
  for (std::size_t i = 0; i < k; ++i) sum *= squared;
  return sum;
}

std::optional<double> FirstFlow::find(const StruckBeam& beam, const StepEnds& step) {
  const SectionField& sections = beam.sections();
  if (step.event_free || !sections.can_yield()) return std::nullopt;
  beam.mesh().curvatures(beam.beam_positions(step.y1), end_.curvatures);
  if (!sections.any_outside(end_.curvatures)) return std::nullopt;
  beam.read_motion(step.y0, start_);
  beam.read_motion(step.y1, end_);
  const auto low = sections.window_low();
  const auto high = sections.window_high();
  double first = HUGE_VAL;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const double k1 = end_.curvatures[i];
    if (k1 >= low[i] && k1 <= high[i]) continue;
    const double sense = k1 > high[i] ? 1.0 : -1.0;
    const double edge = sense > 0.0 ? high[i] : -low[i];
    const HermiteCubic path(sense * start_.curvatures[i] - edge, sense * start_.rates[i],
                            sense * k1 - edge, sense * end_.rates[i], step.length());
    first = std::min(first, step.t0 + path.rise(0.0, 1.0) * step.length());
  }
  return first;
}

}  // namespace subimpact
