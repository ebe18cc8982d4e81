#include <fmt/format.h>

#include <iterator>

#include "case/counted.h"
#include "subimpact/io/report.h"
#include "subimpact/io/work_precision.h"

namespace subimpact {
namespace {

constexpr double us = 1e6;  // per second

std::string point_line(const WorkPrecisionPoint& point) {
  const EventErrors& errors = point.errors;
  const std::string head = fmt::format("{:<22} {:<14} {:<12}", point.setting.method,
                                       point.setting.text(), to_string(point.verdict));
  const bool ran = point.verdict != Verdict::not_run && point.verdict != Verdict::refused;
  if (!ran) return head + "\n";
  const bool completed = point.verdict == Verdict::right || point.verdict == Verdict::wrong_count;
  const std::string accuracy =
      completed ? fmt::format("{:>4}/{:<4} {:>9.1e} {:>9.1e} {:>9.1e} {:>9.1e}",
                              errors.n_corresponding, errors.n_reference, errors.median * us,
                              errors.maximum * us, errors.peak_force, errors.striker_velocity)
                : std::string(49, ' ');
  return fmt::format("{} {} {:>10} {:>10} {:>10} {:>8}\n", head, accuracy,
                     duration_text(point.seconds), point.work.right_hand_sides,
                     point.work.mass_solves, point.work.factorisations);
}

std::string setting_text(const WorkPrecisionPoint& point) {
  return fmt::format("{} at {}: {}, largest error {:.1e} us", point.setting.method,
                     point.setting.text(), duration_text(point.seconds), point.errors.maximum * us);
}

std::string error_text(double seconds) { return fmt::format("{:g} us", seconds * us); }

}  // namespace

std::string work_precision_table(const WorkPrecision& study) {
  const Reference& reference = study.reference;
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "reference: {}; {}, times to {:.1e} us\n", reference.description,
                 counted(reference.sub_impacts.size(), "sub-impact"), reference.error * us);
  fmt::format_to(out, "horizon: {:.3f} us ({})\n", reference.horizon * us,
                 reference.horizon_reason);
  if (const auto growth = error_growth(study.points)) {
    fmt::format_to(out, "errors grow {:.2g}-fold from the first separation to the last event\n",
                   *growth);
  }
  fmt::format_to(
      out, "\n{:<22} {:<14} {:<12} {:>9} {:>9} {:>9} {:>9} {:>9} {:>10} {:>10} {:>10} {:>8}\n", "",
      "", "", "corre-", "times,", "times,", "peaks,", "striker,", "wall", "right-hand", "mass",
      "factori-");
  fmt::format_to(out,
                 "{:<22} {:<14} {:<12} {:>9} {:>9} {:>9} {:>9} {:>9} {:>10} {:>10} {:>10} {:>8}\n",
                 "method", "setting", "verdict", "spond", "median us", "max us", "max rel.", "rel.",
                 "time", "sides", "solves", "sations");
  std::string method;
  for (const WorkPrecisionPoint& point : study.points) {
    if (!method.empty() && point.setting.method != method) fmt::format_to(out, "\n");
    method = point.setting.method;
    text.append(point_line(point));
  }
  bool first = true;
  for (const WorkPrecisionPoint& point : study.points) {
    if (point.message.empty()) continue;
    if (first) fmt::format_to(out, "\n");
    first = false;
    fmt::format_to(out, "{} at {}: {}\n", point.setting.method, point.setting.text(),
                   point.message);
  }
  return fmt::to_string(text);
}

std::string recommendation_text(const std::vector<Recommendation>& recommendations) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (const Recommendation& item : recommendations) {
    if (!item.point) {
      fmt::format_to(out, "  {:<9} not reached by any setting that was run\n",
                     error_text(item.wanted));
      continue;
    }
    fmt::format_to(out, "  {:<9} {}\n", error_text(item.wanted), setting_text(*item.point));
    if (!item.steady) continue;
    fmt::format_to(out, "            by chance: finer settings miss it; reliably from {} on\n",
                   setting_text(*item.steady));
  }
  return fmt::to_string(text);
}

}  // namespace subimpact
