#include <limits>
#include <memory>
#include <utility>

#include "case/model_factory.h"
#include "integrate/arkode_ark.h"
#include "integrate/arkode_erk.h"
#include "integrate/central_difference.h"
#include "integrate/cvode.h"
#include "integrate/exponential.h"
#include "integrate/flying.h"
#include "integrate/nystrom.h"
#include "system/beam_flight.h"
#include "system/modal_beam.h"

namespace subimpact {

std::unique_ptr<Integrator> make_integrator(const Case& input, const Used& used, StruckBeam& beam) {
  if (input.solver.method == Method::central_difference) {
    return std::make_unique<CentralDifference>(beam, *used.step);
  }
  const bool flies = input.solver.method == Method::exponential && beam.sections().can_yield();
  if (input.solver.method == Method::nystrom || flies) {
    NystromOptions options;
    if (used.table) options.table = *used.table;
    options.relative_tolerance = input.solver.rtol;
    options.fixed_step = input.solver.step;
    options.max_step = input.solver.max_step;
    auto nystrom = std::make_unique<Nystrom>(beam, options);
    if (!flies) return nystrom;
    return std::make_unique<Flying>(
        std::move(nystrom), std::make_unique<BeamFlight>(beam),
        input.solver.max_step.value_or(std::numeric_limits<double>::infinity()));
  }
  if (input.solver.method == Method::exponential) {
    ExponentialOptions options;
    options.relative_tolerance = input.solver.rtol;
    options.fixed_step = input.solver.step;
    options.max_step = input.solver.max_step;
    return std::make_unique<Exponential>(std::make_unique<ModalBeam>(beam), options);
  }
  const VectorOperations vector_operations =
      input.solver.vector_operations == VectorOperationsKind::library ? VectorOperations::library
                                                                      : VectorOperations::project;
  if (input.solver.method == Method::adams || input.solver.method == Method::bdf) {
    CvodeOptions options;
    options.max_order = *used.max_order;
    options.relative_tolerance = input.solver.rtol;
    options.max_step = input.solver.max_step;
    options.vector_operations = vector_operations;
    return input.solver.method == Method::adams ? make_cvode_adams(beam, options)
                                                : make_cvode_bdf(beam, options);
  }
  if (input.solver.method == Method::dirk || input.solver.method == Method::imex) {
    ArkOptions options;
    options.table = *used.table;
    options.relative_tolerance = input.solver.rtol;
    options.fixed_step = input.solver.step;
    options.max_step = input.solver.max_step;
    options.vector_operations = vector_operations;
    return input.solver.method == Method::dirk ? make_arkode_dirk(beam, options)
                                               : make_arkode_imex(beam, options);
  }
  ErkOptions options;
  options.table = *used.table;
  options.relative_tolerance = input.solver.rtol;
  options.fixed_step = input.solver.step;
  options.max_step = input.solver.max_step;
  options.vector_operations = vector_operations;
  return make_arkode_erk(beam, options);
}

}  // namespace subimpact
