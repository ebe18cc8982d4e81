#include "system/struck_beam.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "events/hermite.h"
#include "model/lanes.h"

namespace subimpact {
namespace {

// A cubic through a step's ends is trusted to know the height of a hump between them to this part
// of it; a hump that comes closer to zero is looked at on the trajectory.
constexpr double doubtful_share = 0.5;

bool contains(const GuardList& guards, EventKind kind, std::size_t section) {
  return std::any_of(guards.begin(), guards.end(), [&](const Guard& guard) {
    return guard.kind == kind && guard.section == section;
  });
}

}  // namespace

StruckBeam::StruckBeam(const Scene& scene, std::unique_ptr<BeamMesh> mesh, SectionField sections,
                       std::unique_ptr<MassSolver> mass_solver)
    : mesh_(std::move(mesh)),
      sections_(std::move(sections)),
      contact_law_(ContactLaw::of(scene)),
      mass_solver_(std::move(mass_solver)),
      n_(mesh_->n_unknowns()),
      striker_mass_(scene.striker.mass),
      striker_velocity_(scene.striker.velocity),
      stress_reach_(0.5 * scene.beam.youngs_modulus * scene.beam.thickness),
      momentum_functional_(n_),
      curvatures_(mesh_->n_sections()),
      moments_(mesh_->n_sections()),
      trial_(n_ + 1) {
  const double exponent = contact_law_.exponent();
  const double contact_time = std::pow(
      striker_mass_ / (contact_law_.stiffness() * std::pow(striker_velocity_, exponent - 1.0)),
      1.0 / (exponent + 1.0));
  scales_ = {striker_velocity_ * contact_time, striker_velocity_};
  mesh_->mass().multiply(mesh_->translation(), momentum_functional_);
  for (Kinematics* at : {&start_, &end_}) {
    at->curvatures.assign(mesh_->n_sections(), 0.0);
    at->rates.assign(mesh_->n_sections(), 0.0);
  }
}

State StruckBeam::initial_state() const {
  State y(2 * n_positions(), 0.0);
  y.back() = striker_velocity_;
  return y;
}

double StruckBeam::force(double indentation) const {
  if (contact_evaluation_ == ContactEvaluation::switching) {
    return contact_law_.force(contact_history_, indentation);
  }
  return contact_law_.branch_force(contact_branch_, contact_history_, indentation);
}

void StruckBeam::acceleration(std::span<const double> positions, std::span<double> result) {
  ++n_accelerations_;
  const auto unknowns = positions.first(n_);
  const auto forces = result.first(n_);
  mesh_->curvatures(unknowns, curvatures_);
  sections_.moments(curvatures_, moments_);
  mesh_->bending_forces(moments_, forces);
  const double contact = force(positions[n_] - mesh_->struck_point()(unknowns));
  mesh_->struck_point().add_to(forces, contact);
  mass_solver_->solve(forces);
  result[n_] = -contact / striker_mass_;
}

void StruckBeam::force(std::span<const double> positions, Part part, std::span<double> result) {
  const auto unknowns = positions.first(n_);
  const auto forces = result.first(n_);
  if (part == Part::rest) {
    std::fill(forces.begin(), forces.end(), 0.0);
  } else {
    ++n_forces_;
    mesh_->curvatures(unknowns, curvatures_);
    sections_.moments(curvatures_, moments_);
    mesh_->bending_forces(moments_, forces);
  }
  result[n_] = 0.0;
  if (part == Part::stiff) return;
  const double contact = force(positions[n_] - mesh_->struck_point()(unknowns));
  mesh_->struck_point().add_to(forces, contact);
  result[n_] = -contact;
}

double StruckBeam::force_slope(double indentation) const {
  const ContactBranch branch = contact_evaluation_ == ContactEvaluation::switching
                                   ? contact_law_.branch(contact_history_, indentation)
                                   : contact_branch_;
  return contact_law_.branch_slope(branch, contact_history_, indentation);
}

void StruckBeam::stiffness_entries(std::span<const double> positions, Part part,
                                   std::span<double> values) {
  const auto unknowns = positions.first(n_);
  std::fill(moments_.begin(), moments_.end(), 0.0);
  if (part != Part::rest) {
    mesh_->curvatures(unknowns, curvatures_);
    for (std::size_t i = 0; i < moments_.size(); ++i) {
      moments_[i] = sections_.tangent(i, curvatures_[i]);
    }
  }
  const double slope =
      part == Part::stiff ? 0.0 : force_slope(positions[n_] - mesh_->struck_point()(unknowns));
  jacobian().stiffness_entries(moments_, slope, values);
}

double StruckBeam::indentation(const State& y) const {
  return y[n_] - mesh_->struck_point()(beam_positions(y));
}

double StruckBeam::indentation_rate(const State& y) const {
  return y.back() - mesh_->struck_point()(beam_velocities(y));
}

double StruckBeam::contact_force(const State& y) const { return force(indentation(y)); }

// --- events
// ----------------------------------------------------------------------------------------

GuardValue StruckBeam::contact_guard(EventKind kind, double indentation, double rate) const {
  switch (kind) {
    case EventKind::contact_begins:
      return {indentation - residual_indentation(), rate};
    case EventKind::contact_ends:
      return {residual_indentation() - indentation, -rate};
    case EventKind::contact_yields:
      return {indentation - contact_law_.yield_threshold(contact_history_), rate};
    default:
      return {-rate, 0.0};  // unloads
  }
}

double StruckBeam::curvature(const Guard& guard, std::span<const double> unknowns) {
  mesh_->curvatures(unknowns, curvatures_);
  return curvatures_[guard.section];
}

double StruckBeam::negligible_excursion(const State& y) const {
  const double size = std::abs(y[n_]) + std::abs(mesh_->struck_point()(beam_positions(y)));
  return 8.0 * std::numeric_limits<double>::epsilon() * size;
}

GuardValue StruckBeam::evaluate(const Guard& guard, const State& y) {
  if (guard.kind == EventKind::contact_unloads) {
    acceleration({y.data(), n_ + 1}, trial_);
    const double second = trial_[n_] - mesh_->struck_point()({trial_.data(), n_});
    return {-guard.sense * indentation_rate(y), -guard.sense * second};
  }
  if (guard.kind == EventKind::section_reverses) {
    acceleration({y.data(), n_ + 1}, trial_);
    const double second = curvature(guard, {trial_.data(), n_});
    const double rate = curvature(guard, beam_velocities(y));
    return {-guard.sense * rate, -guard.sense * second};
  }
  return contact_guard(guard.kind, indentation(y), indentation_rate(y));
}

bool StruckBeam::find_crossing(const StepEnds& step, double reversal_tolerance,
                               const GuardList& without, Crossing& earliest) {
  earliest.guess = std::numeric_limits<double>::infinity();
  bool found = find_contact_crossing(step, without, earliest);
  if (sections_.can_yield() && std::isfinite(reversal_tolerance)) {
    found = find_reversal(step, reversal_tolerance, without, earliest) || found;
  }
  return found;
}

bool StruckBeam::find_contact_crossing(const StepEnds& step, const GuardList& without,
                                       Crossing& earliest) {
  const double lambda0 = indentation(step.y0);
  const double lambda1 = indentation(step.y1);
  const double rate0 = indentation_rate(step.y0);
  const double rate1 = indentation_rate(step.y1);
  bool found = false;
  const auto consider = [&](EventKind kind) {
    if (contains(without, kind, 0)) return;
    const GuardValue g0 = contact_guard(kind, lambda0, rate0);
    const GuardValue g1 = contact_guard(kind, lambda1, rate1);
    double after = 0.0;
    double guess = 0.0;
    if (kind == EventKind::contact_unloads) {
      if (!(g1.value > 0.0)) return;
      guess = g0.value < 0.0 ? g0.value / (g0.value - g1.value) : 0.0;
    } else {
      const HermiteCubic path(g0.value, g0.rate, g1.value, g1.rate, step.length());
      if (g1.value > 0.0) {
        if (g0.value >= 0.0 && g0.rate > 0.0 && g1.rate > 0.0) {
          // Beyond from the start on: it happened at the start.
          earliest = {{kind}, step.t0, step.t0, step.t0};
          found = true;
          return;
        }
        // A guard still at zero from the event before first falls: look behind its lowest point.
        if (g0.rate < 0.0) {
          const HermiteCubic mirrored(-g0.value, -g0.rate, -g1.value, -g1.rate, step.length());
          if (g1.rate > 0.0) after = mirrored.peak();
        }
      } else {
        // Not beyond at the end; was it in between?
        if (!pair_detection_ || !(g0.rate > 0.0 && g1.rate < 0.0)) return;
        const double peak = path.peak();
        const double height = path(peak) - std::max(g0.value, g1.value);
        if (!(path(peak) > negligible_excursion(step.y1) - doubtful_share * height)) return;
        const double time = step.t0 + peak * step.length();
        if (time < earliest.guess) {
          earliest = {{kind}, step.t0, step.t1, time, true};
          found = true;
        }
        return;
      }
      guess = path.rise(after, 1.0);
    }
    const double t_guess = step.t0 + guess * step.length();
    if (t_guess < earliest.guess) {
      earliest = {{kind}, step.t0 + after * step.length(), step.t1, t_guess};
      found = true;
    }
  };
  switch (contact_branch_) {
    case ContactBranch::separated:
      consider(EventKind::contact_begins);
      break;
    case ContactBranch::elastic:
      consider(EventKind::contact_ends);
      consider(EventKind::contact_yields);
      break;
    case ContactBranch::plastic:
      consider(EventKind::contact_unloads);
      break;
  }
  return found;
}

bool StruckBeam::find_reversal(const StepEnds& step, double tolerance, const GuardList& without,
                               Crossing& earliest) {
  read_kinematics(step.y1, end_);
  const double h = step.length();
  const double* k0 = start_.curvatures.data();
  const double* k1 = end_.curvatures.data();
  const double* r0 = start_.rates.data();
  const double* r1 = end_.rates.data();
  const double* low = sections_.window_low().data();
  const double* high = sections_.window_high().data();
  bool found = false;
  const auto consider = [&](std::size_t i) {
    const double sense = r0[i] > 0.0 ? 1.0 : -1.0;
    if (contains(without, EventKind::section_reverses, i)) return;
    const HermiteCubic path(sense * k0[i], sense * r0[i], sense * k1[i], sense * r1[i], h);
    const double at = path.peak();
    const double edge = sense > 0.0 ? high[i] : -low[i];
    if (path(at) - std::max(edge, sense * k1[i]) <= tolerance) return;
    const double guess = step.t0 + at * h;
    if (guess < earliest.guess) {
      earliest = {{EventKind::section_reverses, i, sense}, step.t0, step.t1, guess};
      found = true;
    }
  };
  // A cubic exceeds its ends by at most 4/27 of the step times each end's rate.
  const double reach = 4.0 / 27.0 * h;
  for_each_found(
      sections_.size(),
      [=](std::size_t i) {
        const Lanes start = lanes_at(r0 + i);
        const Lanes end = lanes_at(r1 + i);
        const Lanes up = start > 0.0 ? start : -start;
        const Lanes down = end > 0.0 ? end : -end;
        const Lanes margin = reach * (up + down);
        const Lanes a = lanes_at(k0 + i);
        const Lanes b = lanes_at(k1 + i);
        const Lanes upper = a > b ? a : b;
        const Lanes lower = a > b ? b : a;
        return (start * end < 0.0) &
               ((upper + margin > lanes_at(high + i)) | (lower - margin < lanes_at(low + i)));
      },
      [=](std::size_t i) {
        const double margin = reach * (std::abs(r0[i]) + std::abs(r1[i]));
        return r0[i] * r1[i] < 0.0 && (std::max(k0[i], k1[i]) + margin > high[i] ||
                                       std::min(k0[i], k1[i]) - margin < low[i]);
      },
      consider);
  return found;
}

double StruckBeam::event_value(const Guard& guard, const State& y) {
  return guard.kind == EventKind::section_reverses ? curvature(guard, beam_positions(y))
                                                   : indentation(y);
}

void StruckBeam::apply(const Guard& guard, const State& y) {
  switch (guard.kind) {
    case EventKind::contact_begins:
      contact_branch_ = ContactBranch::elastic;
      break;
    case EventKind::contact_yields:
      contact_branch_ = ContactBranch::plastic;
      break;
    case EventKind::contact_unloads:
      contact_history_ = contact_law_.commit(contact_history_, indentation(y));
      contact_branch_ = ContactBranch::elastic;
      break;
    case EventKind::contact_ends:
      contact_branch_ = ContactBranch::separated;
      break;
    case EventKind::section_reverses:
      break;  // committing the curvature is all there is to it
  }
}

bool StruckBeam::commit(const State& y) {
  if (contact_branch_ == ContactBranch::plastic ||
      contact_evaluation_ == ContactEvaluation::switching) {
    contact_history_ = contact_law_.commit(contact_history_, indentation(y));
  }
  if (!sections_.can_yield()) return false;
  read_kinematics(y, start_);
  return sections_.commit(start_.curvatures) > 0;
}

void StruckBeam::follow_branch(const State& y) {
  contact_branch_ = contact_law_.branch(contact_history_, indentation(y));
}

void StruckBeam::read_kinematics(const State& y, Kinematics& at) const {
  mesh_->curvatures(beam_positions(y), at.curvatures);
  mesh_->curvatures(beam_velocities(y), at.rates);
}

// --- accounts
// --------------------------------------------------------------------------------------

Energies StruckBeam::energies(const State& y) {
  Energies sum;
  sum.striker = 0.5 * striker_mass_ * y.back() * y.back();
  sum.beam_kinetic = 0.5 * mesh_->mass().quadratic_form(beam_velocities(y));
  mesh_->curvatures(beam_positions(y), curvatures_);
  const SectionField::Energies bending = sections_.energies(curvatures_, mesh_->section_weights());
  sum.bending_elastic = bending.elastic;
  sum.bending_plastic = bending.plastic;
  const double lambda = indentation(y);
  const ContactHistory reached = contact_branch_ == ContactBranch::plastic
                                     ? contact_law_.commit(contact_history_, lambda)
                                     : contact_history_;
  sum.contact_plastic = contact_law_.dissipated_energy(reached);
  if (in_contact()) sum.contact_elastic = contact_law_.recoverable_energy(reached, lambda);
  return sum;
}

double StruckBeam::momentum(const State& y) const {
  double sum = striker_mass_ * y.back();
  const auto velocities = beam_velocities(y);
  for (std::size_t i = 0; i < n_; ++i) sum += momentum_functional_[i] * velocities[i];
  return sum;
}

BeamJacobian& StruckBeam::jacobian() const {
  if (!jacobian_) jacobian_ = std::make_unique<BeamJacobian>(*mesh_, striker_mass_);
  return *jacobian_;
}

double StruckBeam::beam_mass() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < n_; ++i) sum += momentum_functional_[i] * mesh_->translation()[i];
  return sum;
}

