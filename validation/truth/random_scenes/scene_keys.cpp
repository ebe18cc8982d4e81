#include "random_scenes/scene_keys.h"

#include <cmath>
#include <vector>

#include "random_scenes/cost.h"

namespace subimpact::scenes {
namespace {

double sign(Random& random) { return random.chance(0.5) ? 1.0 : -1.0; }

// What a scene's keys are measured by.
struct Scales {
  double velocity;      // m/s, of the strike
  double time;          // s, of a contact or of a few
  double acceleration;  // m/s2: turns the velocity round in the time
  double stiffness;     // N/m, of the beam at mid-span
};

// On a beam that nothing holds, or that turns about a pin.
void draw_motion(Random& random, double velocity, Beam& beam) {
  const bool turns = !beam.is_free() || random.chance(0.3);
  if (!turns || random.chance(0.3)) beam.velocity = velocity;
  if (turns) beam.angular_velocity = 2.0 * velocity / beam.length;
}

void draw_stop(Random& random, const Scales& scales, Scene& scene) {
  const double position = scene.striker.position;
  scene.beam.velocity = scene.beam.angular_velocity = 0.0;
  if (scene.beam.is_free()) {
    scene.beam.velocity = -scales.velocity;
  } else {
    const double arm = scene.beam.length * (position - scene.beam.used_pivot());
    scene.beam.angular_velocity = -scales.velocity / (arm != 0.0 ? arm : scene.beam.length);
  }
  if (random.chance(0.3)) scene.striker.gap = scales.velocity * scales.time;
  scene.striker.fixed = true;
  scene.striker.mass = scene.striker.velocity = 0.0;
}

PointForce draw_force(Random& random, const Scales& scales, double mass) {
  PointForce force{random.uniform()};
  const auto value = [&] {
    return sign(random) * mass * scales.acceleration * random.log_uniform(1e-3, 0.3);
  };
  if (random.chance(0.4)) {
    force.table = {{0.0, value()}};
    return force;
  }
  double time = random.chance(0.5) ? 0.0 : scales.time * random.uniform();
  for (std::size_t n = 2 + random.index(4); n > 0; --n) {
    force.table.push_back({time, value()});
    if (random.chance(0.8)) time += scales.time * random.log_uniform(0.05, 3.0);
  }
  return force;
}

void draw_one(Random& random, const Scales& scales, Case& input) {
  Scene& scene = input.scene;
  Beam& beam = scene.beam;
  switch (random.index(9)) {
    case 0:
      scene.gravity = scales.acceleration * random.log_uniform(1e-4, 0.3) * sign(random);
      break;
    case 1:
      scene.striker.drop_height = 1.0;  // set when all keys are there
      break;
    case 2:
      scene.striker.gap = scales.velocity * scales.time * random.log_uniform(1e-2, 3.0);
      break;
    case 3:
      draw_stop(random, scales, scene);
      break;
    case 4:
      draw_motion(random, scales.velocity * random.uniform(-0.5, 0.5), beam);
      break;
    case 5:
      beam.load = sign(random) * beam.mass_per_length() * scales.acceleration *
                  random.log_uniform(1e-3, 0.3);
      if (random.chance(0.3)) beam.start = BeamStart::equilibrium;
      break;
    case 6:
      beam.forces.push_back(draw_force(random, scales, beam.mass()));
      break;
    case 7:
      beam.springs.push_back({random.chance(0.4) ? 0.5 : random.uniform(),
                              scales.stiffness * random.log_uniform(1e-2, 1e2)});
      break;
    default:
      beam.foundation = scales.stiffness / beam.length * random.log_uniform(1e-2, 1e2);
  }
}

std::vector<const char*> names_of(const Scene& scene) {
  const Beam& beam = scene.beam;
  std::vector<const char*> names;
  const auto add = [&](bool is_there, const char* name) {
    if (is_there) names.push_back(name);
  };
  add(scene.gravity != 0.0, "gravity");
  add(scene.striker.drop_height.has_value(), "fall");
  add(scene.striker.gap > 0.0, "gap");
  add(scene.striker.fixed, "stop");
  add(beam.moves_at_start(), "moving beam");
  add(beam.load != 0.0, "load");
  add(!beam.forces.empty(), "forces");
  add(!beam.springs.empty(), "springs");
  add(beam.foundation > 0.0, "bedding");
  add(beam.start == BeamStart::equilibrium, "equilibrium");
  return names;
}

}  // namespace

void draw_scene_keys(Random& random, Case& input) {
  Scene& scene = input.scene;
  const double velocity = scene.striker.velocity;
  const double time = contact_time(input) * random.log_uniform(0.5, 5.0);
  const Scales scales{velocity, time, velocity / time,
                      48.0 * scene.beam.bending_stiffness() / std::pow(scene.beam.length, 3)};
  do {
    draw_one(random, scales, input);
  } while (names_of(scene).size() < 2 || random.chance(0.4));
  if (!scene.striker.drop_height) return;
  const double g = scene.gravity != 0.0 ? std::abs(scene.gravity) : standard_gravity;
  scene.striker.drop_height = velocity * velocity / (2.0 * g);
  scene.striker.velocity = 0.0;
}

std::string scene_keys_of(const Case& input) {
  std::string text;
  for (const char* name : names_of(input.scene)) text += std::string(", ") + name;
  return text;
}

}  // namespace subimpact::scenes
