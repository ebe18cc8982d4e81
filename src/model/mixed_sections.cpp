#include "model/mixed_sections.h"

#include <algorithm>
#include <cmath>

#include "numerics/gauss.h"

namespace subimpact {
namespace {

constexpr double tolerance = 1e-8;  // of the equations, in M_y
constexpr double off_hinge = MomentLaw::limit - 1e-4;  // where a hinge that stops is left
constexpr int most_iterations = 60;
constexpr int bold_iterations = 10;  // after which the error must fall in each
constexpr int most_rounds = 40;

double bubble_of(double hat) { return (hat - hat * hat * hat) / 6.0; }

// Where a step of size `step` towards the pole of the law at a distance `left` ends, as a part of
// it: taken in the curvature, in which the law is nearly linear.
double part_of_step(double left, double step) {
  if (step < 0.1 * left) return 1.0;
  const double x = left > 0.5 ? 1.5 - left : 1.0 / std::sqrt(2.0 * left);
  const double reached = x + step * (left > 0.5 ? 1.0 : x * x * x);
  const double left_then = reached <= 1.0 ? 1.5 - reached : 0.5 / (reached * reached);
  return (left - left_then) / step;
}

}  // namespace

MixedSections::MixedSections(const MixedMesh& mesh, double stiffness,
                             std::optional<SectionLaw> law)
    : mesh_(mesh),
      stiffness_(stiffness),
      law_(std::move(law)),
      yield_curvature_(law_ ? law_->window({}).high : 1.0),
      response_(mesh),
      cell_of_(mesh.n_kept_cells(), none),
      low_(mesh.n_sections(), -yield_curvature_),
      high_(mesh.n_sections(), yield_curvature_),
      p_(mesh.n_sections(), 0.0),
      elastic_(mesh.n_sections(), 0.0),
      before_(elastic_),
      earlier_(elastic_),
      scratch_(mesh.n_kept_cells()) {
  for (std::size_t i = 0; i < mesh.n_sections(); ++i) {
    if (mesh.may_hinge(i + mesh.first_moment())) hinges_.push_back({.section = i});
  }
}

bool MixedSections::solve(const double* unknowns, double* moved) {
  mesh_.jumps(unknowns, p_.data(), elastic_.data());
  mesh_.solve_hats(elastic_);
  flowed_ = false;
  for (Hinge& hinge : hinges_) hinge.turned = hinge.sense = 0.0;
  if (!law_) return true;
  coupled_ = moved != nullptr;
  active_.clear();
  if (!find_active()) return true;
  for (const std::size_t cell : flowing_) {
    if (std::ranges::find(active_, cell) == active_.end()) active_.push_back(cell);
  }
  flowed_ = true;
  ++n_solves_;
  // The moments without flow stay in elastic_ until all cells that flow have been found.
  for (int round = 0; round < most_rounds; ++round) {
    std::ranges::sort(active_);
    gather();
    if (!newton()) return false;
    AlignedVector& now = elastic_;
    apply(nullptr);
    const bool more = find_active();
    if (!more) break;
    // take back
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const PlasticResponse::Column& column = response_.column(nodes_[i]);
      const double p = -p_new_[i] * yield_curvature_, b = -b_new_[i] * yield_curvature_;
      const double* of_p = column.of(coupled_ ? PlasticResponse::curvature_of_p
                                              : PlasticResponse::curvature_at_rest);
      const double* of_b = column.of(PlasticResponse::curvature_of_b);
      double* at = now.data() + column.first;
      for (std::size_t k = 0; k < column.size; ++k) at[k] += p * of_p[k];
      if (coupled_) for (std::size_t k = 0; k < column.size; ++k) at[k] += b * of_b[k];
    }
  }
  if (moved != nullptr) apply(moved);
  return true;
}

bool MixedSections::find_active() {
  const std::size_t n_before = active_.size();
  const double* now = elastic_.data();
  const double* low = low_.data();
  const double* high = high_.data();
  const auto are_outside = [=](std::size_t i) {
    const Lanes here = lanes_at(now + i);
    return (here > lanes_at(high + i)) | (here < lanes_at(low + i));
  };
  const auto is_outside = [=](std::size_t i) { return now[i] > high[i] || now[i] < low[i]; };
  for_each_found(elastic_.size(), are_outside, is_outside, [&](std::size_t i) {
    const std::size_t node = i + mesh_.first_moment();
    for (const std::size_t cell : {node - 1, node}) {
      if (cell >= mesh_.n_kept_cells()) continue;  // also -1
      if (cell_of_[cell] == none) make_cell(cell);
      const std::size_t index = cell_of_[cell];
      if (std::ranges::find(active_, index) != active_.end()) continue;
      if (flows(cells_[index])) active_.push_back(index);
    }
  });
  return active_.size() > n_before;
}

