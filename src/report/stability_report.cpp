#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "case/case_choices.h"
#include "case/counted.h"
#include "subimpact/report/stability.h"

namespace subimpact {
namespace {

constexpr double us = 1e6;  // per second

// One character a cell of the map.
char letter(Verdict verdict) {
  switch (verdict) {
    case Verdict::right:
      return '+';
    case Verdict::wrong_count:
      return 'w';
    case Verdict::inaccurate:
      return 'i';
    case Verdict::unstable:
      return 'U';
    case Verdict::failed:
      return 'F';
    case Verdict::refused:
      return 'r';
    case Verdict::not_run:
      return '.';
  }
  return '?';
}

}  // namespace

std::string critical_step_table(const std::vector<CriticalStep>& rows) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{:<22} {:<16} {:>6} {:>9} {:>13} {:>13} {:>10}\n", "method", "theory",
                 "cells", "omega h", "predicted, us", "measured, us", "difference");
  for (const CriticalStep& row : rows) {
    fmt::format_to(out, "{:<22} {:<16} {:>6} {:>9.4f} {:>13.6g} {:>13.6g} {:>8.2f} %\n", row.method,
                   name_of(row.theory), row.segments, row.limit, row.predicted * us,
                   row.measured * us, 100.0 * (row.measured / row.predicted - 1.0));
  }
  std::string method;
  for (const CriticalStep& row : rows) {
    if (row.method == method) continue;
    method = row.method;
    for (const Resonance& range : resonances(method)) {
      fmt::format_to(out,
                     "{}: grows for omega h from {:.4f} to {:.4f} too, by up to {:.1e} per step\n",
                     method, range.from, range.to, range.growth - 1.0);
    }
  }
  return fmt::to_string(text);
}

std::string stiff_contact_table(const std::vector<StiffContact>& rows) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{:>14} {:>14} {:>14} {:>14} {:>10}\n", "spring, N/m", "beam only, us",
                 "predicted, us", "measured, us", "difference");
  for (const StiffContact& row : rows) {
    fmt::format_to(out, "{:>14.4g} {:>14.6g} {:>14.6g} {:>14.6g} {:>8.2f} %\n", row.stiffness,
                   row.beam_only * us, row.predicted * us, row.measured * us,
                   100.0 * (row.measured / row.predicted - 1.0));
  }
  return fmt::to_string(text);
}

std::string damping_table(const std::vector<Damping>& rows) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{:<22} {:>12} {:>12} {:>12} {:>22}\n", "share of the amplitude",
                 "omega h = 1", "10", "100", "largest difference");
  fmt::format_to(out, "{:<22} {:>12} {:>12} {:>12} {:>22}\n", "left by one step", "", "", "",
                 "measured - predicted");
  std::vector<std::string> methods;
  for (const Damping& row : rows) {
    if (methods.empty() || methods.back() != row.method) methods.push_back(row.method);
  }
  for (const std::string& method : methods) {
    double at[3] = {0.0, 0.0, 0.0};
    double largest = 0.0;
    for (const Damping& row : rows) {
      if (row.method != method) continue;
      largest = std::max(largest, std::abs(row.measured - row.predicted));
      for (int i = 0; i < 3; ++i) {
        if (std::abs(row.angle / std::pow(10.0, i) - 1.0) < 1e-9) at[i] = row.measured;
      }
    }
    fmt::format_to(out, "{:<22} {:>12.5f} {:>12.5f} {:>12.5f} {:>22.1e}\n", method, at[0], at[1],
                   at[2], largest);
  }
  return fmt::to_string(text);
}

std::string outcome_table(const OutcomeMap& map) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "reference: {}; {} up to {:.3f} us\n", map.reference.description,
                 counted(map.reference.sub_impacts.size(), "sub-impact"),
                 map.reference.horizon * us);
  fmt::format_to(out,
                 "+ right   w wrong count   i inaccurate   U unstable   F solver failed   r "
                 "refused   . left out\n");
  std::string group, row;
  for (const OutcomePoint& point : map.points) {
    if (point.group != group) {
      if (!group.empty()) fmt::format_to(out, "\n");
      group = point.group;
      row.clear();
      fmt::format_to(out, "\n{:<28}", group == "tolerance" ? "rtol" : "omega_max h");
      for (const OutcomePoint& other : map.points) {
        if (other.group == group && other.row == point.row) fmt::format_to(out, " {:>6g}", other.x);
      }
    }
    if (point.row != row) {
      row = point.row;
      fmt::format_to(out, "\n{:<28}", row);
    }
    fmt::format_to(out, " {:>6}", letter(point.verdict));
  }
  fmt::format_to(out, "\n");
  return fmt::to_string(text);
}

std::string missed_pairs_table(const std::vector<MissedPairs>& rows) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  if (rows.empty()) return {};
  fmt::format_to(out, "{}; shortest sub-impact or separation {:.3g} us\n",
                 counted(rows.front().n_runs, "strike"), rows.front().shortest * us);
  fmt::format_to(out, "{:>9} {:>28} {:>28}\n", "step, us", "all found, pairs looked for",
                 "all found, ends of steps only");
  for (const MissedPairs& row : rows) {
    fmt::format_to(out, "{:>9.3g} {:>28} {:>28}\n", row.step * us, row.right_with_search,
                   row.right_without);
  }
  return fmt::to_string(text);
}

std::string layer_table(const LayerStudy& study) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{:>7} {:>11} {:>12} {:>14} {:>12}  {}\n", "layers", "sub-impacts",
                 "correspond", "median, us", "largest, us", "");
  fmt::format_to(out, "{:>7} {:>11}\n", "exact", study.exact.sub_impacts.size());
  for (const LayerPoint& point : study.points) {
    fmt::format_to(out, "{:>7} {:>11} {:>12} {:>14.3e} {:>12.3e}  {}\n", point.layers,
                   point.errors.n_found, point.errors.n_corresponding, point.errors.median * us,
                   point.errors.maximum * us,
                   point.errors.unmatched ? point.errors.unmatched->description : "");
  }
  return fmt::to_string(text);
}

}  // namespace subimpact
