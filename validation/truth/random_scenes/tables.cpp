#include "random_scenes/tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

namespace subimpact::scenes {
namespace {

constexpr double due_percent = 99.0;
constexpr int fewest_for_percent = 100;  // below that one run that fails is more than 1 %
const char* const due_methods[] = {"erk", "nystrom", "exponential"};
const char* const outcomes[] = {"completed",     "inaccurate",    "unstable",   "chattering",
                                "solver failed", "left validity", "wall clock", "stood still",
                                "refused",       "exception",     "crashed",    "hung"};
const char* const methods[] = {
    "central-difference", "erk", "nystrom", "exponential", "dirk", "adams", "bdf"};
const char* const bands[] = {"looser than 1e-4", "1e-4 to 1e-6", "1e-6 and tighter", "fixed steps"};

bool is_count(const Record& r) {
  return r.id.purpose == Purpose::counts || r.id.purpose == Purpose::scene_keys;
}

std::string command(const Record& r) {
  return fmt::format("scripts/study random_scenes --seed {} --write {} --of {}", r.id.seed,
                     r.id.number, to_string(r.id.purpose));
}

std::set<std::string> outcomes_seen(const std::vector<Record>& records) {
  std::set<std::string> seen;
  for (const Record& r : records) seen.insert(r.outcome);
  return seen;
}

std::string by_method_and_band(const std::vector<Record>& records) {
  const auto seen = outcomes_seen(records);
  std::string head = "| method | rtol | runs |", rule = "|---|---|---|", rows;
  for (const char* outcome : outcomes) {
    if (!seen.count(outcome)) continue;
    head += fmt::format(" {} |", outcome);
    rule += "---|";
  }
  head += " a check failed |";
  rule += "---|";
  for (const char* method : methods) {
    for (const char* band : bands) {
      std::map<std::string, int> n;
      int total = 0, failed = 0;
      for (const Record& r : records) {
        if (r.method != method || r.band != band) continue;
        ++n[r.outcome];
        ++total;
        failed += !r.failures.empty();
      }
      if (total == 0) continue;
      rows += fmt::format("| {} | {} | {} |", method, band, total);
      for (const char* outcome : outcomes) {
        if (seen.count(outcome)) rows += n[outcome] ? fmt::format(" {} |", n[outcome]) : "  |";
      }
      rows += failed ? fmt::format(" {} |\n", failed) : "  |\n";
    }
  }
  return head + "\n" + rule + "\n" + rows;
}

std::string by_check(const std::vector<Record>& records) {
  std::map<std::string, std::map<std::string, int>> n;  // check, method
  for (const Record& r : records) {
    for (const Failure& f : r.failures) ++n[f.check][r.method];
  }
  if (n.empty()) return "Every check holds of every scene.\n";
  std::string text = "| check that fails | scenes | of which |\n|---|---|---|\n";
  for (const auto& [check, of_methods] : n) {
    int total = 0;
    std::vector<std::string> parts;
    for (const auto& [method, count] : of_methods) {
      total += count;
      parts.push_back(fmt::format("{} {}", method, count));
    }
    text += fmt::format("| {} | {} | {} |\n", check, total, fmt::join(parts, ", "));
  }
  return text;
}

std::string where_due(const std::vector<Record>& records) {
  std::string text;
  for (const char* method : due_methods) {
    const Completed c = completed_where_due(records, method);
    text += fmt::format(
        "- {}{}: {:.2f} % of {} completed; beside them {} left validity, {} over the wall clock\n",
        method, std::string(method) == "exponential" ? " (elastic)" : "", c.percent(), c.n,
        c.left_validity, c.wall_clock);
  }
  return text;
}

std::string counts(const std::vector<Record>& records, Purpose purpose) {
  int n = 0, compared = 0, wrong = 0, flagged = 0, flagged_right = 0;
  std::map<std::string, int> why_not;
  for (const Record& r : records) {
    if (r.id.purpose != purpose) continue;
    ++n;
    compared += r.compared;
    wrong += r.wrong_count;
    flagged += r.wrong_count && r.flagged;
    flagged_right += r.compared && !r.wrong_count && r.flagged;
    if (!r.compared) ++why_not[r.why_not.empty() ? r.outcome : r.why_not];
  }
  if (n == 0) return "";
  std::string text = fmt::format(
      "{} scenes for counts{}; {} compared, {} wrong counts, {} of them flagged; {} right counts "
      "marked.\n",
      n, purpose == Purpose::scene_keys ? " with two or more of the keys of scenes" : "", compared,
      wrong, flagged, flagged_right);
  for (const auto& [why, count] : why_not)
    text += fmt::format("- not compared: {} ({})\n", why, count);
  return text + "\n";
}

std::string totals(const std::vector<Record>& records) {
  int refused = 0, too_costly = 0, failed = 0;
  double seconds = 0.0, longest = 0.0;
  for (const Record& r : records) {
    refused += r.refused;
    too_costly += r.too_costly;
    failed += !r.failures.empty();
    seconds += r.seconds;
    longest = std::max(longest, r.seconds);
  }
  return fmt::format(
      "{} scenes, {} with a check that fails; {} draws refused, {} too costly; {:.0f} s of wall "
      "clock, at most {:.1f} s a scene\n",
      records.size(), failed, refused, too_costly, seconds, longest);
}

}  // namespace

Completed completed_where_due(const std::vector<Record>& records, const std::string& method) {
  Completed c;
  for (const Record& r : records) {
    if (r.method != method || !r.tight || (method == "exponential" && !r.elastic)) continue;
    if (r.outcome == "left validity") {
      ++c.left_validity;
    } else if (r.outcome == "wall clock") {
      ++c.wall_clock;
    } else {
      ++c.n;
      c.completed += r.outcome == "completed";
    }
  }
  return c;
}

bool all_hold(const std::vector<Record>& records) {
  for (const Record& r : records) {
    if (!r.failures.empty()) return false;
  }
  for (const char* method : due_methods) {
    const Completed c = completed_where_due(records, method);
    if (c.n >= fewest_for_percent ? c.percent() < due_percent : c.n - c.completed > 1) return false;
  }
  return true;
}

std::string outcome_tables(const std::vector<Record>& records) {
  std::vector<Record> checks;
  for (const Record& r : records) {
    if (!is_count(r)) checks.push_back(r);
  }
  std::string text = totals(records) + "\n";
  if (!checks.empty()) text += by_method_and_band(checks) + "\n" + where_due(checks) + "\n";
  text += counts(records, Purpose::counts) + counts(records, Purpose::scene_keys);
  return text + by_check(records);
}

std::string failure_list(const std::vector<Record>& records) {
  std::string text;
  for (const Record& r : records) {
    const bool due = r.tight && (r.method == "erk" || r.method == "nystrom" ||
                                 (r.method == "exponential" && r.elastic));
    const bool odd = due && r.outcome != "completed" && r.outcome != "left validity";
    if (r.failures.empty() && !odd && r.outcome != "wall clock") continue;
    text += fmt::format("scene {}: {}, {}: {}, {} sub-impacts, {:.3f} of the end time, {:.1f} s\n",
                        r.id.number, r.method, r.setting, r.outcome, r.n_sub_impacts, r.reached,
                        r.seconds);
    if (!r.message.empty()) text += fmt::format("    {}\n", r.message);
    for (const Failure& f : r.failures)
      text += fmt::format("    FAILED {}: {}\n", f.check, f.detail);
    text += fmt::format("    {}\n", command(r));
  }
  return text;
}

std::string csv(const std::vector<Record>& records) {
  std::string text =
      "purpose,number,method,band,outcome,n_sub_impacts,compared,wrong_count,flagged,n_failed,"
      "refused,too_costly,guess_s,wall_s,setting\n";
  for (const Record& r : records) {
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{:.3g},{:.3g},\"{}\"\n",
                        to_string(r.id.purpose), r.id.number, r.method, r.band, r.outcome,
                        r.n_sub_impacts, r.compared, r.wrong_count, r.flagged, r.failures.size(),
                        r.refused, r.too_costly, r.guess, r.seconds, r.setting);
  }
  return text;
}

}  // namespace subimpact::scenes