bool MixedSections::flows(const Cell& cell) const {
  const std::size_t first = mesh_.first_moment();
  double ends[2];
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t section = cell.cell + k - first;
    ends[k] = section < elastic_.size() ? elastic_[section] / yield_curvature_ : 0.0;
  }
  for (std::size_t i = cell.first_point; i < cell.end_point; ++i) {
    const Point& point = points_[i];
    const double moment = point.hat[0] * ends[0] + point.hat[1] * ends[1];
    if (moment > point.law.high() || moment < point.law.low()) return true;
  }
  return false;
}

void MixedSections::make_cell(std::size_t cell) {
  Cell made{cell, points_.size(), 0, {none, none}, {}, {}};
  const double h = mesh_.cell_length(cell);
  const auto add = [&](double at, double weight) {
    Point point{};
    const double hats[] = {1.0 - at, at};
    for (int k = 0; k < 2; ++k) {
      point.hat[k] = hats[k];
      point.weight[k] = h * weight * hats[k];
      point.bubble[k] = h * weight * bubble_of(hats[k]);
    }
    points_.push_back(point);
  };
  const bool cusp_before = mesh_.may_hinge(cell);
  const bool cusp_after = mesh_.may_hinge(cell + 1);
  if (!cusp_before && !cusp_after) {
    for (std::size_t k = 0; k < 2; ++k) add(gauss<2>.points[k], gauss<2>.weights[k]);
  } else {
    // In t with x = t^2 from the hinge, which integrates the cusp x^-1/2 exactly.
    for (std::size_t k = 0; k < 5; ++k) {
      const double t = gauss<5>.points[k];
      add(cusp_before ? t * t : 1.0 - t * t, 2.0 * t * gauss<5>.weights[k]);
    }
  }
  made.end_point = points_.size();
  cell_of_[cell] = cells_.size();
  cells_.push_back(made);
}

// Sections of the equations, and what p and b at each does to the moments of all.
void MixedSections::gather() {
  const auto read_moments = [&] {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      elastic_moment_[i] = elastic_[nodes_[i]] / yield_curvature_;
    }
  };
  if (active_ == gathered_ && gathered_coupled_ == coupled_) return read_moments();
  gathered_ = active_;
  gathered_coupled_ = coupled_;
  const std::size_t first = mesh_.first_moment();
  nodes_.clear();
  const auto note = [&](std::size_t node) {
    const std::size_t section = node - first;
    if (node < first || section >= mesh_.n_sections()) return;  // the end: no moment
    if (std::ranges::find(nodes_, section) == nodes_.end()) nodes_.push_back(section);
  };
  for (const std::size_t index : active_) {
    note(cells_[index].cell);
    note(cells_[index].cell + 1);
  }
  std::ranges::sort(nodes_);
  const auto local = [&](std::size_t section) {
    const auto at = std::ranges::lower_bound(nodes_, section);
    return at != nodes_.end() && *at == section ? static_cast<std::size_t>(at - nodes_.begin())
                                                : none;
  };
  for (const std::size_t index : active_) {
    Cell& cell = cells_[index];
    cell.local[0] = cell.cell < first ? none : local(cell.cell - first);
    cell.local[1] = local(cell.cell + 1 - first);
  }
  for (Hinge& hinge : hinges_) hinge.local = local(hinge.section);
  const std::size_t n = nodes_.size();
  for (auto* each : {&moment_, &elastic_moment_, &p_new_, &b_new_, &residual_, &step_}) each->resize(n);
  for (auto* each : {&of_p_, &of_b_, &jacobian_}) each->assign(n * n, 0.0);
  for (std::size_t j = 0; j < n; ++j) {
    const PlasticResponse::Column& column = response_.column(nodes_[j]);
    for (std::size_t i = 0; i < n; ++i) {
      of_p_[j * n + i] = column.at(coupled_ ? PlasticResponse::curvature_of_p
                                            : PlasticResponse::curvature_at_rest, nodes_[i]);
      of_b_[j * n + i] = coupled_ ? column.at(PlasticResponse::curvature_of_b, nodes_[i]) : 0.0;
    }
  }
  read_moments();
}

