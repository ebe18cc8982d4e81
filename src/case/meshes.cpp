#include "case/meshes.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "case/problem.h"
#include "model/mesh/cell_mesh.h"
#include "model/mesh/hermite/hermite_mesh.h"
#include "model/mesh/rigid_mesh.h"
#include "model/mesh/shear/spectral_mesh.h"
#include "model/mesh/shear/timoshenko_mesh.h"
#include "simulate/settings/refuse.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

using Mesh = std::shared_ptr<const BeamMesh>;

CellMesh::Spacing spacing_of(const Case& input) {
  using Spacing = CellMesh::Spacing;
  if (input.model.spacing == CellSpacing::points) return Spacing::points;
  return input.model.spacing == CellSpacing::whole ? Spacing::whole : Spacing::cells;
}

// Where a mesh of `count` equal parts cannot be struck.
[[noreturn]] void refuse_position(const Case& input, const char* why, int count, const char* parts,
                                  const char* also) {
  const double nearest = 0.5 / count;
  refuse("striker.position",
         "is {}, {}; allowed with {} {}: from {:.6g} to {:.6g}{}; move the strike inwards or use "
         "more {}",
         input.scene.striker.position, why, count, parts, nearest, 1.0 - nearest, also, parts);
}

bool has_end(const Case& input, EndSupport support) {
  const auto& ends = input.scene.beam.ends;
  return ends[0] == support || ends[1] == support;
}

void check_cells(const Case& input) {
  const bool shears = input.scene.beam.shears();
  const bool has_points = input.model.spacing == CellSpacing::points;
  check_rules({{has_points && shears, "model.spacing",
                "is \"points\", which is the published run's and has no shear; allowed with "
                "beam.theory = \"timoshenko\": \"cells\"; leave it out"},
               {has_points && !input.scene.beam.is_free(), "model.spacing",
                "is \"points\", which is for free ends; allowed with supports: \"cells\"; leave it "
                "out, or set beam.ends = [\"free\", \"free\"]"},
               {input.model.spacing == CellSpacing::whole && shears, "model.spacing",
                "is \"whole\", but cells that shear have no inertia to add at their ends; allowed "
                "with beam.theory = \"timoshenko\": \"cells\"; leave it out"}});
  if (has_points) return;
  const int cells = input.model.segments;
  const double at = input.scene.striker.position;
  if (!(at * cells >= 0.5 && (1.0 - at) * cells >= 0.5)) {
    refuse_position(input, "closer to an end than half a cell", cells, "segments",
                    ", the outermost cell centres");
  }
  const auto fewest = static_cast<int>(CellMesh::fewest_cells_if_clamped);
  if (has_end(input, EndSupport::clamped) && cells < fewest) {
    refuse("model.segments", "is {}; allowed with a clamped end: {} or more; use more segments",
           cells, fewest);
  }
}

// There is a node at the strike; an element much shorter than others would determine the time step.
void check_elements(const Case& input) {
  const int elements = input.model.elements;
  const double at = input.scene.striker.position;
  if (strikes_end(input)) {
    if (input.scene.beam.ends[at == 0.0 ? 0 : 1] == EndSupport::free) return;
    refuse("striker.position",
           "is {}, on a support; allowed: strictly between the supports; move the strike inwards",
           at);
  }
  if (elements * std::min(at, 1.0 - at) >= 0.5) return;
  refuse_position(input, "closer to an end than half an element", elements, "elements",
                  has_end(input, EndSupport::free) ? ", or a free end itself" : "");
}

Mesh make_rigid_mesh(const Case& input) {
  check_rules(
      {{!input.scene.beam.is_free(), "model.mesh",
        "is \"rigid\", but a rigid beam moves only with free ends; set beam.ends = [\"free\", "
        "\"free\"] (with beam.fixed = true it does not move), or use another mesh"}});
  return std::make_shared<RigidMesh>(input.scene.beam, input.scene.striker.position);
}

// Whether one half is modelled, which needs an odd count of cells or an even one of elements.
bool uses_half(const Case& input) {
  const MeshDescriptor::Refinement& refinement = *descriptor_of(input.model.mesh).refinement;
  const int count = input.model.*refinement.count;
  const bool odd = refinement.odd_in_half;
  if (!uses_symmetry(input)) return false;
  if ((count % 2 != 0) == odd) return true;
  refuse(refinement.key,
         "is {}, but the half model of a scene struck at mid-span needs an {} number, so that a {} "
         "lies under the striker; use {} or {}, or set model.symmetry = \"off\"",
         count, odd ? "odd" : "even", odd ? "cell" : "node", count - 1, count + 1);
}

// A mesh of `count` parts, of the whole beam or of one half.
template <class M, class... Details>
Mesh make_mesh(const Case& input, int count, const Details&... details) {
  return std::make_shared<M>(input.scene.beam, input.scene.striker.position,
                             static_cast<std::size_t>(count),
                             uses_half(input) ? M::Extent::half : M::Extent::whole, details...);
}

Mesh make_cell_mesh(const Case& input) {
  const int segments = input.model.segments;
  if (input.scene.beam.shears()) return make_mesh<TimoshenkoMesh>(input, segments);
  return make_mesh<CellMesh>(input, segments, spacing_of(input));
}

