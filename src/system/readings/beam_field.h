#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "subimpact/model/scene.h"
#include "subimpact/system/readings.h"
#include "system/readings/accounts.h"

namespace subimpact {

/// How a mesh holds the beam's end at x (m): free, pinned or clamped, as its functionals of the
/// displacement and the rotation there show. `x` must be an end of the part modelled. Nothing on a
/// mesh without such functionals.
std::optional<EndSupport> support_at(const BeamMesh& mesh, double x);

/// The curvature at a point, from those of two sections of a mesh with their shares.
struct CurvatureAt {
  std::size_t section, next;
  double share, next_share;

  /// `values`: of all sections.
  double operator()(std::span<const double> values) const {
    return share * values[section] + next_share * values[next];
  }
  double of(const BeamMesh& mesh, std::span<const double> unknowns) const {
    return share * mesh.curvature(section, unknowns) + next_share * mesh.curvature(next, unknowns);
  }
};
/// At x (m) of the part modelled, of a beam of length `length` (m): linear between neighbouring
/// sections. Between the outermost section and a free or pinned end it falls to zero; towards a
/// clamped end and the middle of a half model it continues the line of the two nearest sections.
CurvatureAt curvature_at(const BeamMesh& mesh, double length, double x);

/// The field along the beam at some stations: displacement w, rotation of the section, velocity,
/// curvature kappa, moment M and plastic curvature kappa - M/(E I).
///
/// Stations are sections of the mesh, where curvature and moment are those of the equations of
/// motion, and both ends of the part modelled. At a free or pinned end M = 0; at a clamped end
/// without a section of its own, curvature and moment continue those of the two nearest sections in
/// a straight line. On a half model mirrored_* give the other half.
class BeamField {
 public:
  /// Some `most_stations` stations on the whole beam of length `length` (m), spread evenly over the
  /// sections, the struck, the first and the last one among them; fewer if there are fewer
  /// sections, and none for 0. `beam` must outlive this.
  BeamField(const StruckBeam& beam, double length, std::size_t most_stations);

  /// Whether the mesh gives displacements; otherwise there are no stations.
  static bool is_available(const BeamMesh& mesh) {
    return mesh.displacement_at(0.0) && mesh.rotation_at(0.0);
  }

  std::size_t size() const { return stations_.size(); }
  /// Stations of the whole beam, the mirrored ones too, of such a field.
  static std::size_t whole_size(const BeamMesh& mesh, double length, std::size_t most_stations);
  /// Number of stations (x < l - x) of the part modelled that have a mirror image at l - x.
  std::size_t n_mirrored() const { return n_mirrored_; }
  double position(std::size_t station) const { return stations_[station].position; }
  double mirrored_position(std::size_t station) const { return length_ - position(station); }

  /// Displacements, curvatures and moments of a state; not where the unknowns are modes.
  void read(const State& y, Accounts& accounts);
  /// Velocities and rotations of that state as well.
  void read_motion(const State& y);

  /// Whether the unknowns are natural modes of an elastic beam.
  bool in_modes() const { return in_modes_; }
  /// States in modes and their fields, which read() computes at once.
  struct States {
    std::vector<double> positions;   ///< of one state after another
    std::vector<double> velocities;  ///< likewise; empty: velocities and rotations are not read
    /// Displacements, curvatures and rotations of the stations, and velocities: a column per state.
    Eigen::MatrixXd values, motion;
  };
  /// `tolerance`: of displacements and curvatures, relative to the largest that were shown so far;
  /// modes that move nothing by more are left out.
  void read(States& states, double tolerance) const;
  /// Makes one of the states that were read that of displacement() and the others.
  void show(const States& states, Eigen::Index state);

  double displacement(std::size_t i) const { return displacements_[i]; }
  double curvature(std::size_t i) const { return curvatures_[i]; }
  double moment(std::size_t i) const { return moments_[i]; }
  double plastic_curvature(std::size_t i) const {
    return subimpact::plastic_curvature(curvatures_[i], moments_[i], bending_stiffness_);
  }
  /// m/s and rad.
  double velocity(std::size_t i) const { return velocities_[i]; }
  double rotation(std::size_t i) const { return rotations_[i]; }

 private:
  struct Station {
    double position;  // m
    SparseFunctional displacement, rotation;
    CurvatureAt curvature;
  };
  // x of the stations, m.
  static std::vector<double> places_of(const BeamMesh& mesh, double length, std::size_t most);
  static std::size_t count_mirrored(const BeamMesh& mesh, double length,
                                    const std::vector<double>& places);
  SparseFunctional curvature_in_modes(const CurvatureAt& at) const;
  // The slowest ones, without which no station is off by more than the tolerance.
  Eigen::Index n_modes_needed(const double* positions, double tolerance) const;

  const StruckBeam& beam_;
  double length_;
  double bending_stiffness_;
  bool in_modes_;
  std::vector<Station> stations_;
  std::size_t n_mirrored_ = 0;
  std::vector<double> displacements_, curvatures_, moments_, velocities_, rotations_;
  // Where the unknowns are modes: displacements, curvatures and rotations of the stations by mode,
  // and the largest share of each mode in the first and in the second.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> by_mode_;
  Eigen::VectorXd displacement_shares_, curvature_shares_;
  double largest_displacement_ = 0.0, largest_curvature_ = 0.0;  // that were shown
};

/// A section of the whole beam, with its share of the length.
struct PlacedSection {
  double position;      ///< x, m
  double length;        ///< integration weight, m
  std::size_t section;  ///< index in the mesh; of a mirrored section, that of its image
};
/// In ascending order of x; on a half model with the mirrored half.
std::vector<PlacedSection> sections_of_whole_beam(const BeamMesh& mesh, double length);

/// The displacement w_p(x) (m) of a beam at rest with the plastic curvatures of its sections (1/m),
/// against its own chord (docs/theory.md, "Accounts"). `shear_flexibility` is s = E I/(k G A), m2,
/// zero where sections do not shear.
class PermanentSet {
 public:
  PermanentSet(const BeamMesh& mesh, double length, double shear_flexibility,
               std::span<const double> plastic_curvatures);
  double at(double x) const;
  /// The same against the supports: the clamp of a cantilever, otherwise the chord.
  double from_supports(double x) const { return at(x) + at_zero_ + turn_ * x; }

 private:
  double at_zero_ = 0.0, turn_ = 0.0;  // of the chord of a cantilever against its clamp
  std::vector<PlacedSection> sections_;
  std::vector<double> rotations_, moments_;  // sums up to each section: of R_j and R_j x_j
  double c1_ = 0.0, c2_ = 0.0, c3_ = 0.0;    // of x, x^2, x^3
};

/// Plastic zones of the whole beam, in order of x: plastic curvatures above `least` (1/m).
std::vector<PlasticZone> plastic_zones(const BeamMesh& mesh, double length,
                                       std::span<const double> plastic_curvatures, double least);

}  // namespace subimpact
