#include "model/mesh/shear/timoshenko_mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model/mesh/modes.h"
#include "numerics/lanes.h"

namespace subimpact {
namespace {

std::size_t cells_before(double position, std::size_t n_cells) {
  const double nodes = position * static_cast<double>(n_cells) - 0.5;
  return static_cast<std::size_t>(
      std::clamp(std::lround(nodes), 0L, static_cast<long>(n_cells) - 1L));
}

std::size_t rotations_of_ends(const Beam& beam, bool half) {
  const auto pinned = [&](std::size_t end) { return beam.ends[end] == EndSupport::pinned; };
  return (pinned(0) ? 1 : 0) + (!half && pinned(1) ? 1 : 0);
}

// Places nearer to each other than this count as one.
constexpr double same_place = 1e-9;
constexpr double rounding = 1e-14;

std::size_t nodes_kept(std::size_t n_cells, bool half) { return half ? n_cells / 2 + 1 : n_cells; }

}  // namespace

TimoshenkoMesh::TimoshenkoMesh(const Beam& beam, double position, std::size_t n_cells,
                               Extent extent)
    : BeamMesh(2 * nodes_kept(n_cells, extent == Extent::half) - 1 +
                   rotations_of_ends(beam, extent == Extent::half),
               0, extent == Extent::half),
      ends_(beam.ends),
      n_before_(beam.ends[0] == EndSupport::pinned ? 1 : 0),
      n_nodes_(nodes_kept(n_cells, symmetric())),
      gyration_(beam.radius_of_gyration()),
      mass_per_length_(beam.mass_per_length()),
      rotary_inertia_(beam.rotary_inertia()),
      shear_stiffness_per_length_(beam.shear_stiffness()) {
  if (n_cells < fewest_cells) {
    throw std::invalid_argument("Timoshenko mesh: at least 5 cells are needed");
  }
  if (!beam.shears())
    throw std::invalid_argument("Timoshenko mesh: the beam's theory has no shear");
  if (symmetric() && (n_cells % 2 == 0 || position != 0.5 || ends_[0] != ends_[1])) {
    throw std::invalid_argument(
        "Timoshenko mesh: a half model needs an odd number of cells, struck at 0.5, and ends "
        "alike");
  }
  const std::size_t before = cells_before(position, n_cells);
  const auto length_of = [&](double part, std::size_t cells) {
    return part * beam.length / (static_cast<double>(cells) + 0.5);
  };
  sides_[0] = {length_of(position, before), before};
  sides_[1] = {length_of(1.0 - position, n_cells - 1 - before), n_cells - 1 - before};
  beam_mass_ = beam.mass();
  if (beam.is_free()) {
    translation_.assign(n_unknowns(), 0.0);
    for (std::size_t i = 0; i < n_nodes_; ++i) translation_[node(i)] = 1.0;
  }
  assemble_mass();
  assemble_shear();
  place_sections();
  place_unknowns();
  struck_point_.terms = {{node(before), 1.0}};
  if (!symmetric()) assemble_moment();
  if (ends_[0] == EndSupport::free) {  // no curvature there
    const double share = 0.5 * sides_[0].length / sides_[before > 0 ? 0 : 1].length;
    first_end_.terms = {{node(0), 1.0 + share}, {node(1), -share}};
  }
}

double TimoshenkoMesh::cell_length(std::size_t cell) const {
  if (cell == sides_[0].n_cells) return 0.5 * (sides_[0].length + sides_[1].length);
  return sides_[cell < sides_[0].n_cells ? 0 : 1].length;
}

void TimoshenkoMesh::assemble_mass() {
  momentum_functional_.assign(n_unknowns(), 0.0);
  const double rotation_mass = rotary_inertia_ / (gyration_ * gyration_);  // kg/m, of r phi
  const std::size_t struck = sides_[0].n_cells;
  for (std::size_t i = 0; i < n_nodes_; ++i) {
    const double mass =
        (symmetric() && i == struck ? 1.0 : copies()) * mass_per_length_ * cell_length(i);
    mass_.at(node(i), node(i)) = mass;
    momentum_functional_[node(i)] = mass;
  }
  for (std::size_t i = 0; i + 1 < n_nodes_; ++i) {
    // The outer half of a free end cell turns with the face next to it.
    const bool is_first = i == 0 && ends_[0] == EndSupport::free;
    const bool is_last = !symmetric() && i + 2 == n_nodes_ && ends_[1] == EndSupport::free;
    const double cells = 1.0 + (is_first ? 0.5 : 0.0) + (is_last ? 0.5 : 0.0);
    const double length = sides_[i < struck ? 0 : 1].length;
    mass_.at(node(i) + 1, node(i) + 1) = copies() * rotation_mass * cells * length;
  }
  if (ends_[0] == EndSupport::pinned) {
    mass_.at(0, 0) = copies() * rotation_mass * 0.5 * sides_[0].length;
  }
  if (!symmetric() && ends_[1] == EndSupport::pinned) {
    mass_.at(n_unknowns() - 1, n_unknowns() - 1) = rotation_mass * 0.5 * sides_[1].length;
  }
}

// The momentum of the rigid rotation w = x, phi = 1.
void TimoshenkoMesh::assemble_moment() {
  moment_functional_.resize(n_unknowns());
  for (std::size_t k = 0; k < n_unknowns(); ++k) {
    moment_functional_[k] = gyration_ * mass_.at(k, k);
  }
  for (std::size_t i = 0; i < n_nodes_; ++i) {
    moment_functional_[node(i)] = node_position(i) * mass_.at(node(i), node(i));
  }
}

void TimoshenkoMesh::assemble_shear() {
  shear_stiffness_ = BandedMatrix(n_unknowns(), 2);
  const auto add = [&](std::vector<SparseFunctional::Term> strain, double weight) {
    SparseFunctional{std::move(strain), {}}.add_square(weight, shear_stiffness_);
  };
  const double turn = -1.0 / gyration_;
  for (std::size_t i = 0; i + 1 < n_nodes_; ++i) {
    const double length = sides_[i < sides_[0].n_cells ? 0 : 1].length;
    add({{node(i), -1.0 / length}, {node(i) + 1, turn}, {node(i + 1), 1.0 / length}},
        copies() * shear_stiffness_per_length_ * length);
  }
  for (std::size_t end = 0; end < (symmetric() ? 1u : 2u); ++end) {
    if (ends_[end] == EndSupport::free) continue;
    const EndFace face = end_face(end);
    add({{face.rotation, face.turn}, {face.node, face.rise}}, face.stiffness);
  }
}

double TimoshenkoMesh::length() const {
  return sides_[0].length * (static_cast<double>(sides_[0].n_cells) + 0.5) +
         sides_[1].length * (static_cast<double>(sides_[1].n_cells) + 0.5);
}

double TimoshenkoMesh::node_position(std::size_t i) const {
  if (i <= sides_[0].n_cells) return (static_cast<double>(i) + 0.5) * sides_[0].length;
  return length() - (static_cast<double>(n_nodes_ - 1 - i) + 0.5) * sides_[1].length;
}

void TimoshenkoMesh::place_unknowns() {
  for (std::size_t i = 0; i < n_nodes_; ++i) {
    displacements_.push_back({node_position(i), {{{node(i), 1.0}}, {}}});
    if (i + 1 == n_nodes_) break;
    rotations_.push_back(
        {0.5 * (node_position(i) + node_position(i + 1)), {{{node(i) + 1, 1.0 / gyration_}}, {}}});
  }
  const auto end_displacement = [&](std::size_t end, const Place& outer, const Place& inner) {
    Place place{end == 0 ? 0.0 : length(), {}};
    if (ends_[end] == EndSupport::free) place.value = between(outer, inner, place.x);
    return place;
  };
  const auto end_rotation = [&](std::size_t end, const Place& outer) {
    Place place{end == 0 ? 0.0 : length(), {}};
    if (ends_[end] == EndSupport::free) place.value = outer.value;
    if (ends_[end] == EndSupport::pinned) {
      place.value.terms = {{end_face(end).rotation, 1.0 / gyration_}};
    }
    return place;
  };
  if (symmetric()) {
    rotations_.push_back({0.5 * length(), {}});
  } else {
    displacements_.push_back(
        end_displacement(1, displacements_.back(), displacements_[n_nodes_ - 2]));
    rotations_.push_back(end_rotation(1, rotations_.back()));
  }
  displacements_.insert(displacements_.begin(),
                        end_displacement(0, displacements_[0], displacements_[1]));
  rotations_.insert(rotations_.begin(), end_rotation(0, rotations_[0]));
}

SparseFunctional TimoshenkoMesh::between(const Place& before, const Place& after, double x) {
  double share = (x - before.x) / (after.x - before.x);
  const double nearest = std::round(share);
  if (std::abs(share - nearest) < same_place) share = nearest;  // a support holds it wholly
  SparseFunctional value;
  value.add(1.0 - share, before.value);
  value.add(share, after.value);
  return value;
}

SparseFunctional TimoshenkoMesh::at(const std::vector<Place>& places, double x) {
  const auto after = std::clamp(std::ranges::upper_bound(places, x, {}, &Place::x),
                                places.begin() + 1, places.end() - 1);
  return between(*(after - 1), *after, x);
}

std::vector<BeamMesh::Slope> TimoshenkoMesh::slopes() const {
  std::vector<Slope> all;
  for (auto next = displacements_.begin() + 1; next != displacements_.end(); ++next) {
    const Place& before = *(next - 1);
    const double length = next->x - before.x;
    all.push_back({copies() * length, {}});
    all.back().value.add(1.0 / length, next->value);
    all.back().value.add(-1.0 / length, before.value);
  }
  return all;
}

void TimoshenkoMesh::place_sections() {
  const std::size_t first = ends_[0] == EndSupport::free ? 1 : 0;
  const std::size_t end = !symmetric() && ends_[1] == EndSupport::free ? n_nodes_ - 1 : n_nodes_;
  const std::size_t struck = sides_[0].n_cells;
  for (std::size_t i = first; i < end; ++i) {
    const bool is_mirror = symmetric() && i == struck;
    const double weight = (is_mirror ? 1.0 : copies()) * cell_length(i);
    const double slope = 1.0 / (gyration_ * cell_length(i));
    slopes_.push_back(slope);
    weights_.push_back(weight);
    positions_.push_back(node_position(i));
    const bool has_before = node(i) > 0;
    const bool has_after = node(i) + 1 < n_unknowns();
    if (is_mirror) {
      add_stencil(node(i) - 1, std::array{-2.0 * slope});
    } else if (has_before && has_after) {
      add_stencil(node(i) - 1, std::array{-slope, 0.0, slope});
    } else if (has_after) {
      add_stencil(node(i) + 1, std::array{slope});
    } else {
      add_stencil(node(i) - 1, std::array{-slope});
    }
    if (i == struck) struck_section_ = n_sections() - 1;
  }
  if (struck < first) struck_section_ = 0;
  if (struck >= end) struck_section_ = n_sections() - 1;
}

void TimoshenkoMesh::curvatures(std::span<const double> unknowns, std::span<double> kappa) const {
  const std::size_t n = n_sections();
  // A clamp and the mirror of a half model take the unknown on the other side.
  const std::size_t begin = ends_[0] == EndSupport::clamped ? 1 : 0;
  const std::size_t end = symmetric() || ends_[1] == EndSupport::clamped ? n - 1 : n;
  const double* before = unknowns.data() + section_stencil(begin).first - 2 * begin;
  const double* slope = slopes_.data();
  double* k = kappa.data();
  for (std::size_t i = begin; i < end; ++i) k[i] = slope[i] * (before[2 * i + 2] - before[2 * i]);
  const auto take_one = [&](std::size_t i) {
    const auto [first, row] = section_stencil(i);
    k[i] = row[0] * unknowns[first];
  };
  if (begin > 0) take_one(0);
  if (end < n) take_one(n - 1);
}

void TimoshenkoMesh::bending_forces(std::span<const double> moments,
                                    std::span<double> forces) const {
  // W times a coefficient is +-couple, whatever the cell's length, also under symmetry.
  const double couple = copies() / gyration_;
  const std::size_t first = ends_[0] == EndSupport::free ? 1 : 0;  // cell of the first section
  const std::size_t n_faces = n_nodes_ - 1;
  const double* m = moments.data() - first;
  const bool far_end_bends = first + n_sections() == n_nodes_;
  double* f = forces.data();
  if (n_before_ > 0) f[0] = couple * m[0];
  f += n_before_;
  const std::size_t end = far_end_bends ? n_faces : n_faces - 1;
  for (std::size_t j = first; j < end; ++j) {
    f[2 * j] = 0.0;
    f[2 * j + 1] = couple * (m[j + 1] - m[j]);
  }
  if (first == 1) {
    f[0] = 0.0;
    f[1] = couple * m[1];
  }
  if (!far_end_bends) {
    f[2 * end] = 0.0;
    f[2 * end + 1] = -couple * m[end];
  }
  f[2 * n_faces] = 0.0;
  if (node(n_faces) + 1 < n_unknowns()) f[2 * n_faces + 1] = -couple * m[n_faces];
}

// With the shear strain of face j times kGA, S_j = rise (w_{j+1} - w_j) - turn (r phi_j): the node
// at its left has the force S_j - S_{j-1}, the face itself arm S_j. Written for a node and its face
// at once, with coefficients that alternate, so that eight unknowns that follow each other are
// computed together; differences first, so that a large translation costs no digits. Which unknowns
// those are must not depend on addresses: results would, in their last digits.
void TimoshenkoMesh::add_shear_forces(std::span<const double> unknowns,
                                      std::span<double> forces) const {
  const double* q = unknowns.data() + n_before_;
  double* f = forces.data() + n_before_;
  for (std::size_t side = 0; side < (symmetric() ? 1u : 2u); ++side) {
    const double stiffness = copies() * shear_stiffness_per_length_;
    const double rise = stiffness / sides_[side].length;
    const double turn = stiffness / gyration_;
    const double arm = sides_[side].length / gyration_;
    const std::size_t begin = side == 0 ? 0 : 2 * sides_[0].n_cells;
    const std::size_t end = side == 0 ? 2 * sides_[0].n_cells : 2 * (n_nodes_ - 1);
    if (begin == end) continue;
    const auto shear = [=](std::size_t k) { return rise * (q[k + 2] - q[k]) - turn * q[k + 1]; };
    f[begin] += shear(begin);
    f[begin + 1] += arm * shear(begin);
    const auto node_and_face = [=](std::size_t k) {
      f[k] += rise * ((q[k + 2] - q[k]) - (q[k] - q[k - 2])) - turn * (q[k + 1] - q[k - 1]);
      f[k + 1] += arm * shear(k);
    };
    std::size_t k = begin + 2;
    const Lanes rises = alternating(rise, 0.0);
    const Lanes slopes = alternating(-turn, arm * rise);
    const Lanes turns = alternating(0.0, -arm * turn);
    for (; k + n_lanes < end; k += n_lanes) {  // up to q[k + 9], and q[end] is the last
      const Lanes here = lanes_at(q + k);
      const Lanes second = (lanes_at(q + k + 2) - here) - (here - lanes_at(q + k - 2));
      const Lanes first = lanes_at(q + k + 1) - lanes_at(q + k - 1);
      store(lanes_at(f + k) + rises * second + slopes * first + turns * here, f + k);
    }
    for (; k < end; k += 2) node_and_face(k);
    f[end] -= shear(end - 2);
  }
  for (std::size_t end = 0; end < (symmetric() ? 1u : 2u); ++end) {
    if (ends_[end] == EndSupport::free) continue;
    const EndFace face = end_face(end);
    const double force = face.stiffness * face.strain(unknowns);
    forces[face.node] -= face.rise * force;
    if (face.turn != 0.0) forces[face.rotation] -= face.turn * force;
  }
}

TimoshenkoMesh::EndFace TimoshenkoMesh::end_face(std::size_t end) const {
  const double length = sides_[end].length;
  return {.node = end == 0 ? node(0) : node(n_nodes_ - 1),
          .rotation = end == 0 ? 0 : n_unknowns() - 1,
          .rise = (end == 0 ? 2.0 : -2.0) / length,
          .turn = ends_[end] == EndSupport::pinned ? -1.0 / gyration_ : 0.0,
          .stiffness = copies() * shear_stiffness_per_length_ * 0.5 * length};
}

// From the strains: a product with the matrix would lose to rounding what a large translation adds.
double TimoshenkoMesh::shear_energy(std::span<const double> unknowns) const {
  const double* q = unknowns.data() + n_before_;
  double sum = 0.0;
  for (std::size_t j = 0; j + 1 < n_nodes_; ++j) {
    const double length = sides_[j < sides_[0].n_cells ? 0 : 1].length;
    const double strain = (q[2 * j + 2] - q[2 * j]) / length - q[2 * j + 1] / gyration_;
    sum += length * strain * strain;
  }
  sum *= copies() * shear_stiffness_per_length_;
  for (std::size_t end = 0; end < (symmetric() ? 1u : 2u); ++end) {
    if (ends_[end] == EndSupport::free) continue;
    const EndFace face = end_face(end);
    const double strain = face.strain(unknowns);
    sum += face.stiffness * strain * strain;
  }
  return 0.5 * sum;
}

double TimoshenkoMesh::highest_frequency(double bending_stiffness) const {
  const double wave = 2.0 / std::min(sides_[0].length, sides_[1].length);
  const double shear = shear_stiffness_per_length_;
  const double bending = bending_stiffness * wave * wave;
  // rho A rho I W^2 - b W + c = 0 for W = omega^2
  const double a = mass_per_length_ * rotary_inertia_;
  const double b = mass_per_length_ * (shear + bending) + rotary_inertia_ * shear * wave * wave;
  const double c = shear * wave * wave * bending;
  return std::sqrt((b + std::sqrt(std::max(b * b - 4.0 * a * c, 0.0))) / (2.0 * a));
}

bool TimoshenkoMesh::has_closed_modes() const {
  const bool alike = symmetric() || std::abs(sides_[1].length / sides_[0].length - 1.0) < rounding;
  return alike && ends_[0] == EndSupport::free && ends_[1] == EndSupport::free;
}

NaturalModes TimoshenkoMesh::natural_modes(double bending_stiffness) const {
  if (!has_closed_modes()) return dense_natural_modes(*this, bending_stiffness);
  const std::size_t n_cells = sides_[0].n_cells + sides_[1].n_cells + 1;
  const CellChain cells{n_cells, sides_[0].length, mass_per_length_, rotary_inertia_,
                        bending_stiffness};
  std::optional<NaturalModes> modes =
      shear_cell_modes({cells, shear_stiffness_per_length_, gyration_}, symmetric(), mass());
  return modes ? std::move(*modes) : dense_natural_modes(*this, bending_stiffness);
}

}  // namespace subimpact
