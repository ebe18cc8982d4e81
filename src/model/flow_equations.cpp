#include "model/flow_equations.h"

#include <algorithm>
#include <cmath>

namespace subimpact {
namespace {

constexpr auto none = SubCellSections::none;
constexpr double tolerance = 1e-6;  // of the equations, in M_y
constexpr int most_iterations = 300;
constexpr int bold_iterations = 10;
constexpr int most_releases = 4;  // of hinges, in one solution
// Responses that are smaller beside that of a node to itself, those of nodes far away, are left out
// of the matrix in bold iterations: steps then err by as little, and errors of the equations do
// not.
constexpr double least_in_matrix = 1e-5;
// Distance from M_p, in M_y, where a hinge that stops turning is left, and within which one begins
// to turn, at first and after one has stopped.
constexpr double off_hinge = 1e-4;
constexpr double at_hinge = 1e-5;
constexpr double at_hinge_again = 1e-9;
// Between these distances the moment of a hinge that can neither turn nor be free is looked for.
constexpr double shortest_hold = 1e-14;
constexpr double longest_hold = 1.0;
constexpr int most_bisections = 100;

// Measured on scenes of 400 to 3000 cells: costs of a cell's sections in one iteration, and of an
// elimination for n nodes over n^3, in accelerations of a cell.
constexpr double work_of_cell = 95.0;
constexpr double work_of_elimination = 0.011;

}  // namespace

FlowEquations::FlowEquations(const MixedMesh& mesh, SubCellSections& cells, double yield_curvature)
    : mesh_(mesh), cells_(cells), yield_curvature_(yield_curvature), response_(mesh) {
  for (std::size_t i = 0; i < mesh.n_sections(); ++i) {
    if (mesh.may_hinge(i + mesh.first_moment())) hinges_.push_back({.section = i});
  }
}

std::size_t FlowEquations::local_of(std::size_t node) const {
  const std::size_t section = node - mesh_.first_moment();  // wraps where a node has no moment
  const auto at = std::ranges::lower_bound(nodes_, section);
  return at != nodes_.end() && *at == section ? static_cast<std::size_t>(at - nodes_.begin())
                                              : none;
}

void FlowEquations::gather(const std::vector<std::size_t>& active, bool coupled) {
  if (active == gathered_ && coupled == coupled_) return;
  gathered_ = active;
  coupled_ = coupled;
  nodes_.clear();
  for (const std::size_t index : active) {
    for (const std::size_t node : {cells_.cell_of(index), cells_.cell_of(index) + 1}) {
      const std::size_t section = node - mesh_.first_moment();
      if (section < mesh_.n_sections()) nodes_.push_back(section);
    }
  }
  std::ranges::sort(nodes_);
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  local_cells_.clear();
  for (const std::size_t index : active) {
    const std::size_t cell = cells_.cell_of(index);
    local_cells_.push_back({index, {local_of(cell), local_of(cell + 1)}, {}});
  }
  for (Hinge& hinge : hinges_) hinge.local = local_of(hinge.section + mesh_.first_moment());
  const std::size_t stride = (nodes_.size() + n_lanes - 1) / n_lanes * n_lanes;
  if (stride != stride_) resize(stride);
  read_responses();
}

void FlowEquations::resize(std::size_t stride) {
  stride_ = stride;
  for (auto* each : {&moments_, &without_flow_, &p_, &b_, &error_, &step_, &part_, &tried_,
                     &tried_turn_, &above_}) {
    each->assign(stride_, 0.0);
  }
}

void FlowEquations::read_responses() {
  const std::size_t n = nodes_.size();
  for (auto* each : {&of_p_, &of_b_}) each->assign(n * stride_, 0.0);
  jacobian_.resize(n * stride_);
  const auto of_p = coupled_ ? PlasticResponse::curvature_of_p : PlasticResponse::curvature_at_rest;
  band_ = 0;
  for (std::size_t j = 0; j < n; ++j) {
    const PlasticResponse::Column& column = response_.column(nodes_[j]);
    const auto read = [&](PlasticResponse::Kind kind, AlignedVector& into) {
      const double* values = column.of(kind);
      double* result = into.data() + j * stride_;
      std::size_t i = 0;
      while (nodes_[i] < column.first) ++i;
      for (; i < n && nodes_[i] < column.first + column.size; ++i) {
        result[i] = values[nodes_[i] - column.first];
      }
    };
    read(of_p, of_p_);
    if (coupled_) read(PlasticResponse::curvature_of_b, of_b_);
    const double* own = of_p_.data() + j * stride_;
    const double least = least_in_matrix * std::abs(own[j]);
    const auto counts = [&](std::size_t i) { return std::abs(own[i]) > least; };
    std::size_t last = n - 1, first = 0;  // responses change their sign on the way
    while (last > j + band_ && !counts(last)) --last;
    while (first + band_ < j && !counts(first)) ++first;
    band_ = std::max({band_, last - std::min(last, j), j - std::min(first, j)});
  }
}

bool FlowEquations::solve(const std::vector<std::size_t>& active, bool coupled,
                          const Moments& moments) {
  gather(active, coupled);
  start(moments);
  if (iterate(bold_iterations)) return true;
  // Again from the moments of the last commit, by short steps alone.
  start({moments.without_flow, moments.before, moments.before});
  return iterate(0);
}

bool FlowEquations::iterate(int bold) {
  double within = at_hinge;
  for (int k = 0; k < most_releases; ++k) {
    if (!converge(bold, within)) return false;
    if (!release_hinges()) return true;
    within = at_hinge_again;
  }
  return converge(bold, within) && std::ranges::all_of(hinges_, [this](Hinge& hinge) {
           return !hinge.turns_back() || hold(hinge);
         });
}

bool FlowEquations::converge(int bold, double within) {
  for (int k = 0; k < most_iterations; ++k) {
    const double error = evaluate();
    if (!std::isfinite(error)) return false;
    if (error < tolerance) return true;
    if (k == bold) band_ = nodes_.size();
    find_step();
    if (k < bold) {
      advance();
    } else {
      descend(error);
    }
    engage_hinges(within);
    pull_inside();
  }
  return false;
}

bool FlowEquations::hold(Hinge& hinge) {
  double low = shortest_hold, high = longest_hold;
  const double response = of_p_[hinge.local * stride_ + hinge.local];
  for (int k = 0; k < most_bisections; ++k) {
    hinge.below = std::sqrt(low * high);
    moments_[hinge.local] = hinge.moment();
    pull_inside();
    if (!converge(0, at_hinge_again)) return false;
    if (std::abs(response * hinge.turned) < tolerance) {
      hinge.turned = hinge.sense = hinge.below = 0.0;
      evaluate();
      return true;
    }
    (hinge.turns_back() ? low : high) = hinge.below;
  }
  return false;
}

// From the moments extrapolated over the last two commits, hinges turning as they did.
void FlowEquations::start(const Moments& moments) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const std::size_t section = nodes_[i];
    without_flow_[i] = moments.without_flow[section] / yield_curvature_;
    moments_[i] = moments.before[section] / yield_curvature_;
    step_[i] = (moments.before[section] - moments.earlier[section]) / yield_curvature_;
  }
  for (Hinge& hinge : hinges_) {
    hinge.turned = 0.0;
    hinge.sense = hinge.is_among() ? hinge.sense_before : 0.0;
    if (!hinge.is_among()) continue;
    double& moment = moments_[hinge.local];
    if (hinge.turns()) {
      moment = hinge.sense * MomentLaw::limit;
      step_[hinge.local] = 0.0;
    } else {
      constexpr double largest = MomentLaw::limit - off_hinge;
      moment = std::clamp(moment, -largest, largest);
    }
  }
  pull_inside();  // moments of the last step were found to the tolerance only
  advance();
}

