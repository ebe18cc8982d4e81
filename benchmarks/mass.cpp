// The banded mass solver against KLU: whole runs, and single solves over the number of
// unknowns.

#include <fmt/format.h>

#include <algorithm>

#include "integrate/sundials.h"
#include "model/mesh/cell_mesh.h"
#include "parts.h"

namespace subimpact::benchmarks {
namespace {

void compare_runs(const Settings& settings) {
  fmt::print("Elastic section, half model of 501 cells, 2 ms.\n\n");
  fmt::print("{:44} {:>14} {:>10} {:>8}\n", "", "banded s", "klu s", "ratio");
  const auto row = [&](const char* name, const Case& with_banded) {
    Case with_klu = with_banded;
    with_klu.study.mass_solver = MassSolverKind::klu;
    const std::vector<double> seconds = seconds_side_by_side(
        settings, {[&] { run_to_end(with_banded); }, [&] { run_to_end(with_klu); }});
    fmt::print("{:44} {:14.4f} {:10.4f} {:8.2f}\n", name, seconds[0], seconds[1],
               seconds[1] / seconds[0]);
  };
  Case erk = paper_case(SectionKind::elastic);
  erk.solver.method = Method::erk;
  erk.solver.table = "dormand-prince";
  row("erk, dormand-prince, rtol 1e-8", erk);
  Case nystrom = paper_case(SectionKind::elastic);
  nystrom.solver.method = Method::nystrom;
  nystrom.solver.table = "dprkn8";
  row("nystrom, dprkn8, rtol 1e-8", nystrom);
  Case central = paper_case(SectionKind::elastic);
  central.solver.method = Method::central_difference;
  central.solver.step = 1e-7;
  row("central-difference, step 0.1 us", central);
}

void compare_solves(const Settings& settings) {
  fmt::print("\nOne solve with the mass matrix of the whole beam, factored before.\n\n");
  fmt::print("{:>10} {:>16} {:>12} {:>8}\n", "unknowns", "banded us", "klu us", "ratio");
  const Beam beam = paper_case(SectionKind::elastic).scene.beam;
  for (const std::size_t n : {251, 501, 2001}) {
    const CellMesh mesh(beam, 0.5, n, CellMesh::Extent::whole);
    const BandedSolver banded(mesh.mass());
    const auto klu = make_klu_mass_solver(mesh.mass());
    std::vector<double> right_hand_side(n), x(n);
    for (std::size_t i = 0; i < n; ++i) {
      right_hand_side[i] = static_cast<double>(i * 37 % 101) - 50.0;
    }
    constexpr long n_solves = 4000;
    const auto solve_many = [&](const MassSolver& solver) {
      for (long k = 0; k < n_solves; ++k) {
        std::copy(right_hand_side.begin(), right_hand_side.end(), x.begin());
        solver.solve(x);
      }
    };
    const std::vector<double> seconds =
        seconds_side_by_side(settings, {[&] { solve_many(banded); }, [&] { solve_many(*klu); }});
    fmt::print("{:10} {:16.3f} {:12.3f} {:8.2f}\n", n, 1e6 * seconds[0] / n_solves,
               1e6 * seconds[1] / n_solves, seconds[1] / seconds[0]);
  }
}

}  // namespace

void measure_mass(const Settings& settings) {
  compare_runs(settings);
  compare_solves(settings);
}

}  // namespace subimpact::benchmarks
