#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "integrate/klu_mass_solver.h"
#include "model/flexural_frequencies.h"
#include "model/modal_mesh.h"
#include "numerics/mass_solver.h"
#include "simulate/methods.h"
#include "simulate/run_parts.h"
#include "system/beam_field.h"
#include "system/contact_event_functions.h"
#include "system/contact_resonance.h"

namespace subimpact {
namespace {

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

// How far the section correction of a step may be off, as part of the striker's velocity. At rtol
// the error is a third of what the integrator may add, root mean square over the steps of the
// paper's beam. A smaller tolerance cuts steps at section events, some thousand in 8 ms, however
// small rtol is: at rtol 1e-8 those cost more than they gain, at 1e-12 a share of 1e-8 adds a tenth
// of the time and takes nine tenths (paper's beam) to 99.9 % (slender beams without rotary inertia)
// off the errors of events.
double correction_tolerance(double rtol) {
  constexpr double cheap_from = 1e-8;
  constexpr double least = 1e-20;
  const double ratio = std::min(1.0, rtol / cheap_from);
  return std::max(least, rtol * ratio * ratio);
}

// With more natural modes than these a run computes them when it begins: 600 take some ms where
// they have a closed form, and 0.5 s where they have none.
constexpr std::size_t most_modes_before_run = 600;

// Measured on 20,001 cells: the program, and per unknown the dirk method, which takes the most.
constexpr double memory_of_program = 12e6;       // bytes
constexpr double memory_per_unknown = 4e3;       // bytes
constexpr double matrices_of_modes = 1.0;        // shapes
constexpr double matrices_of_dense_modes = 6.0;  // and mass, stiffness, decomposition
constexpr double matrices_of_flight = 3.0;       // of free flight beside the modes

// Modes of n = 600 unknowns take 0.5 s by dense decomposition, as 600^3/2 entries of right-hand
// sides do, and some 4 ms in closed form.
constexpr double work_per_dense_mode = 0.5;
constexpr double work_per_closed_entry = 2.0;

std::vector<std::string> tables_of(const MethodDescriptor& method) {
  std::vector<std::string> names;
  if (!method.tables) return names;
  for (const CoefficientTable& table : method.tables()) names.push_back(table.name);
  return names;
}

std::optional<int> max_order_used(const Options& options) {
  const std::optional<int>& asked = options.solver.max_order;
  const MethodDescriptor& method = descriptor_of(options.solver.method);
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

std::vector<std::string> methods_of_sundials() {
  std::vector<std::string> names;
  for (const MethodDescriptor& method : methods()) {
    if (method.sundials) names.emplace_back(method.name);
  }
  return names;
}

std::vector<std::string> methods_that(bool (*holds)(const MethodDescriptor&)) {
  std::vector<std::string> names;
  for (const MethodDescriptor& method : methods()) {
    if (holds(method)) names.emplace_back(method.name);
  }
  return names;
}

bool takes_any_damping(const MethodDescriptor& method) {
  return method.damping == MethodDescriptor::Damping::any;
}
bool takes_damping_of_modes(const MethodDescriptor& method) {
  return method.damping != MethodDescriptor::Damping::none;
}
bool takes_damping_ratio(const MethodDescriptor& method) {
  return takes_damping_of_modes(method) && method.modes != MethodDescriptor::Modes::never;
}

void check_contact_damping(const Problem& problem, const Options& options,
                           const ResolvedSettings& used) {
  const double damping = problem.contact_damping;
  if (damping == 0.0) return;
  const MethodDescriptor& method = descriptor_of(options.solver.method);
  const auto refuse = [&](const std::string& why) {
    throw InvalidCase("contact.damping", fmt::format("is {:g} s/m, but {}", damping, why));
  };
  if (std::isfinite(problem.contact_law->yield_threshold({}))) {
    refuse("the contact law yields; allowed: 0, or a law that never yields");
  }
  if (!takes_any_damping(method)) {
    refuse(
        fmt::format("{} cannot integrate a contact force that depends on velocities; allowed "
                    "solver.method: {}; choose one, or leave the damping out",
                    method.name, fmt::join(methods_that(takes_any_damping), ", ")));
  }
  if (used.events != EventHandling::located) {
    refuse("a damped contact needs located events; leave solver.events out");
  }
}

void check_beam_damping(const BeamDamping& damping, const Options& options, bool can_yield) {
  if (damping.is_none()) return;
  const MethodDescriptor& method = descriptor_of(options.solver.method);
  const auto [key, value] = damping.ratio > 0.0 ? std::pair("beam.damping.ratio", damping.ratio)
                            : damping.mass > 0.0
                                ? std::pair("beam.damping.mass", damping.mass)
                                : std::pair("beam.damping.stiffness", damping.stiffness);
  const auto refuse = [&, key = key, value = value](const std::string& why) {
    throw InvalidCase(key, fmt::format("is {:g}, but {}", value, why));
  };
  if (damping.ratio > 0.0 && can_yield) {
    refuse(
        "a beam that yields has no natural modes; set model.section = \"elastic\", or give "
        "beam.damping.mass and beam.damping.stiffness in its place");
  }
  if (damping.ratio > 0.0 && !takes_damping_ratio(method)) {
    refuse(
        fmt::format("{} does not integrate a damped beam in its natural modes; allowed "
                    "solver.method: {}; choose one, or give beam.damping.mass and "
                    "beam.damping.stiffness in its place",
                    method.name, fmt::join(methods_that(takes_damping_ratio), ", ")));
  }
  if (!takes_damping_of_modes(method)) {
    refuse(
        fmt::format("{} cannot integrate forces that depend on velocities; allowed "
                    "solver.method: {}; choose one, or leave the damping out",
                    method.name, fmt::join(methods_that(takes_damping_of_modes), ", ")));
  }
  if (can_yield && !takes_any_damping(method)) {
    refuse(
        fmt::format("{} damps beams that stay elastic only; set model.section = \"elastic\", "
                    "or choose solver.method {}",
                    method.name, fmt::join(methods_that(takes_any_damping), ", ")));
  }
}

// Section events are found on paths of an undamped beam.
ReversalHandling reversals_used(const Problem& problem, const Options& options, bool can_yield) {
  const bool damped = problem.contact_damping > 0.0 || !problem.beam.damping.is_none();
  if (!damped || !can_yield) return reversals_of(options);
  if (options.solver.reversals == ReversalHandling::located) {
    throw InvalidCase("solver.reversals",
                      "is \"located\", but section events of a damped strike are not located; "
                      "allowed: \"step-end\"; leave it out");
  }
  return ReversalHandling::step_end;
}

// Settings that the method cannot take.
void check_method(const Options& options, const ResolvedSettings& used, bool can_yield) {
  const MethodDescriptor& method = descriptor_of(options.solver.method);
  if (used.events == EventHandling::library && !method.sundials) {
    throw InvalidCase(
        "solver.events",
        fmt::format("is \"library\", the root-finding of SUNDIALS, which {} does not "
                    "have; allowed: {}; or use {}",
                    method.name,
                    method.needs_located_events ? "\"located\"" : "\"located\", \"interpolated\"",
                    fmt::join(methods_of_sundials(), ", ")));
  }
  if (method.needs_located_events && used.events != EventHandling::located) {
    throw InvalidCase("solver.events",
                      fmt::format("is \"interpolated\", but the steps of {} are too long for it; "
                                  "allowed: \"located\"; leave it out, or use another "
                                  "solver.method",
                                  method.name));
  }
  if (method.steps == MethodDescriptor::Steps::adaptive_order && options.solver.step) {
    throw InvalidCase(
        "solver.step",
        fmt::format("is {} s, but {} chooses step and order together and has no fixed step; leave "
                    "it out (solver.max_step bounds the step), or use another method",
                    *options.solver.step, method.name));
  }
  if (!method.needs_adaptive_steps_to_yield || !can_yield) return;
  const auto refuse = [&](const char* key, const char* what) {
    throw InvalidCase(key, fmt::format("is {}, which {} cannot do where the beam may yield; leave "
                                       "it out, set model.section = \"elastic\", or use nystrom",
                                       what, method.name));
  };
  if (options.solver.step) refuse("solver.step", "given: a fixed step");
  if (used.reversals != ReversalHandling::located) refuse("solver.reversals", "\"step-end\"");
}

// The given table, or the first one of the method; nothing for a method without tables.
std::optional<std::string> table_used(const Options& options) {
  const std::vector<std::string> names = tables_of(descriptor_of(options.solver.method));
  const std::optional<std::string>& asked = options.solver.table;
  if (!asked) return names.empty() ? std::nullopt : std::optional(names.front());
  if (std::find(names.begin(), names.end(), *asked) == names.end()) {
    throw InvalidCase(
        "solver.table",
        fmt::format("is \"{}\", which {} does not have; {}", *asked,
                    descriptor_of(options.solver.method).name,
                    names.empty() ? "leave it out: the method has no tables"
                                  : fmt::format("allowed: {}", fmt::join(names, ", "))));
  }
  return asked;
}

double default_central_step(const ResolvedSettings& used) {
  // The scheme's energy is off by some (h/T)^2 of what the contact's own motion holds, m_eff/m of
  // the whole.
  const double steps = std::max(default_steps_in_contact,
                                default_steps_to_keep_energy * std::sqrt(used.contact_mass_share));
  return std::min(default_part_of_critical * used.critical_step, used.contact_time / steps);
}

// Numbers that are possible one by one may overflow or vanish together.
void check_scales(const Striker& striker, const StruckBeam& beam) {
  const double energy = 0.5 * striker.mass * striker.velocity * striker.velocity;
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
          striker.velocity, energy, scales.position));
}

void check_central_step(const Options& options, const ResolvedSettings& used) {
  const double step = *used.step;
  if (step > used.critical_step && !options.study.beyond_critical) {
    throw InvalidCase(
        "solver.step",
        fmt::format("is {:.6g} us, above the stability limit of central differences for this beam "
                    "with the contact at its stiffest, {:.6g} us (2/omega); use a smaller step, "
                    "leave it out for {:.6g} us, or set study.beyond_critical = true to see it "
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

double energy_tolerance(const Options& options, const ResolvedSettings& used) {
  if (options.accuracy.energy) return *options.accuracy.energy;
  if (used.step || used.events == EventHandling::interpolated) return most_tolerated_energy;
  return std::clamp(tolerated_energy_per_rtol * options.solver.rtol, least_tolerated_energy,
                    most_tolerated_energy);
}

// Whether an elastic beam on this mesh is integrated in its natural modes, which a damping ratio
// needs. Explicit methods see the
// same motion in either unknowns, but a step in modes needs no mass solve.
bool in_modes(const Options& options, const BeamMesh& mesh, const BeamDamping& damping) {
  const MethodDescriptor::Modes modes = descriptor_of(options.solver.method).modes;
  if (modes != MethodDescriptor::Modes::where_cheaper) {
    return modes == MethodDescriptor::Modes::always;
  }
  return damping.ratio > 0.0 ||
         (mesh.prefers_modes() && options.study.mass_solver == MassSolverKind::banded);
}

// Whether resolve() has left a beam in the unknowns of its mesh that is to run in modes.
bool modes_are_left_out(const Options& options, const StruckBeam& beam) {
  return beam.mesh().modal_stiffness().empty() && !beam.sections().can_yield() &&
         in_modes(options, beam.mesh(), beam.damping());
}

bool has_modes(const Options& options, const StruckBeam& beam) {
  return in_modes(options, beam.mesh(), beam.damping()) ||
         options.stop == StopRule::no_more_contact;
}

double decomposition_of(const Options& options, const StruckBeam& beam) {
  if (!has_modes(options, beam)) return 0.0;
  const BeamMesh& mesh = beam.mesh();
  const auto n = static_cast<double>(mesh.n_unknowns());
  return mesh.has_closed_modes() ? work_per_closed_entry * n * n : work_per_dense_mode * n * n * n;
}

double memory_of(const Options& options, const StruckBeam& beam) {
  const BeamMesh& mesh = beam.mesh();
  const auto n = static_cast<double>(mesh.n_unknowns());
  const bool yields = beam.sections().can_yield();
  const bool flies = yields && in_modes(options, mesh, beam.damping());
  const double of_modes = mesh.has_closed_modes() ? matrices_of_modes : matrices_of_dense_modes;
  const double matrices =
      (has_modes(options, beam) ? of_modes : 0.0) + (flies ? matrices_of_flight : 0.0);
  return memory_of_program + memory_per_unknown * n + sizeof(double) * matrices * n * n;
}

SectionField make_sections(const Problem& problem, SectionField::Storage storage) {
  const Beam& beam = problem.beam;
  const auto& section = problem.section;
  const std::size_t n = problem.mesh->n_sections();
  if (problem.may_yield && std::isfinite(beam.yield_stress)) {
    return SectionField(n, SectionLaw(beam, section.value_or(Fibres::continuous())), storage);
  }
  return SectionField(n, (section ? section->slope() : 1.0) * beam.bending_stiffness());
}

// E h/2 of the fibre farthest from the axis.
double outer_stiffness(const Problem& problem) {
  const double of_rectangle = 0.5 * problem.beam.youngs_modulus * problem.beam.thickness;
  return problem.section ? problem.section->outer_modulus() * of_rectangle : of_rectangle;
}

std::string section_name(const Problem& problem, const StruckBeam& beam) {
  if (beam.mesh().highest_frequency(beam.sections().stiffness()) == 0.0) return "rigid";
  std::string name = problem.section ? problem.section->name() : Fibres::continuous().name();
  if (beam.sections().can_yield()) return name;
  return problem.section ? name + ", elastic" : "elastic";
}

// Of the beam in bending, with its own section; layers stand for the rectangle.
double first_period(const Problem& problem) {
  const double of_rectangle = 2.0 * M_PI / flexural_frequencies(problem.beam, 1).front();
  return problem.section ? of_rectangle / std::sqrt(problem.section->represented_slope())
                         : of_rectangle;
}

void check(const Problem& problem, const Options& options) {
  const auto positive = [](double x) { return x > 0.0 && std::isfinite(x); };
  const auto refuse = [](const char* key, const char* why) { throw InvalidCase(key, why); };
  const Beam& beam = problem.beam;
  const double sizes[] = {beam.length, beam.mass(), beam.bending_stiffness(),
                          beam.bending_stiffness() / std::pow(beam.length, 4)};
  if (!std::ranges::all_of(sizes, positive)) {
    refuse("beam", "has no mass or stiffness that is positive and finite; check its numbers");
  }
  if (!problem.mesh) refuse("model.mesh", "is missing; give Problem::mesh a mesh");
  if (!problem.contact_law) refuse("contact.law", "is missing; give Problem::contact_law a law");
  if (!positive(options.end_time)) refuse("time.end", "is not a time; allowed: above 0 s");
  if (const double touch = problem.striker.first_touch(); !(touch < options.end_time)) {
    throw InvalidCase("striker.gap",
                      fmt::format("is {:g} m, which takes the striker {:.6g} s at {:g} m/s, but "
                                  "time.end is {:g} s; allowed: below {:g} m; reduce it, or set a "
                                  "later time.end",
                                  problem.striker.gap, touch, problem.striker.velocity,
                                  options.end_time, options.end_time * problem.striker.velocity));
  }
  if (!positive(options.solver.rtol)) refuse("solver.rtol", "is not positive; allowed: above 0");
}

// A mesh of a user's own may give no displacements along the beam.
double shape_interval(const Options& options, const BeamMesh& mesh) {
  const std::optional<double>& asked = options.output.shapes;
  if (BeamField::is_available(mesh)) return options.output.shape_interval(options.end_time);
  const auto refuse = [](const char* key) {
    throw InvalidCase(key,
                      "is given, but this mesh gives no displacements along the beam; leave it "
                      "out, or give the mesh displacement_at() and rotation_at()");
  };
  if (asked && *asked > 0.0) refuse("output.shapes");
  if (!options.output.points.empty()) refuse("output.points");
  return 0.0;
}

std::size_t most_shape_points(const Options& options) {
  return static_cast<std::size_t>(options.output.shape_points);
}

ResolvedSettings settings_of(const Problem& problem, const Options& options,
                             const StruckBeam& beam) {
  ResolvedSettings used;
  used.half_model = beam.mesh().symmetric();
  used.n_unknowns = beam.mesh().n_unknowns();
  used.n_sections = beam.mesh().n_sections();
  used.mesh = beam.mesh().description();
  if (modes_are_left_out(options, beam)) used.mesh += modal_description;
  used.highest_frequency = beam.mesh().highest_frequency(beam.sections().stiffness());
  const ContactResonance resonance = contact_resonance(beam, problem.beam.thickness);
  used.largest_contact_slope = resonance.largest_slope;
  used.joined_frequency = resonance.highest_frequency;
  used.contact_time = resonance.contact_time;
  used.contact_mass_share = resonance.effective_mass / problem.striker.mass;
  used.critical_step = 2.0 / used.joined_frequency;
  const ContactLaw& law = beam.contact().law();
  used.contact_law = law.name();
  used.contact_stiffness = law.scales().stiffness;
  used.contact_exponent = law.scales().exponent;
  used.yield_indentation = law.yield_threshold({});
  used.section = section_name(problem, beam);
  used.yield_curvature = problem.beam.yield_curvature();
  used.first_period = first_period(problem);
  used.initial_energy =
      0.5 * problem.striker.mass * problem.striker.velocity * problem.striker.velocity;
  check_scales(problem.striker, beam);
  used.table = table_used(options);
  used.events = events_of(options);
  used.reversals = reversals_used(problem, options, beam.sections().can_yield());
  used.max_order = max_order_used(options);
  check_method(options, used, beam.sections().can_yield());
  check_contact_damping(problem, options, used);
  check_beam_damping(problem.beam.damping, options, beam.sections().can_yield());
  if (descriptor_of(options.solver.method).steps == MethodDescriptor::Steps::fixed) {
    used.step = options.solver.step.value_or(default_central_step(used));
    check_central_step(options, used);
  } else {
    used.step = options.solver.step;
    if (!used.step) {
      const SecondOrderOde::Scales scales = beam.scales();
      used.position_tolerance = options.solver.rtol * scales.position;
      used.velocity_tolerance = options.solver.rtol * scales.velocity;
    }
  }
  used.energy_tolerance = energy_tolerance(options, used);
  used.shape_interval = shape_interval(options, beam.mesh());
  if (used.shape_interval > 0.0) {
    used.n_shape_points =
        BeamField(beam, problem.beam.length, most_shape_points(options)).whole_size();
  }
  used.memory = memory_of(options, beam);
  used.decomposition = decomposition_of(options, beam);
  return used;
}

// The sections nearest to the given positions; in a half model their mirror images stand for those
// of the other half.
std::vector<std::size_t> sections_at(const std::vector<double>& fractions, double length,
                                     const BeamMesh& mesh) {
  std::vector<std::size_t> sections;
  const auto& positions = mesh.section_positions();
  for (const double fraction : fractions) {
    const double x = length * (mesh.symmetric() ? std::min(fraction, 1.0 - fraction) : fraction);
    const auto nearest =
        std::min_element(positions.begin(), positions.end(),
                         [x](double a, double b) { return std::abs(a - x) < std::abs(b - x); });
    sections.push_back(static_cast<std::size_t>(nearest - positions.begin()));
  }
  return sections;
}

FieldOptions field_options(const Problem& problem, const Options& options,
                           const ResolvedSettings& used) {
  FieldOptions fields;
  fields.shape_interval = used.shape_interval;
  fields.most_points = most_shape_points(options);
  fields.end_time = options.end_time;
  fields.length = problem.beam.length;
  fields.thickness = problem.beam.thickness;
  fields.struck_at = problem.striker.position * problem.beam.length;
  if (problem.beam.shears()) {
    fields.shear_flexibility = problem.beam.bending_stiffness() / problem.beam.shear_stiffness();
  }
  fields.yield_curvature = problem.beam.yield_curvature();
  fields.reactions = options.output.interval > 0.0;
  for (const double fraction : options.output.points) {
    fields.points.push_back(fraction * problem.beam.length);
  }
  return fields;
}

RunOptions run_options(const Problem& problem, const Options& options, const ResolvedSettings& used,
                       const BeamMesh& mesh) {
  RunOptions run;
  run.loop.end_time = options.end_time;
  run.loop.first_touch = problem.striker.first_touch();
  run.loop.events = used.events;
  run.loop.double_roots = options.study.pair_detection;
  if (used.reversals == ReversalHandling::located) {
    run.loop.correction_tolerance =
        correction_tolerance(options.solver.rtol) * problem.striker.velocity;
  }
  run.loop.largest_indentation = problem.beam.thickness;
  run.loop.audit_interval = descriptor_of(options.solver.method).audit_interval;
  run.loop.shortest_contact = M_PI / used.joined_frequency;
  run.limits = {used.energy_tolerance, tolerated_momentum};
  run.history_interval = options.output.interval;
  run.sections = sections_at(options.output.sections, problem.beam.length, mesh);
  run.fields = field_options(problem, options, used);
  run.zone_gap = options.output.zone_gap * used.first_period;
  run.subzone_gap = options.output.subzone_gap * used.first_period;
  run.fixed_step = used.step;
  if (options.stop == StopRule::no_more_contact) run.stops_without_contact = problem.beam;
  return run;
}

// The rotary inertia of a beam that is much thicker than long outweighs its mass by more than
// numbers of 16 digits can hold.
std::unique_ptr<MassSolver> make_mass_solver(const Problem& problem, const Options& options,
                                             const BeamMesh& mesh) {
  try {
    if (options.study.mass_solver == MassSolverKind::klu) return make_klu_mass_solver(mesh.mass());
    return std::make_unique<BandedSolver>(mesh.mass());
  } catch (const std::exception&) {
    throw InvalidCase(
        "beam.thickness",
        fmt::format("is {:g} m, with which the mass matrix of a beam of {:g} m is not positive "
                    "definite; allowed: beams that are longer than thick; check the units, or use "
                    "a coarser mesh",
                    problem.beam.thickness, problem.beam.length));
  }
}

}  // namespace

StruckBeam make_struck_beam(const Problem& problem, const Options& options,
                            SectionField::Storage storage, Coordinates coordinates) {
  std::shared_ptr<const BeamMesh> mesh = problem.mesh;
  SectionField sections = make_sections(problem, storage);
  if (coordinates == Coordinates::chosen && !sections.can_yield() &&
      in_modes(options, *mesh, problem.beam.damping)) {
    mesh = std::make_shared<ModalMesh>(std::move(mesh), sections.stiffness());
  }
  std::unique_ptr<MassSolver> solver = make_mass_solver(problem, options, *mesh);
  return StruckBeam(StruckBeamParts{std::move(mesh), std::move(sections), problem.contact_law,
                                    problem.striker.mass, problem.striker.velocity,
                                    outer_stiffness(problem), std::move(solver),
                                    problem.contact_damping, problem.beam.damping});
}

RunParts::RunParts(const Problem& of, const Options& options, StruckBeam struck_beam)
    : problem(of),
      given(options),
      check_contact_law(problem.check_contact_law),
      beam(std::move(struck_beam)),
      settings(settings_of(problem, options, beam)),
      run(run_options(problem, options, settings, beam.mesh())) {}

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
  return descriptor_of(given.solver.method).make(beam, options);
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
  StruckBeam beam = make_struck_beam(problem, options, SectionField::Storage::when_yielded,
                                     few ? Coordinates::chosen : Coordinates::of_mesh);
  ResolvedRun run(std::make_unique<RunParts>(problem, options, std::move(beam)));
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  run.parts().setup_seconds = taken.count();
  return run;
}

}  // namespace subimpact
