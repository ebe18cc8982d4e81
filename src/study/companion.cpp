#include "subimpact/study/companion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "case/meshes.h"
#include "case/problem.h"
#include "simulate/methods.h"
#include "study/error_part.h"
#include "study/mesh_resolution.h"
#include "study/run_beside.h"
#include "subimpact/study/mesh_error_bars.h"

namespace subimpact {
namespace {

// Stated error over the error that a difference stands for, measured to cover 98 % of event times
// on random scenes (validation/error_bars). Sections that yield and hinges make times converge
// unevenly; elements of fourth order come from meshes too coarse to be in their asymptotic range.
constexpr double safety = 2.1;
constexpr double safety_if_yielding = 3.0;
constexpr double safety_of_high_order = 5.0;
constexpr double safety_with_hinges = 4.0;
constexpr double looser = 10.0;  // rtol
constexpr double loosest = 1e-1;
// A default step that grows less than this from mesh to mesh is limited by the contact.
constexpr double least_step_ratio = 1.4;

// Stated error over difference.
double error_factor(const Companion& companion, bool yielded) {
  if (companion.ratio <= 1.0) return safety / (looser - 1.0);
  Case mesh = companion.input;
  const bool uneven =
      yielded && mesh.model.mesh == MeshKind::hermite && mesh.model.hinges == HingeUse::automatic;
  if (!yielded) mesh.model.section = SectionKind::elastic;
  const int order = *mesh_order(mesh);
  const double factor = uneven      ? safety_with_hinges
                        : yielded   ? safety_if_yielding
                        : order > 2 ? safety_of_high_order
                                    : safety;
  return factor / (std::pow(companion.ratio, order) - 1.0);
}

// Twice the step, or the largest that is stable.
double doubled_step(const Case& coarser, double step) {
  const bool bounded = descriptor_of(coarser.solver.method).steps == MethodDescriptor::Steps::fixed;
  if (!bounded) return 2.0 * step;
  return std::max(step, std::min(2.0 * step, largest_stable_step(coarser)));
}

// What the method does in time, coarser; in words where it is not the default of the mesh.
std::string coarsen_time(const Case& input, Case& coarser) {
  const std::optional<double> step = step_of(input);
  if (!step) {
    coarser.solver.rtol = std::min(looser * input.solver.rtol, loosest);
    return fmt::format("rtol = {:.3g}", coarser.solver.rtol);
  }
  if (!input.solver.step) {
    const std::optional<double> by_default = step_of(coarser);
    if (by_default && *by_default >= least_step_ratio * *step) {
      return fmt::format("a step of {:.4g} us", 1e6 * *by_default);
    }
  }
  coarser.solver.step = doubled_step(coarser, *step);
  return fmt::format("a step of {:.4g} us", 1e6 * *coarser.solver.step);
}

}  // namespace

std::optional<Companion> companion_of(const Case& input) {
  try {
    const std::optional<RefinedRun> coarser_mesh = on_other_mesh(input, 0.5);
    Companion companion;
    companion.input = coarser_mesh ? coarser_mesh->input : input;
    companion.input.solver.step = input.solver.step;
    companion.input.output.keep_no_rows();
    const std::string in_time = coarsen_time(input, companion.input);
    if (!coarser_mesh) {
      companion.name = "time";
      companion.description = "the same with " + in_time;
      return companion;
    }
    companion.ratio = static_cast<double>(mesh_count(input)) / mesh_count(companion.input);
    companion.name = "mesh and time";
    companion.description = coarser_mesh->description + " and " + in_time;
    resolve(companion.input);
    return companion;
  } catch (const InvalidCase&) {  // of the coarser run
    return std::nullopt;
  }
}

void add_companion_errors(Result& result, const Case& input, const Companion& companion,
                          const Result& other) {
  const bool yielded = result.n_yielded_sections > 0 || other.n_yielded_sections > 0;
  ErrorPart part = compare_events(result, other, companion.name, companion.description,
                                  error_factor(companion, yielded));
  include_free_ends(part, input, result);
  set_error_bars(result, {part});
  doubt_unresolved_contacts(result, input);
}

double memory_with_companion(const Case& input, const ResolvedSettings& settings) {
  const std::optional<Companion> companion = companion_of(input);
  return settings.memory + (companion ? resolve(companion->input).settings().memory : 0.0);
}

Result simulate_with_companion(const Case& input, Jobs jobs, const Progress& progress,
                               RowSink* rows) {
  resolve(input);  // whatever is wrong with the case itself
  const std::optional<Companion> companion = companion_of(input);
  if (!companion) return simulate(input, progress, nullptr, rows);
  RunPair pair = run_beside(input, &companion->input, jobs, progress, rows);
  if (pair.other) add_companion_errors(pair.run, input, *companion, *pair.other);
  return std::move(pair.run);
}

}  // namespace subimpact
