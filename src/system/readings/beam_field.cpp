#include "system/readings/beam_field.h"

#include <algorithm>
#include <cmath>

namespace subimpact {
namespace {

// Positions nearer than this part of the length are one.
constexpr double same_place = 1e-9;

double end_of_part(const BeamMesh& mesh, double length) {
  return mesh.symmetric() ? 0.5 * length : length;
}

}  // namespace

std::optional<EndSupport> support_at(const BeamMesh& mesh, double x) {
  const auto displacement = mesh.displacement_at(x);
  const auto rotation = mesh.rotation_at(x);
  if (!displacement || !rotation) return std::nullopt;
  if (!displacement->is_zero()) return EndSupport::free;
  // A section at the very end is the hinge of a clamped end.
  const auto positions = mesh.section_positions();
  const double tolerance = same_place * (positions.back() - positions.front());
  const bool has_hinge =
      std::abs(positions.front() - x) <= tolerance || std::abs(positions.back() - x) <= tolerance;
  return rotation->is_zero() || has_hinge ? EndSupport::clamped : EndSupport::pinned;
}

CurvatureAt curvature_at(const BeamMesh& mesh, double length, double x) {
  const auto positions = mesh.section_positions();
  const std::size_t last = positions.size() - 1;
  const auto after =
      static_cast<std::size_t>(std::ranges::lower_bound(positions, x) - positions.begin());
  const std::size_t section = std::min(after, last);
  const auto line_to = [&](std::size_t next) {
    if (next == section) return CurvatureAt{section, section, 1.0, 0.0};
    const double share = (x - positions[section]) / (positions[next] - positions[section]);
    return CurvatureAt{section, next, 1.0 - share, share};
  };
  if (positions[section] == x) return line_to(section);
  if (after > 0 && after <= last) return line_to(after - 1);
  const bool first = after == 0;
  const double end = first ? 0.0 : end_of_part(mesh, length);
  if ((!first && mesh.symmetric()) || support_at(mesh, end) == EndSupport::clamped) {
    return line_to(first ? std::min<std::size_t>(1, last) : std::max<std::size_t>(last, 1) - 1);
  }
  return {section, section, (x - end) / (positions[section] - end), 0.0};
}

BeamField::BeamField(const StruckBeam& beam, double length, std::size_t most_stations)
    : beam_(beam),
      length_(length),
      bending_stiffness_(beam.sections().stiffness()),
      in_modes_(!beam.modal_stiffness().empty()) {
  const BeamMesh& mesh = beam.mesh();
  const std::vector<double> places = places_of(mesh, length, most_stations);
  for (const double x : places) {
    stations_.push_back(
        {x, *mesh.displacement_at(x), *mesh.rotation_at(x), curvature_at(mesh, length, x)});
  }
  n_mirrored_ = count_mirrored(mesh, length, places);
  for (auto* values : {&displacements_, &curvatures_, &moments_, &velocities_, &rotations_}) {
    values->resize(size());
  }
  if (!in_modes_ || places.empty()) return;
  const auto n = static_cast<Eigen::Index>(size());
  by_mode_.setZero(3 * n, static_cast<Eigen::Index>(mesh.n_unknowns()));
  const auto put = [&](const SparseFunctional& value, Eigen::Index row) {
    if (!value.is_zero()) {
      by_mode_.row(row) = Eigen::Map<const Eigen::RowVectorXd>(value.dense.data(), by_mode_.cols());
    }
  };
  for (Eigen::Index i = 0; i < n; ++i) {
    const Station& station = stations_[static_cast<std::size_t>(i)];
    put(station.displacement, i);
    put(curvature_in_modes(station.curvature), n + i);
    put(station.rotation, 2 * n + i);
  }
  displacement_shares_ = by_mode_.topRows(n).cwiseAbs().colwise().maxCoeff();
  curvature_shares_ = by_mode_.middleRows(n, n).cwiseAbs().colwise().maxCoeff();
}

std::vector<double> BeamField::places_of(const BeamMesh& mesh, double length,
                                         std::size_t most_stations) {
  std::vector<double> places;
  if (most_stations == 0 || !is_available(mesh)) return places;
  const auto positions = mesh.section_positions();
  const std::size_t last = mesh.n_sections() - 1;
  const double end = end_of_part(mesh, length);
  const double tolerance = same_place * length;
  const std::size_t most =
      std::max<std::size_t>(mesh.symmetric() ? most_stations / 2 + 1 : most_stations, 5);
  const std::size_t stride = std::max<std::size_t>((last + most - 4) / (most - 4), 1);
  if (positions[0] > tolerance) places.push_back(0.0);
  for (std::size_t i = 0; i <= last; ++i) {
    const bool chosen = i % stride == mesh.struck_section() % stride;
    if (chosen || i == 0 || i == last) places.push_back(positions[i]);
  }
  if (positions[last] < end - tolerance) places.push_back(end);
  return places;
}

std::size_t BeamField::count_mirrored(const BeamMesh& mesh, double length,
                                      const std::vector<double>& places) {
  if (!mesh.symmetric()) return 0;
  const double before = end_of_part(mesh, length) - same_place * length;
  const auto n = std::ranges::count_if(places, [&](double x) { return x < before; });
  return static_cast<std::size_t>(n);
}

std::size_t BeamField::whole_size(const BeamMesh& mesh, double length, std::size_t most_stations) {
  const std::vector<double> places = places_of(mesh, length, most_stations);
  return places.size() + count_mirrored(mesh, length, places);
}

Eigen::Index BeamField::n_modes_needed(const double* positions, double tolerance) const {
  double displacement = 0.0, curvature = 0.0;
  Eigen::Index n = by_mode_.cols();
  for (; n > 0; --n) {
    const double z = std::abs(positions[n - 1]);
    displacement += displacement_shares_[n - 1] * z;
    curvature += curvature_shares_[n - 1] * z;
    if (!(displacement <= tolerance * largest_displacement_) ||
        !(curvature <= tolerance * largest_curvature_)) {
      break;
    }
  }
  return n;
}

SparseFunctional BeamField::curvature_in_modes(const CurvatureAt& at) const {
  SparseFunctional curvature = beam_.mesh().curvature_functional(at.section);
  if (at.next == at.section && at.share == 1.0) return curvature;
  const SparseFunctional next = beam_.mesh().curvature_functional(at.next);
  for (std::size_t k = 0; k < curvature.dense.size(); ++k) {
    curvature.dense[k] = at.share * curvature.dense[k] + at.next_share * next.dense[k];
  }
  return curvature;
}

void BeamField::read(States& states, double tolerance) const {
  using Columns = Eigen::Map<const Eigen::MatrixXd>;
  const Eigen::Index n_states =
      static_cast<Eigen::Index>(states.positions.size()) / by_mode_.cols();
  const auto n_stations = static_cast<Eigen::Index>(size());
  const Columns positions(states.positions.data(), by_mode_.cols(), n_states);
  Eigen::Index n = 0;
  for (Eigen::Index k = 0; k < n_states; ++k) {
    n = std::max(n, n_modes_needed(positions.col(k).data(), tolerance));
  }
  const bool moves = !states.velocities.empty();
  const auto fields = by_mode_.topRows((moves ? 3 : 2) * n_stations);
  states.values.noalias() = fields.leftCols(n) * positions.topRows(n);
  if (!moves) return;
  const Columns velocities(states.velocities.data(), by_mode_.cols(), n_states);
  states.motion.noalias() = by_mode_.topRows(n_stations) * velocities;
}

void BeamField::show(const States& states, Eigen::Index state) {
  const auto n = static_cast<Eigen::Index>(size());
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto station = static_cast<std::size_t>(i);
    displacements_[station] = states.values(i, state);
    curvatures_[station] = states.values(n + i, state);
    moments_[station] = bending_stiffness_ * curvatures_[station];
    largest_displacement_ = std::max(largest_displacement_, std::abs(displacements_[station]));
    largest_curvature_ = std::max(largest_curvature_, std::abs(curvatures_[station]));
    if (states.velocities.empty()) continue;
    rotations_[station] = states.values(2 * n + i, state);
    velocities_[station] = states.motion(i, state);
  }
}

