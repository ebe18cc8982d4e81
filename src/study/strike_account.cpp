#include "subimpact/study/strike_account.h"

#include <algorithm>

namespace subimpact {
namespace {

// Of the row nearest in time: events have rows of their own, on either side.
const HistoryRow& row_at(const Result& result, double time) {
  const auto& rows = result.history;
  const auto after = std::lower_bound(rows.begin(), rows.end(), time,
                                      [](const HistoryRow& row, double t) { return row.time < t; });
  if (after == rows.end()) return rows.back();
  if (after == rows.begin() || after->time == time) return *after;
  const auto before = std::prev(after);
  return time - before->time < after->time - time ? *before : *after;
}

StrikePart part(const Result& result, StrikePart::Kind kind, int zone, int subzone, double start,
                double end) {
  return {kind,
          zone,
          subzone,
          start,
          end,
          row_at(result, start).bending_elastic,
          row_at(result, end).bending_elastic};
}

}  // namespace

std::optional<StrikeAccount> account_of(const Result& result) {
  const auto& hits = result.sub_impacts;
  if (result.history.empty() || hits.empty()) return std::nullopt;
  using Kind = StrikePart::Kind;
  StrikeAccount account;
  const auto last_where = [&](std::size_t from, auto same) {
    std::size_t last = from;
    while (last + 1 < hits.size() && same(hits[last + 1], hits[from])) ++last;
    return last;
  };
  const auto same_zone = [](const SubImpact& a, const SubImpact& b) { return a.zone == b.zone; };
  const auto same_subzone = [](const SubImpact& a, const SubImpact& b) {
    return a.zone == b.zone && a.subzone == b.subzone;
  };
  for (std::size_t first = 0; first < hits.size();) {
    const std::size_t zone_last = last_where(first, same_zone);
    const int zone = hits[first].zone;
    account.parts.push_back(
        part(result, Kind::zone, zone, 0, hits[first].start, result.end_of(hits[zone_last])));
    for (std::size_t i = first; i <= zone_last;) {
      const std::size_t last = last_where(i, same_subzone);
      const double end = result.end_of(hits[last]);
      account.parts.push_back(
          part(result, Kind::subzone, zone, hits[i].subzone, hits[i].start, end));
      if (last < zone_last) {
        account.parts.push_back(part(result, Kind::subzone_separation, zone, hits[i].subzone, end,
                                     hits[last + 1].start));
      }
      i = last + 1;
    }
    if (zone_last + 1 < hits.size()) {
      account.parts.push_back(part(result, Kind::separation, zone, 0,
                                   result.end_of(hits[zone_last]), hits[zone_last + 1].start));
    }
    first = zone_last + 1;
  }
  account.strike_end = result.end_of(hits.back());
  account.elastic_at_end = row_at(result, account.strike_end).bending_elastic;
  double lowest = result.history.front().striker_energy;
  for (const HistoryRow& row : result.history) {
    if (row.time > account.strike_end) break;
    if (row.bending_elastic > account.largest_elastic) {
      account.largest_elastic = row.bending_elastic;
      account.largest_elastic_at = row.time;
    }
    lowest = std::min(lowest, row.striker_energy);
    account.striker_gain = std::max(account.striker_gain, row.striker_energy - lowest);
  }
  account.striker_loss =
      result.history.front().striker_energy - row_at(result, account.strike_end).striker_energy;
  return account;
}

}  // namespace subimpact