SubCellSections::Ends FlowEquations::at_ends(const LocalCell& cell,
                                             const AlignedVector& of_nodes) const {
  const auto at = [&](std::size_t node) { return node == none ? 0.0 : of_nodes[node]; };
  return {at(cell.nodes[0]), at(cell.nodes[1])};
}

// column -= (response to a node's p) p + (that to its b) b, in the rows of a range.
void FlowEquations::subtract_response(std::size_t node, double p, double b, Rows rows,
                                      double* column) const {
  const double* of_p = of_p_.data() + node * stride_;
  const double* of_b = of_b_.data() + node * stride_;
  for (std::size_t i = rows.begin; i < rows.end; i += n_lanes) {
    store(lanes_at(column + i) - (p * lanes_at(of_p + i) + b * lanes_at(of_b + i)), column + i);
  }
}

// p and b at the present moments. Returns the largest error of the equations.
double FlowEquations::evaluate() {
  const std::size_t n = nodes_.size();
  work_ += work_of_cell * static_cast<double>(local_cells_.size());
  std::ranges::fill(p_, 0.0);
  std::ranges::fill(b_, 0.0);
  for (LocalCell& cell : local_cells_) {
    cell.flow = cells_.flow(cell.index, at_ends(cell, moments_));
    for (std::size_t k = 0; k < 2; ++k) {
      if (cell.nodes[k] == none) continue;
      p_[cell.nodes[k]] += cell.flow.p[k];
      b_[cell.nodes[k]] += cell.flow.b[k];
    }
  }
  for (const Hinge& hinge : hinges_) {
    if (hinge.turns()) p_[hinge.local] += hinge.turned;
  }
  for (std::size_t i = 0; i < n; ++i) error_[i] = moments_[i] - without_flow_[i];
  for (std::size_t j = 0; j < n; ++j) {
    if (p_[j] != 0.0 || b_[j] != 0.0) {
      subtract_response(j, p_[j], b_[j], {0, stride_}, error_.data());
    }
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double error = std::abs(error_[i]);
    largest = error <= largest ? largest : error;  // NaN too
  }
  return largest;
}

