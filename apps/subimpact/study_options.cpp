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

std::string positive_seconds(const std::string& text) {
  const double value = std::strtod(text.c_str(), nullptr);
  if (value > 0.0 && std::isfinite(value)) return {};
  return fmt::format("is {}; allowed: seconds, finite and above 0", text);
}

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

std::string did_you_mean(const std::string& name) {
  return name.empty() ? "see `subimpact methods`" : fmt::format("did you mean \"{}\"?", name);
}

std::string unknown_method(const std::string& option, const std::string& method) {
  const std::vector<std::string> names = names_of_choices("solver.method");
  const std::string own = own_name("solver.method", method);
  return fmt::format("--methods {}: unknown method \"{}\"; allowed: {}; {}", option, method,
                     fmt::join(names, ", "),
                     did_you_mean(own.empty() ? nearest_name(method, names) : own));
}

std::string unknown_table(const std::string& option, const std::string& method,
                          const std::string& table) {
  const std::vector<std::string> names = table_names(method);
  if (names.empty()) {
    return fmt::format("--methods {}: {} has no tables; write --methods {}", option, method,
                       method);
  }
  const std::string near = nearest_name(table, names);
  return fmt::format("--methods {}: unknown table \"{}\"; allowed for {}: {}; {}", option, table,
                     method, fmt::join(names, ", "),
                     did_you_mean(near.empty() ? near : method + ":" + near));
}

std::string unknown_events(const std::string& option, const std::string& events) {
  const std::vector<std::string> names = names_of_choices("solver.events");
  return fmt::format("--methods {}: unknown treatment of events \"{}\"; allowed: {}; {}", option,
                     events, fmt::join(names, ", "), did_you_mean(nearest_name(events, names)));
}

template <class List>
bool contains(const List& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

}  // namespace

void check_method_names(const std::vector<std::string>& methods) {
  for (const std::string& option : methods) {
    const auto [method, table, events] = parse_method_name(option);
    if (!contains(names_of_choices("solver.method"), method))
      throw CaseFileError(unknown_method(option, method));
    if (table && !contains(table_names(method), *table)) {
      throw CaseFileError(unknown_table(option, method, *table));
    }
    if (events && !contains(names_of_choices("solver.events"), *events)) {
      throw CaseFileError(unknown_events(option, *events));
    }
  }
}

void check_methods(const Case& input, const std::vector<std::string>& methods) {
  check_method_names(methods);
  for (const std::string& method : methods) settings_of(input, method);
}

}  // namespace subimpact::app
