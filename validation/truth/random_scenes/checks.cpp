#include "random_scenes/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "random_scenes/generator.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"

namespace subimpact::scenes {
namespace {

constexpr double default_energy_tolerance = 1e-3;  // until ResolvedSettings says which one holds
constexpr double momentum_tolerance = 1e-9;
constexpr double rounding = 1e-9;  // of sums of energies of very different sizes

class Checks {
 public:
  Checks(const Case& input, const Result& result)
      : input_(input),
        result_(result),
        speed_(input.scene.bodies().velocity_scale()),
        momentum_(std::max(input.scene.bodies().moving_mass() * speed_,
                           striker_momentum() + std::abs(beam_momentum()))),
        energy_(0.5 * input.scene.bodies().moving_mass() * speed_ * speed_),
        tolerance_(result.used.energy_tolerance > 0.0 ? result.used.energy_tolerance
                                                      : default_energy_tolerance) {}

  std::vector<Failure> all() {
    finite_numbers();
    outcome();
    if (result_.outcome.completed()) {
      totals();
      transitions();
      sub_impacts();
      history();
    }
    return std::move(failures_);
  }

 private:
  template <class... Args>
  void expect(bool holds, const char* check, fmt::format_string<Args...> format, Args&&... args) {
    if (holds) return;
    const bool known = std::any_of(failures_.begin(), failures_.end(),
                                   [&](const Failure& f) { return f.check == check; });
    if (!known) failures_.push_back({check, fmt::format(format, std::forward<Args>(args)...)});
  }

  void finite_in(const char* where, std::size_t i, std::initializer_list<double> values) {
    std::size_t n = 0;
    for (const double value : values) {
      expect(std::isfinite(value), "finite", "{} {}, number {} is {}", where, i, n++, value);
    }
  }

  double striker_momentum() const {
    return input_.scene.striker.mass * input_.scene.bodies().striker_velocity();
  }
  double beam_momentum() const {
    return input_.scene.beam.mass() * input_.scene.beam.velocity_at(0.5);
  }
  bool has_work() const { return input_.scene.gravity != 0.0 || input_.scene.beam.has_loads(); }

  void finite_numbers();
  void outcome();
  void totals();
  void transitions();
  void sub_impacts();
  void one_sub_impact(std::size_t i);
  void history();
  void one_row(std::size_t i);
  void impulse_from_rows();

