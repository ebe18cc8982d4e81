#include "case/meshes.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "case/problem.h"
#include "case/refuse.h"
#include "model/cell_mesh.h"
#include "model/hermite_mesh.h"
#include "model/mixed_mesh.h"
#include "model/rigid_mesh.h"
#include "model/spectral_mesh.h"
#include "model/timoshenko_mesh.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

using Mesh = std::shared_ptr<const BeamMesh>;

ElementGrading grading_of(const Case& input) {
  return {input.model.strike_refinement, input.model.refined_length * input.scene.beam.length};
}

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

bool strikes_end(const Case& input) {
  return input.scene.striker.position == 0.0 || input.scene.striker.position == 1.0;
}

// Whether the strike is at an end with a support.
bool strikes_support(const Case& input) {
  const int end = input.scene.striker.position == 0.0 ? 0 : 1;
  return input.scene.beam.ends[end] != EndSupport::free;
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

// What mixed cells are not derived for.
void check_mixed_model(const Case& input) {
  const Beam& beam = input.scene.beam;
  const BeamDamping& damping = beam.damping;
  const bool is_shaped = beam.section.shape != SectionShape::rectangle;
  const bool yields = may_yield(input);
  const char* of_scene =
      "is given, but mixed cells, whose masses and step are made for free waves, have no loads, "
      "springs or motion at the start; leave it out, or use another mesh";
  const char* of_damping =
      "is above 0, but mixed cells have no damping; leave it out, or use another mesh";
  const char* of_section =
      "is given, but mixed cells that yield find the curvature from the moment by the closed "
      "form of a rectangle that does not harden; allowed with model.mesh = \"mixed\": such a "
      "rectangle, or model.section = \"elastic\"; choose one, or another mesh";
  check_rules({{input.scene.gravity != 0.0, "scene.gravity", of_scene},
               {beam.load != 0.0, "beam.load", of_scene},
               {!beam.forces.empty(), "beam.forces", of_scene},
               {!beam.springs.empty(), "beam.springs", of_scene},
               {beam.foundation != 0.0, "beam.foundation", of_scene},
               {beam.velocity != 0.0, "beam.velocity", of_scene},
               {beam.angular_velocity != 0.0, "beam.angular_velocity", of_scene},
               {beam.rotary_inertia() == 0.0, "beam.theory",
                "is \"euler-bernoulli\", but mixed cells need rotary inertia; allowed with "
                "model.mesh = \"mixed\": \"rayleigh\"; choose it, or another mesh"},
               {damping.ratio > 0.0, "beam.damping.ratio", of_damping},
               {damping.mass > 0.0, "beam.damping.mass", of_damping},
               {damping.stiffness > 0.0, "beam.damping.stiffness", of_damping}});
  if (input.parts.section || input.model.section == SectionKind::layers) {
    refuse(
        "model.section",
        "is {}, but mixed cells find the curvature from the moment by the rectangle's closed form; "
        "allowed with model.mesh = \"mixed\": \"exact\", \"elastic\"; choose one, or another mesh",
        input.parts.section ? "a section of its own" : "\"layers\"");
  }
  check_rules({{yields && is_shaped, "beam.section.shape", of_section},
               {yields && beam.hardening > 0.0, "beam.hardening", of_section}});
}

void check_mixed(const Case& input) {
  check_mixed_model(input);
  const auto cells = static_cast<std::size_t>(std::max(input.model.segments, 0));
  const double at = input.scene.striker.position;
  const std::size_t before = MixedMesh::cells_before(at, cells);
  if (std::min(before, cells - before) >= MixedMesh::fewest_beside) return;
  const double nearest = static_cast<double>(MixedMesh::fewest_beside) / static_cast<double>(cells);
  refuse("striker.position",
         "is {}, closer to an end than {} of {} segments; allowed: from {:.6g} to {:.6g}; move the "
         "strike inwards or use more segments",
         at, MixedMesh::fewest_beside, cells, nearest, 1.0 - nearest);
}

// There is a node at the strike; an element much shorter than others would determine the time step.
void check_elements(const Case& input) {
  const int elements = input.model.elements;
  const double at = input.scene.striker.position;
  const double length = input.scene.beam.length;
  if (strikes_end(input)) {
    if (!strikes_support(input)) return;
    refuse("striker.position",
           "is {}, on a support; allowed: strictly between the supports; move the strike inwards",
           at);
  }
  const ElementGrading grading = grading_of(input);
  const double before = grading.elements_within(at * length);
  const double after = grading.elements_within((1.0 - at) * length);
  if (elements * std::min(before, after) >= 0.5 * (before + after)) return;
  if (grading.refinement != 1.0) {
    refuse("striker.position",
           "is {}, closer to an end than half an element, of {} graded towards the strike; move "
           "the strike inwards or use more elements",
           at, elements);
  }
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
                             static_cast<std::size_t>(count), details...);
}

template <class M>
typename M::Extent extent_of(const Case& input) {
  return uses_half(input) ? M::Extent::half : M::Extent::whole;
}

Mesh make_cell_mesh(const Case& input) {
  const int segments = input.model.segments;
  if (input.scene.beam.shears()) {
    return make_mesh<TimoshenkoMesh>(input, segments, extent_of<TimoshenkoMesh>(input));
  }
  return make_mesh<CellMesh>(input, segments, extent_of<CellMesh>(input), spacing_of(input));
}

