#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "integrate/central_difference.h"
#include "integrate/nystrom.h"
#include "integrate/sundials.h"

namespace subimpact {

/// A method as the tests see it: what it claims, and how to make it.
struct ExplicitMethod {
  std::string name;
  int order;
  double order_band;  ///< observed orders this far off are still its own
  int evaluations;    ///< an accepted step's
  using Make = std::function<std::unique_ptr<Integrator>(SecondOrderOde&, double)>;
  Make with_step;
  Make with_tolerance;  ///< empty: fixed steps only
};

inline std::ostream& operator<<(std::ostream& out, const ExplicitMethod& method) {
  return out << method.name;
}

inline std::vector<ExplicitMethod> adaptive_methods() {
  std::vector<ExplicitMethod> methods;
  for (const CoefficientTable& table : explicit_tables()) {
    const auto make = [name = table.name](SecondOrderOde& ode, auto set) {
      IntegratorOptions options;
      options.table = name;
      set(options);
      return make_arkode_erk(ode, options);
    };
    methods.push_back(
        {"erk_" + table.name, table.order, 0.3, table.evaluations,
         [make](SecondOrderOde& ode, double step) {
           return make(ode, [step](IntegratorOptions& options) { options.fixed_step = step; });
         },
         [make](SecondOrderOde& ode, double rtol) {
           return make(ode,
                       [rtol](IntegratorOptions& options) { options.relative_tolerance = rtol; });
         }});
  }
  for (const NystromTable& table : nystrom_tables()) {
    const auto make = [name = table.name](SecondOrderOde& ode, auto set) {
      IntegratorOptions options;
      options.table = name;
      set(options);
      return std::unique_ptr<Integrator>(std::make_unique<Nystrom>(ode, options));
    };
    // Of the highest orders double precision shows little: rounding is soon reached.
    methods.push_back(
        {"nystrom_" + table.name, table.order, table.order > 8 ? 1.0 : 0.5, table.evaluations,
         [make](SecondOrderOde& ode, double step) {
           return make(ode, [step](IntegratorOptions& options) { options.fixed_step = step; });
         },
         [make](SecondOrderOde& ode, double rtol) {
           return make(ode,
                       [rtol](IntegratorOptions& options) { options.relative_tolerance = rtol; });
         }});
  }
  return methods;
}

inline std::vector<ExplicitMethod> all_methods() {
  std::vector<ExplicitMethod> methods = adaptive_methods();
  methods.push_back({"central_difference",
                     2,
                     0.1,
                     1,
                     [](SecondOrderOde& ode, double step) {
                       return std::unique_ptr<Integrator>(
                           std::make_unique<CentralDifference>(ode, step));
                     },
                     {}});
  return methods;
}

/// Names for parametrised tests: letters, digits and underscores only.
inline std::string test_name(const ExplicitMethod& method) {
  std::string name = method.name;
  for (char& c : name) {
    if (c == '-' || c == '.') c = '_';
  }
  return name;
}

}  // namespace subimpact
