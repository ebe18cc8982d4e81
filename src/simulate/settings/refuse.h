#pragma once

#include <fmt/format.h>

#include <initializer_list>
#include <utility>

#include "subimpact/simulate/error.h"

namespace subimpact {

/// Throws InvalidCase for a key of the case file; `why` as for fmt::format.
template <class... Values>
[[noreturn]] void refuse(const char* key, fmt::format_string<Values...> why, Values&&... values) {
  throw InvalidCase(key, fmt::format(why, std::forward<Values>(values)...));
}

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
