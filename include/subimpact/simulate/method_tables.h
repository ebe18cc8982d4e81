#pragma once

#include <string>
#include <vector>

#include "subimpact/simulate/options.h"

namespace subimpact {

/// A table of coefficients that solver.table may name.
struct MethodTable {
  Method method;  ///< the one it belongs to
  std::string name;
  int order;
  int embedded_order;  ///< of the error estimate
  int evaluations;     ///< right-hand sides an accepted step costs; for an implicit method its
                       ///< stages, each of which is evaluated two or three times
  std::string note;    ///< what it is for, and its source
};

/// All tables; the first of each method is its default.
const std::vector<MethodTable>& method_tables();

}  // namespace subimpact
