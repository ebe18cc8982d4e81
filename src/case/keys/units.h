#pragma once

/// Values with a unit, as in "711.2 mm".

#include <optional>
#include <string>
#include <string_view>

#include "subimpact/case/case_keys.h"

namespace subimpact {

/// The text without spaces and tabs at its ends.
std::string_view trimmed(std::string_view text);

/// A number and the text after it; the number of "heavy" is empty.
struct NumberAndUnit {
  std::string_view number, unit;
};
NumberAndUnit split_unit(std::string_view text);

/// The value of a text such as "711.2 mm" in the unit of a key ("m"): exactly the double 0.7112.
/// `unit` may be two, "N/m^1.5 or N/m". Nothing without a number or unit, or with a unit of another
/// quantity than that of `unit`.
std::optional<double> value_in(std::string_view unit, std::string_view text);

/// Whether a key has positions along the beam, as fractions of its length or, in a text, as
/// lengths.
bool is_position(const CaseKey& key);

/// The number that a text with a unit stands for, where the key is a number; else the value itself.
KeyValue in_unit_of(const CaseKey& key, KeyValue value);

/// The units allowed in place of that of a key, separated: "m, mm, um"; empty: none.
std::string units_beside(std::string_view unit, std::string_view separator = ", ");

}  // namespace subimpact
