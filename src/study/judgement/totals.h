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

/// Of things in order of time, the one that overlaps the time from `start` to `end` most; null:
/// none does. `end_of`: the end of a thing (s).
template <class Thing, class EndOf>
const Thing* most_overlapping(double start, double end, const std::vector<Thing>& all,
                              EndOf end_of) {
  const Thing* best = nullptr;
  double most = 0.0;
  auto there =
      std::ranges::partition_point(all, [&](const Thing& thing) { return end_of(thing) <= start; });
  for (; there != all.end() && there->start < end; ++there) {
    const double overlap = std::min(end_of(*there), end) - std::max(there->start, start);
    if (!(overlap > most)) continue;
    most = overlap;
    best = &*there;
  }
  return best;
}

/// Sets the totals of an error estimate: numbers of the run as a whole (docs/theory/errors.md). The
/// error of the largest displacement, moment or strain is at least what another place may exceed it
/// by, to first order in the mesh (validation/truth/defaults).
void set_totals(const Case& input, const Result& run, std::span<const RunBeside> beside,
                ErrorEstimate& estimate);

/// Sets the errors of the times at which the beam touches and lifts off supports, as those of
/// totals, where each run beside that counts for existence has such a contact. Returns since when
/// (s) one of them, or the run, lacks one that the other has; infinite if none does.
double set_support_errors(Result& run, std::span<const RunBeside> beside);

}  // namespace subimpact
