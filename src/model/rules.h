#pragma once

#include <fmt/format.h>

#include <stdexcept>

namespace subimpact {

/// A rule of a part that a caller gives, broken: which, by what number and where.
class BrokenRule : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

template <class... Values>
void require(bool holds, fmt::format_string<const Values&...> broken, const Values&... values) {
  if (!holds) throw BrokenRule(fmt::format(broken, values...));
}

}  // namespace subimpact
