#pragma once

/// Scenes of scenes.py with their events, as this program runs them.

#include <cstddef>
#include <string>
#include <vector>

#include "subimpact/simulate/simulate.h"

namespace grazes {

struct Mode {
  double mass, stiffness, displacement;  ///< kg, N/m, of the struck point
};

struct Event {
  bool begins;
  double time;  ///< s
};

/// A striker meets modes through a spring that pushes only.
struct Scene {
  std::string family;  ///< "one-mode" or "beam"
  int number;
  std::string kind;  ///< "opening" of a contact or "closing" of a gap
  double depth;      ///< of the graze, over the amplitude; negative: a near miss
  double time;       ///< s, of the extremum
  double duration;   ///< s, of the graze
  double end;        ///< s
  double striker_mass, velocity, stiffness;
  std::vector<Mode> modes;
  std::vector<Event> events;  ///< to 25 digits in the file

  bool touches() const { return depth > 0.0; }
  double highest_frequency() const;  ///< rad/s, of the modes
  /// rad/s, an upper bound while in contact.
  double fastest() const;
};

std::vector<Scene> read_scenes(const std::string& file);

/// Of striker, mesh and contact law of the study's own.
subimpact::Problem problem_of(const Scene& scene);

}  // namespace grazes
