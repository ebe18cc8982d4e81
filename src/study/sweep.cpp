#include "subimpact/study/judgement/event_errors.h"

#include <fmt/format.h>

#include <cmath>

#include "case/problem.h"
#include "simulate/settings/methods.h"
#include "study/method_choice.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/case/simulate.h"

namespace subimpact {
namespace {

// Fixed steps over that of central differences, as powers of 2.
constexpr int longest_step = 5;  // where accuracy alone limits it
constexpr int longest_explicit_step = 2;
constexpr int shortest_step = -8;
constexpr int loosest_decade = -2;
constexpr int tightest_decade = -12;

// Whether the method chooses its steps by a tolerance where no step is given.
bool takes_tolerance(const Case& input) {
  const OwnIntegrator* own = input.parts.integrator.get();
  return !descriptor_of(input.solver.method).has_fixed_steps() &&
         !(input.solver.method == Method::own && own != nullptr && !own->is_adaptive);
}

}  // namespace

MethodName parse_method_name(const std::string& name) {
  MethodName parts;
  const std::size_t plus = name.find('+');
  if (plus != std::string::npos) parts.events = name.substr(plus + 1);
  const std::string without_events = name.substr(0, plus);
  const std::size_t colon = without_events.find(':');
  if (colon != std::string::npos) parts.table = without_events.substr(colon + 1);
  parts.method = without_events.substr(0, colon);
  return parts;
}

Case with_method(const Case& input, const std::string& name) {
  const MethodName parts = parse_method_name(name);
  Case chosen = input;
  chosen.output.keep_no_rows();
  chosen.solver.table.reset();
  assign(chosen, *find_case_key("solver.method"), parts.method);
  if (parts.table) {
    assign(chosen, *find_case_key("solver.table"), *parts.table);
  } else if (chosen.solver.method == input.solver.method) {
    chosen.solver.table = input.solver.table;
  }
  if (!descriptor_of(chosen.solver.method).order) chosen.solver.max_order.reset();
  if (parts.events) {
    assign(chosen, *find_case_key("solver.events"), *parts.events);
  } else if (events_of(chosen) == EventHandling::library &&
             !descriptor_of(chosen.solver.method).sundials) {
    chosen.solver.events.reset();
  }
  return chosen;
}

Method possible_method(const Case& input, Method method) {
  const bool needs_modes = descriptor_of(method).modes == MethodDescriptor::Modes::always;
  if (!input.scene.beam.has_natural_modes() && needs_modes) method = Method::nystrom;
  using Damping = MethodDescriptor::Damping;
  const bool contact = !(input.scene.contact_damping() == 0.0) ||  // NaN before a flight
                       input.scene.beam.has_damped_supports();
  const bool beam = !input.scene.beam.damping.is_none();
  const Damping taken = descriptor_of(method).damping;
  const bool of_modes = taken == Damping::of_modes && !contact && !may_yield(input);
  return (!contact && !beam) || taken == Damping::any || of_modes ? method : Method::erk;
}

bool central_differences_suit(Case input) {
  constexpr double least_phase = 1.0 / 32.0;  // of the mesh's highest frequency in a step
  input.solver = {};
  input.solver.method = Method::central_difference;
  try {
    const ResolvedSettings used = resolve(input).settings();
    return *used.step * used.highest_frequency >= least_phase;
  } catch (const InvalidCase&) {
    return true;
  }
}

bool can_run(const Case& input) {
  try {
    resolve(input);
    return true;
  } catch (const InvalidCase&) {
    return false;
  }
}

int order_of(const Case& input, const ResolvedSettings& used) {
  if (input.solver.method == Method::own) return input.parts.integrator->order;
  for (const MethodTable& table : method_tables()) {
    if (table.method == input.solver.method && table.name == used.table) return table.order;
  }
  return descriptor_of(input.solver.method).has_fixed_steps() ? 2 : 0;  // central differences
}

std::string Setting::text() const {
  return fixed_step ? fmt::format("step {:.4g} us", 1e6 * value)
                    : fmt::format("rtol {:.0e}", value);
}

Case with_setting(const Case& input, const Setting& setting) {
  Case chosen = with_method(input, setting.method);
  if (setting.fixed_step) {
    chosen.solver.step = setting.value;
  } else {
    chosen.solver.step.reset();
    chosen.solver.rtol = setting.value;
  }
  return chosen;
}

std::vector<Setting> settings_of(const Case& input, const std::string& method) {
  Case chosen = with_method(input, method);
  const MethodDescriptor& descriptor = descriptor_of(chosen.solver.method);
  const bool has_tolerance = takes_tolerance(chosen);
  chosen.solver.step.reset();
  if (!has_tolerance && !descriptor.has_fixed_steps()) chosen.solver.step = input.end_time;
  const double critical = resolve(chosen).settings().critical_step;
  const auto step = [&](int power) {
    return Setting{method, true, std::ldexp(default_part_of_critical * critical, power)};
  };
  std::vector<Setting> settings;
  for (int decade = loosest_decade; has_tolerance && decade >= tightest_decade; --decade) {
    settings.push_back({method, false, std::pow(10.0, decade)});
  }
  const bool is_stable = descriptor.implicit || descriptor.modes == MethodDescriptor::Modes::always;
  int power = descriptor.has_fixed_steps() ? 0 : is_stable ? longest_step : longest_explicit_step;
  if (!can_run(with_setting(input, step(power)))) return settings;
  for (; power >= shortest_step; --power) settings.push_back(step(power));
  return settings;
}

std::vector<std::string> default_methods(const Case& input) {
  std::vector<std::string> methods;
  Case free = input;
  free.solver.step.reset();
  if (input.parts.integrator) methods.push_back("own");
  for (const char* method :
       {"central-difference", "exponential", "nystrom:dprkn8", "nystrom:dprkn12", "erk:dop853",
        "erk:dop853+library", "erk:dormand-prince", "erk:verner", "erk:bogacki-shampine", "adams",
        "adams+library", "bdf", "dirk:esdirk547"}) {
    if (can_run(with_method(free, method))) methods.push_back(method);
  }
  return methods;
}

}  // namespace subimpact
