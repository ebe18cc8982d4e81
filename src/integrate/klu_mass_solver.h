#pragma once

#include <memory>

#include "numerics/mass_solver.h"

namespace subimpact {

/// The mass matrix factored once by KLU (SuiteSparse), a general sparse LU. Throws
/// std::runtime_error with KLU's status if it cannot be factored.
std::unique_ptr<MassSolver> make_klu_mass_solver(const BandedMatrix& mass);

}  // namespace subimpact
