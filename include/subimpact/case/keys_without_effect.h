#pragma once

#include <set>
#include <string>
#include <vector>

#include "subimpact/case/case.h"

namespace subimpact {

/// The keys that a user gave, in the file and on the command line.
struct GivenKeys {
  std::set<std::string> in_file;
  std::set<std::string> in_settings;  ///< of the command line, which override the file
};

/// Keys that were given but have no effect beside another key: one sentence per key, such as
/// 'model.layers = 40 has no effect with model.section = "exact"'. None for a key of the file that
/// has no effect because of a setting on the command line: the file is often run with other
/// choices.
std::vector<std::string> keys_without_effect(const Case& input, const GivenKeys& given);

}  // namespace subimpact
