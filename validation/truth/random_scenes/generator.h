#pragma once

/// Random scenes: everything a case can say, drawn from a seed and the scene's number alone.

#include <cstdint>
#include <string>

#include "subimpact/case/case.h"

namespace subimpact::scenes {

/// What a scene is for, which sets what it may cost.
enum class Purpose {
  checks,      ///< one run, at the drawn setting
  counts,      ///< four runs, two of them at rtol 1e-10
  scene_keys,  ///< likewise, with two or more of the keys of scenes (scene_keys.h)
  slice        ///< one run of a test
};

constexpr const char* to_string(Purpose purpose) {
  constexpr const char* names[] = {"checks", "counts", "keys", "slice"};
  return names[static_cast<int>(purpose)];
}

struct SceneId {
  std::uint64_t seed = 1;
  int number = 0;
  Purpose purpose = Purpose::checks;
};

struct Drawn {
  Case input;
  int refused = 0;       ///< draws before this one that the program does not run
  int too_costly = 0;    ///< draws before this one that would have had to end too soon
  double seconds = 0.0;  ///< what it was thought to take, roughly
};

Drawn draw(const SceneId& id);

/// The scene as a case file.
std::string case_text(const Case& input);

}  // namespace subimpact::scenes
