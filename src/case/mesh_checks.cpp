#include "case/mesh_checks.h"

#include <fmt/format.h>

#include <algorithm>

#include "model/cell_mesh.h"
#include "subimpact/case/simulate.h"

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
  const double length = input.scene.beam.length;
  const auto& ends = input.scene.beam.ends;
  if (at == 0.0 || at == 1.0) {
    if (ends[at == 0.0 ? 0 : 1] == EndSupport::free) return;
    throw InvalidCase("striker.position",
                      fmt::format("is {}, on a support; allowed: strictly between the supports; "
                                  "move the strike inwards",
                                  at));
  }
  const ElementGrading grading = grading_of(input);
  const double before = grading.elements_within(at * length);
  const double after = grading.elements_within((1.0 - at) * length);
  if (elements * std::min(before, after) >= 0.5 * (before + after)) return;
  if (grading.refinement != 1.0) {
    throw InvalidCase("striker.position",
                      fmt::format("is {}, closer to an end than half an element, of {} graded "
                                  "towards the strike; move the strike inwards or use more "
                                  "elements",
                                  at, input.model.elements));
  }
  throw InvalidCase(
      "striker.position",
      fmt::format("is {}, closer to an end than half an element; allowed with {} elements: from "
                  "{:.6g} to {:.6g}, or a free end itself; move the strike inwards or use more "
                  "elements",
                  at, input.model.elements, 0.5 / elements, 1.0 - 0.5 / elements));
}

void check_is_not_graded(const Case& input) {
  if (input.model.strike_refinement == 1.0) return;
  throw InvalidCase("model.strike_refinement",
                    fmt::format("is {:g}, but only elements can be shorter at the strike; allowed "
                                "with this mesh: 1; leave it out, or set model.mesh = \"hermite\"",
                                input.model.strike_refinement));
}

}  // namespace

ElementGrading grading_of(const Case& input) {
  return {input.model.strike_refinement, input.model.refined_length * input.scene.beam.length};
}

void check_mesh(const Case& input) {
  if (input.model.mesh != MeshKind::hermite) check_is_not_graded(input);
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
