#pragma once

#include <fmt/format.h>

#include <initializer_list>
#include <utility>

#include "simulate/settings/refuse.h"

namespace subimpact {

/// Throws an error of the given type.
template <class Error, class... Values>
[[noreturn]] void fail(fmt::format_string<Values...> message, Values&&... values) {
  throw Error(fmt::format(message, std::forward<Values>(values)...));
}

/// A rule across keys: the key that breaks it, and the message.
struct Rule {
  bool is_broken;
  const char* key;
  const char* message;
};

/// Throws InvalidCase for the first rule that is broken.
inline void check_rules(std::initializer_list<Rule> rules) {
  for (const Rule& rule : rules) {
    if (rule.is_broken) throw InvalidCase(rule.key, rule.message);
  }
}

}  // namespace subimpact
