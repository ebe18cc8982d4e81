#include "model/section/section_law.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace subimpact {
namespace {

using Point = SectionHistory::Point;

// The i-th reversal point in force: those stored and, where the motion turns back, the edge on top.
const Point& point_in_force(const SectionHistory& history, std::size_t i) {
  return i < history.reversals.size() ? history.reversals[i] : history.edge;
}

bool reverses(const SectionHistory& history, double x) {
  return history.direction * (x - history.edge.x) < 0.0;
}

// x at which the branch from the last reversal point ends on an older one.
double limit_of(const std::vector<Point>& reversals) {
  const std::size_t n = reversals.size();
  return n >= 2 ? reversals[n - 2].x : n == 1 ? -reversals[0].x : 0.0;
}

// The branch from the last reversal point on, without its limit.
SectionBranch innermost_branch(const SectionHistory& history) {
  const bool virgin = history.reversals.empty();
  return {virgin ? Point{0.0, 0.0} : history.reversals.back(),
          static_cast<double>(history.direction), virgin, 0.0};
}

}  // namespace

SectionLaw::SectionLaw(const Beam& beam, const Fibres& fibres)
    : fibres_(fibres),
      yield_curvature_(beam.yield_curvature()),
      yield_moment_(beam.yield_moment()),
      yield_stress_(beam.yield_stress),
      stiffness_(fibres.slope() * beam.bending_stiffness()) {
  if (!std::isfinite(beam.yield_stress) || !(beam.yield_stress > 0.0)) {
    throw std::invalid_argument("section law: the yield stress must be positive and finite");
  }
}

bool SectionLaw::inside_window(const SectionHistory& history, double x) const {
  const double half_window = fibres_.first_yield();
  if (history.direction == 0) return std::abs(x) <= half_window;
  const double behind = history.direction * (history.edge.x - x);
  return behind >= 0.0 && behind <= 2.0 * half_window;
}

ElasticWindow SectionLaw::window(const SectionHistory& history) const {
  const double half_window = fibres_.first_yield() * yield_curvature_;
  if (history.direction == 0) return {-half_window, half_window, 0.0};
  const double edge = history.edge.x * yield_curvature_;
  const double offset = stiffness_ * edge - history.edge.m * yield_moment_;
  return history.direction > 0 ? ElasticWindow{edge - 2.0 * half_window, edge, offset}
                               : ElasticWindow{edge, edge + 2.0 * half_window, offset};
}

SectionBranch SectionLaw::branch_at(const SectionHistory& history, double x) const {
  const bool turned = reverses(history, x);
  const double sense = turned ? -history.direction : history.direction;
  std::size_t n = history.reversals.size() + (turned ? 1 : 0);
  while (n > 0) {
    const Point& origin = point_in_force(history, n - 1);
    const double limit = n >= 2 ? point_in_force(history, n - 2).x : -origin.x;
    if (sense * (x - limit) <= 0.0) return {origin, sense, false, limit * yield_curvature_};
    n -= n >= 2 ? 2 : 1;
  }
  return {{0.0, 0.0}, sense, true, sense * std::numeric_limits<double>::infinity()};
}

Fibres::Response SectionLaw::branch_response(const SectionBranch& branch, double x) const {
  if (branch.virgin) return fibres_.response(x);
  const double step = x - branch.origin.x;
  const auto [moment, work] = fibres_.response(0.5 * step);
  return {branch.origin.m + 2.0 * moment, branch.origin.m * step + 4.0 * work};
}

double SectionLaw::moment(const SectionHistory& history, double curvature) const {
  const ElasticWindow elastic = window(history);
  if (curvature >= elastic.low && curvature <= elastic.high) {
    return stiffness_ * curvature - elastic.offset;
  }
  return flowing_moment(history, curvature);
}

double SectionLaw::flowing_moment(const SectionHistory& history, double curvature) const {
  const double x = curvature / yield_curvature_;
  return yield_moment_ * branch_response(branch_at(history, x), x).moment;
}

SectionBranch SectionLaw::branch_from_edge(const SectionHistory& history) const {
  return branch_at(history, history.edge.x);
}

double SectionLaw::moment_on(const SectionBranch& branch, double curvature) const {
  return yield_moment_ * branch_response(branch, curvature / yield_curvature_).moment;
}

