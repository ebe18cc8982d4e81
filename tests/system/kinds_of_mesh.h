#pragma once

#include "model/mesh/cell_mesh.h"
#include "model/mesh/hermite/hermite_mesh.h"
#include "model/mesh/shear/spectral_mesh.h"
#include "model/mesh/shear/timoshenko_mesh.h"
#include "paper_scene.h"
#include "print.h"

namespace subimpact {

enum class Kind { cells, hermite, timoshenko, spectral };
inline std::ostream& operator<<(std::ostream& out, Kind kind) {
  constexpr const char* names[] = {"cells", "hermite", "timoshenko", "spectral"};
  return out << names[static_cast<int>(kind)];
}

inline bool shears(Kind kind) { return kind == Kind::timoshenko || kind == Kind::spectral; }
// Whether the sections lie at the centres of cells.
inline bool has_cells(Kind kind) { return kind == Kind::cells || kind == Kind::timoshenko; }

inline Beam beam_with(Ends ends, Kind kind) {
  Beam beam = paper_beam(shears(kind) ? BeamTheory::timoshenko : BeamTheory::rayleigh, ends);
  if (shears(kind)) beam.poisson = 0.33;
  return beam;
}

// `n`: cells or elements of the whole beam.
inline std::shared_ptr<const BeamMesh> make_mesh(Kind kind, const Beam& beam, double position,
                                                 std::size_t n, bool half = false) {
  const auto extent = half ? BeamMesh::Extent::half : BeamMesh::Extent::whole;
  if (kind == Kind::cells) return std::make_shared<CellMesh>(beam, position, n, extent);
  if (kind == Kind::timoshenko) return std::make_shared<TimoshenkoMesh>(beam, position, n, extent);
  if (kind == Kind::spectral) return std::make_shared<SpectralMesh>(beam, position, n, extent);
  return std::make_shared<HermiteMesh>(beam, position, n, extent);
}

}  // namespace subimpact
