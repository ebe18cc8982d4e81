#include "integrate/sundials/linear_algebra.h"

#include <klu.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_version.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <stdexcept>
#include <string>

#include "integrate/sundials.h"
#include "numerics/vector_sum.h"

namespace subimpact {
namespace {

std::size_t size(N_Vector v) { return static_cast<std::size_t>(NV_LENGTH_S(v)); }

// z[i] = f(i); z may alias an operand entry by entry.
template <class F>
void fill(N_Vector z, F f) {
  double* out = NV_DATA_S(z);
  const std::size_t n = size(z);
#pragma GCC ivdep
  for (std::size_t i = 0; i < n; ++i) out[i] = f(i);
}

// Sum or maximum of f(i) in eight running parts, so that the compiler may vectorise it.
template <class F, class Join>
double reduce(std::size_t n, double start, F f, Join join) {
  constexpr std::size_t lanes = 8;
  double part[lanes];
  for (double& value : part) value = start;
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) part[lane] = join(part[lane], f(i + lane));
  }
  for (; i < n; ++i) part[0] = join(part[0], f(i));
  for (std::size_t lane = 1; lane < lanes; ++lane) part[0] = join(part[0], part[lane]);
  return part[0];
}
constexpr auto plus = [](double a, double b) { return a + b; };

// The operations SUNDIALS' integrators spend their time in; the library's own do for the rest.
void linear_sum(sunrealtype a, N_Vector x, sunrealtype b, N_Vector y, N_Vector z) {
  fill(z, [=, u = NV_DATA_S(x), v = NV_DATA_S(y)](std::size_t i) { return a * u[i] + b * v[i]; });
}
void constant(sunrealtype c, N_Vector z) {
  fill(z, [=](std::size_t) { return c; });
}
void divide(N_Vector x, N_Vector y, N_Vector z) {
  fill(z, [u = NV_DATA_S(x), v = NV_DATA_S(y)](std::size_t i) { return u[i] / v[i]; });
}
void scale(sunrealtype c, N_Vector x, N_Vector z) {
  if (c == 1.0 && x == z) return;
  fill(z, [=, u = NV_DATA_S(x)](std::size_t i) { return c * u[i]; });
}
sunrealtype max_norm(N_Vector x) {
  return reduce(
      size(x), 0.0, [u = NV_DATA_S(x)](std::size_t i) { return std::abs(u[i]); },
      [](double a, double b) { return std::max(a, b); });
}
sunrealtype dot(N_Vector x, N_Vector y) {
  return reduce(
      size(x), 0.0, [u = NV_DATA_S(x), v = NV_DATA_S(y)](std::size_t i) { return u[i] * v[i]; },
      plus);
}
sunrealtype wrms_norm(N_Vector x, N_Vector w) {
  const double sum = reduce(
      size(x), 0.0,
      [u = NV_DATA_S(x), v = NV_DATA_S(w)](std::size_t i) {
        const double weighted = u[i] * v[i];
        return weighted * weighted;
      },
      plus);
  return std::sqrt(sum / static_cast<double>(size(x)));
}

// High-order tables are full of zeros, which the sum leaves out. Further passes carry the sum so
// far along with weight 1; only the first vector may be z, so nothing is lost in between.
int linear_combination(int n, sunrealtype* c, N_Vector* x, N_Vector z) {
  VectorSum sum;
  double* out = NV_DATA_S(z);
  for (int k = 0; k < n; ++k) {
    if (sum.is_full()) {
      sum.write(out, size(z));
      sum = {};
      sum.add(1.0, out);
    }
    sum.add(c[k], NV_DATA_S(x[k]));
  }
  sum.write(out, size(z));
  return 0;
}

// SUNDIALS writes into what its own function returns, which is null where the memory is used up.
N_Vector clone(N_Vector vector) {
  N_Vector copy = N_VClone_Serial(vector);
  if (copy == nullptr) throw std::bad_alloc();
  return copy;
}