Mesh make_mixed_mesh(const Case& input) {
  const int cells = input.model.segments;
  const bool in_differences = input.solver.method == Method::central_difference;
  double ratio = in_differences ? 1.0 : 0.0;
  if (in_differences && input.solver.step) {
    const double natural = MixedMesh::natural_step_of(
        input.scene.beam, input.scene.striker.position, static_cast<std::size_t>(cells));
    ratio = std::min(*input.solver.step / natural, 1.0);  // longer ones are refused (simulate)
  }
  return make_mesh<MixedMesh>(input, cells, extent_of<MixedMesh>(input), ratio);
}

Mesh make_hermite_mesh(const Case& input) {
  const bool has_hinges = input.model.hinges == HingeUse::automatic && may_yield(input);
  return make_mesh<HermiteMesh>(
      input, input.model.elements, static_cast<std::size_t>(input.model.sections_per_element),
      extent_of<HermiteMesh>(input), HermiteMesh::Options{grading_of(input), has_hinges});
}

Mesh make_spectral_mesh(const Case& input) {
  return make_mesh<SpectralMesh>(input, input.model.elements, extent_of<SpectralMesh>(input));
}

double size_of_cells(const Case& input) {
  return CellMesh::spacing_of(input.scene.beam, static_cast<std::size_t>(input.model.segments),
                              spacing_of(input));
}

double size_of_elements(const Case& input) {
  return input.scene.beam.length / input.model.elements;
}

int order_of_elements(const Case& input) {
  if (!may_yield(input)) return 4;
  return input.model.hinges == HingeUse::off ? 1 : 2;
}

// Plastic hinges keep the order of times between 1 and 2; of elastic beams, the contact's part of
// the error in time has the order 2, below some 0.01 us.
int order_of_mixed(const Case& input) { return may_yield(input) ? 1 : 2; }

constexpr const char* keys_of_mixed[] = {"model.segments", "model.symmetry"};
constexpr const char* keys_of_cells[] = {"model.segments", "model.spacing", "model.symmetry"};
constexpr const char* keys_of_elements[] = {"model.elements",       "model.sections_per_element",
                                            "model.hinges",         "model.strike_refinement",
                                            "model.refined_length", "model.symmetry"};

constexpr const char* keys_of_spectral[] = {"model.elements", "model.symmetry"};

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
    {.kind = MeshKind::mixed,
     .name = "mixed",
     .note = "cells with moments linear between nodes, fourth order while nothing flows, best by "
             "central differences at a step of their own: Rayleigh's theory, exact or elastic "
             "sections",
     .keys = keys_of_mixed,
     .has_own_step = true,
     .suits = [](const Beam& beam) { return !beam.shears(); },
     .check = check_mixed,
     .make = make_mixed_mesh,
     .refinement = {{&ModelOptions::segments, "model.segments", "mixed cells",
                     static_cast<int>(MixedMesh::fewest_cells), false,
                     [](const Case& c) { return c.scene.beam.length / c.model.segments; },
                     order_of_mixed}}},
    {.kind = MeshKind::hermite,
     .name = "hermite",
     .note = "cubic Hermite elements, fourth order, for beams that do not shear",
     .keys = keys_of_elements,
     .suits = [](const Beam& beam) { return !beam.shears(); },
     .check = check_elements,
     .make = make_hermite_mesh,
     .refinement = {{&ModelOptions::elements, "model.elements", "elements",
                     static_cast<int>(HermiteMesh::fewest_elements), false, size_of_elements,
                     order_of_elements}}},
    {.kind = MeshKind::spectral,
     .name = "spectral",
     .note = "elements of degree 4 for beams that shear",
     .keys = keys_of_spectral,
     .suits = [](const Beam& beam) { return beam.shears(); },
     .check = check_elements,
     .make = make_spectral_mesh,
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

void check_spacing(const Case& input) {
  if (!mesh_uses(input, "model.strike_refinement") && input.model.strike_refinement != 1.0) {
    refuse("model.strike_refinement",
           "is {:g}, but only elements can be shorter at the strike; allowed with this mesh: 1; "
           "leave it out, or set model.mesh = \"hermite\"",
           input.model.strike_refinement);
  }
  if (!mesh_uses(input, "model.spacing") && input.model.spacing != CellSpacing::cells) {
    refuse("model.spacing",
           "is {}, but only cells have a spacing; allowed with this mesh: \"cells\"; leave it out, "
           "or set model.mesh = \"cells\"",
           to_text(*find_case_key("model.spacing")->get(input)));
  }
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
           mesh.name, to_text(*find_case_key("beam.theory")->get(input)),
           fmt::join(suitable, ", "));
  }
  check_spacing(input);
  mesh.check(input);
}

MeshKind default_mesh(const Case& input) {
  if (!strikes_end(input) || input.model.spacing == CellSpacing::points) return MeshKind::cells;
  return input.scene.beam.shears() ? MeshKind::spectral : MeshKind::hermite;
}

bool step_follows_mesh(const Case& input) {
  const bool chosen = !input.solver.step && input.solver.method == Method::central_difference;
  return chosen && mesh_has_own_step(input);
}

bool mesh_has_own_step(const Case& input) {
  if (input.parts.mesh) return input.parts.mesh->natural_step().has_value();
  return descriptor_of(input.model.mesh).has_own_step;
}

bool mesh_uses(const Case& input, const char* key) {
  if (input.parts.mesh) return false;
  const auto keys = descriptor_of(input.model.mesh).keys;
  return std::ranges::find(keys, std::string_view(key)) != keys.end();
}

}  // namespace subimpact
