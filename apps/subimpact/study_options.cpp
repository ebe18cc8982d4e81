#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "commands.h"
#include "subimpact/study/sweep.h"

namespace subimpact::app {

std::string positive_seconds(const std::string& text) {
  const double value = std::strtod(text.c_str(), nullptr);
  if (value > 0.0 && std::isfinite(value)) return {};
  return fmt::format("is {}; allowed: seconds, finite and above 0", text);
}

void check_methods(const Case& input, const std::vector<std::string>& methods) {
  for (const std::string& method : methods) {
    try {
      settings_of(input, method);
    } catch (const InvalidCase& error) {
      const bool of_method = error.key == "solver.method" || error.key == "solver.table";
      if (!of_method) throw;
      throw CaseFileError(fmt::format("--methods {}: {} {}", method, error.key, error.what()));
    }
  }
}

}  // namespace subimpact::app
