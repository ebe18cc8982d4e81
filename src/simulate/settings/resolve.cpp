#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "model/mesh/modal_mesh.h"
#include "model/mesh/modes.h"
#include "numerics/mass_solver.h"
#include "numerics/units.h"
#include "simulate/run_parts.h"
#include "simulate/settings/methods.h"
#include "simulate/settings/refuse.h"
#include "system/contact/contact_events.h"
#include "system/contact/contact_resonance.h"
#include "system/readings/accounts.h"
#include "system/readings/beam_field.h"

namespace subimpact {
namespace {

// Energy errors of adaptive methods are some 1 to 1000 rtol, with Cash and Karp's table, which
// grows slowly where it should be neutral, 1000. What is tolerated by default, within bounds:
constexpr double tolerated_energy_per_rtol = 1e4;
constexpr double least_tolerated_energy = 1e-6;
constexpr double most_tolerated_energy = 1e-3;

// A larger number of natural modes is computed when the run begins: 600 take a few ms if they have
// a closed form, otherwise 0.5 s.
constexpr std::size_t most_modes_before_run = 600;

// Numbers that are possible one by one may overflow or vanish together.
void check_scales(double energy, const StruckBeam& beam) {
  const SecondOrderOde::Scales scales = beam.scales();
  const double smallest = std::min({energy, scales.position, scales.velocity});
  const double largest = std::max({energy, scales.position, scales.velocity});
  if (smallest > 1e-100 && largest < 1e100) return;
  refuse(
      "striker.velocity",
      "is {:g} m/s, with which the strike has {:g} J and an indentation of some {:g} m: beyond "
      "what numbers of 16 digits can follow; allowed: both from 1e-100 to 1e100; check the units "
      "of striker and contact",
      scales.velocity, energy, scales.position);
}

double energy_tolerance(const Options& options, const ResolvedSettings& used) {
  if (options.accuracy.energy) return *options.accuracy.energy;
  if (used.step || used.events == EventHandling::interpolated) return most_tolerated_energy;
  return std::clamp(tolerated_energy_per_rtol * options.solver.rtol, least_tolerated_energy,
                    most_tolerated_energy);
}

SectionField make_sections(const Problem& problem) {
  const Beam& beam = problem.beam;
  const auto& section = problem.section;
  const std::size_t n = problem.mesh->n_sections();
  if (problem.may_yield && std::isfinite(beam.yield_stress)) {
    return SectionField(n, SectionLaw(beam, section.value_or(Fibres::continuous(beam))));
  }
  return SectionField(n, (section ? section->slope() : 1.0) * beam.bending_stiffness());
}

// E h/2 of the fibre farthest from the axis.
double outer_stiffness(const Problem& problem) {
  const double of_rectangle = 0.5 * problem.beam.youngs_modulus * problem.beam.height();
  return problem.section ? problem.section->outer_modulus() * of_rectangle : of_rectangle;
}

std::string section_name(const Problem& problem, const StruckBeam& beam) {
  if (beam.mesh().n_sections() == 1) return "rigid";
  std::string name = problem.section ? problem.section->name() : Fibres::continuous().name();
  if (beam.sections().can_yield()) return name;
  return problem.section ? name + ", elastic" : "elastic";
}

// First period of the beam in bending, with its own section; layers represent the rectangle.
double first_period(const Problem& problem) {
  const double of_rectangle = 2.0 * M_PI / flexural_frequencies(problem.beam, 1).front();
  return problem.section ? of_rectangle / std::sqrt(problem.section->represented_slope())
                         : of_rectangle;
}

void check(const Problem& problem, const Options& options) {
  const auto positive = [](double x) { return x > 0.0 && std::isfinite(x); };
  const Beam& beam = problem.beam;
  const double sizes[] = {beam.length, beam.mass(), beam.bending_stiffness(),
                          beam.bending_stiffness() / std::pow(beam.length, 4)};
  if (!std::ranges::all_of(sizes, positive)) {
    refuse("beam", "has no mass or stiffness that is positive and finite; check its numbers");
  }
  if (!problem.mesh) refuse("model.mesh", "is missing; give Problem::mesh a mesh");
  if (problem.check_mesh) {
    if (const auto broken = broken_rule(*problem.mesh, beam)) refuse("model.mesh", "{}", *broken);
  }
  if (!problem.contact_law) refuse("contact.law", "is missing; give Problem::contact_law a law");
  if (!positive(options.end_time)) refuse("time.end", "is not a time; allowed: above 0 s");
  check_start(problem);
  const bool uniform = !problem.bodies().has_approach_to_compute();
  if (const double touch = problem.striker.first_touch(); uniform && !(touch < options.end_time)) {
    const auto& striker = problem.striker;
    refuse("striker.gap",
           "is {:g} m, which takes the striker {:.6g} s at {:g} m/s, but time.end is {:g} s; "
           "allowed: below {:g} m; reduce it, or set a later time.end",
           striker.gap, touch, striker.velocity, options.end_time,
           options.end_time * striker.velocity);
  }
  if (!positive(options.solver.rtol)) refuse("solver.rtol", "is not positive; allowed: above 0");
}

void check_own(const Problem& problem, const Options& options, const ResolvedSettings& used,
               const StruckBeam& beam) {
  const OwnIntegrator* own = problem.integrator.get();
  if (own == nullptr || !own->make) {
    refuse("solver.method",
           "is \"own\", but no integrator is given: a program that uses the library gives one as "
           "CaseParts::integrator; use another method");
  }
  if (!own->is_adaptive && !options.solver.step) {
    refuse(
        "solver.step",
        "is missing, and this integrator has no error control; central differences take {:.4g} us",
        us * used.critical_step);
  }
  if (!own->takes_velocities && beam.depends_on_velocity()) {
    refuse("solver.method",
           "is \"own\", of q'' = a(q), but damping depends on velocities; leave it "
           "out, or set OwnIntegrator::takes_velocities");
  }
}

// A mesh of a user's own may give no displacements along the beam.
double shape_interval(const Options& options, const BeamMesh& mesh) {
  const std::optional<double>& asked = options.output.shapes;
  if (BeamField::is_available(mesh)) return options.output.shape_interval(options.end_time);
  const auto refuse_field = [](const char* key) {
    refuse(key,
           "is given, but this mesh gives no displacements along the beam; leave it out, or give "
           "the mesh displacement_at() and rotation_at()");
  };
  if (asked && *asked > 0.0) refuse_field("output.shapes");
  if (!options.output.points.empty()) refuse_field("output.points");
  return 0.0;
}

ResolvedSettings settings_of(const Problem& problem, const Options& options,
                             const StruckBeam& beam) {
  ResolvedSettings used;
  used.half_model = beam.mesh().symmetric();
  used.n_unknowns = beam.mesh().n_unknowns();
  used.n_sections = beam.mesh().n_sections();
  used.mesh = beam.mesh().description();
  if (modes_are_left_out(options, beam)) used.mesh += modal_description;
  used.highest_frequency = beam.highest_frequency();
  const ContactResonance resonance = contact_resonance(beam, problem.beam.height());
  used.largest_contact_slope = resonance.largest_slope;
  used.joined_frequency = resonance.highest_frequency;
  used.contact_time = resonance.contact_time;
  const double mass = problem.striker.fixed ? beam.mesh().beam_mass() : problem.striker.mass;
  used.contact_mass_share = resonance.effective_mass / mass;
  used.critical_step = 2.0 / used.joined_frequency;
  const ContactLaw& law = beam.contact().law();
  used.contact_law = law.name();
  used.contact_stiffness = law.scales().stiffness;
  used.contact_exponent = law.scales().exponent;
  used.yield_indentation = law.yield_threshold({});
  used.section = section_name(problem, beam);
  used.yield_curvature = problem.beam.yield_curvature();
  used.first_period = first_period(problem);
  check_scales(0.5 * mass * beam.scales().velocity * beam.scales().velocity, beam);
  used.initial_energy = Accounts(beam).energies(beam.initial_state()).total();
  used.table = table_used(options);
  used.events = events_of(options);
  used.reversals = reversals_used(problem, options, beam.sections().can_yield());
  used.max_order = max_order_used(options);
  check_method(options, used, beam.sections().can_yield());
  if (options.solver.method == Method::own) check_own(problem, options, used, beam);
  check_contact_damping(problem, options, used);
  check_modes(problem.beam, options);
  check_beam_damping(problem.beam.damping, options, beam.sections().can_yield());
  used.step = step_used(options, used);
  if (!used.step) {
    const SecondOrderOde::Scales scales = beam.scales();
    used.position_tolerance = options.solver.rtol * scales.position;
    used.velocity_tolerance = options.solver.rtol * scales.velocity;
  }
  used.energy_tolerance = energy_tolerance(options, used);
  check_next_strike(problem);
  used.shape_interval = shape_interval(options, beam.mesh());
  if (used.shape_interval > 0.0) {
    const auto most = static_cast<std::size_t>(options.output.shape_points);
    used.n_shape_points = BeamField::whole_size(beam.mesh(), problem.beam.length, most);
  }
  used.memory = memory_of(options, beam);
  used.decomposition = decomposition_of(options, beam);
  return used;
}

// The rotary inertia of a beam much thicker than long outweighs its mass by more than 16 digits.
BandedSolver make_mass_solver(const Problem& problem, const BeamMesh& mesh) {
  try {
    return BandedSolver(mesh.mass());
  } catch (const std::exception&) {
    refuse("beam.thickness",
           "is {:g} m, with which the mass matrix of a beam of {:g} m is not positive definite; "
           "allowed: beams that are longer than thick; check the units, or use a coarser mesh",
           problem.beam.height(), problem.beam.length);
  }
}

Tension make_tension(const BeamMesh& mesh, const Beam& beam, bool may_yield) {
  BandedMatrix form = mesh.slope_form();
  if (form.size() == 0) {
    refuse("beam.axial",
           "is \"held\", but this mesh gives no slopes along the beam; leave it out, use another "
           "model.mesh, or give the mesh slopes()");
  }
  return {std::move(form), beam, may_yield ? beam.yield_stress * beam.area() : HUGE_VAL};
}

// A typical velocity (m/s) of a striker that its weight alone presses in, to the depth d at which
// the contact has taken up its fall: m g d = W(d).
double velocity_under_weight(const Problem& problem) {
  const double g = problem.striker.fixed ? 0.0 : std::max(problem.gravity, 0.0);
  if (g == 0.0) return 0.0;
  double depth = problem.beam.height();
  for (int i = 0; i < 60; ++i) {
    depth = problem.contact_law->indentation_at(problem.striker.mass * g * depth);
  }
  return std::sqrt(g * depth);
}

}  // namespace

StruckBeam make_struck_beam(const Problem& problem, const Options& options,
                            Coordinates coordinates) {
  std::shared_ptr<const BeamMesh> mesh = problem.mesh;
  SectionField sections = make_sections(problem);
  if (coordinates == Coordinates::chosen && !sections.can_yield() &&
      problem.beam.has_natural_modes() && in_modes(options, *mesh, problem.beam.damping)) {
    mesh = std::make_shared<ModalMesh>(std::move(mesh), sections.stiffness());
  }
  BandedSolver solver = make_mass_solver(problem, *mesh);
  Loads loads(*mesh, problem.beam, problem.gravity);
  std::optional<Tension> tension;
  if (problem.beam.stretches()) tension = make_tension(*mesh, problem.beam, sections.can_yield());
  StruckBeam beam(StruckBeamParts{
      std::move(mesh), std::move(sections), problem.contact_law, problem.striker.inertia(),
      problem.bodies().striker_velocity(), outer_stiffness(problem), std::move(solver),
      problem.contact_damping, problem.beam.damping, std::move(loads),
      std::max(problem.bodies().velocity_scale(), velocity_under_weight(problem)),
      std::move(tension), problem.restitution_velocity,
      problem.beam.may_lift() ? &problem.beam : nullptr});
  set_start(problem, beam);
  beam.settle_on_supports(beam.initial_state());
  return beam;
}

RunParts::RunParts(const Problem& of, const Options& options, StruckBeam struck_beam)
    : problem(of),
      given(options),
      beam(std::move(struck_beam)),
      settings(settings_of(problem, options, beam)) {}

void RunParts::complete() {
  if (modes_are_left_out(given, beam)) beam = make_struck_beam(problem, given);
}

std::unique_ptr<Integrator> RunParts::make_integrator() {
  const bool library = given.study.vector_operations == VectorOperationsKind::library;
  IntegratorOptions options{
      .relative_tolerance = given.solver.rtol,
      .fixed_step = settings.step,
      .max_step = given.solver.max_step,
      .table = settings.table.value_or(""),
      .max_order = settings.max_order.value_or(0),
      .constant_force_on_last = given.study.striker_update == StrikerUpdate::constant_force,
      .vector_operations = library ? VectorOperations::library : VectorOperations::project};
  if (settings.events == EventHandling::library) {
    options.event_functions =
        std::make_shared<ContactEventFunctions>(beam, given.study.pair_detection);
  }
  if (given.solver.method != Method::own) {
    return descriptor_of(given.solver.method).make(beam, options);
  }
  auto own = problem.integrator->make(
      beam, {given.solver.rtol, settings.step, given.solver.max_step, settings.critical_step});
  if (!own) refuse("solver.method", "is \"own\", but OwnIntegrator::make() returned none");
  return own;
}

ResolvedRun::ResolvedRun(std::unique_ptr<RunParts> parts) : parts_(std::move(parts)) {}
ResolvedRun::ResolvedRun(ResolvedRun&&) noexcept = default;
ResolvedRun& ResolvedRun::operator=(ResolvedRun&&) noexcept = default;
ResolvedRun::~ResolvedRun() = default;

const ResolvedSettings& ResolvedRun::settings() const { return parts_->settings; }

ResolvedRun resolve(const Problem& problem, const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  check(problem, options);
  const bool few = problem.mesh->n_unknowns() <= most_modes_before_run;
  StruckBeam beam =
      make_struck_beam(problem, options, few ? Coordinates::chosen : Coordinates::of_mesh);
  ResolvedRun run(std::make_unique<RunParts>(problem, options, std::move(beam)));
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  run.parts().setup_seconds = taken.count();
  return run;
}

}  // namespace subimpact
