#include "subimpact/study/run_as_asked.h"

#include "case/meshes.h"
#include "study/mesh_resolution.h"
#include "subimpact/case/simulate.h"

namespace subimpact {
namespace {

constexpr double usual_poisson = 0.3;
// The contact with shear is looked for up to this many times the end of that without.
constexpr double longest = 3.0;

Case coarse_case(const Case& input, const Result& result, double end_of_first) {
  Case coarse = input;
  coarse.title.clear();
  coarse.end_time = longest * end_of_first;
  coarse.stop = StopRule::end_time;
  coarse.scene.beam.damping = {};
  coarse.scene.contact.damping = 0.0;
  coarse.model = {};
  coarse.model.section = input.model.section;
  coarse.model.layers = input.model.layers;
  coarse.solver = {};
  coarse.solver.method = Method::central_difference;
  coarse.accuracy = {};
  coarse.output = {};
  coarse.output.keep_no_rows();
  // An odd number has a centre at mid-span.
  const int cells = parts_that_resolve(coarse, result.used.contact_time, most_cells_at_first);
  coarse.model.segments = 2 * (cells / 2) + 1;
  return coarse;
}

std::optional<double> end_of_first(const Case& input) {
  try {
    const Result result = simulate(input);
    if (!result.outcome.completed() || result.sub_impacts.empty()) return std::nullopt;
    return result.sub_impacts.front().end;
  } catch (const InvalidCase&) {  // of numbers that only such a mesh cannot hold
    return std::nullopt;
  }
}

}  // namespace

std::optional<NeglectedShear> neglected_shear(const Case& input, const Result& result) {
  const bool has_cells = descriptor_of(input.model.mesh).bends && !input.parts.mesh;
  if (!has_cells || input.scene.beam.shears()) return std::nullopt;
  if (result.sub_impacts.empty() || !result.sub_impacts.front().end) return std::nullopt;
  Case coarse = coarse_case(input, result, *result.sub_impacts.front().end);
  const std::optional<double> without = end_of_first(coarse);
  if (!without) return std::nullopt;
  Beam& beam = coarse.scene.beam;
  beam.theory = BeamTheory::timoshenko;
  if (!coarse.scene.beam_poisson()) beam.poisson = usual_poisson;
  if (!beam.poisson) beam.poisson = coarse.scene.beam_poisson();
  return NeglectedShear{*without, end_of_first(coarse)};
}

}  // namespace subimpact
