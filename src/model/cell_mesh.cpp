#include "model/cell_mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model/cell_modes.h"

namespace subimpact {

CellMesh::CellMesh(const Beam& beam, double position, std::size_t n_cells, Extent extent)
    : BeamMesh(extent == Extent::half ? n_cells / 2 + 1 : n_cells, 1, extent == Extent::half),
      n_cells_(n_cells),
      spacing_(beam.length / static_cast<double>(n_cells)),
      mass_per_length_(beam.mass_per_length()),
      rotary_inertia_(beam.rotary_inertia()) {
  if (n_cells < 5) throw std::invalid_argument("cell mesh: at least 5 cells are needed");
  if (symmetric() && (n_cells % 2 == 0 || position != 0.5)) {
    throw std::invalid_argument(
        "cell mesh: a half model needs an odd number of cells, struck at 0.5");
  }
  const double inverse = 1.0 / (spacing_ * spacing_);
  stencil_ = {inverse, -2.0 * inverse, inverse};
  struck_stencil_ = {2.0 * inverse, -2.0 * inverse};
  const std::size_t n = n_unknowns();
  const double copies = symmetric() ? 2.0 : 1.0;  // the mirrored cells are folded in
  const double cell_mass = mass_per_length_ * spacing_;
  const double coupling = rotary_inertia_ / spacing_;
  for (std::size_t i = 0; i < n; ++i) mass_.at(i, i) = copies * cell_mass;
  if (symmetric()) mass_.at(n - 1, n - 1) = cell_mass;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    mass_.at(i, i) += copies * coupling;
    mass_.at(i + 1, i + 1) += copies * coupling;
    mass_.at(i, i + 1) -= copies * coupling;
  }
  std::fill(translation_.begin(), translation_.end(), 1.0);

  const std::size_t n_sections = symmetric() ? n - 1 : n - 2;
  for (std::size_t i = 1; i <= n_sections; ++i) {
    positions_.push_back((static_cast<double>(i) + 0.5) * spacing_);
    weights_.push_back(copies * spacing_);
  }
  if (symmetric()) weights_.back() = spacing_;

  first_end_.terms = {{0, 1.5}, {1, -0.5}};  // no curvature at a free end
  if (symmetric()) {
    struck_point_.terms = {{n - 1, 1.0}};
    struck_section_ = n_sections - 1;
  } else {
    const double cells = static_cast<double>(n_cells);
    const double at = std::clamp(position * cells - 0.5, 0.0, cells - 1.0);
    const auto left = std::min(static_cast<std::size_t>(at), n - 2);
    const double share = at - static_cast<double>(left);
    if (share == 0.0) {
      struck_point_.terms = {{left, 1.0}};
    } else if (share == 1.0) {
      struck_point_.terms = {{left + 1, 1.0}};
    } else {
      struck_point_.terms = {{left, 1.0 - share}, {left + 1, share}};
    }
    const auto nearest = static_cast<std::size_t>(std::lround(at));
    struck_section_ = std::clamp<std::size_t>(nearest, 1, n - 2) - 1;
  }
}

void CellMesh::curvatures(std::span<const double> unknowns, std::span<double> kappa) const {
  const double inverse = 1.0 / (spacing_ * spacing_);
  const std::size_t n_inner = n_unknowns() - 2;
  const double* w = unknowns.data();
  double* k = kappa.data();
  for (std::size_t i = 0; i < n_inner; ++i) k[i] = (w[i + 2] - 2.0 * w[i + 1] + w[i]) * inverse;
  if (symmetric()) k[n_inner] = 2.0 * (w[n_inner] - w[n_inner + 1]) * inverse;
}

void CellMesh::bending_forces(std::span<const double> moments, std::span<double> forces) const {
  // moments[i] belongs to cell i + 1; the mirror's share makes the struck cell's row half of the
  // others', which is what folding its neighbour's force does.
  const double scale = (symmetric() ? 2.0 : 1.0) / spacing_;
  const std::size_t n = n_unknowns();
  const double* m = moments.data();
  double* f = forces.data();
  f[0] = -scale * m[0];
  f[1] = scale * (2.0 * m[0] - m[1]);
  if (symmetric()) {
    for (std::size_t i = 2; i + 1 < n; ++i) f[i] = scale * (2.0 * m[i - 1] - m[i - 2] - m[i]);
    f[n - 1] = scale * (m[n - 2] - m[n - 3]);
  } else {
    for (std::size_t i = 2; i + 2 < n; ++i) f[i] = scale * (2.0 * m[i - 1] - m[i - 2] - m[i]);
    f[n - 2] = scale * (2.0 * m[n - 3] - m[n - 4]);
    f[n - 1] = -scale * m[n - 3];
  }
}

BeamMesh::SectionStencil CellMesh::section_stencil(std::size_t section) const {
  if (symmetric() && section + 1 == n_sections()) return {section, struck_stencil_};
  return {section, stencil_};
}

double CellMesh::highest_frequency(double bending_stiffness) const {
  const double inverse = 4.0 / (spacing_ * spacing_);
  return inverse * std::sqrt(bending_stiffness / (mass_per_length_ + rotary_inertia_ * inverse));
}

NaturalModes CellMesh::natural_modes(double bending_stiffness) const {
  const std::size_t n = n_unknowns();
  NaturalModes modes = free_cell_modes(
      {n_cells_, spacing_, mass_per_length_, rotary_inertia_, bending_stiffness}, symmetric(), n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::span<double> shape(modes.shapes.data() + k * n, n);
    const double scale = 1.0 / std::sqrt(mass().quadratic_form(shape));
    for (double& entry : shape) entry *= scale;
  }
  return modes;
}

std::string CellMesh::description() const {
  return std::to_string(n_cells_) + " cells" + (symmetric() ? ", one half by symmetry" : "");
}

}  // namespace subimpact
