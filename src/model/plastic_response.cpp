#include "model/plastic_response.h"

#include <algorithm>
#include <cmath>

namespace subimpact {
namespace {

constexpr double smallest_entry = 1e-14;  // beside the largest of its kind

}  // namespace

PlasticResponse::PlasticResponse(const MixedMesh& mesh)
    : mesh_(mesh), mass_(mesh.make_mass_solver()), columns_(mesh.n_sections()) {}

// Mass s = J h^2 K^T T^-1 q - rho A h^2 r and M/(E I) = T^-1 (K s - p), with q, r and p at one node.
void PlasticResponse::respond(std::size_t section, double q, double r, double p,
                              std::vector<double>& shift, std::vector<double>& curvature) const {
  const std::size_t node = section + mesh_.first_moment();
  const double before = node > 0 ? mesh_.cell_length(node - 1) : 0.0;
  const double after = node < mesh_.n_kept_cells() ? mesh_.cell_length(node) : 0.0;
  const double h = before > 0.0 && after > 0.0 ? 0.5 * (before + after) : before + after;
  std::vector<double> moment(mesh_.n_sections(), 0.0);
  moment[section] = -mesh_.rotary_inertia() * h * h * q;
  mesh_.solve_hats(moment);
  shift.resize(mesh_.n_unknowns());
  mesh_.forces_of(moment.data(), 1.0, shift.data());
  const std::size_t unknown = node - mesh_.first_unknown();
  if (unknown < shift.size()) {
    shift[unknown] -= mesh_.copies_of_part() * mesh_.mass_per_length() * h * h * r;
  }
  mass_->solve(shift);
  std::vector<double> jump(mesh_.n_sections(), 0.0);
  jump[section] = p;
  curvature.resize(mesh_.n_sections());
  mesh_.jumps(shift.data(), jump.data(), curvature.data());
  mesh_.solve_hats(curvature);
}

std::unique_ptr<const PlasticResponse::Column> PlasticResponse::make(std::size_t section) const {
  std::vector<double> shifts[2], curvatures[2];
  respond(section, 1.0 / 6.0, 1.0 / 12.0, 1.0, shifts[0], curvatures[0]);
  respond(section, -1.0, -1.0, 0.0, shifts[1], curvatures[1]);
  std::vector<double> at_rest(mesh_.n_sections(), 0.0);
  at_rest[section] = -1.0;
  mesh_.solve_hats(at_rest);

  auto column = std::make_unique<Column>();
  column->to_unknown = static_cast<long>(mesh_.first_unknown()) -
                       static_cast<long>(mesh_.first_moment());
  const auto unknown_of = [&](std::size_t i) { return static_cast<long>(i) - column->to_unknown; };
  const auto shift_at = [&](std::size_t which, std::size_t i) {
    const long u = unknown_of(i);
    return u >= 0 && u < static_cast<long>(shifts[which].size())
               ? shifts[which][static_cast<std::size_t>(u)]
               : 0.0;
  };
  const auto value = [&](int kind, std::size_t i) {
    switch (kind) {
      case curvature_of_p:
        return curvatures[0][i];
      case curvature_of_b:
        return curvatures[1][i];
      case shift_of_p:
        return shift_at(0, i);
      case shift_of_b:
        return shift_at(1, i);
      default:
        return at_rest[i];
    }
  };
  std::size_t first = section, end = section + 1;
  for (int kind = 0; kind < n_kinds; ++kind) {
    double largest = 0.0;
    for (std::size_t i = 0; i < mesh_.n_sections(); ++i) {
      largest = std::max(largest, std::abs(value(kind, i)));
    }
    for (std::size_t i = 0; i < mesh_.n_sections(); ++i) {
      if (std::abs(value(kind, i)) < smallest_entry * largest) continue;
      first = std::min(first, i);
      end = std::max(end, i + 1);
    }
  }
  column->first = first;
  column->size = end - first;
  for (int kind = 0; kind < n_kinds; ++kind) {
    for (std::size_t i = first; i < end; ++i) column->values.push_back(value(kind, i));
  }
  return column;
}

}  // namespace subimpact