// Whole lanes that hold the rows of a column within the band.
FlowEquations::Rows FlowEquations::rows_of(std::size_t column) const {
  const std::size_t first = column - std::min(column, band_);
  const std::size_t end = std::min(column + band_ + n_lanes, stride_);
  return {first / n_lanes * n_lanes, end / n_lanes * n_lanes};
}

// What lies outside the band, in these lanes, is zero.
void FlowEquations::assemble() {
  const std::size_t n = nodes_.size();
  for (std::size_t i = 0; i < n; ++i) {
    double* column = jacobian_.data() + i * stride_;
    const Rows rows = rows_of(i);
    std::fill(column + rows.begin, column + rows.end, 0.0);
    column[i] = 1.0;
  }
  for (const LocalCell& cell : local_cells_) {
    for (std::size_t l = 0; l < 2; ++l) {
      if (cell.nodes[l] == none) continue;
      double* column = jacobian_.data() + cell.nodes[l] * stride_;
      for (std::size_t k = 0; k < 2; ++k) {
        const double p = cell.flow.p_slope[k][l], b = cell.flow.b_slope[k][l];
        if (cell.nodes[k] == none || p == 0.0) continue;
        subtract_response(cell.nodes[k], p, b, rows_of(cell.nodes[l]), column);
      }
    }
  }
  for (const Hinge& hinge : hinges_) {
    if (!hinge.turns()) continue;
    const Rows rows = rows_of(hinge.local);
    const std::size_t column = hinge.local * stride_;
    for (std::size_t i = rows.begin; i < rows.end; ++i) jacobian_[column + i] = -of_p_[column + i];
  }
  for (std::size_t j = 0; j < n; ++j) {
    double* column = jacobian_.data() + j * stride_;
    const Rows rows = rows_of(j);
    std::fill(column + rows.begin, column + std::max(rows.begin, j - std::min(j, band_)), 0.0);
    std::fill(column + std::min(j + band_ + 1, rows.end), column + rows.end, 0.0);
  }
}

