#include <algorithm>
#include <initializer_list>

#include "case/meshes.h"
#include "case/problem.h"
#include "simulate/methods.h"
#include "study/method_choice.h"
#include "subimpact/study/within.h"

namespace subimpact {
namespace {

constexpr double tolerance_of_rigid_bodies = 1e-10;

bool has_any(const GivenKeys& given, std::initializer_list<const char*> keys) {
  return std::any_of(keys.begin(), keys.end(), [&](const char* key) {
    return given.in_file.contains(key) || given.in_settings.contains(key);
  });
}

// Why elements, and mostly natural modes, suit a beam of which no section yields.
std::string elastic_reason(const Case& chosen) {
  if (chosen.solver.method != Method::exponential) return "the beam bends elastically";
  return may_yield(chosen) ? "no section yields, so that free flight is exact in natural modes; "
                             "contact, in which one might, is integrated by nystrom"
                           : "the beam bends elastically, so that natural modes are exact in time";
}

}  // namespace

OpenChoices open_choices(const GivenKeys& given) {
  OpenChoices open;
  open.size = !has_any(given, {"model.segments", "model.elements"});
  open.mesh = open.size &&
              !has_any(given, {"model.mesh", "model.spacing", "model.sections_per_element",
                               "model.hinges", "model.strike_refinement", "model.refined_length"});
  open.tolerance = !has_any(given, {"solver.rtol", "solver.step", "solver.max_step"});
  open.method =
      open.tolerance && !has_any(given, {"solver.method", "solver.table", "solver.max_order",
                                         "solver.events", "solver.reversals"});
  return open;
}

ChosenModel choose_model(const Case& input, const OpenChoices& open, bool yields) {
  ChosenModel chosen{input, {}};
  ModelOptions& model = chosen.input.model;
  SolverOptions& solver = chosen.input.solver;
  const bool own_mesh = input.parts.mesh != nullptr;
  const bool bends = own_mesh || descriptor_of(model.mesh).bends;
  if (!bends) {
    if (open.method) solver.method = method_for_damping(input, Method::nystrom);
    if (open.tolerance) solver.rtol = tolerance_of_rigid_bodies;
    chosen.reason = "a rigid body has no mesh to refine";
    return chosen;
  }
  const bool central = !open.method && solver.method == Method::central_difference;
  const bool shears = input.scene.beam.shears();
  if (open.mesh && !own_mesh) {
    const bool prefers_cells = yields || central;
    model.mesh = prefers_cells ? default_mesh(input)
                 : shears      ? MeshKind::spectral
                               : MeshKind::hermite;
    if (model.mesh == MeshKind::cells && !shears && input.accuracy.event_times) {
      // Else the error of free ends, of first order, is the last to fall.
      model.spacing = CellSpacing::whole;
    }
  }
  if (open.method && !yields) solver.method = Method::exponential;
  if (open.method && yields) {
    const bool cells = !own_mesh && model.mesh == MeshKind::cells;
    solver.method = cells ? Method::central_difference : Method::nystrom;
  }
  if (open.method) solver.method = method_for_damping(input, solver.method);
  if (open.method && mesh_has_own_step(chosen.input)) solver.method = Method::central_difference;
  const bool fixed = !open.method && !open.mesh;
  chosen.reason = fixed ? "the case fixes mesh and method"
                  : yields
                      ? "sections yield, so that kinks, not the order of a method, bound the error"
                      : elastic_reason(chosen.input);
  return chosen;
}

}  // namespace subimpact
