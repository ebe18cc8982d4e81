#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "numerics/units.h"
#include "simulate/run_parts.h"
#include "simulate/settings/methods.h"
#include "simulate/settings/refuse.h"

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

// Measured on 20,001 cells: the program, and per unknown the dirk method, which takes the most.
constexpr double memory_of_program = 12e6;       // bytes
constexpr double memory_per_unknown = 4e3;       // bytes
constexpr double matrices_of_modes = 1.0;        // shapes
constexpr double matrices_of_dense_modes = 6.0;  // and mass, stiffness, decomposition
constexpr double matrices_of_flight = 3.0;       // of free flight beside the modes

// Modes of n = 600 unknowns take 0.5 s by dense decomposition, as 600^3/2 entries of right-hand
// sides do.
constexpr double work_per_dense_mode = 0.5;

// Names in a list.
std::string methods_that(bool (*holds)(const MethodDescriptor&)) {
  std::vector<std::string> names;
  for (const MethodDescriptor& method : methods()) {
    if (holds(method) && method.kind != Method::own) names.emplace_back(method.name);
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

bool always_in_modes(const MethodDescriptor& method) {
  return method.modes == MethodDescriptor::Modes::always;
}
bool is_of_sundials(const MethodDescriptor& method) { return method.sundials; }
bool runs_in_modes(const Options& options, const StruckBeam& beam) {
  return beam.tension() == nullptr && beam.supports().empty() &&
         in_modes(options, beam.mesh(), beam.damping());
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

double default_central_step(const ResolvedSettings& used) {
  // The scheme's energy is off by some (h/T)^2 of what the contact's own motion holds, m_eff/m.
  const double steps = std::max(default_steps_in_contact,
                                default_steps_to_keep_energy * std::sqrt(used.contact_mass_share));
  return std::min(default_part_of_critical * used.critical_step, used.contact_time / steps);
}

void check_central_step(const Options& options, const ResolvedSettings& used, double step) {
  if (step > used.critical_step && !options.study.beyond_critical) {
    refuse("solver.step",
           "is {:.6g} us, above the stability limit of central differences for this beam with the "
           "contact at its stiffest, {:.6g} us (2/omega); use a smaller step, leave it out for "
           "{:.6g} us, or set study.beyond_critical = true to see it fail",
           us * step, us * used.critical_step, us * default_central_step(used));
  }
  if (used.events == EventHandling::located && used.highest_frequency > 0.0 &&
      step > largest_part_if_located * used.critical_step) {
    refuse(
        "solver.events",
        "is \"located\" with central differences of {:.6g} us, which gain energy without bound "
        "where steps end at events; allowed: \"interpolated\" (the default), or a solver.step up "
        "to {:.6g} us; leave it out",
        us * step, us * largest_part_if_located * used.critical_step);
  }
}

}  // namespace

std::optional<int> max_order_used(const Options& options) {
  const std::optional<int>& asked = options.solver.max_order;
  const MethodDescriptor& method = descriptor_of(options.solver.method);
  if (!method.order) {
    if (!asked) return std::nullopt;
    refuse("solver.max_order",
           "is {}, but {} has no order to choose; leave it out, or use adams or bdf", *asked,
           method.name);
  }
  const int order = asked.value_or(method.order->usual);
  if (order < 1 || order > method.order->limit) {
    refuse("solver.max_order", "is {}; allowed for {}: from 1 to {}", order, method.name,
           method.order->limit);
  }
  return order;
}

void check_contact_damping(const Problem& problem, const Options& options,
                           const ResolvedSettings& used) {
  double damping = problem.contact_damping;
  const char* key = "contact.damping";
  for (const Spring& spring : problem.beam.springs) {
    if (damping > 0.0 || !spring.one_sided) continue;
    damping = spring.one_sided->damping;
    key = "beam.springs";
  }
  if (damping == 0.0) return;
  const MethodDescriptor& method = descriptor_of(options.solver.method);
  if (problem.contact_damping > 0.0 && std::isfinite(problem.contact_law->yield_threshold({}))) {
    refuse(key, "is {:g} s/m, but the contact law yields; allowed: 0, or a law that never yields",
           damping);
  }
  if (!takes_any_damping(method)) {
    refuse(key,
           "has a damping of {:g} s/m, but {} cannot integrate a contact force that depends on "
           "velocities; "
           "allowed solver.method: {}; choose one, or leave the damping out",
           damping, method.name, methods_that(takes_any_damping));
  }
  if (used.events != EventHandling::located) {
    refuse(key, "is {:g} s/m, but a damped contact needs located events; leave solver.events out",
           damping);
  }
}

void check_beam_damping(const BeamDamping& damping, const Options& options, bool can_yield) {
  if (damping.is_none()) return;
  const MethodDescriptor& method = descriptor_of(options.solver.method);
  const auto [key, value] = damping.ratio > 0.0 ? std::pair("beam.damping.ratio", damping.ratio)
                            : damping.mass > 0.0
                                ? std::pair("beam.damping.mass", damping.mass)
                                : std::pair("beam.damping.stiffness", damping.stiffness);
  if (damping.ratio > 0.0 && can_yield) {
    refuse(key,
           "is {:g}, but a beam that yields has no natural modes; set model.section = \"elastic\", "
           "or give beam.damping.mass and beam.damping.stiffness in its place",
           value);
  }
  if (damping.ratio > 0.0 && !takes_damping_ratio(method)) {
    refuse(key,
           "is {:g}, but {} does not integrate a damped beam in its natural modes; allowed "
           "solver.method: {}; choose one{}",
           value, method.name, methods_that(takes_damping_ratio),
           takes_damping_of_modes(method)
               ? ", or give beam.damping.mass and beam.damping.stiffness in its place"
               : "");
  }
  if (!takes_damping_of_modes(method)) {
    refuse(key,
           "is {:g}, but {} cannot integrate forces that depend on velocities; allowed "
           "solver.method: {}; choose one, or leave the damping out",
           value, method.name, methods_that(takes_damping_of_modes));
  }
  if (can_yield && !takes_any_damping(method)) {
    refuse(
        key,
        "is {:g}, but {} damps beams that stay elastic only; set model.section = \"elastic\", or "
        "choose solver.method {}",
        value, method.name, methods_that(takes_any_damping));
  }
}

ReversalHandling reversals_used(const Problem& problem, const Options& options, bool can_yield) {
  const bool damped = problem.contact_damping > 0.0 || !problem.beam.damping.is_none() ||
                      problem.beam.has_damped_supports();
  if (!damped || !can_yield) return reversals_of(options);
  if (options.solver.reversals == ReversalHandling::located) {
    refuse("solver.reversals",
           "is \"located\", but section events of a damped strike are not located; allowed: "
           "\"step-end\"; leave it out");
  }
  return ReversalHandling::step_end;
}

void check_method(const Options& options, const ResolvedSettings& used, bool can_yield) {
  const MethodDescriptor& method = descriptor_of(options.solver.method);
  if (used.events == EventHandling::library && !method.sundials) {
    refuse("solver.events",
           "is \"library\", the root-finding of SUNDIALS, which {} does not have; allowed: {}; or "
           "use {}",
           method.name,
           method.needs_located_events ? "\"located\"" : "\"located\", \"interpolated\"",
           methods_that(is_of_sundials));
  }
  if (method.needs_located_events && used.events != EventHandling::located) {
    refuse("solver.events",
           "is \"interpolated\", but the steps of {} are too long for it; allowed: \"located\"; "
           "leave it out, or use another solver.method",
           method.name);
  }
  if (method.steps == MethodDescriptor::Steps::adaptive_order && options.solver.step) {
    refuse("solver.step",
           "is {} s, but {} chooses step and order together and has no fixed step; leave it out "
           "(solver.max_step bounds the step), or use another method",
           *options.solver.step, method.name);
  }
  if (!method.needs_adaptive_steps_to_yield || !can_yield) return;
  const auto refuse_to_yield = [&](const char* key, const char* what) {
    refuse(key,
           "is {}, which {} cannot do where the beam may yield; leave it out, set model.section = "
           "\"elastic\", or use nystrom",
           what, method.name);
  };
  if (options.solver.step) refuse_to_yield("solver.step", "given: a fixed step");
  if (used.reversals != ReversalHandling::located) {
    refuse_to_yield("solver.reversals", "\"step-end\"");
  }
}

std::optional<std::string> table_used(const Options& options) {
  const MethodDescriptor& method = descriptor_of(options.solver.method);
  std::vector<std::string> names;
  for (const MethodTable& table : method_tables()) {
    if (table.method == method.kind) names.push_back(table.name);
  }
  const std::optional<std::string>& asked = options.solver.table;
  if (!asked) return names.empty() ? std::nullopt : std::optional(names.front());
  if (std::ranges::find(names, *asked) == names.end()) {
    refuse("solver.table", "is \"{}\", which {} does not have; {}", *asked, method.name,
           names.empty() ? "leave it out: the method has no tables"
                         : fmt::format("allowed: {}", fmt::join(names, ", ")));
  }
  return asked;
}

std::optional<double> step_used(const Options& options, const ResolvedSettings& used) {
  if (!descriptor_of(options.solver.method).has_fixed_steps()) {
    return options.solver.step;
  }
  const double step = options.solver.step.value_or(default_central_step(used));
  check_central_step(options, used, step);
  return step;
}

void check_modes(const Beam& beam, const Options& options) {
  if (beam.has_natural_modes()) return;
  const char* const because =
      beam.stretches()
          ? "beam.axial = \"held\" gives the beam a tension that grows with its deflection, and so "
            "no natural modes"
          : "a beam that can lift off its supports (one_sided of beam.springs, \"rests\" of "
            "beam.ends) has no natural modes";
  const MethodDescriptor& method = descriptor_of(options.solver.method);
  if (always_in_modes(method)) {
    refuse("solver.method", "is \"{}\", but {}; allowed solver.method: {}", method.name, because,
           methods_that([](const MethodDescriptor& m) { return !always_in_modes(m); }));
  }
  if (beam.damping.ratio > 0.0) {
    refuse("beam.damping.ratio",
           "is {:g}, but {}; give beam.damping.mass and beam.damping.stiffness in its place",
           beam.damping.ratio, because);
  }
}

bool in_modes(const Options& options, const BeamMesh& mesh, const BeamDamping& damping) {
  const MethodDescriptor::Modes modes = descriptor_of(options.solver.method).modes;
  if (modes != MethodDescriptor::Modes::where_cheaper) {
    return modes == MethodDescriptor::Modes::always;
  }
  return damping.ratio > 0.0 || mesh.prefers_modes();
}

bool modes_are_left_out(const Options& options, const StruckBeam& beam) {
  return beam.mesh().modal_stiffness().empty() && !beam.sections().can_yield() &&
         runs_in_modes(options, beam);
}

double decomposition_of(const Options& options, const StruckBeam& beam) {
  if (!runs_in_modes(options, beam)) return 0.0;
  const BeamMesh& mesh = beam.mesh();
  const auto n = static_cast<double>(mesh.n_unknowns());
  return mesh.has_closed_modes() ? mesh.closed_modes_work() : work_per_dense_mode * n * n * n;
}

double memory_of(const Options& options, const StruckBeam& beam) {
  const BeamMesh& mesh = beam.mesh();
  const auto n = static_cast<double>(mesh.n_unknowns());
  const bool yields = beam.sections().can_yield();
  const bool flies = yields && runs_in_modes(options, beam);
  const double of_modes = mesh.has_closed_modes() ? matrices_of_modes : matrices_of_dense_modes;
  const double matrices =
      (runs_in_modes(options, beam) ? of_modes : 0.0) + (flies ? matrices_of_flight : 0.0);
  return memory_of_program + memory_per_unknown * n + sizeof(double) * matrices * n * n;
}

}  // namespace subimpact