void BeamField::read_motion(const State& y) {
  for (std::size_t i = 0; i < size(); ++i) {
    velocities_[i] = stations_[i].displacement(beam_.beam_velocities(y));
    rotations_[i] = stations_[i].rotation(beam_.beam_positions(y));
  }
}

void BeamField::read(const State& y, Accounts& accounts) {
  const auto unknowns = beam_.beam_positions(y);
  const Accounts::Bending bending = accounts.bending(y);
  for (std::size_t i = 0; i < size(); ++i) {
    displacements_[i] = stations_[i].displacement(unknowns);
    curvatures_[i] = stations_[i].curvature(bending.curvatures);
    moments_[i] = stations_[i].curvature(bending.moments);
  }
}

std::vector<PlacedSection> sections_of_whole_beam(const BeamMesh& mesh, double length) {
  std::vector<PlacedSection> sections;
  const auto positions = mesh.section_positions();
  const auto weights = mesh.section_weights();
  const double middle = 0.5 * length * (1.0 - same_place);
  for (std::size_t i = 0; i < mesh.n_sections(); ++i) {
    const bool has_image = mesh.symmetric() && positions[i] < middle;
    sections.push_back({positions[i], has_image ? 0.5 * weights[i] : weights[i], i});
  }
  if (!mesh.symmetric()) return sections;
  for (std::size_t i = mesh.n_sections(); i-- > 0;) {
    if (positions[i] >= middle) continue;
    sections.push_back({length - positions[i], 0.5 * weights[i], i});
  }
  return sections;
}

