#include "model/mesh/cell_mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model/mesh/modes.h"
#include "numerics/lanes.h"

namespace subimpact {
namespace {

bool is_clamped(EndSupport end) { return end == EndSupport::clamped; }

std::size_t count_unknowns(const Beam& beam, std::size_t n_cells, bool half) {
  const std::size_t slaved =
      (is_clamped(beam.ends[0]) ? 1 : 0) + (!half && is_clamped(beam.ends[1]) ? 1 : 0);
  const std::size_t fewest = is_clamped(beam.ends[0]) || is_clamped(beam.ends[1])
                                 ? CellMesh::fewest_cells_if_clamped
                                 : CellMesh::fewest_cells;
  if (n_cells < fewest) {
    throw std::invalid_argument("cell mesh: at least 5 cells are needed, 7 with a clamped end");
  }
  return (half ? n_cells / 2 + 1 : n_cells) - slaved;
}

// A place in units of the spacing, without rounding where it is a centre or a face.
double snapped(double at) {
  const double nearest = 0.5 * std::round(2.0 * at);
  return std::abs(at - nearest) < 1e-10 ? nearest : at;
}

// Share of the first unknown in the outermost cell of a clamped end.
constexpr double clamped_share = 1.0 / 9.0;

// Sections of an end, outermost first; `unit` is 1/dx^2.
std::vector<std::array<double, 2>> end_stencils(EndSupport end, double unit) {
  if (end == EndSupport::pinned) return {{-3.0 * unit, unit}};
  if (end == EndSupport::free) return {};
  return {{(1.0 - clamped_share) * unit, 0.0}, {(-2.0 + clamped_share) * unit, unit}};
}

}  // namespace

double CellMesh::spacing_of(const Beam& beam, std::size_t n_cells, Spacing spacing) {
  return beam.length / static_cast<double>(spacing == Spacing::points ? n_cells - 1 : n_cells);
}

CellMesh::CellMesh(const Beam& beam, double position, std::size_t n_cells, Extent extent,
                   Spacing spacing)
    : BeamMesh(count_unknowns(beam, n_cells, extent == Extent::half), 1, extent == Extent::half),
      n_cells_(n_cells),
      spacing_(spacing_of(beam, n_cells, spacing)),
      first_centre_(spacing == Spacing::points ? 0.0 : 0.5),
      mass_per_length_(beam.mass_per_length()),
      rotary_inertia_(beam.rotary_inertia()),
      whole_(spacing == Spacing::whole),
      ends_(beam.ends) {
  if (symmetric() && (n_cells % 2 == 0 || position != 0.5 || ends_[0] != ends_[1])) {
    throw std::invalid_argument(
        "cell mesh: a half model needs an odd number of cells, struck at 0.5, and ends alike");
  }
  if (spacing == Spacing::points && !beam.is_free()) {
    throw std::invalid_argument("cell mesh: the spacing of points is for free ends");
  }
  const double inverse = 1.0 / (spacing_ * spacing_);
  first_sections_ = end_stencils(ends_[0], inverse);
  if (!symmetric()) last_sections_ = end_stencils(ends_[1], inverse);
  std::reverse(last_sections_.begin(), last_sections_.end());
  for (EndStencil& stencil : last_sections_) std::swap(stencil[0], stencil[1]);
  if (beam.is_free()) translation_.assign(n_unknowns(), 1.0);
  beam_mass_ = spacing == Spacing::points
                   ? mass_per_length_ * spacing_ * static_cast<double>(n_cells)
                   : beam.mass();
  assemble_mass();
  if (!symmetric()) assemble_moment();
  place_sections();
  place_strike(position);
  first_end_ = *displacement_at(0.0);
}

SparseFunctional CellMesh::cell(std::size_t i) const {
  const std::size_t slaved = is_clamped(ends_[0]) ? 1 : 0;
  if (i < slaved) return {{{0, clamped_share}}, {}};
  if (i - slaved == n_unknowns()) return {{{n_unknowns() - 1, clamped_share}}, {}};
  return {{{i - slaved, 1.0}}, {}};
}

double CellMesh::link(std::size_t i) const {
  double share = 1.0;
  if (whole_ && i == 0 && ends_[0] == EndSupport::free) share += 0.5;
  if (whole_ && i + 2 == n_cells_ && ends_[1] == EndSupport::free) share += 0.5;
  return share;
}

void CellMesh::assemble_mass() {
  const double cell_mass = mass_per_length_ * spacing_;
  const std::size_t n_kept = symmetric() ? n_cells_ / 2 + 1 : n_cells_;
  momentum_functional_.assign(n_unknowns(), 0.0);
  for (std::size_t i = 0; i < n_kept; ++i) {
    const auto [unknown, share] = cell(i).terms.front();
    const double mass = symmetric() && i + 1 == n_kept ? cell_mass : copies() * cell_mass;
    mass_.at(unknown, unknown) += mass * share * share;
    momentum_functional_[unknown] += mass * share;
    if (i + 1 == n_kept) break;
    const auto [next, next_share] = cell(i + 1).terms.front();
    const double coupling = link(i) * rotary_inertia_ / spacing_;
    mass_.at(unknown, unknown) += copies() * coupling * share * share;
    mass_.at(next, next) += copies() * coupling * next_share * next_share;
    // If both cells share one unknown, this entry counts twice.
    mass_.at(unknown, next) -=
        (unknown == next ? 2.0 : 1.0) * copies() * coupling * share * next_share;
  }
  // Half a link to the upside-down mirror image.
  const double of_half = 2.0 * rotary_inertia_ / spacing_;
  if (ends_[0] == EndSupport::pinned) mass_.at(0, 0) += copies() * of_half;
  if (!symmetric() && ends_[1] == EndSupport::pinned) {
    mass_.at(n_unknowns() - 1, n_unknowns() - 1) += of_half;
  }
}

// Between two centres the rotary inertia of a link has the momentum J (v[i+1] - v[i]): of all links
// alike the sum is that between the outermost centres. At a pinned end half a link has J v.
void CellMesh::assemble_moment() {
  moment_functional_.assign(n_unknowns(), 0.0);
  for (std::size_t i = 0; i < n_cells_; ++i) {
    const double x = (static_cast<double>(i) + first_centre_) * spacing_;
    cell(i).add_to(moment_functional_, mass_per_length_ * spacing_ * x);
  }
  for (const std::size_t i : {std::size_t{0}, n_cells_ - 2}) {
    const double more = (link(i) - 1.0) * rotary_inertia_;
    cell(i).add_to(moment_functional_, -more);
    cell(i + 1).add_to(moment_functional_, more);
  }
  if (ends_[0] != EndSupport::pinned) cell(0).add_to(moment_functional_, -rotary_inertia_);
  if (ends_[1] != EndSupport::pinned) {
    cell(n_cells_ - 1).add_to(moment_functional_, rotary_inertia_);
  }
}

// The displacement of a cell's centre, from the one before the first to the one after the last,
// which continue the beam beyond its ends (in the half model: into the mirrored half).
SparseFunctional CellMesh::continued_cell(long i) const {
  const long n = static_cast<long>(n_cells_);
  if (symmetric() && i > n / 2) i = n - 1 - i;
  if (i >= 0 && i < n) return cell(static_cast<std::size_t>(i));
  const std::size_t outermost = i < 0 ? 0 : n_cells_ - 1;
  const EndSupport end = ends_[i < 0 ? 0 : 1];
  SparseFunctional displacement;
  displacement.add(end == EndSupport::pinned    ? -1.0
                   : end == EndSupport::clamped ? 1.0
                                                : 2.0,
                   cell(outermost));
  if (end == EndSupport::free) displacement.add(-1.0, cell(i < 0 ? 1 : n_cells_ - 2));
  return displacement;
}

std::optional<SparseFunctional> CellMesh::displacement_at(double x) const {
  const double cells = static_cast<double>(n_cells_);
  const double at = std::clamp(snapped(x / spacing_ - first_centre_), -first_centre_,
                               cells - 1.0 + first_centre_);  // in spacings, from the first centre
  SparseFunctional displacement;
  const bool before = at < 0.0;
  if ((before || at > cells - 1.0) && ends_[before ? 0 : 1] == EndSupport::clamped) {
    // Within the outer half of the end cell: the parabola.
    const double from_end = 1.0 - 2.0 * (before ? -at : at - (cells - 1.0));
    displacement.add(from_end * from_end, cell(before ? 0 : n_cells_ - 1));
    return displacement;
  }
  const double left = std::floor(at);
  const auto i = static_cast<long>(left);
  displacement.add(1.0 - (at - left), continued_cell(i));
  displacement.add(at - left, continued_cell(i + 1));
  return displacement;
}

std::optional<SparseFunctional> CellMesh::rotation_at(double x) const {
  const double n_faces = static_cast<double>(n_cells_) + 1.0;  // both ends among them
  const double at = std::clamp(snapped(x / spacing_ - first_centre_) + 0.5, 0.0, n_faces - 1.0);
  const double left = std::min(std::floor(at), n_faces - 2.0);
  const auto face = static_cast<long>(left);  // between the centres face - 1 and face
  const double share = at - left;
  SparseFunctional slope;
  for (const long i : {face, face + 1}) {
    const double factor = (i == face ? 1.0 - share : share) / spacing_;
    slope.add(factor, continued_cell(i));
    slope.add(-factor, continued_cell(i - 1));
  }
  return slope;
}

// At the faces; each end counts half.
std::vector<BeamMesh::Slope> CellMesh::slopes() const {
  const auto n_faces = static_cast<long>(symmetric() ? n_cells_ / 2 + 1 : n_cells_ + 1);
  std::vector<Slope> all;
  for (long face = 0; face < n_faces; ++face) {
    const bool is_end = face == 0 || face == static_cast<long>(n_cells_);
    all.push_back({copies() * spacing_ * (is_end ? 0.5 : 1.0), {}});
    all.back().value.add(1.0 / spacing_, continued_cell(face));
    all.back().value.add(-1.0 / spacing_, continued_cell(face - 1));
  }
  return all;
}

void CellMesh::place_sections() {
  const std::size_t first = ends_[0] == EndSupport::free ? 1 : 0;
  const std::size_t end = symmetric()                    ? n_cells_ / 2 + 1
                          : ends_[1] == EndSupport::free ? n_cells_ - 1
                                                         : n_cells_;
  for (std::size_t i = first; i < end; ++i) {
    positions_.push_back((static_cast<double>(i) + first_centre_) * spacing_);
    weights_.push_back(copies() * spacing_);
  }
  if (symmetric()) weights_.back() = spacing_;
  const double inverse = 1.0 / (spacing_ * spacing_);
  const std::size_t n_inner = n_unknowns() - 2;
  for (const EndStencil& stencil : first_sections_) add_stencil(0, stencil);
  for (std::size_t i = 0; i < n_inner; ++i) {
    add_stencil(i, std::array{inverse, -2.0 * inverse, inverse});
  }
  if (symmetric()) add_stencil(n_inner, std::array{2.0 * inverse, -2.0 * inverse});
  for (const EndStencil& stencil : last_sections_) add_stencil(n_inner, stencil);
}

void CellMesh::place_strike(double position) {
  const std::size_t first = ends_[0] == EndSupport::free ? 1 : 0;  // cell with a section
  if (symmetric()) {
    struck_point_.terms = {{n_unknowns() - 1, 1.0}};
    struck_section_ = n_sections() - 1;
    return;
  }
  const double cells = static_cast<double>(n_cells_);
  const double length = cells - 1.0 + 2.0 * first_centre_;  // of the beam, in spacings
  const double at = std::clamp(position * length - first_centre_, 0.0, cells - 1.0);
  const auto left = std::min(static_cast<std::size_t>(at), n_cells_ - 2);
  const double share = at - static_cast<double>(left);
  struck_point_.add(1.0 - share, cell(left));
  struck_point_.add(share, cell(left + 1));
  const auto nearest = static_cast<std::size_t>(std::lround(at));
  struck_section_ = std::clamp<std::size_t>(nearest, first, first + n_sections() - 1) - first;
}

void CellMesh::curvatures(std::span<const double> unknowns, std::span<double> kappa) const {
  const double inverse = 1.0 / (spacing_ * spacing_);
  const std::size_t n = n_unknowns();
  const std::size_t n_inner = n - 2;
  const double* w = unknowns.data();
  double* k = kappa.data();
  for (const EndStencil& end : first_sections_) *k++ = end[0] * w[0] + end[1] * w[1];
  assign_by_lines(k, n_inner,
                  [=](auto at) { return (at(w + 2) - 2.0 * at(w + 1) + at(w)) * inverse; });
  k += n_inner;
  if (symmetric()) *k = 2.0 * (w[n_inner] - w[n_inner + 1]) * inverse;
  for (const EndStencil& end : last_sections_) *k++ = end[0] * w[n - 2] + end[1] * w[n - 1];
}

void CellMesh::bending_forces(std::span<const double> moments, std::span<double> forces) const {
  // m[i] belongs to the section centred on unknown i + 1; the mirror's share makes the struck
  // cell's row half of the others', which is what folding its neighbour's force does.
  const double scale = copies() / spacing_;
  const std::size_t n = n_unknowns();
  const double* m = moments.data() + first_sections_.size();
  double* f = forces.data();
  const auto inner_forces = [=](std::size_t n_others) {
    assign_by_lines(f + 2, n < n_others ? 0 : n - n_others,
                    [=](auto at) { return scale * (2.0 * at(m + 1) - at(m) - at(m + 2)); });
  };
  f[0] = -scale * m[0];
  f[1] = scale * (2.0 * m[0] - m[1]);
  if (symmetric()) {
    inner_forces(3);
    f[n - 1] = scale * (m[n - 2] - m[n - 3]);
  } else {
    inner_forces(4);
    f[n - 2] = scale * (2.0 * m[n - 3] - m[n - 4]);
    f[n - 1] = -scale * m[n - 3];
  }
  const double weight = weights_.front();
  m = moments.data();
  for (const EndStencil& end : first_sections_) {
    f[0] -= weight * end[0] * *m;
    f[1] -= weight * end[1] * *m++;
  }
  m = moments.data() + n_sections() - last_sections_.size();
  for (const EndStencil& end : last_sections_) {
    f[n - 2] -= weight * end[0] * *m;
    f[n - 1] -= weight * end[1] * *m++;
  }
}

double CellMesh::highest_frequency(double bending_stiffness) const {
  const double inverse = 4.0 / (spacing_ * spacing_);
  return inverse * std::sqrt(bending_stiffness / (mass_per_length_ + rotary_inertia_ * inverse));
}

bool CellMesh::has_closed_modes() const {
  const bool is_even = !whole_ || rotary_inertia_ == 0.0;
  return is_even && ends_[0] == EndSupport::free && ends_[1] == EndSupport::free;
}

NaturalModes CellMesh::natural_modes(double bending_stiffness) const {
  if (!has_closed_modes()) return dense_natural_modes(*this, bending_stiffness);
  const std::size_t n = n_unknowns();
  NaturalModes modes = free_cell_modes(
      {n_cells_, spacing_, mass_per_length_, rotary_inertia_, bending_stiffness}, symmetric(), n);
  normalise(modes, mass());
  return modes;
}

}  // namespace subimpact
