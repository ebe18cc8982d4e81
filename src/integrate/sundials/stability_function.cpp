#include <vector>

#include "integrate/stability.h"
#include "integrate/sundials/butcher_tables.h"

namespace subimpact {
namespace {

using Complex = std::complex<double>;

// Stages one after the other; none depends on a later one.
Complex stability(const ARKodeButcherTableMem& table, Complex z) {
  std::vector<Complex> stages(static_cast<std::size_t>(table.stages));
  Complex end = 1.0;
  for (int i = 0; i < table.stages; ++i) {
    Complex sum = 1.0;
    for (int j = 0; j < i; ++j) sum += z * table.A[i][j] * stages[static_cast<std::size_t>(j)];
    stages[static_cast<std::size_t>(i)] = sum / (1.0 - z * table.A[i][i]);
    end += z * table.b[i] * stages[static_cast<std::size_t>(i)];
  }
  return end;
}

}  // namespace

Complex explicit_stability(const std::string& table, Complex z) {
  return stability(*load_explicit_table(table), z);
}

Complex dirk_stability(const std::string& table, Complex z) {
  return stability(*load_dirk_table(table), z);
}

}  // namespace subimpact