  const Case& input_;
  const Result& result_;
  double speed_;          // m/s, a typical one
  double momentum_;       // m v0 of a beam at rest
  double energy_;         // J, of the strike; where loads do work, the largest of the rows so far
  double tolerance_;      // of the energy, relative
  double initial_ = 0.0;  // J, of the first row
  std::vector<Failure> failures_;
};

void Checks::finite_numbers() {
  const Result& r = result_;
  for (std::size_t i = 0; i < r.history.size(); ++i) {
    const HistoryRow& h = r.history[i];
    finite_in("history row", i,
              {h.time, h.force, h.indentation, h.struck_displacement, h.striker_displacement,
               h.struck_deflection, h.striker_relative, h.struck_velocity, h.striker_velocity,
               h.back_stress, h.striker_energy, h.beam_kinetic_energy, h.bending_elastic,
               h.bending_plastic, h.contact_elastic, h.contact_plastic, h.energy_error,
               h.momentum_error.value_or(0.0)});
  }
  for (std::size_t i = 0; i < r.section_history.size(); ++i) {
    const SectionRow& s = r.section_history[i];
    finite_in("section row", i, {s.time, s.position, s.curvature, s.moment, s.plastic_curvature});
  }
  for (std::size_t i = 0; i < r.sub_impacts.size(); ++i) {
    const SubImpact& s = r.sub_impacts[i];
    finite_in("sub-impact", i,
              {s.start, s.end.value_or(0.0), s.peak_force, s.impulse, s.force_integral,
               s.max_indentation, s.residual_indentation, s.striker_velocity});
  }
  for (std::size_t i = 0; i < r.transitions.size(); ++i) {
    finite_in("transition", i, {r.transitions[i].time, r.transitions[i].value});
  }
  finite_in("finals", 0,
            {r.outcome.time, r.max_force, r.max_indentation, r.striker_velocity,
             r.beam_mean_velocity, r.max_energy_error, r.max_momentum_error.value_or(0.0),
             r.max_impulse_error, r.first_section_yield.value_or(0.0),
             r.first_contact_yield.value_or(0.0), r.no_more_contact.value_or(0.0)});
}

void Checks::outcome() {
  const Outcome& out = result_.outcome;
  expect(out.time >= 0.0 && out.time <= input_.end_time * (1.0 + 1e-12), "outcome's time",
         "{} of {}", out.time, input_.end_time);
  expect(!out.message.empty(), "outcome has a message", "empty");
  if (out.kind == OutcomeKind::inaccurate || out.kind == OutcomeKind::unstable) {
    expect(out.first_failure.has_value(), "first_failure is set", "{}", out.message);
  }
  if (out.first_failure) {
    const Interval& failed = *out.first_failure;
    expect(failed.from >= 0.0 && failed.from <= failed.to && failed.to <= out.time,
           "first_failure is an interval", "{} to {}, run to {}", failed.from, failed.to, out.time);
  }
  if (out.completed() && !result_.no_more_contact) {
    expect(out.time >= input_.end_time, "completed runs reach the end", "{} of {}", out.time,
           input_.end_time);
  }
}

void Checks::totals() {
  expect(result_.max_energy_error <= tolerance_, "largest energy error", "{:.3g} > {:.3g}",
         result_.max_energy_error, tolerance_);
  if (result_.max_momentum_error) {
    expect(*result_.max_momentum_error <= momentum_tolerance, "largest momentum error", "{:.3g}",
           *result_.max_momentum_error);
  }
  if (!input_.scene.beam.is_unsupported() || input_.scene.striker.fixed || has_work()) return;
  const double total = input_.scene.striker.mass * result_.striker_velocity +
                       input_.scene.beam.mass() * result_.beam_mean_velocity;
  const double error = (total - striker_momentum() - beam_momentum()) / momentum_;
  expect(std::abs(error) <= momentum_tolerance, "momentum of the final velocities", "{:.3g}",
         error);
}

// The contact's branches follow one another; sections turn when they like.
void Checks::transitions() {
  enum class Branch { separated, elastic, plastic } branch = Branch::separated;
  double time = 0.0;
  std::size_t n_begins = 0;
  for (std::size_t i = 0; i < result_.transitions.size(); ++i) {
    const Transition& event = result_.transitions[i];
    expect(event.time >= time, "transitions in order", "{} at {} after {}", to_string(event.kind),
           event.time, time);
    time = event.time;
    Branch from = branch, to = branch;
    switch (event.kind) {
      case EventKind::contact_begins:
        from = Branch::separated, to = Branch::elastic;
        ++n_begins;
        break;
      case EventKind::contact_yields:
        from = Branch::elastic, to = Branch::plastic;
        break;
      case EventKind::contact_unloads:
        from = Branch::plastic, to = Branch::elastic;
        break;
      case EventKind::contact_ends:
        from = Branch::elastic, to = Branch::separated;
        break;
      case EventKind::section_reverses:
      case EventKind::support_touches:
      case EventKind::support_lifts:
        continue;
    }
    expect(branch == from, "transitions follow one another", "{} at {}, transition {}",
           to_string(event.kind), event.time, i);
    branch = to;
  }
  expect(n_begins == result_.sub_impacts.size(), "a sub-impact for each beginning", "{} of {}",
         result_.sub_impacts.size(), n_begins);
}

void Checks::sub_impacts() {
  for (std::size_t i = 0; i < result_.sub_impacts.size(); ++i) one_sub_impact(i);
}

void Checks::one_sub_impact(std::size_t i) {
  const SubImpact& s = result_.sub_impacts[i];
  const bool last = i + 1 == result_.sub_impacts.size();
  const double end = s.end.value_or(result_.outcome.time);
  expect(s.end.has_value() || last, "only the last is open", "sub-impact {}", i);
  expect(s.start < end || (!s.end && s.start <= end), "start before end", "sub-impact {}: {} to {}",
         i, s.start, end);
  expect(s.peak_force > 0.0 || !s.end, "peak force above 0", "sub-impact {} at {}: {}", i, s.start,
         s.peak_force);
  if (i > 0) {
    const double before = result_.sub_impacts[i - 1].end.value_or(s.start);
    expect(s.start >= before, "no overlap", "sub-impact {}: starts {}, the last one ends {}", i,
           s.start, before);
  }
  const double allowed = tolerance_ * momentum_;
  expect(s.impulse >= -allowed, "impulse not negative", "sub-impact {} at {}: {:.3g} of m v0", i,
         s.start, s.impulse / momentum_);
  // No force can give more than its peak over the whole time.
  expect(s.impulse <= s.peak_force * (end - s.start) * (1.0 + 1e-6) + allowed,
         "impulse within peak times duration", "sub-impact {} at {}: {:.3g} and {:.3g} of m v0", i,
         s.start, s.impulse / momentum_, s.peak_force * (end - s.start) / momentum_);
  if (result_.used.energy_tolerance > 0.0) {
    const double error = (s.impulse - s.force_integral) / momentum_;
    expect(std::abs(error) <= tolerance_, "impulse is the integral of force",
           "sub-impact {} at {}: {:.3g} of m v0", i, s.start, error);
  }
}

void Checks::history() {
  for (std::size_t i = 0; i < result_.history.size(); ++i) one_row(i);
  impulse_from_rows();
}

void Checks::one_row(std::size_t i) {
  const HistoryRow& row = result_.history[i];
  // A force this small may be left at an event by rounding.
  expect(row.force >= 0.0, "history force not negative", "row {} at {}: {:.3g}, {:.3g} of the peak",
         i, row.time, row.force, row.force / result_.max_force);
  const double taken_up = row.striker_energy + row.beam_kinetic_energy + row.bending_elastic +
                          row.bending_plastic + row.contact_elastic + row.contact_plastic +
                          row.beam_damping;
  if (i == 0) initial_ = taken_up - row.work;
  if (i == 0 || has_work()) energy_ = std::max(energy_, taken_up);
  const double error = (taken_up - row.work - initial_) / energy_;
  expect(std::abs(error) <= tolerance_ + rounding, "energy error of rows",
         "row {} at {}: {:.3g} > {:.3g}", i, row.time, error, tolerance_);
  // Between rows loads may have made more of the energy, which the error is relative to.
  const bool is_the_sums =
      has_work() ? std::abs(row.energy_error) <= std::abs(error) + rounding
                 : std::abs(error - row.energy_error) <= rounding + 1e-6 * std::abs(error);
  expect(is_the_sums, "energy error is the sum's", "row {} at {}: {:.3g}, stated {:.3g}", i,
         row.time, error, row.energy_error);
  const double v = row.striker_velocity;
  const double striker = 0.5 * input_.scene.striker.mass * v * v;
  expect(std::abs(striker - row.striker_energy) <= rounding * energy_, "striker's energy",
         "row {} at {}: {} and {}", i, row.time, striker, row.striker_energy);
  for (const double part : {row.beam_kinetic_energy, row.bending_elastic, row.bending_plastic,
                            row.contact_elastic, row.contact_plastic}) {
    expect(part >= -(tolerance_ + rounding) * energy_, "energies not negative",
           "row {} at {}: {:.3g}", i, row.time, part / energy_);
  }
  if (row.momentum_error) {
    expect(std::abs(*row.momentum_error) <= momentum_tolerance, "momentum error of rows",
           "row {} at {}: {:.3g}", i, row.time, *row.momentum_error);
  }
  if (i == 0) return;
  const double before = result_.history[i - 1].time;
  expect(row.time >= before, "history in order", "row {} at {} after {}", i, row.time, before);
  // Events leave two rows each at their time, and a row of the interval may fall on one, as the
  // first always does; all other rows have a time of their own.
  if (row.time != before) return;
  const auto same_time = [&](const auto& one) { return one.time == row.time; };
  const auto n_rows = std::count_if(result_.history.begin(), result_.history.end(), same_time);
  const auto n_events =
      std::count_if(result_.transitions.begin(), result_.transitions.end(), same_time);
  const double interval = input_.output.history_interval(input_.end_time);
  const double grid = std::round(row.time / interval) * interval;
  const bool on_grid = std::abs(grid - row.time) <= 1e-12 * input_.end_time;
  expect(n_rows <= 2 * n_events + (on_grid ? 1 : 0), "two rows to an event",
         "{} rows and {} events at {}", n_rows, n_events, row.time);
}

// What the striker lost between the rows at start and end, and the peak that rows show.
void Checks::impulse_from_rows() {
  const std::vector<HistoryRow>& rows = result_.history;
  if (rows.empty()) return;
  const Striker& striker = input_.scene.striker;
  for (std::size_t i = 0; i < result_.sub_impacts.size(); ++i) {
    const SubImpact& s = result_.sub_impacts[i];
    const double end = s.end.value_or(rows.back().time);
    const HistoryRow *first = nullptr, *last = nullptr;
    for (const HistoryRow& row : rows) {
      if (row.time == s.start) first = &row;
      if (row.time == end && last == nullptr) last = &row;
      if (row.time < s.start || row.time > end) continue;
      expect(row.force <= s.peak_force * (1.0 + 1e-3) + 1e-6 * result_.max_force,
             "no force above the peak", "sub-impact {} at {}: {} > {}", i, row.time, row.force,
             s.peak_force);
    }
    expect(first != nullptr && last != nullptr, "rows at start and end", "sub-impact {} at {}", i,
           s.start);
    if (first == nullptr || last == nullptr) continue;
    if (striker.fixed) continue;
    const double lost = striker.mass * (first->striker_velocity - last->striker_velocity +
                                        input_.scene.gravity * (end - s.start));
    const double error = (s.impulse - lost) / momentum_;
    expect(std::abs(error) <= tolerance_, "impulse is what the striker lost",
           "sub-impact {} at {}: {:.3g} of m v0", i, s.start, error);
  }
}

}  // namespace

std::vector<Failure> failures_of(const Case& input, const Result& result) {
  return Checks(input, result).all();
}

std::vector<Failure> failures_of_file(const Case& input) {
  try {
    const Case read = read_case_text(case_text(input), "scene").value;
    for (const CaseKey& key : case_keys()) {
      const auto text = [&](const Case& c) {
        const auto value = key.get(c);
        return value ? to_text(*value) : std::string("none");
      };
      if (text(read) == text(input)) continue;
      return {{"reads back from a file", key.name + ": " + text(input) + ", " + text(read)}};
    }
  } catch (const std::exception& error) {
    return {{"reads back from a file", error.what()}};
  }
  return {};
}

}  // namespace subimpact::scenes
