#include "study_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "case/slips.h"
#include "commands.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/simulate/method_tables.h"
#include "subimpact/study/sweep.h"

namespace subimpact::app {
namespace {

std::vector<std::string> names_of_choices(const char* key) {
  std::vector<std::string> names;
  for (const Choice& choice : find_case_key(key)->choices) names.push_back(choice.name);
  return names;
}

std::vector<std::string> table_names(const std::string& method) {
  std::vector<std::string> names;
  for (const MethodTable& table : method_tables()) {
    if (to_string(table.method) == method) names.push_back(table.name);
  }
  return names;
}

// Refuses a part of an `option` that is not one of `names`. `method`: to which the names belong;
// `meant`: a name that is known to stand for the unknown one.
void check_name(const std::string& option, const char* what, const std::string& name,
                const std::vector<std::string>& names, const std::string& method = {},
                std::string meant = {}) {
  if (std::ranges::find(names, name) != names.end()) return;
  if (meant.empty()) meant = nearest_name(name, names);
  throw CaseFileError(fmt::format(
      "--methods {}: unknown {} \"{}\"; allowed{}: {}; {}", option, what, name,
      method.empty() ? "" : " for " + method, fmt::join(names, ", "),
      meant.empty()
          ? "see `subimpact methods`"
          : fmt::format("did you mean \"{}{}\"?", method.empty() ? "" : method + ":", meant)));
}

}  // namespace

CLI::Option* add_seconds_option(CLI::App& command, const std::string& name, double& seconds,
                                const std::string& meaning) {
  const auto check = [](const std::string& text) {
    const double value = std::strtod(text.c_str(), nullptr);
    if (value > 0.0 && std::isfinite(value)) return std::string();
    return fmt::format("is {}; allowed: seconds, finite and above 0", text);
  };
  return command.add_option(name, seconds, meaning)->check(check)->capture_default_str();
}

void check_method_names(const std::vector<std::string>& methods) {
  for (const std::string& option : methods) {
    const auto [method, table, events] = parse_method_name(option);
    check_name(option, "method", method, names_of_choices("solver.method"), {},
               own_name("solver.method", method));
    const std::vector<std::string> tables = table_names(method);
    if (table && tables.empty()) {
      throw CaseFileError(fmt::format("--methods {}: {} has no tables; write --methods {}", option,
                                      method, method));
    }
    if (table) check_name(option, "table", *table, tables, method);
    if (events) {
      check_name(option, "treatment of events", *events, names_of_choices("solver.events"));
    }
  }
}

void check_methods(const Case& input, const std::vector<std::string>& methods) {
  check_method_names(methods);
  for (const std::string& method : methods) settings_of(input, method);
}

}  // namespace subimpact::app
