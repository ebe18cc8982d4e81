#pragma once

#include <memory>
#include <string>

#include "subimpact/simulate/run_state.h"

namespace subimpact {

inline constexpr const char* state_name = "state.json";

/// Numbers in the shortest digits that give the same double back.
std::string state_json(const RunState& state);
/// Its inverse. Throws ResultsError, without the name of the file.
std::shared_ptr<const RunState> state_from(const std::string& text);

}  // namespace subimpact
