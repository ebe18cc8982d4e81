#include "case/other_names.h"

#include <cctype>

namespace subimpact {
namespace {

/// A choice as other programs and textbooks call it: in lower case, with hyphens between words.
struct OtherName {
  const char* key;
  const char* name;
  const char* own;
};

constexpr OtherName other_names[] = {
    {"beam.ends", "fixed", "clamped"},
    {"beam.ends", "built-in", "clamped"},
    {"beam.ends", "encastre", "clamped"},
    {"beam.ends", "encastered", "clamped"},
    {"beam.ends", "rigid", "clamped"},
    {"beam.ends", "simply-supported", "pinned"},
    {"beam.ends", "simple", "pinned"},
    {"beam.ends", "simple-support", "pinned"},
    {"beam.ends", "supported", "pinned"},
    {"beam.ends", "ss", "pinned"},
    {"beam.ends", "hinged", "pinned"},
    {"beam.ends", "hinge", "pinned"},
    {"beam.ends", "roller", "pinned"},
    {"solver.method", "rk4", "erk"},
    {"solver.method", "rk45", "erk"},
    {"solver.method", "ode45", "erk"},
    {"solver.method", "dopri5", "erk"},
    {"solver.method", "dop853", "erk"},
    {"solver.method", "runge-kutta", "erk"},
    {"solver.method", "rkn", "nystrom"},
    {"solver.method", "nystroem", "nystrom"},
    {"solver.method", "runge-kutta-nystrom", "nystrom"},
    {"solver.method", "explicit", "central-difference"},
    {"solver.method", "leapfrog", "central-difference"},
    {"solver.method", "verlet", "central-difference"},
    {"solver.method", "newmark", "central-difference"},
    {"solver.method", "cd", "central-difference"},
    {"solver.method", "implicit", "dirk"},
    {"solver.method", "gear", "bdf"},
    {"solver.method", "modal", "exponential"},
    {"beam.theory", "bernoulli", "euler-bernoulli"},
    {"beam.theory", "bernoulli-euler", "euler-bernoulli"},
    {"beam.theory", "euler", "euler-bernoulli"},
    {"model.mesh", "finite-elements", "hermite"},
    {"model.mesh", "elements", "hermite"},
    {"model.mesh", "fem", "hermite"},
    {"model.mesh", "finite-differences", "cells"},
    {"model.mesh", "segments", "cells"},
    {"study.mass_solver", "tridiagonal", "banded"},
};

std::string spelt_alike(std::string_view name) {
  std::string text;
  for (const char c : name) {
    const bool between_words = c == ' ' || c == '_';
    text += between_words ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return text;
}

}  // namespace

const std::vector<MovedKey>& moved_keys() {
  static const std::vector<MovedKey> keys = {
      {"beam.height", "beam.thickness"},
      {"beam.modulus", "beam.youngs_modulus"},
      {"beam.supports", "beam.ends"},
      {"striker.radius", "striker.nose_radius"},
      {"striker.speed", "striker.velocity"},
      {"model.cells", "model.segments"},
      {"time.end_time", "time.end"},
      {"solver.tolerance", "solver.rtol"},
      {"solver.dt", "solver.step"},
      {"solver.vector_operations", "study.vector_operations"},
      {"solver.mass_solver", "study.mass_solver"},
      {"solver.pair_detection", "study.pair_detection"},
      {"solver.beyond_critical", "study.beyond_critical"},
  };
  return keys;
}

const char* moved_to(std::string_view old_name) {
  for (const MovedKey& key : moved_keys()) {
    if (key.old_name == old_name) return key.new_name;
  }
  return nullptr;
}

std::string own_name(std::string_view key, std::string_view name) {
  const std::string wanted = spelt_alike(name);
  for (const OtherName& other : other_names) {
    if (other.key == key && other.name == wanted) return other.own;
  }
  return {};
}

}  // namespace subimpact
