#include "study/method_choice.h"

#include "case/problem.h"
#include "simulate/methods.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/case/simulate.h"
#include "subimpact/study/sweep.h"

namespace subimpact {

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
  chosen.solver.max_order.reset();
  assign(chosen, *find_case_key("solver.method"), parts.method);
  if (parts.table) {
    assign(chosen, *find_case_key("solver.table"), *parts.table);
  } else if (chosen.solver.method == input.solver.method) {
    chosen.solver.table = input.solver.table;
    chosen.solver.max_order = input.solver.max_order;
  }
  if (parts.events) {
    assign(chosen, *find_case_key("solver.events"), *parts.events);
  } else if (events_of(chosen) == EventHandling::library &&
             !descriptor_of(chosen.solver.method).sundials) {
    chosen.solver.events.reset();
  }
  const bool fixed = descriptor_of(chosen.solver.method).steps == MethodDescriptor::Steps::fixed;
  if (!fixed && chosen.solver.method != input.solver.method) chosen.solver.step.reset();
  return chosen;
}

Method method_for_damping(const Case& input, Method method) {
  using Damping = MethodDescriptor::Damping;
  const bool contact = input.scene.contact.damping > 0.0;
  const bool beam = !input.scene.beam.damping.is_none();
  const Damping taken = descriptor_of(method).damping;
  const bool of_modes = taken == Damping::of_modes && !contact && !may_yield(input);
  return (!contact && !beam) || taken == Damping::any || of_modes ? method : Method::erk;
}

bool can_run(const Case& input) {
  try {
    resolve(input);
    return true;
  } catch (const InvalidCase&) {
    return false;
  }
}

}  // namespace subimpact
