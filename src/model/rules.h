#pragma once

#include <fmt/format.h>

#include <span>
#include <stdexcept>

#include "subimpact/model/mesh/beam_mesh.h"

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

/// Throw BrokenRule for a functional, or a row of B, that `n` unknowns cannot have.
void check_functional(const char* name, const SparseFunctional& functional, std::size_t n);
void check_row(std::size_t section, std::size_t first, std::span<const double> row, std::size_t n);

}  // namespace subimpact
