#include "simulate/mesh_checks.h"

#include <fmt/format.h>

#include "model/cell_mesh.h"
#include "subimpact/simulate/simulate.h"

namespace subimpact {
namespace {

void check_cells(const Case& input) {
  const double cells = input.model.segments;
  const double at = input.scene.striker.position;
  if (!(at * cells >= 0.5 && (1.0 - at) * cells >= 0.5)) {
    throw InvalidCase(
        "striker.position",
        fmt::format(
            "is {}, closer to an end than half a cell; allowed with {} segments: from {:.6g} to "
            "{:.6g}, the outermost cell centres; move the strike inwards or use more segments",
            at, input.model.segments, 0.5 / cells, 1.0 - 0.5 / cells));
  }
  const auto& ends = input.scene.beam.ends;
  const bool clamped = ends[0] == EndSupport::clamped || ends[1] == EndSupport::clamped;
  const auto fewest = static_cast<int>(CellMesh::fewest_cells_if_clamped);
  if (clamped && input.model.segments < fewest) {
    throw InvalidCase("model.segments",
                      fmt::format("is {}; allowed with a clamped end: {} or more; use more "
                                  "segments",
                                  input.model.segments, fewest));
  }
}

// The strike takes a node, and an element much shorter than the others would rule the time step.
void check_elements(const Case& input) {
  const double elements = input.model.elements;
  const double at = input.scene.striker.position;
  const auto& ends = input.scene.beam.ends;
  if (at == 0.0 || at == 1.0) {
    if (ends[at == 0.0 ? 0 : 1] == EndSupport::free) return;
    throw InvalidCase("striker.position",
                      fmt::format("is {}, on a support; allowed: strictly between the supports; "
                                  "move the strike inwards",
                                  at));
  }
  if (at * elements >= 0.5 && (1.0 - at) * elements >= 0.5) return;
  throw InvalidCase(
      "striker.position",
      fmt::format("is {}, closer to an end than half an element; allowed with {} elements: from "
                  "{:.6g} to {:.6g}, or a free end itself; move the strike inwards or use more "
                  "elements",
                  at, input.model.elements, 0.5 / elements, 1.0 - 0.5 / elements));
}

}  // namespace

void check_mesh(const Case& input) {
  switch (input.model.mesh) {
    case MeshKind::cells:
      return check_cells(input);
    case MeshKind::hermite:
      return check_elements(input);
    case MeshKind::rigid:
      return;
  }
}

}  // namespace subimpact