double MixedSections::evaluate_law() {
  const std::size_t n = nodes_.size();
  std::ranges::fill(p_new_, 0.0);
  std::ranges::fill(b_new_, 0.0);
  for (const std::size_t index : active_) {
    Cell& cell = cells_[index];
    double ends[2], p[2] = {}, b[2] = {};
    for (int k = 0; k < 2; ++k) ends[k] = cell.local[k] == none ? 0.0 : moment_[cell.local[k]];
    for (auto& row : cell.of_p) row[0] = row[1] = 0.0;
    for (auto& row : cell.of_b) row[0] = row[1] = 0.0;
    for (std::size_t i = cell.first_point; i < cell.end_point; ++i) {
      Point& point = points_[i];
      point.moment = point.hat[0] * ends[0] + point.hat[1] * ends[1];
      const MomentLaw::Flow flow = point.law.at(point.moment);
      const double flowed = flow.plastic - point.law.plastic();
      if (flow.slope == 0.0) continue;
      for (int k = 0; k < 2; ++k) {
        p[k] += point.weight[k] * flowed;
        b[k] += point.bubble[k] * flowed;
        for (int l = 0; l < 2; ++l) {
          cell.of_p[k][l] += point.weight[k] * flow.slope * point.hat[l];
          cell.of_b[k][l] += point.bubble[k] * flow.slope * point.hat[l];
        }
      }
    }
    for (int k = 0; k < 2; ++k) {
      const std::size_t row = cell.local[k];
      if (row == none) continue;
      p_new_[row] += p[k];
      b_new_[row] += b[k];
    }
  }
  for (const Hinge& hinge : hinges_) {
    if (hinge.sense != 0.0) p_new_[hinge.local] += hinge.turned;
  }
  for (std::size_t i = 0; i < n; ++i) residual_[i] = moment_[i] - elastic_moment_[i];
  for (std::size_t j = 0; j < n; ++j) {
    const double p = p_new_[j], b = b_new_[j];
    if (p == 0.0 && b == 0.0) continue;
    const double* of_p = of_p_.data() + j * n;
    const double* of_b = of_b_.data() + j * n;
    double* result = residual_.data();
    for (std::size_t i = 0; i < n; ++i) result[i] -= of_p[i] * p + of_b[i] * b;
  }
  double largest = 0.0;
  for (const double error : residual_) {
    largest = std::abs(error) <= largest ? largest : std::abs(error);  // NaN too
  }
  return largest;
}

void MixedSections::assemble() {
  const std::size_t n = nodes_.size();
  double* jac = jacobian_.data();
  std::fill_n(jac, n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) jac[i * n + i] = 1.0;
  for (const std::size_t index : active_) {
    const Cell& cell = cells_[index];
    for (int k = 0; k < 2; ++k) {
      const std::size_t row = cell.local[k];
      if (row == none) continue;
      for (int l = 0; l < 2; ++l) {
        const std::size_t column = cell.local[l];
        if (column == none || cell.of_p[k][l] == 0.0) continue;
        const double p = cell.of_p[k][l], b = cell.of_b[k][l];
        const double* of_p = of_p_.data() + row * n;
        const double* of_b = of_b_.data() + row * n;
        double* result = jac + column * n;
#pragma GCC ivdep
        for (std::size_t i = 0; i < n; ++i) result[i] -= of_p[i] * p + of_b[i] * b;
      }
    }
  }
  for (const Hinge& hinge : hinges_) {
    if (hinge.sense == 0.0) continue;
    const std::size_t start = hinge.local * n;
    for (std::size_t i = 0; i < n; ++i) jac[start + i] = -of_p_[start + i];
  }
}

