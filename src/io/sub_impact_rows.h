#pragma once

#include <string>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// The sub-impacts of a run as people read them: microseconds, newtons, millimetres, with the
/// digits that the error estimate allows; without one, with a fixed number of digits.
///
/// A time has its error beside it and a duration is rounded to the sum of the errors of start and
/// end. Over one sub-impact, the relative errors of peak force, of impulse and of the changes of
/// indentation and striker velocity are taken to be at most the relative error r of its duration;
/// errors of indentation, residual and striker velocity are sums of those of their changes:
///
///     dF = r F,  dP = r P,  dv_i = dv_(i-1) + r_i |v_i - v_(i-1)|,
///     dlambda_i = drho_(i-1) + r_i |lambda_i - rho_(i-1)|,  rho the residual indentation.
///
/// A rule, not an estimate; docs/files.md has the measured shares. Of a contact that lasts to the
/// end of the run these errors are not known: its values have two digits.
/// Sub-impacts that are not decided have a question mark in place of an error; their times have no
/// digit that the largest known error forbids.
struct SubImpactRows {
  struct Column {
    const char* name;
    const char* unit;
    std::size_t width = 0;  ///< in characters, at least that of its cells
  };
  std::vector<Column> columns;
  struct Row {
    bool is_decided = true;          ///< also where no error estimate exists
    std::vector<std::string> cells;  ///< one per column, decimal points under each other
  };
  std::vector<Row> rows;
};

/// `plus_minus`: what stands between a time and its error.
SubImpactRows sub_impact_rows(const Result& result, const char* plus_minus = "+-");

/// Errors of what a run ends with, by the same rule; infinite where it is not decided, or where the
/// run has no error estimate.
struct FinalErrors {
  double max_force = 0.0;         ///< N
  double max_indentation = 0.0;   ///< m
  double striker_velocity = 0.0;  ///< m/s
  /// m/s, of the mean of the beam, by the conservation of momentum; infinite where supports or
  /// damping take momentum up.
  double beam_velocity = 0.0;
};
FinalErrors final_errors(const Case& input, const Result& result);

/// Why the sub-impacts from the first undecided one on are not decided; empty if all are, or if
/// there is no error estimate.
std::string undecided_reason(const Result& result);

}  // namespace subimpact
