#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace subimpact {

/// A key of case files that has another name now, or that is often called by another name.
struct MovedKey {
  const char* old_name;  ///< with its table, as the new one
  const char* new_name;
};

/// All of them. A key that is renamed leaves its old name here.
const std::vector<MovedKey>& moved_keys();

/// The present name of a key; nullptr if the name was never one.
const char* moved_to(std::string_view old_name);

/// What a choice of a key is called here, for a name it has elsewhere ("fixed": "clamped"); empty
/// for a name that is not known.
std::string own_name(std::string_view key, std::string_view name);

}  // namespace subimpact
