#pragma once

#include <functional>
#include <vector>

#include "random_scenes/run.h"

namespace subimpact::scenes {

/// Runs scenes in as many processes, so that one that crashes or hangs is told from the others.
/// `done` gets the records as they come, in no particular order.
void run_scenes(const std::vector<SceneId>& scenes, int processes, double limit,
                const std::function<void(const Record&)>& done);

}  // namespace subimpact::scenes
