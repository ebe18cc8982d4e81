#include <cvode/cvode.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "integrate/sundials/cvode_integrator.h"

namespace subimpact {
namespace {

struct FreeNonlinearSolver {
  void operator()(SUNNonlinearSolver solver) const { SUNNonlinSolFree(solver); }
};

class Adams final : public CvodeIntegrator {
 public:
  Adams(SecondOrderOde& ode, const CvodeOptions& options)
      : CvodeIntegrator(ode, CV_ADAMS, options),
        iteration_(SUNNonlinSol_FixedPoint(vector(), 0, context())) {
    if (!iteration_) throw IntegrationFailure(0.0, "SUNNonlinSol_FixedPoint", "no memory", "");
    check(CVodeSetNonlinearSolver(memory(), iteration_.get()), "CVodeSetNonlinearSolver");
  }

 private:
  std::unique_ptr<std::remove_pointer_t<SUNNonlinearSolver>, FreeNonlinearSolver> iteration_;
};

}  // namespace

std::unique_ptr<Integrator> make_cvode_adams(SecondOrderOde& ode, const CvodeOptions& options) {
  return std::make_unique<Adams>(ode, options);
}

}  // namespace subimpact
