#include "outcome.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "subimpact/io/case_file.h"

namespace subimpact::validation {
namespace {

constexpr double most_digits = 12.0;

std::string published_text(const Row& row) {
  switch (row.bound) {
    case Bound::holds:
      return "yes";
    case Bound::within:
      return fmt::format("< {:.6g}", row.published);
    default:
      return fmt::format("{:.10g}", row.published);
  }
}

std::string ours_text(const Row& row) {
  if (row.bound == Bound::holds) return row.ours == 1.0 ? "yes" : "no";
  return fmt::format("{:.10g}", row.ours);
}

std::string tolerance_text(const Row& row) {
  switch (row.bound) {
    case Bound::relative:
      return row.tolerance >= 1e-3 ? fmt::format("{:.2g} %", 100.0 * row.tolerance)
                                   : fmt::format("{:.0e}", row.tolerance);
    case Bound::absolute:
      return fmt::format("± {:.3g}", row.tolerance);
    default:
      return "";
  }
}

std::string digits_text(const Row& row) {
  const double digits = row.digits();
  return digits < 0.0 ? "" : fmt::format("{:.1f}", digits);
}

}  // namespace

bool Row::agrees() const {
  switch (bound) {
    case Bound::relative:
      return std::abs(ours / published - 1.0) <= tolerance;
    case Bound::absolute:
      return std::abs(ours - published) <= tolerance;
    case Bound::within:
      return ours < published;
    case Bound::holds:
      return ours == 1.0;
  }
  return false;
}

double Row::digits() const {
  if (bound == Bound::within || bound == Bound::holds || published == 0.0) return -1.0;
  const double difference = std::abs(ours / published - 1.0);
  return difference == 0.0 ? most_digits : std::clamp(-std::log10(difference), 0.0, most_digits);
}

Case case_of(const std::string& folder, const std::vector<std::string>& settings) {
  std::vector<Override> overrides;
  for (const std::string& setting : settings) overrides.push_back(parse_override(setting));
  return read_case_file(std::string(SUBIMPACT_VALIDATION) + "/" + folder + "/case.toml", overrides)
      .value;
}

std::string table_head(bool with_name) {
  return std::string(with_name ? "| case | source " : "") +
         "| quantity | published | ours | digits | tolerance | verdict |\n" +
         (with_name ? "|---|---" : "") + "|---|---|---|---|---|---|\n";
}

std::string table(const Outcome& outcome, const std::string& name) {
  std::string text;
  for (const Row& row : outcome.rows) {
    if (!name.empty()) text += fmt::format("| [{0}]({0}/) | {1} ", name, outcome.source);
    const std::string verdict = row.agrees()  ? "agrees"
                                : row.fails() ? "**FAILS**"
                                              : "differs: " + row.why_it_differs;
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", row.quantity, published_text(row),
                        ours_text(row), digits_text(row), tolerance_text(row), verdict);
  }
  return text;
}

}  // namespace subimpact::validation