void MixedSections::eliminate() {
  const std::size_t n = nodes_.size();
  for (std::size_t i = 0; i < n; ++i) step_[i] = -residual_[i];
  double* x = step_.data();
  for (std::size_t k = 0; k < n; ++k) {
    double* pivot = jacobian_.data() + k * n;
    const double inverse = 1.0 / pivot[k];
    for (std::size_t i = k + 1; i < n; ++i) pivot[i] *= inverse;
    const auto subtract = [&](double* column) {
      const double factor = column[k];
      if (factor == 0.0) return;
#pragma GCC ivdep
      for (std::size_t i = k + 1; i < n; ++i) column[i] -= factor * pivot[i];
    };
    for (std::size_t j = k + 1; j < n; ++j) subtract(jacobian_.data() + j * n);
    subtract(x);
  }
  for (std::size_t k = n; k-- > 0;) {
    const double* column = jacobian_.data() + k * n;
    x[k] /= column[k];
    for (std::size_t i = 0; i < k; ++i) x[i] -= x[k] * column[i];
  }
}

// Moves moment_ by step_, nowhere past the pole of the law.
void MixedSections::advance() {
  const std::size_t n = nodes_.size();
  residual_.assign(n, 1.0);  // part of the step that each node takes
  const auto limit = [&](double moment, double step) {
    const double left = MomentLaw::limit - std::copysign(moment, moment * step);
    return part_of_step(left, std::abs(step));
  };
  for (Hinge& hinge : hinges_) {
    if (hinge.local == none) continue;
    double& step = step_[hinge.local];
    if (hinge.sense != 0.0) {
      hinge.turned += step;
      step = 0.0;
    } else {
      residual_[hinge.local] = limit(moment_[hinge.local], step);
    }
  }
  for (const std::size_t index : active_) {
    const Cell& cell = cells_[index];
    double steps[2], ends[2];
    for (int k = 0; k < 2; ++k) {
      const bool is_end = cell.local[k] == none;
      steps[k] = is_end ? 0.0 : step_[cell.local[k]];
      ends[k] = is_end ? 0.0 : moment_[cell.local[k]];
    }
    for (std::size_t i = cell.first_point; i < cell.end_point; ++i) {
      const Point& point = points_[i];
      const double step = point.hat[0] * steps[0] + point.hat[1] * steps[1];
      const double part = limit(point.hat[0] * ends[0] + point.hat[1] * ends[1], step);
      for (int k = 0; k < 2; ++k) {
        if (cell.local[k] == none) continue;
        double& taken = residual_[cell.local[k]];
        taken = std::min(taken, part);
      }
    }
  }
  for (double part = 1.0;; part *= 0.5) {
    for (std::size_t i = 0; i < n; ++i) moment_[i] += part * residual_[i] * step_[i];
    if (is_inside()) return;
    for (std::size_t i = 0; i < n; ++i) moment_[i] -= part * residual_[i] * step_[i];
    if (part < 1e-3) return;
  }
}

// As advance(), but all nodes by the same part of the step, so short that the error falls.
void MixedSections::descend(double error) {
  const std::vector<double> start = moment_;
  std::vector<double> step = step_;
  std::vector<double> turned;
  for (Hinge& hinge : hinges_) {
    turned.push_back(hinge.turned);
    if (hinge.sense != 0.0) step[hinge.local] = 0.0;
  }
  for (double part = 1.0; part > 1e-6; part *= 0.5) {
    for (std::size_t i = 0; i < start.size(); ++i) moment_[i] = start[i] + part * step[i];
    for (std::size_t k = 0; k < hinges_.size(); ++k) {
      Hinge& hinge = hinges_[k];
      if (hinge.sense != 0.0) hinge.turned = turned[k] + part * step_[hinge.local];
    }
    if (is_inside() && evaluate_law() < (1.0 - 0.1 * part) * error) return;
  }
}

bool MixedSections::is_inside() const {
  for (const Hinge& hinge : hinges_) {
    if (hinge.local != none && std::abs(moment_[hinge.local]) > MomentLaw::limit) return false;
  }
  for (const std::size_t index : active_) {
    const Cell& cell = cells_[index];
    double ends[2];
    for (int k = 0; k < 2; ++k) ends[k] = cell.local[k] == none ? 0.0 : moment_[cell.local[k]];
    for (std::size_t i = cell.first_point; i < cell.end_point; ++i) {
      const double at = points_[i].hat[0] * ends[0] + points_[i].hat[1] * ends[1];
      if (!(std::abs(at) < MomentLaw::limit)) return false;
    }
  }
  return true;
}