PermanentSet::PermanentSet(const BeamMesh& mesh, double length, double shear_flexibility,
                           std::span<const double> plastic_curvatures)
    : sections_(sections_of_whole_beam(mesh, length)) {
  double rotation = 0.0, moment = 0.0;
  for (const PlacedSection& here : sections_) {
    rotation += plastic_curvatures[here.section] * here.length;
    moment += plastic_curvatures[here.section] * here.length * here.position;
    rotations_.push_back(rotation);
    moments_.push_back(moment);
  }
  const double l = length;
  const double s = rotation * l - moment;  // w(l) of the double integral
  const auto is_clamped = [&](double x) { return support_at(mesh, x) == EndSupport::clamped; };
  const auto is_held = [&](double x) { return support_at(mesh, x) != EndSupport::free; };
  const bool first = is_clamped(0.0) && (mesh.symmetric() || is_held(l));
  const bool last = mesh.symmetric() ? first : is_clamped(l) && is_held(0.0);
  const double sheared = shear_flexibility * l;
  if (first && last) {  // neither displacement nor rotation at l
    const double b = (s - 0.5 * rotation * l) / (l * l * l / 12.0 + sheared);
    c1_ = -shear_flexibility * b;
    c2_ = -0.5 * rotation / l - 0.25 * b * l;
    c3_ = b / 6.0;
  } else if (first) {  // neither displacement nor moment at l
    const double b = s / (l * l * l / 3.0 + sheared);
    c1_ = -shear_flexibility * b;
    c2_ = -0.5 * b * l;
    c3_ = b / 6.0;
  } else if (last) {  // neither displacement nor rotation at l, no moment at 0
    const double b = (s - rotation * l) / (l * l * l / 3.0 + sheared);
    c1_ = -s / l - b * l * l / 6.0;
    c3_ = b / 6.0;
  } else {
    c1_ = -s / l;
    if (is_clamped(0.0)) turn_ = s / l;
    if (!mesh.symmetric() && is_clamped(l)) {
      at_zero_ = rotation * l - s;
      turn_ = s / l - rotation;
    }
  }
}

double PermanentSet::at(double x) const {
  const auto after = std::ranges::lower_bound(sections_, x, {}, &PlacedSection::position);
  const auto n = static_cast<std::size_t>(after - sections_.begin());
  const double integral = n > 0 ? rotations_[n - 1] * x - moments_[n - 1] : 0.0;
  return integral + x * (c1_ + x * (c2_ + x * c3_));
}

std::vector<PlasticZone> plastic_zones(const BeamMesh& mesh, double length,
                                       std::span<const double> plastic_curvatures, double least) {
  std::vector<PlasticZone> zones;
  double sign = 0.0;  // of the zone that is open; 0: none
  for (const PlacedSection& here : sections_of_whole_beam(mesh, length)) {
    const double kappa = plastic_curvatures[here.section];
    if (!(std::abs(kappa) > least)) {
      sign = 0.0;
      continue;
    }
    const double half = 0.5 * here.length;
    if (kappa * sign <= 0.0) {
      zones.push_back({std::max(here.position - half, 0.0), here.position, 0.0});
    }
    sign = kappa;
    zones.back().to = std::min(here.position + half, length);
    zones.back().rotation += kappa * here.length;
  }
  return zones;
}

}  // namespace subimpact
