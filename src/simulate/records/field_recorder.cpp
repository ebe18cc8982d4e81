#include "simulate/records/field_recorder.h"

#include <algorithm>
#include <cmath>

#include "simulate/run_parts.h"

namespace subimpact {
namespace {

// History rows that the envelope follows, at most, roughly.
constexpr double most_followed = 4000.0;

// Tolerance of the envelope, relative to the largest value.
constexpr double envelope_tolerance = 1e-8;

// States in modes whose fields are read at once.
constexpr std::size_t most_waiting = 64;

// Plastic curvature in units of the yield curvature below which it is rounding.
constexpr double least_plastic = 1e-9;

}  // namespace

FieldRecorder::FieldRecorder(const RunParts& parts, Result& result, RowSink& rows)
    : beam_(parts.beam),
      material_(parts.problem.beam),
      end_time_(parts.given.end_time),
      shapes_(parts.settings.shape_interval),
      regular_(parts.given.output.extremes_interval(end_time_)),
      result_(result),
      rows_(rows),
      field_(beam_, material_.length,
             shapes_.exist() ? static_cast<std::size_t>(parts.given.output.shape_points) : 0),
      envelope_(field_.size()) {
  const BeamMesh& mesh = beam_.mesh();
  const double length = material_.length;
  if (parts.given.output.has_history() || has_shapes()) {
    reactions_.emplace(beam_, length, parts.problem.striker.position * length);
    if (!reactions_->exist()) reactions_.reset();
  }
  const auto in_part = [&](double x) { return mesh.symmetric() ? std::min(x, length - x) : x; };
  for (const double fraction : parts.given.output.points) {
    points_.push_back({fraction * length, *mesh.displacement_at(in_part(fraction * length))});
  }
  for (const Gauge& gauge : parts.given.output.gauges) {
    const double outer = 0.5 * material_.height();
    gauges_.push_back({curvature_at(mesh, length, in_part(gauge.position * length)),
                       gauge.face == Face::front ? outer : -outer});
  }
  for (std::size_t i = 0; i < field_.size(); ++i) envelope_[i].position = field_.position(i);
}

double FieldRecorder::next_instant() const {
  if (!has_shapes()) return std::numeric_limits<double>::infinity();
  return std::min(shapes_.next(), regular_.next());
}

void FieldRecorder::take_instant(double time, const State& y, Accounts& accounts) {
  const bool shape = shapes_.reach(time);
  const bool regular = regular_.reach(time);
  take_once({time, regular, shape}, y, accounts);
}

void FieldRecorder::add_shape(double time, const State& y, Accounts& accounts) {
  if (!has_shapes()) return;
  shapes_.reach(time);
  regular_.reach(time);
  take_once({time, true, true}, y, accounts);
}

void FieldRecorder::take_once(Instant instant, const State& y, Accounts& accounts) {
  if (!(instant.time > last_shape_time_)) return;
  last_shape_time_ = last_followed_time_ = instant.time;
  if (!std::ranges::all_of(y, [](double x) { return std::isfinite(x); })) return;
  if (reactions_) reactions(instant, y, accounts);
  instant.shape = instant.shape && rows_.takes_shapes();
  take(instant, y, accounts);
}

void FieldRecorder::add_row(double time, double position, double sense, std::size_t station) {
  ++result_.n_shape_rows;
  rows_.add(ShapeRow{time, position, field_.displacement(station), field_.velocity(station),
                     sense * field_.rotation(station), field_.curvature(station),
                     field_.moment(station), field_.plastic_curvature(station)});
}

void FieldRecorder::follow(double time, const State& y, Accounts& accounts) {
  for (const Point& point : points_) {
    rows_.add(PointRow{time, point.position, point.displacement(beam_.beam_positions(y)),
                       point.displacement(beam_.beam_velocities(y))});
  }
  if (!has_shapes()) return;
  if (time - last_followed_time_ < end_time_ / most_followed) return;
  last_followed_time_ = time;
  take({time, false, false}, y, accounts);
}

void FieldRecorder::take(const Instant& instant, const State& y, Accounts& accounts) {
  if (!field_.in_modes()) {
    field_.read(y, accounts);
    if (instant.shape) field_.read_motion(y);
    return take_field(instant);
  }
  const auto add = [](std::span<const double> values, std::vector<double>& to) {
    to.insert(to.end(), values.begin(), values.end());
  };
  add(beam_.beam_positions(y), (instant.shape ? shapes_waiting_ : others_waiting_).positions);
  if (instant.shape) add(beam_.beam_velocities(y), shapes_waiting_.velocities);
  waiting_.push_back(instant);
  if (waiting_.size() == most_waiting) take_waiting();
}

void FieldRecorder::take_waiting() {
  if (waiting_.empty()) return;
  field_.read(shapes_waiting_, 0.0);
  field_.read(others_waiting_, envelope_tolerance);
  Eigen::Index n_shapes = 0, n_others = 0;
  for (const Instant& instant : waiting_) {
    if (instant.shape) {
      field_.show(shapes_waiting_, n_shapes++);
    } else {
      field_.show(others_waiting_, n_others++);
    }
    take_field(instant);
  }
  waiting_.clear();
  for (auto* values :
       {&shapes_waiting_.positions, &shapes_waiting_.velocities, &others_waiting_.positions}) {
    values->clear();
  }
}

void FieldRecorder::take_field(const Instant& instant) {
  widen(instant);
  if (!instant.shape) return;
  for (std::size_t i = 0; i < field_.size(); ++i) add_row(instant.time, field_.position(i), 1.0, i);
  for (std::size_t i = field_.n_mirrored(); i-- > 0;) {
    add_row(instant.time, field_.mirrored_position(i), -1.0, i);
  }
}

void FieldRecorder::widen(const Instant& instant) {
  const double time = instant.time;
  const double outer = 0.5 * material_.height();
  double displacement = 0.0, moment = 0.0, strain = 0.0;
  for (std::size_t i = 0; i < field_.size(); ++i) {
    EnvelopeRow& here = envelope_[i];
    here.displacement.include(field_.displacement(i), time);
    here.moment.include(field_.moment(i), time);
    here.strain.include(-outer * field_.curvature(i), time);  // behind
    here.plastic_curvature.include(field_.plastic_curvature(i), time);
    displacement = std::max(displacement, std::abs(field_.displacement(i)));
    moment = std::max(moment, std::abs(field_.moment(i)));
    strain = std::max(strain, outer * std::abs(field_.curvature(i)));
  }
  result_.peaks.displacement.follow(displacement, instant.regular);
  result_.peaks.moment.follow(moment, instant.regular);
  result_.peaks.strain.follow(strain, instant.regular);
}

SupportReactions::Forces FieldRecorder::reactions(const Instant& instant, const State& y,
                                                  Accounts& accounts) {
  const SupportReactions::Forces forces = reactions_->at(instant.time, y, accounts);
  double along = 0.0, against = 0.0;
  for (std::size_t end = 0; end < forces.size(); ++end) {
    if (!forces[end]) continue;
    const EnvelopeRow::Extreme here{*forces[end], instant.time};
    auto& range = result_.reactions[end];
    if (!range) range = {here, here};
    range->include(here.value, here.time);
    along = std::max(along, here.value);
    against = std::max(against, -here.value);
  }
  result_.peaks.reaction_along.follow(along, instant.regular);
  result_.peaks.reaction_against.follow(against, instant.regular);
  return forces;
}

void FieldRecorder::add_readings(HistoryRow& row, const State& y, Accounts& accounts) {
  for (const GaugeReading& gauge : gauges_) {
    const double curvature = gauge.curvature.of(beam_.mesh(), beam_.beam_positions(y));
    row.gauge_strains.push_back(gauge.distance * curvature);
  }
  if (!reactions_) return;
  const SupportReactions::Forces forces = reactions({row.time, false, false}, y, accounts);
  row.first_reaction = forces[0];
  row.last_reaction = forces[1];
}

void FieldRecorder::finish(double time, const State& y, Accounts& accounts, bool is_good) {
  if (!has_shapes()) return;
  if (is_good) {
    add_shape(time, y, accounts);
    add_rest(y, accounts);
  }
  take_waiting();
  result_.envelope = envelope_;
  for (std::size_t i = field_.n_mirrored(); i-- > 0;) {
    result_.envelope.push_back(envelope_[i]);
    result_.envelope.back().position = field_.mirrored_position(i);
  }
}

void FieldRecorder::add_rest(const State& y, Accounts& accounts) {
  if (!beam_.sections().can_yield()) return;
  const Accounts::Bending bending = accounts.bending(y);
  std::vector<double> plastic(bending.curvatures.size());
  for (std::size_t i = 0; i < plastic.size(); ++i) {
    plastic[i] =
        plastic_curvature(bending.curvatures[i], bending.moments[i], beam_.sections().stiffness());
  }
  const double shear_flexibility =
      material_.shears() ? material_.bending_stiffness() / material_.shear_stiffness() : 0.0;
  const PermanentSet set(beam_.mesh(), material_.length, shear_flexibility, plastic);
  for (std::size_t i = 0; i < field_.size(); ++i) {
    envelope_[i].permanent_set = set.at(field_.position(i));
    envelope_[i].set_from_supports = set.from_supports(field_.position(i));
  }
  result_.plastic_zones = plastic_zones(beam_.mesh(), material_.length, plastic,
                                        least_plastic * material_.yield_curvature());
}

}  // namespace subimpact