// Replaces the library's product, which Debian compiles without optimisation.
int multiply(SUNMatrix matrix, N_Vector x, N_Vector product) {
  const sunindextype* starts = SUNSparseMatrix_IndexPointers(matrix);
  const sunindextype* rows = SUNSparseMatrix_IndexValues(matrix);
  const double* all = SUNSparseMatrix_Data(matrix);
  const double* in = NV_DATA_S(x);
  double* out = NV_DATA_S(product);
  const auto n = static_cast<sunindextype>(size(x));
  std::fill_n(out, n, 0.0);
  for (sunindextype j = 0, k = 0; j < n; ++j) {
    const double factor = in[j];  // out does not overlap in
    for (const sunindextype end = starts[j + 1]; k < end; ++k) out[rows[k]] += all[k] * factor;
  }
  return 0;
}

}  // namespace

ContextPointer make_context() {
  SUNContext context = nullptr;
#if SUNDIALS_VERSION_MAJOR >= 7
  const int flag = SUNContext_Create(SUN_COMM_NULL, &context);
  if (flag == 0) SUNContext_ClearErrHandlers(context);  // each solver keeps its messages itself
#else
  const int flag = SUNContext_Create(nullptr, &context);
#endif
  if (flag != 0) throw std::runtime_error("SUNContext_Create failed");
  return {context, [](SUNContext made) { SUNContext_Free(&made); }};
}

VectorPointer make_vector(std::size_t n, SUNContext context, VectorOperations operations) {
  VectorPointer vector(N_VNew_Serial(static_cast<sunindextype>(n), context));
  if (!vector) throw std::bad_alloc();
  vector->ops->nvclone = clone;
  if (operations == VectorOperations::project) {
    auto& ops = *vector->ops;
    ops.nvlinearsum = linear_sum;
    ops.nvconst = constant;
    ops.nvdiv = divide;
    ops.nvscale = scale;
    ops.nvmaxnorm = max_norm;
    ops.nvdotprod = dot;
    ops.nvwrmsnorm = wrms_norm;
    ops.nvlinearcombination = linear_combination;
  } else {
    N_VEnableFusedOps_Serial(vector.get(), SUNTRUE);
  }
  return vector;
}

std::span<double> entries(N_Vector vector) {
  return {NV_DATA_S(vector), static_cast<std::size_t>(NV_LENGTH_S(vector))};
}

std::string sundials_version() {
  std::array<char, 64> text{};
  if (SUNDIALSGetVersion(text.data(), static_cast<int>(text.size())) != 0) {
    throw std::runtime_error("SUNDIALSGetVersion failed");
  }
  return text.data();
}

MatrixPointer make_sparse_matrix(const SparsityPattern& pattern, SUNContext context) {
  const auto n = static_cast<sunindextype>(pattern.size());
  const auto n_entries = static_cast<sunindextype>(pattern.n_entries());
  MatrixPointer matrix(SUNSparseMatrix(n, n, n_entries, CSC_MAT, context));
  if (!matrix) throw std::runtime_error("SUNSparseMatrix failed");
  matrix->ops->matvec = multiply;
  set_pattern(matrix.get(), pattern);
  const auto all = values(matrix.get(), pattern.n_entries());
  std::fill(all.begin(), all.end(), 0.0);
  return matrix;
}

void set_pattern(SUNMatrix matrix, const SparsityPattern& pattern) {
  const auto convert = [](std::size_t i) { return static_cast<sunindextype>(i); };
  std::transform(pattern.column_starts.begin(), pattern.column_starts.end(),
                 SUNSparseMatrix_IndexPointers(matrix), convert);
  std::transform(pattern.rows.begin(), pattern.rows.end(), SUNSparseMatrix_IndexValues(matrix),
                 convert);
}

std::span<double> values(SUNMatrix matrix, std::size_t n) {
  return {SUNSparseMatrix_Data(matrix), n};
}

LinearSolverPointer make_klu_solver(N_Vector like, SUNMatrix matrix, SUNContext context) {
  LinearSolverPointer solver(SUNLinSol_KLU(like, matrix, context));
  if (!solver) throw std::runtime_error("SUNLinSol_KLU failed");
  return solver;
}

bool analyses_next(SUNLinearSolver klu) {
  return static_cast<SUNLinearSolverContent_KLU>(klu->content)->first_factorize != 0;
}

std::string klu_version() {
  return std::to_string(KLU_MAIN_VERSION) + "." + std::to_string(KLU_SUB_VERSION) + "." +
         std::to_string(KLU_SUBSUB_VERSION);
}

}  // namespace subimpact