template <class M>
Mesh make_element_mesh(const Case& input) {
  return make_mesh<M>(input, input.model.elements);
}

double size_of_cells(const Case& input) {
  return CellMesh::spacing_of(input.scene.beam, static_cast<std::size_t>(input.model.segments),
                              spacing_of(input));
}

double size_of_elements(const Case& input) {
  return input.scene.beam.length / input.model.elements;
}

// Natural modes are for beams that may yield, but hardly do.
int order_of_elements(const Case& input) {
  if (!may_yield(input)) return 4;
  return input.solver.method == Method::exponential ? 2 : 1;
}

constexpr const char* keys_of_cells[] = {"model.segments", "model.spacing", "model.symmetry"};
constexpr const char* keys_of_elements[] = {"model.elements", "model.symmetry"};

constexpr MeshDescriptor rows[] = {
    {.kind = MeshKind::cells,
     .name = "cells",
     .note = "equal cells, second order",
     .keys = keys_of_cells,
     .check = check_cells,
     .make = make_cell_mesh,
     .refinement = {{&ModelOptions::segments, "model.segments", "cells",
                     static_cast<int>(CellMesh::fewest_cells_if_clamped), true, size_of_cells,
                     [](const Case& c) {
                       return c.model.spacing == CellSpacing::points ? 1 : 2;
                     }}}},
    {.kind = MeshKind::hermite,
     .name = "hermite",
     .note = "cubic Hermite elements, fourth order, for beams that do not shear",
     .keys = keys_of_elements,
     .suits = [](const Beam& beam) { return !beam.shears(); },
     .check = check_elements,
     .make = make_element_mesh<HermiteMesh>,
     .refinement = {{&ModelOptions::elements, "model.elements", "elements",
                     static_cast<int>(HermiteMesh::fewest_elements), false, size_of_elements,
                     order_of_elements}}},
    {.kind = MeshKind::spectral,
     .name = "spectral",
     .note = "elements of degree 4 for beams that shear",
     .keys = keys_of_elements,
     .suits = [](const Beam& beam) { return beam.shears(); },
     .check = check_elements,
     .make = make_element_mesh<SpectralMesh>,
     .refinement = {{&ModelOptions::elements, "model.elements", "elements",
                     static_cast<int>(SpectralMesh::fewest_elements), false, size_of_elements,
                     [](const Case&) { return 2; }}}},
    {.kind = MeshKind::rigid,
     .name = "rigid",
     .note = "the beam as a rigid body, for impacts of two bodies",
     .keys = {},
     .bends = false,
     .check = [](const Case&) {},
     .make = make_rigid_mesh},
};

}  // namespace

std::span<const MeshDescriptor> meshes() { return rows; }

const MeshDescriptor& descriptor_of(MeshKind kind) {
  for (const MeshDescriptor& row : rows) {
    if (row.kind == kind) return row;
  }
  throw std::logic_error("a mesh has no descriptor: add a row in meshes.cpp");
}

bool strikes_end(const Case& input) {
  return input.scene.striker.position == 0.0 || input.scene.striker.position == 1.0;
}

void check_mesh(const Case& input) {
  const MeshDescriptor& mesh = descriptor_of(input.model.mesh);
  if (!mesh.suits(input.scene.beam)) {
    std::vector<std::string> suitable;
    for (const MeshDescriptor& row : rows) {
      if (row.suits(input.scene.beam)) suitable.push_back(fmt::format("\"{}\"", row.name));
    }
    refuse("model.mesh",
           "is \"{}\", which does not model beam.theory = {}; allowed with it: {}; use one of "
           "these, or another theory",
           mesh.name, value_text(input, "beam.theory"), fmt::join(suitable, ", "));
  }
  if (!mesh_uses(input, "model.spacing") && input.model.spacing != CellSpacing::cells) {
    refuse("model.spacing",
           "is {}, but only cells have a spacing; allowed with this mesh: \"cells\"; leave it out, "
           "or set model.mesh = \"cells\"",
           value_text(input, "model.spacing"));
  }
  mesh.check(input);
}

void make_room_for_strike(Case& input) {
  const auto& refinement = descriptor_of(input.model.mesh).refinement;
  const double at = input.scene.striker.position;
  const double to_end = std::min(at, 1.0 - at);
  if (!refinement || !(to_end > 0.0)) return;
  int& count = input.model.*refinement->count;
  const int needed = 2 * static_cast<int>(std::min(0.25 / to_end, 1e8)) + 2;
  count = std::max(count, needed + (refinement->odd_in_half ? 1 : 0));
}

MeshKind default_mesh(const Case& input) {
  if (input.scene.beam.fixed) return MeshKind::rigid;
  if (!strikes_end(input) || input.model.spacing == CellSpacing::points) return MeshKind::cells;
  return input.scene.beam.shears() ? MeshKind::spectral : MeshKind::hermite;
}

bool mesh_uses(const Case& input, const char* key) {
  if (input.parts.mesh) return false;
  const auto keys = descriptor_of(input.model.mesh).keys;
  return std::ranges::find(keys, std::string_view(key)) != keys.end();
}

}  // namespace subimpact
