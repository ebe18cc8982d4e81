#include <algorithm>
#include <initializer_list>

#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

bool has_any(const GivenKeys& given, std::initializer_list<const char*> keys) {
  return std::ranges::any_of(keys, [&](const char* key) { return given.contain(key); });
}

}  // namespace

OpenChoices open_choices(const GivenKeys& given) {
  OpenChoices open;
  open.size = !has_any(given, {"model.segments", "model.elements"});
  open.mesh = open.size && !has_any(given, {"model.mesh", "model.spacing", "model.hinges"});
  open.tolerance = !has_any(given, {"solver.rtol", "solver.step", "solver.max_step"});
  open.method =
      open.tolerance && !has_any(given, {"solver.method", "solver.table", "solver.max_order",
                                         "solver.events", "solver.reversals"});
  return open;
}

}  // namespace subimpact
