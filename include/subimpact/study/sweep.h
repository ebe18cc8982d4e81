#pragma once

#include <optional>
#include <string>
#include <vector>

#include "subimpact/case/case.h"

namespace subimpact {

/// The parts of "erk:dop853+library": a method, a table of coefficients after a colon, and a
/// treatment of events (solver.events) after a plus sign. The last two may be left out.
struct MethodName {
  std::string method;
  std::optional<std::string> table, events;
};
MethodName parse_method_name(const std::string& name);

struct Setting {
  std::string method;       ///< "erk:dop853"; a method without tables alone
  bool fixed_step = false;  ///< else it is rtol
  double value = 0.0;       ///< s, or the tolerance

  std::string text() const;  ///< "rtol 1e-08", "step 0.2556 us"
  bool operator==(const Setting&) const = default;
};

/// The case with that setting. Throws InvalidCase for an unknown method.
Case with_setting(const Case& input, const Setting& setting);

/// From coarse to fine. Methods with error control: rtol from 1e-2 to 1e-12 in decades. Then, by
/// methods that take a fixed step, steps each half of the previous one, down to 1/256 of 0.9 of the
/// critical step of central differences: from that step by central differences, from 4 times it by
/// other explicit methods, from 32 times by implicit ones and in modes. Throws InvalidCase for an
/// unknown method or table, and where the method cannot run the case.
std::vector<Setting> settings_of(const Case& input, const std::string& method);

/// The methods of a sweep by default: every method that can run the case, with its relevant tables.
std::vector<std::string> default_methods(const Case& input);

}  // namespace subimpact