bool MixedSections::newton() {
  const std::size_t n = nodes_.size();
  for (Hinge& hinge : hinges_) {
    hinge.sense = hinge.local == none ? 0.0 : hinge.sense_before;
    hinge.turned = 0.0;
  }
  // From the moments extrapolated over the last two commits.
  for (std::size_t i = 0; i < n; ++i) {
    moment_[i] = before_[nodes_[i]] / yield_curvature_;
    step_[i] = (before_[nodes_[i]] - earlier_[nodes_[i]]) / yield_curvature_;
  }
  for (const Hinge& hinge : hinges_) {
    if (hinge.local == none) continue;
    double& moment = moment_[hinge.local];
    if (hinge.sense != 0.0) {
      step_[hinge.local] = 0.0;
      moment = hinge.sense * MomentLaw::limit;
    } else {
      moment = std::clamp(moment, -off_hinge, off_hinge);
    }
  }
  advance();
  int freed = 0;
  for (int k = 0; k < most_iterations; ++k) {
    const double error = evaluate_law();
    ++n_iterations_;
    if (error < tolerance) {
      bool changed = false;
      for (Hinge& hinge : hinges_) {
        if (hinge.sense == 0.0 || hinge.turned * hinge.sense >= 0.0 || freed > 3) continue;
        hinge.turned = 0.0;
        moment_[hinge.local] = hinge.sense * off_hinge;
        hinge.sense = 0.0;
        ++freed;
        changed = true;
      }
      if (!changed) return true;
      continue;
    }
    if (!std::isfinite(error)) return false;
    assemble();
    eliminate();
    if (k < bold_iterations) {
      advance();
    } else {
      descend(error);
    }
    for (Hinge& hinge : hinges_) {
      if (hinge.local == none || hinge.sense != 0.0) continue;
      double& moment = moment_[hinge.local];
      const double left = MomentLaw::limit - std::abs(moment);
      if (left < (freed > 0 ? 1e-9 : 1e-5)) {
        hinge.sense = std::copysign(1.0, moment);
        moment = hinge.sense * MomentLaw::limit;
      }
    }
  }
  return false;
}

void MixedSections::apply(double* moved) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const PlasticResponse::Column& column = response_.column(nodes_[i]);
    const double p = p_new_[i] * yield_curvature_;
    const double b = b_new_[i] * yield_curvature_;
    if (p == 0.0 && b == 0.0) continue;
    if (moved == nullptr) {
      double* at = elastic_.data() + column.first;
      const double* of_p = column.of(coupled_ ? PlasticResponse::curvature_of_p
                                              : PlasticResponse::curvature_at_rest);
      const double* of_b = column.of(PlasticResponse::curvature_of_b);
      if (coupled_) {
        for (std::size_t k = 0; k < column.size; ++k) at[k] += p * of_p[k] + b * of_b[k];
      } else {
        for (std::size_t k = 0; k < column.size; ++k) at[k] += p * of_p[k];
      }
      continue;
    }
    const long start = static_cast<long>(column.first) - column.to_unknown;
    const double* of_p = column.of(PlasticResponse::shift_of_p);
    const double* of_b = column.of(PlasticResponse::shift_of_b);
    const long n = static_cast<long>(mesh_.n_unknowns());
    const long from = std::max(0L, -start);
    const long to = std::min(static_cast<long>(column.size), n - start);
    for (long k = from; k < to; ++k) moved[start + k] += p * of_p[k] + b * of_b[k];
  }
}

bool MixedSections::commit() {
  earlier_.swap(before_);
  std::ranges::copy(elastic_, before_.begin());
  flowing_.clear();
  for (Hinge& hinge : hinges_) hinge.sense_before = flowed_ ? hinge.sense : 0.0;
  if (!flowed_) return false;
  for (const std::size_t index : active_) {
    Cell& cell = cells_[index];
    bool flows = false;
    for (std::size_t i = cell.first_point; i < cell.end_point; ++i) {
      Point& point = points_[i];
      if (point.moment >= point.law.low() && point.moment <= point.law.high()) continue;
      point.law.commit(point.moment, *law_, yield_curvature_);
      flows = true;
    }
    if (!flows) continue;
    flowing_.push_back(index);
    bound(cell);
  }
  for (Hinge& hinge : hinges_) {
    hinge.rotation += hinge.turned;
    hinge.path += std::abs(hinge.turned);
    hinge.turned = 0.0;
  }
  for (std::size_t i = 0; i < nodes_.size(); ++i) p_[nodes_[i]] += p_new_[i] * yield_curvature_;
  flowed_ = false;
  return true;
}

