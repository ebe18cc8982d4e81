#include "body/scenes.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "draws.h"

namespace subimpact::body {
namespace {

struct Metal {
  const char* name;
  double modulus, density;
};
constexpr std::array metals{Metal{"S235", 210e9, 7850.0}, Metal{"S355", 210e9, 7850.0},
                            Metal{"6082-T6", 70e9, 2700.0}, Metal{"1.4301", 200e9, 7900.0}};

enum class Kind { free, pinned, clamped, cantilever, plane, rigid, hollow };
constexpr int n_kinds = 7;

struct Scene {
  Kind kind;
  Metal metal;
  double length, height, width;

  double mass() const { return metal.density * length * width * height; }
  double period() const {  // of a solid beam
    const double root = kind == Kind::cantilever ? 1.875
                        : kind == Kind::pinned   ? std::numbers::pi
                                                 : 4.73;
    const double bending = std::sqrt(metal.modulus / (12.0 * metal.density)) * height;
    return 2.0 * std::numbers::pi * std::pow(length / root, 2) / bending;
  }
};

Scene draw_scene(Random& random, int number) {
  Scene scene{static_cast<Kind>(number % n_kinds), random.one_of(metals), 0.0, 0.0, 0.0};
  scene.length = random.log_uniform(0.05, 1.2);
  scene.height = scene.length * random.log_uniform(1.0 / 80.0, 1.0 / 12.0);
  scene.width = scene.height * random.log_uniform(1.0, 5.0);
  return scene;
}

std::string section_of(Random& random, const Scene& scene) {
  if (scene.kind != Kind::hollow) {
    return fmt::format("width = {:.4g}\nthickness = {:.4g}\n", scene.width, scene.height);
  }
  const double wall = scene.height * random.log_uniform(0.06, 0.15);
  if (random.chance(0.5)) {
    return fmt::format("section = {{ shape = \"tube\", diameter = {:.4g}, wall = {:.4g} }}\n",
                       scene.height, wall);
  }
  return fmt::format(
      "section = {{ shape = \"box\", height = {:.4g}, width = {:.4g}, wall = {:.4g} }}\n",
      scene.height, scene.width, wall);
}

std::string beam_of(Random& random, const Scene& scene, bool is_stop) {
  std::string text = "[beam]\n";
  if (scene.kind == Kind::plane)
    return text + "fixed = true\nmaterial = \"" + scene.metal.name + "\"\n";
  text += fmt::format("material = \"{}\"\nlength = {:.4g}\n", scene.metal.name, scene.length) +
          section_of(random, scene);
  const char* ends = scene.kind == Kind::pinned                         ? "pinned\", \"pinned"
                     : scene.kind == Kind::clamped                      ? "clamped\", \"clamped"
                     : scene.kind == Kind::cantilever                   ? "clamped\", \"free"
                     : scene.kind == Kind::hollow && random.chance(0.5) ? "pinned\", \"pinned"
                                                                        : "free\", \"free";
  text += fmt::format("ends = [\"{}\"]\n", ends);
  // Deflects a stopped cantilever by two to twenty times the gap.
  const double weight = 9.81 * scene.mass() / scene.length;
  if (is_stop)
    text += fmt::format("load = {:.4g}\n", weight * random.log_uniform(20.0, 400.0));
  else if (scene.kind != Kind::free && scene.kind != Kind::rigid && random.chance(0.15)) {
    text += fmt::format("load = {:.4g}\nstart = \"equilibrium\"\n",
                        weight * random.log_uniform(1.0, 20.0));
  }
  return text;
}

std::string contact_of(Random& random, const Scene& scene, bool is_ball) {
  const double kind = random.uniform();
  if (scene.kind != Kind::plane && kind < 0.1) {
    return fmt::format("[contact]\nlaw = \"linear\"\nstiffness = {:.4g}\n",
                       random.log_uniform(1e5, 1e8));
  }
  if (!is_ball || kind < 0.5) return "";
  return "[contact]\nstriker_modulus = 210e9\nstriker_poisson = 0.3\n";
}

}  // namespace

std::string case_text(std::uint64_t seed, int number) {
  Random random(seed * 1000003 + static_cast<std::uint64_t>(number));
  random.next();
  const Scene scene = draw_scene(random, number);
  const bool bends = scene.kind != Kind::plane && scene.kind != Kind::rigid;
  const bool is_stop = scene.kind == Kind::cantilever && random.chance(0.3);
  const bool is_ball =
      scene.kind == Kind::plane || scene.kind == Kind::hollow || is_stop || random.chance(0.6);
  std::string text = beam_of(random, scene, is_stop);
  const bool is_damped = bends && random.chance(0.25);
  const bool is_elastic = is_damped || is_stop || random.chance(0.2);
  if (is_damped)
    text += fmt::format("damping = {{ ratio = {:.3g} }}\n", random.log_uniform(0.002, 0.03));
  text += "[striker]\n";
  text += fmt::format("nose = \"{}\"\nnose_radius = {:.4g}\n", is_ball ? "sphere" : "cylinder",
                      random.log_uniform(0.003, 0.03));
  const bool drops = random.chance(0.3), weighs = drops || random.chance(0.2);
  if (is_stop) {
    text += fmt::format("fixed = true\nposition = {:.3g}\ngap = {:.3g}\n", random.uniform(0.7, 1.0),
                        0.01 * scene.height * random.log_uniform(0.2, 2.0));
  } else {
    const double mass = bends ? scene.mass() : 1.0;
    text += fmt::format("mass = {:.4g}\n", mass * random.log_uniform(0.05, 5.0));
    text += drops ? fmt::format("drop_height = {:.4g}\n", random.log_uniform(0.01, 1.0))
                  : fmt::format("velocity = {:.4g}\n", random.log_uniform(0.2, 8.0));
    const double from = scene.kind == Kind::cantilever ? 0.5 : 0.2;
    const double to = scene.kind == Kind::cantilever ? 1.0 : 0.8;
    const bool is_middle = scene.kind != Kind::cantilever && random.chance(0.5);
    if (scene.kind != Kind::plane) {
      text += fmt::format("position = {:.3g}\n", is_middle ? 0.5 : random.uniform(from, to));
    }
  }
  text += contact_of(random, scene, is_ball);
  if (weighs && !is_stop && random.chance(0.6)) text += "[scene]\ngravity = 9.81\n";
  text += fmt::format("[time]\nend = {:.4g}\n",
                      bends ? scene.period() * random.log_uniform(0.3, 2.0) : 2e-3);
  std::string model;
  if (is_elastic) model += "section = \"elastic\"\n";
  if (scene.kind == Kind::rigid) model += "mesh = \"rigid\"\n";
  return model.empty() ? text : text + "[model]\n" + model;
}

}  // namespace subimpact::body