StruckBeam::Displacements StruckBeam::displacements(const State& y) const {
  const auto unknowns = beam_positions(y);
  return {mesh_->struck_point()(unknowns), y[n_], mesh_->first_end()(unknowns)};
}

std::optional<double> StruckBeam::first_flow(const StepEnds& step) {
  read_kinematics(step.y1, end_);
  std::optional<double> first;
  for (std::size_t i = 0; i < sections_.size(); ++i) {
    const double high = sections_.window_high()[i];
    const double low = sections_.window_low()[i];
    const double k1 = end_.curvatures[i];
    if (k1 >= low && k1 <= high) continue;
    const double sense = k1 > high ? 1.0 : -1.0;
    const double edge = sense > 0.0 ? high : -low;
    const HermiteCubic path(sense * start_.curvatures[i] - edge, sense * start_.rates[i],
                            sense * k1 - edge, sense * end_.rates[i], step.length());
    const double time = step.t0 + path.rise(0.0, 1.0) * step.length();
    if (!first || time < *first) first = time;
  }
  return first;
}

double StruckBeam::back_stress(const State& y) {
  mesh_->curvatures(beam_positions(y), curvatures_);
  const std::size_t section = mesh_->struck_section();
  return sections_.outer_stress(section, curvatures_[section], stress_reach_);
}

}  // namespace subimpact
