#pragma once

/// Factors by which values in SI units are multiplied to be shown in other units.

namespace subimpact {

constexpr double us = 1e6;    // of seconds
constexpr double mm = 1e3;    // of metres
constexpr double um = 1e6;    // of metres
constexpr double MPa = 1e-6;  // of pascals
constexpr double MB = 1e-6;   // of bytes

}  // namespace subimpact
