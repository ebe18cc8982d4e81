#include "simulate/modal_choice.h"

#include "simulate/methods.h"

namespace subimpact {
namespace {

// Measured on 20,001 cells: the program, and per unknown the dirk method, which takes the most.
constexpr double memory_of_program = 12e6;       // bytes
constexpr double memory_per_unknown = 4e3;       // bytes
constexpr double matrices_of_modes = 1.0;        // shapes
constexpr double matrices_of_dense_modes = 6.0;  // and mass, stiffness, decomposition
constexpr double matrices_of_flight = 3.0;       // of free flight beside the modes

// Modes of n = 600 unknowns take 0.5 s by dense decomposition, as 600^3/2 entries of right-hand
// sides do, and some 4 ms in closed form.
constexpr double work_per_dense_mode = 0.5;
constexpr double work_per_closed_entry = 2.0;

bool has_modes(const Options& options, const StruckBeam& beam) {
  return in_modes(options, beam.mesh(), beam.damping()) ||
         options.stop == StopRule::no_more_contact;
}

}  // namespace

bool in_modes(const Options& options, const BeamMesh& mesh, const BeamDamping& damping) {
  const MethodDescriptor::Modes modes = descriptor_of(options.solver.method).modes;
  if (modes != MethodDescriptor::Modes::where_cheaper) {
    return modes == MethodDescriptor::Modes::always;
  }
  return damping.ratio > 0.0 ||
         (mesh.prefers_modes() && options.study.mass_solver == MassSolverKind::banded);
}

bool modes_are_left_out(const Options& options, const StruckBeam& beam) {
  return beam.mesh().modal_stiffness().empty() && !beam.sections().can_yield() &&
         in_modes(options, beam.mesh(), beam.damping());
}

double decomposition_of(const Options& options, const StruckBeam& beam) {
  if (!has_modes(options, beam)) return 0.0;
  const BeamMesh& mesh = beam.mesh();
  const auto n = static_cast<double>(mesh.n_unknowns());
  return mesh.has_closed_modes() ? work_per_closed_entry * n * n : work_per_dense_mode * n * n * n;
}

double memory_of(const Options& options, const StruckBeam& beam) {
  const BeamMesh& mesh = beam.mesh();
  const auto n = static_cast<double>(mesh.n_unknowns());
  const bool yields = beam.sections().can_yield();
  const bool flies = yields && in_modes(options, mesh, beam.damping());
  const double of_modes = mesh.has_closed_modes() ? matrices_of_modes : matrices_of_dense_modes;
  const double matrices =
      (has_modes(options, beam) ? of_modes : 0.0) + (flies ? matrices_of_flight : 0.0);
  return memory_of_program + memory_per_unknown * n + sizeof(double) * matrices * n * n;
}

}  // namespace subimpact
