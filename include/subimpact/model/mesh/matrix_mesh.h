#pragma once

#include "subimpact/model/mesh/beam_mesh.h"

namespace subimpact {

/// A user-defined mesh given by its matrices, for the equations of BeamMesh; SI units.
struct MeshMatrices {
  /// Coefficients (1/m2) of consecutive unknowns, of which `first` is the first.
  struct Row {
    std::size_t first;
    std::vector<double> coefficients;
  };
  BandedMatrix mass;                  ///< kg; positive definite, of half bandwidth up to 3
  std::vector<Row> curvature{};       ///< B: one row per section
  std::vector<double> weights{};      ///< W of the sections, m
  std::vector<double> positions{};    ///< x of the sections, m
  SparseFunctional struck_point{};    ///< S, displacement of the struck point
  SparseFunctional first_end{};       ///< w(0); zero where it is held
  std::vector<double> translation{};  ///< unknowns of a beam that moves by 1 m as a whole
  bool is_held = false;               ///< whether supports prevent this motion
  std::string description = "a mesh given by its matrices";
};

/// The highest frequency is that of B and Mass, found to 1e-3 by bisection. Throws
/// std::invalid_argument for sizes that do not match and for a mass that is not positive definite.
std::shared_ptr<const BeamMesh> mesh_of(MeshMatrices matrices);

}  // namespace subimpact
