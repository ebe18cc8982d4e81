#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace subimpact::app {

/// A time above 0 with its unit, in seconds: "1us", "0.5 ms", "20ns", "2e-7s". Nothing for any
/// other text; a number alone has no unit.
std::optional<double> seconds_of(const std::string& text);

/// An option that takes such a time.
CLI::Option* add_time_option(CLI::App& command, const std::string& names, std::string& text,
                             const std::string& meaning);

}  // namespace subimpact::app
