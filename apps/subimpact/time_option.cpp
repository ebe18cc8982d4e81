#include "time_option.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace subimpact::app {

std::optional<double> seconds_of(const std::string& text) {
  char* rest = nullptr;
  const double value = std::strtod(text.c_str(), &rest);
  if (rest == text.c_str() || !(value > 0.0) || !std::isfinite(value)) return std::nullopt;
  while (*rest == ' ') ++rest;
  constexpr std::pair<std::string_view, double> units[] = {
      {"s", 1.0}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}};
  for (const auto& [unit, seconds] : units) {
    if (rest == unit) return value * seconds;
  }
  return std::nullopt;
}

CLI::Option* add_time_option(CLI::App& command, const std::string& names, std::string& text,
                             const std::string& meaning) {
  return command.add_option(names, text, meaning)->check([](const std::string& given) {
    if (seconds_of(given)) return std::string();
    return fmt::format(
        "is \"{}\"; allowed: a time above 0 with its unit, such as 1us, 0.5ms or 20ns", given);
  });
}

}  // namespace subimpact::app
