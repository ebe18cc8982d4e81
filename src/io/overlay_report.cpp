#include <fmt/format.h>

#include <cmath>

#include "io/uncertain.h"
#include "numerics/units.h"
#include "subimpact/io/report.h"

namespace subimpact {
namespace {

constexpr double like_each_other =
    0.9;  // correlation of two forces that are the same but for noise

std::string fitted_text(const Fitted& fitted, double factor, const char* unit, int most_decimals) {
  const auto rounding =
      fitted.error ? rounding_of(factor * *fitted.error, most_decimals) : std::nullopt;
  if (!rounding) return fmt::format("{:.6g} {}", factor * fitted.value, unit);
  return fmt::format("{} +- {} {}", with_decimals(factor * fitted.value, rounding->decimals),
                     rounding->error, unit);
}

Answer difference(const char* name, double computed, double measured, const char* unit,
                  const std::string& note) {
  return {name,
          fmt::format("{} {} computed, {} measured: {:+.2g} %", with_digits(computed, 4), unit,
                      with_digits(measured, 4), 100.0 * (computed - measured) / measured),
          note};
}

}  // namespace

std::vector<Answer> answers(const Overlay& overlay) {
  const auto& [computed, measured] = std::tie(overlay.computed, overlay.measured);
  std::vector<Answer> all = {
      {"shift", fitted_text(overlay.shift, us, "us", 6),
       fmt::format("by which the measured time is later, {}; correlation {:.4f}, samples {:.4g} us "
                   "apart",
                   overlay.shift.error ? "found" : "as given", overlay.correlation,
                   overlay.sampling_interval * us)}};
  if (overlay.low_pass) {
    all.push_back({"low-pass", fitted_text(*overlay.low_pass, 1e-3, "kHz", 4),
                   std::string(overlay.low_pass->error ? "found" : "as given") +
                       "; Butterworth, fourth order, on the computed force"});
  }
  all.push_back(difference("largest force", computed.peak, measured.peak, "N",
                           fmt::format("at {:.1f} and {:.1f} us of the run",
                                       computed.peak_time * us, measured.peak_time * us)));
  all.push_back(difference("impulse", computed.impulse, measured.impulse, "N s",
                           fmt::format("from {:.6g} to {:.6g} us of the run, which both cover",
                                       overlay.from * us, overlay.to * us)));
  return all;
}

std::string overlay_doubt(const Overlay& overlay) {
  if (overlay.correlation < like_each_other) {
    return fmt::format(
        "the two forces have a correlation of {:.2f}, and two of one strike have more than {}: the "
        "case is not that of the measurement, or the shift or the filter is wrong",
        overlay.correlation, like_each_other);
  }
  if (overlay.low_pass_at_bound) {
    return "the cut-off found is at the end of what was searched: the measurement shows no "
           "low-pass filter of fourth order between two periods in the record and half of the "
           "sampling rate";
  }
  return {};
}

}  // namespace subimpact
