#include "case/model_factory.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "case/mesh_checks.h"
#include "case/methods.h"
#include "integrate/klu_mass_solver.h"
#include "model/cell_mesh.h"
#include "model/contact_laws.h"
#include "model/flexural_frequencies.h"
#include "model/hermite_mesh.h"
#include "model/modal_mesh.h"
#include "model/rigid_mesh.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/case/method_tables.h"
#include "system/contact_resonance.h"

namespace subimpact {
namespace {

constexpr double default_part_of_critical = 0.9;
// Steps that the default step makes at least in the time scale of the shortest contacts, to follow
// them, and where all of the strike's energy goes through them, to keep it to 1e-4.
constexpr double default_steps_in_contact = 8.0;
constexpr double default_steps_to_keep_energy = 48.0;
// Central differences keep no energy where the length of the step changes: after a step cut short
// at an event the energy of a mode of angle omega h may be off by (omega h/2)^2. Up to this part of
// the critical step that is 2 % of the fastest mode at an event.
constexpr double largest_part_if_located = 0.15;

// Energy errors of adaptive methods are some 1 to 1000 rtol, with Cash and Karp's table, which
// grows slowly where it should be neutral, 1000. What is tolerated by default, within bounds:
constexpr double tolerated_energy_per_rtol = 1e4;
constexpr double least_tolerated_energy = 1e-6;
constexpr double most_tolerated_energy = 1e-3;
constexpr double tolerated_momentum = 1e-9;

// How far the section correction of a step may be off, in units of the integrator's own
// tolerance on velocities. At 1 it is off by a third of it, root mean square over the steps of the
// paper's beam; a tighter one costs more steps than the events gain.
constexpr double correction_share = 1.0;

bool is_symmetric(const Scene& scene) {
  return scene.striker.position == 0.5 && scene.beam.ends[0] == scene.beam.ends[1];
}

std::vector<std::string> tables_of(const MethodDescriptor& method) {
  std::vector<std::string> names;
  if (method.tables == nullptr) return names;
  for (const MethodTable& table : method.tables()) names.push_back(table.name);
  return names;
}

std::optional<int> max_order_used(const Case& input) {
  const std::optional<int>& asked = input.solver.max_order;
  const MethodDescriptor& method = descriptor_of(input.solver.method);
  if (!method.order) {
    if (!asked) return std::nullopt;
    throw InvalidCase(
        "solver.max_order",
        fmt::format("is {}, but {} has no order to choose; leave it out, or use adams or bdf",
                    *asked, method.name));
  }
  const int order = asked.value_or(method.order->usual);
  if (order < 1 || order > method.order->limit) {
    throw InvalidCase("solver.max_order", fmt::format("is {}; allowed for {}: from 1 to {}", order,
                                                      method.name, method.order->limit));
  }
  return order;
}

// Settings that the method cannot take.
void check_method(const Case& input, const Used& used, bool can_yield) {
  const MethodDescriptor& method = descriptor_of(input.solver.method);
  if (method.needs_located_events && used.events != EventHandling::located) {
    throw InvalidCase("solver.events",
                      fmt::format("is \"interpolated\", but the steps of {} are too long for it; "
                                  "allowed: \"located\"; leave it out, or use another "
                                  "solver.method",
                                  method.name));
  }
  if (method.steps == MethodDescriptor::Steps::adaptive_order && input.solver.step) {
    throw InvalidCase(
        "solver.step",
        fmt::format("is {} s, but {} chooses step and order together and has no fixed step; leave "
                    "it out (solver.max_step bounds the step), or use another method",
                    *input.solver.step, method.name));
  }
  if (!method.needs_adaptive_steps_to_yield || !can_yield) return;
  const auto refuse = [&](const char* key, const char* what) {
    throw InvalidCase(key, fmt::format("is {}, which {} cannot do where the beam may yield; leave "
                                       "it out, set model.section = \"elastic\", or use nystrom",
                                       what, method.name));
  };
  if (input.solver.step) refuse("solver.step", "given: a fixed step");
  if (used.reversals != ReversalHandling::located) refuse("solver.reversals", "\"step-end\"");
}

// The table asked for, or the method's first; nothing for a method without tables.
std::optional<std::string> table_used(const Case& input) {
  const std::vector<std::string> names = tables_of(descriptor_of(input.solver.method));
  const std::optional<std::string>& asked = input.solver.table;
  if (!asked) return names.empty() ? std::nullopt : std::optional(names.front());
  if (std::find(names.begin(), names.end(), *asked) == names.end()) {
    throw InvalidCase(
        "solver.table",
        fmt::format("is \"{}\", which {} does not have; {}", *asked, to_string(input.solver.method),
                    names.empty() ? "leave it out: the method has no tables"
                                  : fmt::format("allowed: {}", fmt::join(names, ", "))));
  }
  return asked;
}

double default_central_step(const Used& used) {
  // The scheme's energy is off by some (h/T)^2 of what the contact's own motion holds, m_eff/m of
  // the whole.
  const double steps = std::max(default_steps_in_contact,
                                default_steps_to_keep_energy * std::sqrt(used.contact_mass_share));
  return std::min(default_part_of_critical * used.critical_step, used.contact_time / steps);
}

// Numbers that are possible one by one may overflow or vanish together.
void check_scales(const Case& input, const StruckBeam& beam) {
  const double energy =
      0.5 * input.scene.striker.mass * input.scene.striker.velocity * input.scene.striker.velocity;
  const SecondOrderOde::Scales scales = beam.scales();
  const double smallest = std::min({energy, scales.position, scales.velocity});
  const double largest = std::max({energy, scales.position, scales.velocity});
  if (smallest > 1e-100 && largest < 1e100) return;
  throw InvalidCase(
      "striker.velocity",
      fmt::format(
          "is {:g} m/s, with which the strike has {:g} J and an indentation of some {:g} m: "
          "beyond what numbers of 16 digits can follow; allowed: both from 1e-100 to 1e100; "
          "check the units of striker and contact",
          input.scene.striker.velocity, energy, scales.position));
}

void check_central_step(const Case& input, const Used& used) {
  const double step = *used.step;
  if (step > used.critical_step && !input.solver.beyond_critical) {
    throw InvalidCase(
        "solver.step",
        fmt::format("is {:.6g} us, above the stability limit of central differences for this beam "
                    "with the contact at its stiffest, {:.6g} us (2/omega); use a smaller step, "
                    "leave it out for {:.6g} us, or set solver.beyond_critical = true to see it "
                    "fail",
                    1e6 * step, 1e6 * used.critical_step, 1e6 * default_central_step(used)));
  }
  if (used.events == EventHandling::located && used.highest_frequency > 0.0 &&
      step > largest_part_if_located * used.critical_step) {
    throw InvalidCase(
        "solver.events",
        fmt::format("is \"located\" with central differences of {:.6g} us, which gain energy "
                    "without bound where steps end at events; allowed: \"interpolated\" (the "
                    "default), or a solver.step up to {:.6g} us; leave it out",
                    1e6 * step, 1e6 * largest_part_if_located * used.critical_step));
  }
}

double energy_tolerance(const Case& input, const Used& used) {
  if (input.accuracy.energy) return *input.accuracy.energy;
  if (used.step || used.events == EventHandling::interpolated) return most_tolerated_energy;
  return std::clamp(tolerated_energy_per_rtol * input.solver.rtol, least_tolerated_energy,
                    most_tolerated_energy);
}

std::unique_ptr<BeamMesh> make_rigid_mesh(const Case& input) {
  for (const EndSupport end : input.scene.beam.ends) {
    if (end == EndSupport::free) continue;
    throw InvalidCase("model.mesh",
                      "is \"rigid\", but a rigid beam moves only with free ends; set beam.ends = "
                      "[\"free\", \"free\"] (a heavy beam stands for a fixed one), or use another "
                      "mesh");
  }
  return std::make_unique<RigidMesh>(input.scene.beam, input.scene.striker.position);
}

std::unique_ptr<BeamMesh> make_cell_mesh(const Case& input) {
  const bool half = uses_symmetry(input);
  const int segments = input.model.segments;
  if (half && segments % 2 == 0) {
    throw InvalidCase(
        "model.segments",
        fmt::format(
            "is {}, but the half model of a scene struck at mid-span needs an odd number, so "
            "that a cell lies under the striker; use {} or {}, or set model.symmetry = \"off\"",
            segments, segments - 1, segments + 1));
  }
  return std::make_unique<CellMesh>(input.scene.beam, input.scene.striker.position,
                                    static_cast<std::size_t>(segments),
                                    half ? CellMesh::Extent::half : CellMesh::Extent::whole);
}

std::unique_ptr<BeamMesh> make_hermite_mesh(const Case& input) {
  const bool half = uses_symmetry(input);
  const int elements = input.model.elements;
  if (half && elements % 2 != 0) {
    throw InvalidCase(
        "model.elements",
        fmt::format("is {}, but the half model of a scene struck at mid-span needs an even number, "
                    "so that a node lies under the striker; use {} or {}, or set model.symmetry = "
                    "\"off\"",
                    elements, elements - 1, elements + 1));
  }
  return std::make_unique<HermiteMesh>(
      input.scene.beam, input.scene.striker.position, static_cast<std::size_t>(elements),
      static_cast<std::size_t>(input.model.sections_per_element),
      half ? HermiteMesh::Extent::half : HermiteMesh::Extent::whole,
      HermiteMesh::Options{grading_of(input),
                           input.model.hinges == HingeUse::automatic && may_yield(input)});
}

std::unique_ptr<BeamMesh> make_mesh(const Case& input) {
  switch (input.model.mesh) {
    case MeshKind::cells:
      return make_cell_mesh(input);
    case MeshKind::hermite:
      return make_hermite_mesh(input);
    case MeshKind::rigid:
      return make_rigid_mesh(input);
  }
  throw std::logic_error("make_mesh: a mesh of no kind");
}

// Whether an elastic beam on this mesh is integrated in its natural modes. Explicit methods see the
// same motion in either unknowns, but a step in modes needs no mass solve.
bool in_modes(const Case& input, const BeamMesh& mesh) {
  switch (descriptor_of(input.solver.method).modes) {
    case MethodDescriptor::Modes::always:
      return true;
    case MethodDescriptor::Modes::where_cheaper:
      return mesh.prefers_modes() && input.solver.mass_solver == MassSolverKind::tridiagonal;
    case MethodDescriptor::Modes::never:
      return false;
  }
  return false;
}

SectionField make_sections(const Case& input, std::size_t n, SectionField::Storage storage) {
  const Beam& beam = input.scene.beam;
  if (may_yield(input)) return SectionField(n, SectionLaw(beam, *fibres_of(input)), storage);
  const auto& own = input.parts.section;
  return SectionField(n, own ? own->slope() * beam.bending_stiffness() : beam.bending_stiffness());
}

// E h/2 of the fibre farthest from the axis.
double outer_stiffness(const Case& input) {
  const Beam& beam = input.scene.beam;
  const double of_rectangle = 0.5 * beam.youngs_modulus * beam.thickness;
  return input.parts.section ? input.parts.section->outer_modulus() * of_rectangle : of_rectangle;
}

std::string section_name(const Case& input) {
  if (input.model.mesh == MeshKind::rigid) return "rigid";
  const auto& own = input.parts.section;
  if (may_yield(input)) return fibres_of(input)->name();
  return own ? own->name() + ", elastic" : "elastic";
}

// That of the beam in bending, with the section it has.
double first_period(const Case& input) {
  const double of_rectangle = 2.0 * M_PI / flexural_frequencies(input.scene.beam, 1).front();
  const auto& own = input.parts.section;
  return own ? of_rectangle / std::sqrt(own->slope()) : of_rectangle;
}

}  // namespace

bool may_yield(const Case& input) {
  return input.model.section != SectionKind::elastic && input.model.mesh != MeshKind::rigid &&
         std::isfinite(input.scene.beam.yield_stress);
}

bool uses_symmetry(const Case& input) {
  return input.model.symmetry == SymmetryUse::automatic && is_symmetric(input.scene);
}

std::shared_ptr<const ContactLaw> contact_law_of(const Case& input) {
  return input.parts.contact_law ? input.parts.contact_law : make_contact_law(input.scene);
}

std::optional<Fibres> fibres_of(const Case& input) {
  if (input.parts.section) return input.parts.section;
  switch (input.model.section) {
    case SectionKind::elastic:
      return std::nullopt;
    case SectionKind::layers:
      return Fibres::layered(input.model.layers);
    case SectionKind::exact:
      return Fibres::continuous();
  }
  throw std::logic_error("fibres_of: a section of no kind");
}

StruckBeam make_struck_beam(const Case& input, SectionField::Storage storage,
                            Coordinates coordinates) {
  std::unique_ptr<BeamMesh> mesh = make_mesh(input);
  SectionField sections = make_sections(input, mesh->n_sections(), storage);
  if (coordinates == Coordinates::chosen && !sections.can_yield() && in_modes(input, *mesh)) {
    mesh = std::make_unique<ModalMesh>(std::move(mesh), sections.stiffness());
  }
  std::unique_ptr<MassSolver> solver;
  if (input.solver.mass_solver == MassSolverKind::klu) {
    solver = make_klu_mass_solver(mesh->mass());
  } else {
    solver = std::make_unique<BandedSolver>(mesh->mass());
  }
  return StruckBeam(StruckBeamParts{std::move(mesh), std::move(sections), contact_law_of(input),
                                    input.scene.striker.mass, input.scene.striker.velocity,
                                    outer_stiffness(input), std::move(solver)});
}

Used describe(const Case& input, const StruckBeam& beam) {
  const Scene& scene = input.scene;
  Used used;
  used.half_model = beam.mesh().symmetric();
  used.n_unknowns = beam.mesh().n_unknowns();
  used.n_sections = beam.mesh().n_sections();
  used.mesh = beam.mesh().description();
  used.highest_frequency = beam.mesh().highest_frequency(beam.sections().stiffness());
  const ContactResonance resonance = contact_resonance(beam, scene.beam.thickness);
  used.largest_contact_slope = resonance.largest_slope;
  used.joined_frequency = resonance.highest_frequency;
  used.contact_time = resonance.contact_time;
  used.contact_mass_share = resonance.effective_mass / scene.striker.mass;
  used.critical_step = 2.0 / used.joined_frequency;
  const ContactLaw& law = beam.contact().law();
  used.contact_law = law.name();
  used.contact_stiffness = law.scales().stiffness;
  used.contact_exponent = law.scales().exponent;
  used.yield_indentation = law.yield_threshold({});
  used.section = section_name(input);
  used.yield_curvature = scene.beam.yield_curvature();
  used.first_period = first_period(input);
  used.initial_energy = 0.5 * scene.striker.mass * scene.striker.velocity * scene.striker.velocity;
  check_scales(input, beam);
  used.table = table_used(input);
  used.events = events_of(input);
  used.reversals = reversals_of(input);
  used.max_order = max_order_used(input);
  check_method(input, used, beam.sections().can_yield());
  if (descriptor_of(input.solver.method).steps == MethodDescriptor::Steps::fixed) {
    used.step = input.solver.step.value_or(default_central_step(used));
    check_central_step(input, used);
  } else {
    used.step = input.solver.step;
    if (!used.step) {
      const SecondOrderOde::Scales scales = beam.scales();
      used.position_tolerance = input.solver.rtol * scales.position;
      used.velocity_tolerance = input.solver.rtol * scales.velocity;
    }
  }
  used.energy_tolerance = energy_tolerance(input, used);
  return used;
}

AuditLimits audit_limits(const Used& used) { return {used.energy_tolerance, tolerated_momentum}; }

std::unique_ptr<Integrator> make_integrator(const Case& input, const Used& used, StruckBeam& beam) {
  return descriptor_of(input.solver.method).make(input, used, beam);
}

LoopOptions loop_options(const Case& input, const Used& used) {
  LoopOptions options;
  options.end_time = input.end_time;
  options.events = used.events;
  options.double_roots = input.solver.pair_detection;
  if (used.reversals == ReversalHandling::located) {
    options.correction_tolerance =
        correction_share * input.solver.rtol * input.scene.striker.velocity;
  }
  options.largest_indentation = input.scene.beam.thickness;
  options.audit_interval = descriptor_of(input.solver.method).audit_interval;
  options.shortest_contact = M_PI / used.joined_frequency;
  return options;
}

}  // namespace subimpact
