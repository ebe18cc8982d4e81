#include "subimpact/study/sweep.h"

#include <fmt/format.h>

#include <cmath>

#include "simulate/methods.h"
#include "study/method_choice.h"
#include "subimpact/case/simulate.h"

namespace subimpact {
namespace {

constexpr int n_halvings = 8;
constexpr int loosest_decade = -2;
constexpr int tightest_decade = -12;

}  // namespace

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
  chosen.solver.step.reset();
  std::vector<Setting> settings;
  if (descriptor_of(chosen.solver.method).steps == MethodDescriptor::Steps::fixed) {
    const double largest = default_part_of_critical * resolve(chosen).settings().critical_step;
    for (int i = 0; i <= n_halvings; ++i) {
      settings.push_back({method, true, std::ldexp(largest, -i)});
    }
  } else {
    for (int decade = loosest_decade; decade >= tightest_decade; --decade) {
      settings.push_back({method, false, std::pow(10.0, decade)});
    }
  }
  return settings;
}

std::vector<std::string> default_methods(const Case& input) {
  std::vector<std::string> methods;
  for (const char* method :
       {"central-difference", "exponential", "nystrom:dprkn8", "nystrom:dprkn12", "erk:dop853",
        "erk:dop853+library", "erk:dormand-prince", "erk:verner", "erk:bogacki-shampine", "adams",
        "adams+library", "bdf", "dirk:esdirk547", "imex:ark437"}) {
    if (can_run(with_method(input, method))) methods.push_back(method);
  }
  return methods;
}

}  // namespace subimpact
