#include "study/method_choice.h"

#include "simulate/methods.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/case/simulate.h"

namespace subimpact {

Case with_method(const Case& input, const std::string& name) {
  Case chosen = input;
  chosen.output.keep_no_rows();
  chosen.solver.table.reset();
  chosen.solver.max_order.reset();
  const std::size_t colon = name.find(':');
  assign(chosen, *find_case_key("solver.method"), name.substr(0, colon));
  if (colon != std::string::npos) {
    assign(chosen, *find_case_key("solver.table"), name.substr(colon + 1));
  } else if (chosen.solver.method == input.solver.method) {
    chosen.solver.table = input.solver.table;
    chosen.solver.max_order = input.solver.max_order;
  }
  const bool fixed = descriptor_of(chosen.solver.method).steps == MethodDescriptor::Steps::fixed;
  if (!fixed && chosen.solver.method != input.solver.method) chosen.solver.step.reset();
  return chosen;
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