void MixedSections::bound(const Cell& of) {
  const std::size_t first = mesh_.first_moment();
  for (const std::size_t node : {of.cell, of.cell + 1}) {
    const std::size_t section = node - first;
    if (node < first || section >= mesh_.n_sections()) continue;
    double low = -1.5, high = 1.5;
    bool any_made = false;
    for (const std::size_t cell : {node - 1, node}) {
      if (cell >= mesh_.n_kept_cells()) continue;
      if (cell_of_[cell] == none) {
        low = std::max(low, -1.0);
        high = std::min(high, 1.0);
        continue;
      }
      any_made = true;
      const Cell& made = cells_[cell_of_[cell]];
      for (std::size_t i = made.first_point; i < made.end_point; ++i) {
        low = std::max(low, points_[i].law.low());
        high = std::min(high, points_[i].law.high());
      }
    }
    if (any_made) {
      low_[section] = low * yield_curvature_;
      high_[section] = high * yield_curvature_;
    }
  }
}

// In M_y; just within the limits, which rounding may touch.
double MixedSections::moment_in(const Cell& cell, const Point& point) const {
  double moment = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t section = cell.cell + k - mesh_.first_moment();
    if (section < elastic_.size()) moment += point.hat[k] * elastic_[section];
  }
  constexpr double largest = MomentLaw::limit * (1.0 - 1e-15);
  return std::clamp(moment / yield_curvature_, -largest, largest);
}

MixedSections::Energies MixedSections::energies() const {
  Energies sum;
  const std::size_t n = elastic_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t node = i + mesh_.first_moment();
    const double before = node > 0 ? mesh_.cell_length(node - 1) : 0.0;
    const double after = node < mesh_.n_kept_cells() ? mesh_.cell_length(node) : 0.0;
    sum.elastic += elastic_[i] * elastic_[i] * (before + after) / 3.0;
    if (i + 1 < n) sum.elastic += elastic_[i] * elastic_[i + 1] * after / 3.0;
  }
  sum.elastic *= 0.5 * stiffness_;
  const double unit = stiffness_ * yield_curvature_ * yield_curvature_;
  for (const Cell& cell : cells_) {
    for (std::size_t i = cell.first_point; i < cell.end_point; ++i) {
      const Point& point = points_[i];
      const double moment = moment_in(cell, point);
      const double curvature = (moment + point.law.at(moment).plastic) * yield_curvature_;
      const double elastic = law_->elastic_energy(point.law.history(), curvature);
      const double work = law_->work(point.law.history(), curvature);
      const double weight = point.weight[0] + point.weight[1];
      sum.elastic += weight * (elastic - 0.5 * unit * moment * moment);
      sum.plastic += weight * (work - elastic);
    }
  }
  for (const Hinge& hinge : hinges_) {
    sum.plastic += MomentLaw::limit * unit * (hinge.path + std::abs(hinge.turned));
  }
  return {mesh_.copies_of_part() * sum.elastic, mesh_.copies_of_part() * sum.plastic};
}

void MixedSections::read_bending(std::span<double> curvatures, std::span<double> moments) const {
  for (std::size_t i = 0; i < elastic_.size(); ++i) curvatures[i] = p_[i];
  for (std::size_t i = 0; flowed_ && i < nodes_.size(); ++i) {
    curvatures[nodes_[i]] += p_new_[i] * yield_curvature_;
  }
  for (std::size_t i = 0; i < elastic_.size(); ++i) {
    curvatures[i] *= mesh_.copies_of_part() / mesh_.section_weights()[i];
    curvatures[i] += elastic_[i];
    moments[i] = stiffness_ * elastic_[i];
  }
}

double MixedSections::outer_stress_at_strike(double outer_stiffness) const {
  const std::size_t index = cell_of_[mesh_.struck_node() - 1];
  if (index == none) return -outer_stiffness * elastic_[mesh_.struck_section()];
  const Cell& cell = cells_[index];
  const Point& nearest = points_[cell.first_point];
  const double moment = moment_in(cell, nearest);
  return law_->outer_stress(nearest.law.history(),
                            (moment + nearest.law.at(moment).plastic) * yield_curvature_);
}

std::size_t MixedSections::n_yielded() const {
  return static_cast<std::size_t>(std::ranges::count_if(p_, [](double p) { return p != 0.0; }));
}

}  // namespace subimpact