// step_ = -jacobian^-1 error, by elimination column by column; the diagonal dominates.
void FlowEquations::find_step() {
  assemble();
  const std::size_t n = nodes_.size();
  const auto width = static_cast<double>(std::min(n, band_ + 1));
  work_ += work_of_elimination * static_cast<double>(n) * width * width;
  for (std::size_t i = 0; i < n; ++i) step_[i] = -error_[i];
  const auto subtract = [](double factor, const double* from, double* column, Rows rows) {
    for (std::size_t i = rows.begin; i < rows.end; i += n_lanes) {
      store(lanes_at(column + i) - factor * lanes_at(from + i), column + i);
    }
  };
  for (std::size_t k = 0; k < n; ++k) {
    double* pivot = jacobian_.data() + k * stride_;
    const double inverse = 1.0 / pivot[k];
    // Below the diagonal the multipliers; above it and on it zeros, so that whole lanes will do.
    const Rows rows{k / n_lanes * n_lanes, rows_of(k).end};
    for (std::size_t i = rows.begin; i <= k; ++i) {
      above_[i] = pivot[i];
      pivot[i] = 0.0;
    }
    for (std::size_t i = k + 1; i < rows.end; ++i) pivot[i] *= inverse;
    for (std::size_t j = k + 1; j < std::min(n, k + band_ + 1); ++j) {
      double* column = jacobian_.data() + j * stride_;
      if (column[k] != 0.0) subtract(column[k], pivot, column, rows);
    }
    subtract(step_[k], pivot, step_.data(), rows);
    for (std::size_t i = rows.begin; i <= k; ++i) pivot[i] = above_[i];
  }
  for (std::size_t k = n; k-- > 0;) {
    const double* column = jacobian_.data() + k * stride_;
    const double solved = step_[k] /= column[k];
    const Rows rows{rows_of(k).begin, k / n_lanes * n_lanes};
    subtract(solved, column, step_.data(), rows);
    for (std::size_t i = rows.end; i < k; ++i) step_[i] -= solved * column[i];
  }
}

// Moves each node by the part of step_ that the sections next to the node allow.
void FlowEquations::advance() {
  const std::size_t n = nodes_.size();
  std::ranges::fill(part_, 1.0);
  for (Hinge& hinge : hinges_) {
    if (!hinge.is_among()) continue;
    if (hinge.turns()) {
      hinge.turned += step_[hinge.local];
      step_[hinge.local] = 0.0;
    } else {
      part_[hinge.local] = SubCellSections::part_of_step(moments_[hinge.local], step_[hinge.local]);
    }
  }
  for (const LocalCell& cell : local_cells_) {
    const double part =
        cells_.part_of_step(cell.index, at_ends(cell, moments_), at_ends(cell, step_));
    for (const std::size_t node : cell.nodes) {
      if (node != none) part_[node] = std::min(part_[node], part);
    }
  }
  tried_ = moments_;
  for (double all = 1.0; all > 1e-3; all *= 0.5) {
    for (std::size_t i = 0; i < n; ++i) moments_[i] = tried_[i] + all * part_[i] * step_[i];
    if (is_inside()) return;
  }
  moments_ = tried_;
}

// Moves by one part of step_ for all, so short that the error falls: slower, but without cycles.
void FlowEquations::descend(double error) {
  tried_ = moments_;
  for (const Hinge& hinge : hinges_) {
    if (hinge.turns()) tried_turn_[hinge.local] = hinge.turned;
  }
  for (double part = 1.0; part > 1e-6; part *= 0.5) {
    for (std::size_t i = 0; i < nodes_.size(); ++i) moments_[i] = tried_[i] + part * step_[i];
    for (Hinge& hinge : hinges_) {
      if (!hinge.turns()) continue;
      moments_[hinge.local] = tried_[hinge.local];
      hinge.turned = tried_turn_[hinge.local] + part * step_[hinge.local];
    }
    if (is_inside() && evaluate() < (1.0 - 0.1 * part) * error) return;
  }
}

bool FlowEquations::is_inside() const {
  const auto hinge_is = [&](const Hinge& hinge) {
    return !hinge.is_among() || std::abs(moments_[hinge.local]) <= MomentLaw::limit;
  };
  const auto cell_is = [&](const LocalCell& cell) {
    return cells_.is_inside(cell.index, at_ends(cell, moments_));
  };
  return std::ranges::all_of(hinges_, hinge_is) && std::ranges::all_of(local_cells_, cell_is);
}

