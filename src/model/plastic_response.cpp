#include "model/plastic_response.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace subimpact {
namespace {

constexpr std::size_t nodes_of_ends = 5;  // Gregory's weights, and one
constexpr double smallest_entry = 1e-12;  // beside the largest of its kind

}  // namespace

PlasticResponse::PlasticResponse(const MixedMesh& mesh)
    : mesh_(mesh), mass_(mesh.make_mass_solver()), columns_(mesh.n_sections()) {}

// Mass s = J h^2 K^T T^-1 q - rho A h^2 r and M/(E I) = T^-1 (K s - p), with q, r and p at one
// node.
PlasticResponse::Response PlasticResponse::respond(std::size_t section, double q, double r,
                                                   double p) const {
  const std::size_t node = section + mesh_.first_moment();
  const double before = node > 0 ? mesh_.cell_length(node - 1) : 0.0;
  const double after = node < mesh_.n_kept_cells() ? mesh_.cell_length(node) : 0.0;
  const double h = before > 0.0 && after > 0.0 ? 0.5 * (before + after) : before + after;
  std::vector<double> moment(mesh_.n_sections(), 0.0);
  moment[section] = -mesh_.rotary_inertia() * h * h * q;
  mesh_.solve_hats(moment);
  Response result{std::vector<double>(mesh_.n_unknowns()), moment};
  mesh_.forces_of(moment.data(), 1.0, result.shift.data());
  const std::size_t unknown = node - mesh_.first_unknown();  // wraps at a held node
  if (unknown < result.shift.size()) {
    result.shift[unknown] -= mesh_.copies_of_part() * mesh_.mass_per_length() * h * h * r;
  }
  mass_->solve(result.shift);
  std::vector<double> jump(mesh_.n_sections(), 0.0);
  jump[section] = p;
  mesh_.jumps(result.shift.data(), jump.data(), result.curvature.data());
  mesh_.solve_hats(result.curvature);
  return result;
}

// Within the cells of one length, and off the nodes that have other masses than the rest.
bool PlasticResponse::is_far_from_ends(const Column& column) const {
  const std::size_t first = column.first + mesh_.first_moment();
  const std::size_t end = first + column.size;
  if (first < nodes_of_ends || end + nodes_of_ends > mesh_.n_kept_cells()) return false;
  return end <= mesh_.struck_node() || first > mesh_.struck_node();
}

PlasticResponse::Column PlasticResponse::make(std::size_t section) {
  const bool is_before = section + mesh_.first_moment() < mesh_.struck_node();
  std::optional<Pattern>& pattern = patterns_[is_before ? 0 : 1];
  if (pattern) {
    Column shifted = pattern->column;
    shifted.first += section - pattern->section;  // may wrap; is then far from nothing
    shifted.first_unknown += section - pattern->section;
    if (shifted.first < mesh_.n_sections() && is_far_from_ends(shifted)) return shifted;
  }
  Column column = computed(section);
  if (is_far_from_ends(column)) pattern = Pattern{section, column};
  return column;
}

PlasticResponse::Column PlasticResponse::computed(std::size_t section) const {
  const double of_links = (1.0 - mesh_.share_of_links()) / 6.0;
  const Response of_p = respond(section, of_links, 1.0 / 12.0, 1.0);
  const Response of_b = respond(section, -1.0, -1.0, 0.0);
  const Response at_rest = respond(section, 0.0, 0.0, 1.0);
  const std::size_t n = mesh_.n_sections();
  std::array<std::vector<double>, n_kinds> all{of_p.curvature, of_b.curvature,
                                               std::vector<double>(n), std::vector<double>(n),
                                               at_rest.curvature};
  const std::size_t to_unknown = mesh_.first_moment() - mesh_.first_unknown();  // may wrap
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t unknown = i + to_unknown;
    if (unknown >= mesh_.n_unknowns()) continue;
    all[shift_of_p][i] = of_p.shift[unknown];
    all[shift_of_b][i] = of_b.shift[unknown];
  }
  Column column;
  std::size_t end = section + 1;
  column.first = section;
  for (const std::vector<double>& kind : all) {
    double largest = 0.0;
    for (const double value : kind) largest = std::max(largest, std::abs(value));
    const auto counts = [&](double value) { return std::abs(value) > smallest_entry * largest; };
    const auto first = std::ranges::find_if(kind, counts);
    const auto last = std::find_if(kind.rbegin(), kind.rend(), counts);
    if (first == kind.end()) continue;
    column.first = std::min(column.first, static_cast<std::size_t>(first - kind.begin()));
    end = std::max(end, static_cast<std::size_t>(kind.rend() - last));
  }
  column.size = end - column.first;
  column.skipped = column.first + to_unknown >= mesh_.n_unknowns() ? 1 : 0;
  column.first_unknown = column.first + column.skipped + to_unknown;
  column.n_unknowns =
      std::min(column.size - column.skipped, mesh_.n_unknowns() - column.first_unknown);
  std::vector<double> values;
  values.reserve(n_kinds * column.size);
  for (const std::vector<double>& kind : all) {
    for (std::size_t i = column.first; i < end; ++i) values.push_back(kind[i]);
  }
  column.values = std::make_shared<const std::vector<double>>(std::move(values));
  return column;
}

}  // namespace subimpact
