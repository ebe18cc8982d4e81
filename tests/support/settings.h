#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "subimpact/case/case_keys.h"

namespace subimpact {

/// Keys of a case as files name them, each with its value.
using Settings = std::vector<std::pair<const char*, KeyValue>>;
using Names = std::vector<std::string>;

inline Settings operator+(Settings a, const Settings& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Without the checks of single values, which are left to those of the case.
inline Case changed(Case input, const Settings& settings) {
  for (const auto& [name, value] : settings) {
    const CaseKey* key = find_case_key(name);
    if (key == nullptr) throw std::invalid_argument(std::string(name) + " is no key");
    key->set(input, value);
  }
  return input;
}

}  // namespace subimpact
