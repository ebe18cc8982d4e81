#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "subimpact/study/judgement/judgement.h"

namespace subimpact {

/// The largest magnitude that `value`, a member or a function of a row, has in a list.
template <class Row, class Value>
double largest_magnitude(const std::vector<Row>& rows, Value value) {
  double largest = 0.0;
  for (const Row& row : rows) largest = std::max(largest, std::abs(std::invoke(value, row)));
  return largest;
}

/// Sets the totals of an error estimate: numbers of the run as a whole, each with the largest of
/// 3.8 gain |difference| over the runs beside it, summed over the parts (mean velocity of the beam:
/// 5, dissipated energy: 5.5, largest force and indentation: 7; 1.5 times more for a part of one
/// run). That of the largest displacement, moment or strain is at least what another place may
/// exceed it by, to first order in the mesh (validation/truth/defaults). The error of a number of
/// sub-impacts is that of sub-impacts and flights that are not certain, and where there are any at
/// least the difference to a run beside; that of the run is the sum over its zones.
void set_totals(const Case& input, const Result& run, std::span<const RunBeside> beside,
                ErrorEstimate& estimate);

/// Sets the errors of the times at which the beam touches and lifts off supports, as those of
/// totals, where each run beside that counts for existence has such a contact. Returns since when
/// (s) one of them, or the run, lacks one that the other has; infinite if none does.
double set_support_errors(Result& run, std::span<const RunBeside> beside);

/// The number of sub-impacts of a run, and its error, from those of its zones.
Total sum_of_counts(const std::vector<ZoneTotals>& zones);

}  // namespace subimpact
