#include <cvode/cvode.h>
#include <cvode/cvode_ls.h>

#include "integrate/sundials/cvode_integrator.h"
#include "integrate/sundials/reduced_newton.h"

namespace subimpact {
namespace {

class Bdf final : public CvodeIntegrator {
 public:
  Bdf(MechanicalSystem& system, const CvodeOptions& options)
      : CvodeIntegrator(system, CV_BDF, options), newton_(system, context()) {
    check(CVodeSetLinearSolver(memory(), newton_.solver(), newton_.matrix()),
          "CVodeSetLinearSolver");
    check(CVodeSetLinSysFn(memory(), newton_matrix), "CVodeSetLinSysFn");
  }

  WorkCounts work() const override {
    WorkCounts counts = CvodeIntegrator::work();
    newton_.add_counts(counts);
    return counts;
  }

 private:
  static int newton_matrix(sunrealtype, N_Vector y, N_Vector, SUNMatrix,
                           sunbooleantype keep_stiffness, sunbooleantype* updated,
                           sunrealtype gamma, void* frame, N_Vector, N_Vector, N_Vector) {
    auto& self = static_cast<Bdf&>(static_cast<CvodeIntegrator&>(of(frame)));
    *updated = keep_stiffness ? SUNFALSE : SUNTRUE;
    return self.guarded([&] {
      if (!keep_stiffness) self.newton_.update_stiffness(entries(y).first(self.n_positions_));
      self.newton_.assemble(gamma);
    });
  }

  ReducedNewton newton_;
};

}  // namespace

std::unique_ptr<Integrator> make_cvode_bdf(MechanicalSystem& system, const CvodeOptions& options) {
  return std::make_unique<Bdf>(system, options);
}

}  // namespace subimpact
