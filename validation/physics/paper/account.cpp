#include "paper/account.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paper/strike_account.h"
#include "subimpact/io/results.h"

namespace subimpact::validation {
namespace {

constexpr double us = 1e6;
constexpr double ms = 1e3;

// The part of a kind, zone and sub-zone.
const StrikePart& part(const StrikeAccount& account, StrikePart::Kind kind, int zone, int subzone) {
  return *std::find_if(account.parts.begin(), account.parts.end(), [&](const StrikePart& p) {
    return p.kind == kind && p.zone == zone && p.subzone == subzone;
  });
}

}  // namespace

void add_energies(Outcome& outcome, const Result& result) {
  const StrikeAccount account = account_of(result).value();
  const auto holds = [&](const char* statement, bool true_here) {
    outcome.rows.push_back({statement, 1.0, true_here ? 1.0 : 0.0, Bound::holds, 0.0});
  };
  using Kind = StrikePart::Kind;
  holds("the striker's energy only falls",
        account.striker_gain < 1e-6 * result.used.initial_energy);
  holds("U_e rises over zone 1", part(account, Kind::zone, 1, 0).elastic_change() > 0.0);
  holds("U_e rises in the separation of the zones",
        part(account, Kind::separation, 1, 0).elastic_change() > 0.0);
  holds("U_e falls over zone 2", part(account, Kind::zone, 2, 0).elastic_change() < 0.0);
  holds("U_e rises in the first sub-zone",
        part(account, Kind::subzone, 1, 1).elastic_change() > 0.0);
  holds("U_e falls in the separation of the sub-zones",
        part(account, Kind::subzone_separation, 1, 1).elastic_change() < 0.0);
  holds("U_e falls in the second sub-zone",
        part(account, Kind::subzone, 1, 2).elastic_change() < 0.0);
}

std::string runs_head() {
  return "| run | sub-impacts | zone 1 + 2 | first separation, us | zone 1 ends, ms | zone 2, ms "
         "|\n"
         "|---|---|---|---|---|---|\n"
         "| *the paper* | 57 | 18 + 39 | 203 | 1.757 | 5.178 to 7.031 |\n";
}

std::string runs_row(const std::string& name, const Result& result) {
  const auto zones = summarise_zones(result.sub_impacts);
  std::string counts;
  for (const ZoneSummary& zone : zones) {
    counts += fmt::format("{}{}", counts.empty() ? "" : " + ", zone.n_sub_impacts);
  }
  const auto end_ms = [](const ZoneSummary& zone) { return zone.end.value_or(NAN) * ms; };
  return fmt::format(
      "| {} | {} | {} | {:.3f} | {:.4f} | {:.4f} to {:.4f} |\n", name, result.sub_impacts.size(),
      counts, result.sub_impacts.at(0).end.value_or(NAN) * us, end_ms(zones.at(0)),
      zones.size() > 1 ? zones[1].start * ms : NAN, zones.size() > 1 ? end_ms(zones[1]) : NAN);
}

}  // namespace subimpact::validation
