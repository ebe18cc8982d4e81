#include "case/problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "case/meshes.h"
#include "model/mesh/sprung_mesh.h"
#include "numerics/units.h"
#include "simulate/run_parts.h"
#include "simulate/settings/methods.h"
#include "simulate/settings/refuse.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

using Section = std::optional<Fibres>;

constexpr SectionDescriptor section_rows[] = {
    {SectionKind::elastic, "elastic", "the beam never yields (the contact still may)", false,
     [](const ModelOptions&, const Beam&) -> Section { return std::nullopt; }},
    {SectionKind::layers, "layers", "elastic-perfectly plastic layers, stress at mid-layer", true,
     [](const ModelOptions& model, const Beam& beam) -> Section {
       return Fibres::layered(model.layers, beam);
     }},
    {SectionKind::exact, "exact", "the limit of infinitely many layers, in closed form", false,
     [](const ModelOptions&, const Beam& beam) -> Section { return Fibres::continuous(beam); }},
};

// Whether each load or spring has an equal one at the mirror image of its point.
template <class Thing, class Amount>
bool is_mirrored(const std::vector<Thing>& things, const Amount& amount) {
  const auto count = [&](double position, const auto& of) {
    return std::ranges::count_if(things, [&](const Thing& thing) {
      return thing.position == position && amount(thing) == of;
    });
  };
  return std::ranges::all_of(things, [&](const Thing& thing) {
    return count(thing.position, amount(thing)) == count(1.0 - thing.position, amount(thing));
  });
}

void check_displacements(const Case& input, const BeamMesh& mesh) {
  const auto at_end = mesh.displacement_at(0.0);
  if (at_end && at_end->dense.empty()) return;
  refuse(input.scene.beam.foundation > 0.0 ? "beam.foundation" : "beam.springs",
         "is given, but this mesh gives no displacements along the beam; leave it out, or give "
         "the mesh displacement_at()");
}

// Parts of a quadrature along the beam.
std::shared_ptr<const BeamMesh> on_springs(const Case& input,
                                           std::shared_ptr<const BeamMesh> mesh) {
  const auto& refinement = descriptor_of(input.model.mesh).refinement;
  std::size_t n_parts = refinement ? static_cast<std::size_t>(input.model.*refinement->count) : 1;
  if (input.parts.mesh) n_parts = mesh->n_unknowns();
  const bool is_cells = !input.parts.mesh && input.model.mesh == MeshKind::cells;
  return std::make_shared<SprungMesh>(std::move(mesh), input.scene.beam, n_parts, is_cells);
}

}  // namespace

std::span<const SectionDescriptor> sections() { return section_rows; }

const SectionDescriptor& descriptor_of(SectionKind kind) {
  for (const SectionDescriptor& row : section_rows) {
    if (row.kind == kind) return row;
  }
  throw std::logic_error("a section has no descriptor: add a row in problem.cpp");
}

const char* height_key(const Beam& beam) {
  return beam.section.diameter ? "beam.section.diameter"
         : beam.section.height ? "beam.section.height"
                               : "beam.thickness";
}

const char* width_key(const Beam& beam) {
  return beam.section.diameter ? "beam.section.diameter"
         : beam.section.width  ? "beam.section.width"
                               : "beam.width";
}

Beam sized_beam(const Case& input) {
  Beam beam = input.scene.beam;
  for (const int end : {0, 1}) {
    if (!beam.rests[end]) continue;
    beam.springs.push_back({static_cast<double>(end), beam.rest_stiffness(), OneSided{}});
    beam.start = BeamStart::equilibrium;
  }
  if (!beam.fixed) return beam;
  if (beam.length == 0.0) beam.length = 1.0;
  if (beam.area() == 0.0) beam.width = beam.thickness = 0.05 * beam.length;
  if (beam.density == 0.0) beam.density = 1.0;
  beam.youngs_modulus = 1e30 * beam.density;
  return beam;
}

