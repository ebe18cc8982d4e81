#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace subimpact {

/// The number with a decimal comma in a line (from 1) of TOML such as "mass = 0,201"; empty if
/// there is none. Lists are left alone: in [0,5] there are two numbers.
std::string decimal_comma_in(std::string_view text, std::size_t line);

}  // namespace subimpact