// Hinges that would turn against their moment stop. Returns whether any did.
bool FlowEquations::release_hinges() {
  bool any = false;
  for (Hinge& hinge : hinges_) {
    if (!hinge.turns_back()) continue;
    moments_[hinge.local] = hinge.sense * (MomentLaw::limit - off_hinge);
    hinge.turned = hinge.sense = 0.0;
    any = true;
  }
  return any;
}

// Shrinks moments until no section next to a node at the full plastic moment is past it.
void FlowEquations::pull_inside() {
  for (int k = 0; k < most_iterations && !is_inside(); ++k) {
    for (std::size_t i = 0; i < nodes_.size(); ++i) moments_[i] *= 1.0 - tolerance;
    for (const Hinge& hinge : hinges_) {
      if (hinge.turns()) moments_[hinge.local] = hinge.moment();
    }
  }
}

void FlowEquations::engage_hinges(double within) {
  for (Hinge& hinge : hinges_) {
    if (!hinge.is_among() || hinge.turns()) continue;
    double& moment = moments_[hinge.local];
    if (MomentLaw::limit - std::abs(moment) >= within) continue;
    hinge.sense = std::copysign(1.0, moment);
    moment = hinge.sense * MomentLaw::limit;
  }
}

void FlowEquations::forget() {
  for (Hinge& hinge : hinges_) hinge.turned = hinge.sense = 0.0;
}

void FlowEquations::add_to_moments(double factor, std::span<double> elastic_curvatures) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const double p = factor * p_[i] * yield_curvature_, b = factor * b_[i] * yield_curvature_;
    if (p == 0.0 && b == 0.0) continue;
    const PlasticResponse::Column& column = response_.column(nodes_[i]);
    double* result = elastic_curvatures.data() + column.first;
    if (coupled_) {
      const double* of_p = column.of(PlasticResponse::curvature_of_p);
      const double* of_b = column.of(PlasticResponse::curvature_of_b);
      for (std::size_t k = 0; k < column.size; ++k) result[k] += p * of_p[k] + b * of_b[k];
    } else {
      const double* of_p = column.of(PlasticResponse::curvature_at_rest);
      for (std::size_t k = 0; k < column.size; ++k) result[k] += p * of_p[k];
    }
  }
}

void FlowEquations::read_moments(std::span<double> elastic_curvatures) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    elastic_curvatures[nodes_[i]] = moments_[i] * yield_curvature_;
  }
}

void FlowEquations::add_to_unknowns(double* unknowns) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const double p = p_[i] * yield_curvature_, b = b_[i] * yield_curvature_;
    if (p == 0.0 && b == 0.0) continue;
    const PlasticResponse::Column& column = response_.column(nodes_[i]);
    const double* of_p = column.of(PlasticResponse::shift_of_p) + column.skipped;
    const double* of_b = column.of(PlasticResponse::shift_of_b) + column.skipped;
    double* result = unknowns + column.first_unknown;
    for (std::size_t k = 0; k < column.n_unknowns; ++k) result[k] += p * of_p[k] + b * of_b[k];
  }
}

void FlowEquations::add_to_p(std::span<double> p) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i) p[nodes_[i]] += p_[i] * yield_curvature_;
}

void FlowEquations::commit_rest() {
  for (Hinge& hinge : hinges_) hinge.sense_before = 0.0;
}

void FlowEquations::commit(std::vector<std::size_t>& flowed) {
  flowed.clear();
  for (const LocalCell& cell : local_cells_) {
    if (cells_.commit(cell.index, at_ends(cell, moments_))) flowed.push_back(cell.index);
  }
  for (Hinge& hinge : hinges_) {
    hinge.sense_before = hinge.sense;
    hinge.path += std::abs(hinge.turned);
    hinge.turned = 0.0;
  }
}

double FlowEquations::hinge_work() const {
  double work = 0.0;
  for (const Hinge& hinge : hinges_) {
    work += MomentLaw::limit * (hinge.path + std::abs(hinge.turned));
  }
  return work;
}

}  // namespace subimpact
