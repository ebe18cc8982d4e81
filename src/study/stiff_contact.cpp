#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "case/problem.h"
#include "integrate/central_difference.h"
#include "numerics/bracketed_root.h"
#include "simulate/run_parts.h"
#include "study/method_choice.h"
#include "study/parallel.h"
#include "subimpact/study/stability.h"
#include "system/contact_resonance.h"

namespace subimpact {
namespace {

constexpr int n_steps = 600;
constexpr double blown_up = 1e6;  // of the energy at the start; bounded motion stays near it
constexpr double limit_tolerance = 1e-4;  // relative
constexpr double decades[] = {-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0};

// Beam and striker, held together by a spring that pulls as well as it pushes.
StruckBeam held_together(const Case& input, double stiffness) {
  Case trial = with_method(input, "central-difference");
  trial.model.section = SectionKind::elastic;
  trial.scene.contact = {};
  trial.parts.contact_law = nullptr;
  trial.scene.contact.kind = ContactKind::linear;
  trial.scene.contact.stiffness = stiffness;
  trial.scene.striker.nose_radius.reset();
  StruckBeam beam = make_struck_beam(problem_of(trial), trial, Coordinates::of_mesh);
  beam.contact().set(ContactBranch::elastic, {});
  return beam;
}

// Whether central differences blow up from a state that holds something of every mode.
bool blows_up(StruckBeam& beam, double step) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> velocity(-1.0, 1.0);
  const std::size_t n = beam.n_positions();
  State y(2 * n, 0.0);
  for (std::size_t i = n; i < 2 * n; ++i) y[i] = velocity(random);
  double size = 0.0;
  for (const double v : y) size += v * v;
  CentralDifference method(beam, step);
  method.restart(0.0, y);
  for (int i = 0; i < n_steps; ++i) method.step();
  double end = 0.0;
  for (std::size_t i = n; i < 2 * n; ++i) end += method.state()[i] * method.state()[i];
  return !(end < blown_up * size);
}

}  // namespace

std::vector<StiffContact> stiff_contact(const Case& input) {
  std::vector<StiffContact> list;
  for (const double decade : decades) {
    StiffContact row;
    row.stiffness = decade;
    list.push_back(row);
  }
  in_parallel(list.size(), [&](std::size_t i) {
    StiffContact& row = list[i];
    Case trial = with_method(input, "central-difference");
    trial.model.section = SectionKind::elastic;
    const double beam_alone = resolve(trial).settings().highest_frequency;
    row.beam_only = 2.0 / beam_alone;
    // The unit is the spring that alone oscillates as fast as the mesh on a cell's mass.
    const double cell_mass = trial.scene.beam.mass() / trial.model.segments;
    row.stiffness = std::pow(10.0, row.stiffness) * cell_mass * beam_alone * beam_alone;
    StruckBeam beam = held_together(trial, row.stiffness);
    row.predicted =
        2.0 / contact_resonance(beam, std::numeric_limits<double>::infinity()).highest_frequency;
    const auto is_stable = [&](double step) { return !blows_up(beam, step); };
    row.measured =
        bisect(is_stable, 0.05 * row.predicted, 1.5 * row.beam_only, limit_tolerance).first;
  });
  return list;
}

}  // namespace subimpact
