#pragma once

/// Readable parameters and readable failures: enumerations print by their names, and a test over
/// parameters is named after what they print. To be included by every test that compares or
/// iterates over enumerations, so that all files of a test program print them alike.

#include <cctype>
#include <type_traits>

#include "subimpact/model/scene.h"
#include "testing.h"

#if __has_include("case/keys/case_choices.h")
#include "case/keys/case_choices.h"
#endif

namespace subimpact {

// Those of the model, whose names in case files the model's tests cannot see.
inline std::ostream& operator<<(std::ostream& out, BeamTheory theory) {
  return out << (theory == BeamTheory::rayleigh ? "rayleigh" : "euler-bernoulli");
}

inline std::ostream& operator<<(std::ostream& out, EndSupport end) {
  return out << (end == EndSupport::free     ? "free"
                 : end == EndSupport::pinned ? "pinned"
                                             : "clamped");
}

template <class Enum>
concept HasToString = std::is_enum_v<Enum> && requires(Enum value) {
  to_string(value);
};

/// Outcomes, verdicts, kinds of events.
template <HasToString Enum>
std::ostream& operator<<(std::ostream& out, Enum value) {
  return out << to_string(value);
}

/// Choices of the case file that have no to_string().
template <class Enum>
requires std::is_enum_v<Enum> &&(!HasToString<Enum>)&&requires(Enum value) { names_of(value); }
std::ostream& operator<<(std::ostream& out, Enum value) { return out << name_of(value); }

/// The last argument of INSTANTIATE_TEST_SUITE_P: "(rayleigh, { pinned, clamped })" becomes
/// rayleigh_pinned_clamped.
struct NamedAsPrinted {
  template <class Parameter>
  std::string operator()(const testing::TestParamInfo<Parameter>& info) const {
    std::string name;
    for (const char c : testing::PrintToString(info.param)) {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
        name += c;
      } else if (!name.empty() && name.back() != '_') {
        name += '_';
      }
    }
    while (!name.empty() && name.back() == '_') name.pop_back();
    return name;
  }
};

}  // namespace subimpact
