#pragma once

#include <string>

namespace subimpact {

/// A table of Runge-Kutta coefficients, or a pair of tables, as users see it.
struct CoefficientTable {
  std::string name;
  int order = 0;
  int embedded_order = 0;  ///< of the method whose difference is the error estimate
  int evaluations = 0;     ///< right-hand sides per accepted step; of an implicit table its stages
  std::string note;        ///< its source and what it is for
};

}  // namespace subimpact