bool may_yield(const Case& input) {
  return input.model.section != SectionKind::elastic &&
         (input.parts.mesh || descriptor_of(input.model.mesh).bends) &&
         std::isfinite(input.scene.beam.yield_stress);
}

bool is_symmetric(const Case& input) {
  const auto& ends = input.scene.beam.ends;
  const Beam& beam = input.scene.beam;
  return input.scene.striker.position == 0.5 && ends[0] == ends[1] &&
         beam.angular_velocity == 0.0 && beam.rests[0] == beam.rests[1] &&
         is_mirrored(beam.forces, [](const PointForce& force) { return force.table; }) &&
         is_mirrored(beam.springs, [](const Spring& spring) {
           return std::pair(spring.stiffness, spring.one_sided);
         });
}

bool uses_symmetry(const Case& input) {
  return input.model.symmetry == SymmetryUse::automatic && is_symmetric(input);
}

double largest_stable_step(Case input) {
  input.solver.step.reset();
  return default_part_of_critical * resolve(input).settings().critical_step;
}

std::string contact_words(const Case& input) {
  const Scene& scene = input.scene;
  if (input.parts.contact_law) return {};
  const BuiltInContactLaw& law = built_in_contact_law(scene.contact.kind);
  if (!scene.striker.nose_radius || !uses_key(constants_given(input, law), "striker.nose_radius")) {
    if (law.kind == ContactKind::curve) return "contact as measured, law curve";
    return fmt::format("contact of given stiffness, law {}", law.name);
  }
  return fmt::format("{} nose of {:.4g} mm, law {}",
                     scene.nose() == NoseShape::sphere ? "spherical" : "cylindrical",
                     mm * *scene.striker.nose_radius, law.name);
}

std::shared_ptr<const ContactLaw> contact_law_of(const Case& input) {
  return input.parts.contact_law ? input.parts.contact_law : make_contact_law(input.scene);
}

Problem problem_of(const Case& given) {
  Case input = given;
  input.scene.beam = sized_beam(given);
  Problem problem;
  problem.beam = input.scene.beam;
  problem.striker = input.scene.striker;
  problem.gravity = input.scene.gravity;
  problem.mesh = input.parts.mesh ? input.parts.mesh : descriptor_of(input.model.mesh).make(input);
  const Beam& beam = input.scene.beam;
  if (beam.is_sprung() || beam.may_lift()) check_displacements(input, *problem.mesh);
  if (beam.is_sprung()) problem.mesh = on_springs(input, std::move(problem.mesh));
  problem.contact_law = contact_law_of(given);
  problem.contact_damping = input.scene.contact_damping();
  if (input.scene.contact.restitution) {
    problem.restitution_velocity = input.scene.bodies().velocity_scale();
  }
  problem.check_contact_law = input.parts.contact_law != nullptr;
  problem.check_mesh = input.parts.mesh != nullptr;
  problem.integrator = input.parts.integrator;
  problem.may_yield = may_yield(input);
  problem.start = input.parts.start;
  problem.is_one_of_several = input.strikes > 1 || problem.start;
  problem.at_rest = input.at_rest;
  problem.section = input.parts.section;
  if (!problem.section && problem.may_yield) {
    problem.section = descriptor_of(input.model.section).make(input.model, input.scene.beam);
  }
  if (problem.section) problem.section = problem.section->hardened(input.scene.beam.hardening);
  return problem;
}

ResolvedRun resolve(const Case& input) {
  const auto start = std::chrono::steady_clock::now();
  check(input);
  ResolvedRun run = resolve(problem_of(input), input);
  run.parts().warnings = doubtful_units(input);
  run.parts().warnings_of_result = [input](const Result& result) {
    std::vector<std::string> sentences;
    for (auto& each : beyond_the_model(input, result)) sentences.push_back(each.sentence);
    return sentences;
  };
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  run.parts().setup_seconds = taken.count();
  return run;
}

Result simulate(const Case& input, const Progress& progress, Observer* observer, RowSink* rows) {
  return simulate(resolve(input), progress, observer, rows);
}

}  // namespace subimpact