double SectionLaw::tangent_on(const SectionBranch& branch, double curvature) const {
  const double x = curvature / yield_curvature_;
  const double scale = yield_moment_ / yield_curvature_;
  return scale * fibres_.tangent(branch.virgin ? x : 0.5 * (x - branch.origin.x));
}

double SectionLaw::tangent(const SectionHistory& history, double curvature) const {
  const double x = curvature / yield_curvature_;
  if (inside_window(history, x)) return stiffness_;
  return tangent_on(branch_at(history, x), curvature);
}

void SectionLaw::commit(SectionHistory& history, double curvature) const {
  const double x = curvature / yield_curvature_;
  if (inside_window(history, x)) return;
  if (history.direction == 0) {
    history.direction = x > 0.0 ? 1 : -1;
  } else if (reverses(history, x)) {
    history.reversals.push_back(history.edge);
    history.direction = -history.direction;
    history.work_of_branch = 0.0;
  }
  // Along the branches to x. One that passes the previous reversal point closes a loop: forgotten.
  std::vector<Point>& reversals = history.reversals;
  for (;;) {
    const SectionBranch branch = innermost_branch(history);
    const double limit = limit_of(reversals);
    const bool closes = !branch.virgin && branch.sense * (x - limit) >= 0.0;
    const auto [moment, work] = branch_response(branch, closes ? limit : x);
    history.work += work - history.work_of_branch;
    history.work_of_branch = work;
    if (!closes) {
      history.edge = {x, moment};
      return;
    }
    reversals.resize(reversals.size() - (reversals.size() >= 2 ? 2 : 1));
    history.work_of_branch = branch_response(innermost_branch(history), limit).work;
  }
}

double SectionLaw::work(const SectionHistory& history, double curvature) const {
  const double unit = yield_moment_ * yield_curvature_;
  const double x = curvature / yield_curvature_;
  if (inside_window(history, x)) {
    const double step = x - history.edge.x;
    return unit * (history.work + step * (history.edge.m + 0.5 * fibres_.slope() * step));
  }
  SectionHistory reached = history;
  commit(reached, curvature);
  return unit * reached.work;
}

template <class Visit>
void SectionLaw::for_each_zone(const SectionHistory& history, double x, Visit visit) const {
  // Fibres beyond 2/|b - a| flowed on the branch from a to b (beyond 1/|b| on the virgin one) and
  // have been elastic since its end b. Later branches are shorter, so their fibres lie further out.
  const std::size_t n_points = history.reversals.size() + (reverses(history, x) ? 1 : 0);
  double outer = fibres_.extent();
  double end = x;
  for (std::size_t i = n_points + 1; i-- > 0;) {
    const double start = i > 0 ? point_in_force(history, i - 1).x : 0.0;
    const double length = std::abs(end - start);
    const double inner = (i > 0 ? 2.0 : 1.0) / std::max(length, 1e-300);
    if (inner < outer) {
      if (!visit(inner, outer, end > start ? 1.0 : -1.0, x - end)) return;
      outer = inner;
    }
    end = start;
  }
  visit(0.0, outer, 0.0, x);
}

double SectionLaw::elastic_energy(const SectionHistory& history, double curvature) const {
  SectionHistory reached;
  const SectionHistory* now = &history;
  const double x = curvature / yield_curvature_;
  if (!inside_window(history, x)) {
    reached = history;
    commit(reached, curvature);
    now = &reached;
  }
  double energy = 0.0;
  for_each_zone(*now, x, [&](double a, double b, double constant, double slope) {
    energy += fibres_.energy(a, b, constant, slope);
    return true;
  });
  return yield_moment_ * yield_curvature_ * energy;
}

double SectionLaw::outer_stress(const SectionHistory& history, double curvature) const {
  const double x = curvature / yield_curvature_;
  SectionHistory reached = history;
  commit(reached, curvature);
  const double outermost = fibres_.outermost();
  double stress = 0.0;
  for_each_zone(reached, x, [&](double inner, double, double constant, double slope) {
    stress = constant + slope * outermost;
    return inner >= outermost;  // go on to the zone that holds the outermost fibre
  });
  stress += fibres_.hardening() * (x * outermost - stress);
  return -yield_stress_ * fibres_.outer_yield() *
         stress;  // eps = -z kappa: a positive curvature compresses z > 0
}

}  // namespace subimpact
