#include "subimpact/study/judgement/judgement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/meshes.h"
#include "case/problem.h"
#include "simulate/settings/methods.h"

namespace subimpact {
namespace {

// The whole number nearest to x that is odd (or even), or just the nearest.
int nearest(double x, bool any, bool odd) {
  const int n = static_cast<int>(std::lround(x));
  if (any || (n % 2 != 0) == odd) return n;
  return x >= n ? n + 1 : n - 1;
}

// A mesh of the caller's own has no finer one.
std::optional<MeshDescriptor::Refinement> refinement_of(const Case& input) {
  if (input.parts.mesh) return std::nullopt;
  return descriptor_of(input.model.mesh).refinement;
}

}  // namespace

std::optional<int> mesh_order(const Case& input) {
  const auto refinement = refinement_of(input);
  return refinement ? std::optional(refinement->order(input)) : std::nullopt;
}

int mesh_count(const Case& input) {
  const auto refinement = refinement_of(input);
  return refinement ? input.model.*(refinement->count) : 1;
}

std::string mesh_words(const Case& input) {
  const auto refinement = refinement_of(input);
  if (!refinement) return input.parts.mesh ? "a mesh of its own" : "rigid";
  return fmt::format("{} {}", mesh_count(input), refinement->parts);
}

std::optional<Case> on_other_mesh(const Case& input, double factor) {
  const auto refinement = refinement_of(input);
  if (!refinement) return {};
  Case other = input;
  other.output.keep_no_rows();
  int& count = other.model.*(refinement->count);
  // An even number of elements has a node at mid-span: equal elements, with modes in closed form.
  const bool any = !uses_symmetry(input) && refinement->odd_in_half;
  count = nearest(factor * mesh_count(input), any, refinement->odd_in_half);
  if (count < refinement->fewest) return {};
  if (descriptor_of(input.solver.method).has_fixed_steps() && input.solver.step) {
    other.solver.step = std::min(*input.solver.step, largest_stable_step(other));
  }
  return other;
}

}  // namespace subimpact
