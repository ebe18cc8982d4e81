#include <cmath>

#include "integrate/stability.h"
#include "study/free_vibration.h"
#include "study/method_choice.h"
#include "study/parallel.h"
#include "subimpact/simulate/method_tables.h"
#include "subimpact/study/stability.h"

namespace subimpact {
namespace {

constexpr double newton_tolerance = 1e-10;
constexpr int angles_a_decade = 4;

}  // namespace

std::vector<Damping> damping_of_implicit_tables(const Case& input) {
  std::vector<Damping> list;
  for (const MethodTable& table : method_tables()) {
    if (table.method != Method::dirk) continue;
    for (int i = -angles_a_decade; i <= 2 * angles_a_decade; ++i) {
      const double angle = std::pow(10.0, static_cast<double>(i) / angles_a_decade);
      list.push_back(
          {"dirk:" + table.name, angle, std::abs(dirk_stability(table.name, {0.0, angle})), 0.0});
    }
  }
  in_parallel(list.size(), [&](std::size_t i) {
    Case trial = with_method(input, list[i].method);
    trial.solver.rtol = newton_tolerance;
    FreeVibration beam(trial);
    // Any mode will do: only omega h counts.
    const std::size_t mode = beam.n_modes() / 2;
    list[i].measured = beam.growth(mode, list[i].angle / beam.frequency(mode), 1);
  });
  return list;
}

std::vector<MultistepGrowth> bdf_growths() {
  std::vector<MultistepGrowth> list;
  for (int order = 1; order <= 5; ++order) {
    for (int i = -32; i <= 64; ++i) {
      const double angle = std::pow(10.0, i / 32.0);
      list.push_back({order, angle, bdf_growth(order, angle)});
    }
  }
  return list;
}

}  // namespace subimpact
