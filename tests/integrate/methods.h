#pragma once

#include "integrate/central_difference.h"
#include "integrate/nystrom.h"
#include "integrate/sundials.h"
#include "print.h"

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
  using MakeIt = std::unique_ptr<Integrator> (*)(SecondOrderOde&, const IntegratorOptions&);
  std::vector<ExplicitMethod> methods;
  const auto add = [&](const std::string& family, const auto& table, double band, MakeIt make) {
    IntegratorOptions options;
    options.table = table.name;
    methods.push_back({family + table.name, table.order, band, table.evaluations,
                       [=](SecondOrderOde& ode, double step) mutable {
                         options.fixed_step = step;
                         return make(ode, options);
                       },
                       [=](SecondOrderOde& ode, double rtol) mutable {
                         options.relative_tolerance = rtol;
                         return make(ode, options);
                       }});
  };
  for (const CoefficientTable& table : explicit_tables()) {
    add("erk_", table, 0.3, [](SecondOrderOde& ode, const IntegratorOptions& options) {
      return make_arkode_erk(ode, options);
    });
  }
  // Of the highest orders double precision shows little: rounding is soon reached.
  for (const NystromTable& table : nystrom_tables()) {
    add("nystrom_", table, table.order > 8 ? 1.0 : 0.5,
        [](SecondOrderOde& ode, const IntegratorOptions& options) {
          return std::unique_ptr<Integrator>(std::make_unique<Nystrom>(ode, options));
        });
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

}  // namespace subimpact
