#include "paper/strike_account.h"

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

}  // namespace

std::vector<StrikePart> strike_parts(const Result& result) {
  using Kind = StrikePart::Kind;
  std::vector<StrikePart> parts;
  std::size_t zone = 0, subzone = 0;  // places of the present ones in `parts`
  for (const SubImpact& s : result.sub_impacts) {
    const double end = result.end_of(s);
    const bool same_zone = !parts.empty() && parts[zone].zone == s.zone;
    const bool same_subzone = same_zone && parts[subzone].subzone == s.subzone;
    if (same_zone && !same_subzone) {
      parts.push_back(
          {Kind::subzone_separation, s.zone, parts[subzone].subzone, parts[subzone].end, s.start});
    } else if (!same_zone && !parts.empty()) {
      parts.push_back({Kind::separation, parts[zone].zone, 0, parts[zone].end, s.start});
    }
    if (!same_zone) {
      zone = parts.size();
      parts.push_back({Kind::zone, s.zone, 0, s.start, end});
    }
    if (!same_subzone) {
      subzone = parts.size();
      parts.push_back({Kind::subzone, s.zone, s.subzone, s.start, end});
    }
    parts[zone].end = parts[subzone].end = end;
  }
  return parts;
}

std::optional<StrikeAccount> account_of(const Result& result) {
  if (result.history.empty() || result.sub_impacts.empty()) return std::nullopt;
  StrikeAccount account;
  account.parts = strike_parts(result);
  for (StrikePart& part : account.parts) {
    part.elastic_start = row_at(result, part.start).bending_elastic;
    part.elastic_end = row_at(result, part.end).bending_elastic;
  }
  account.strike_end = result.end_of(result.sub_impacts.back());
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
