// Single operations, by Google Benchmark.

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <vector>

#include "measure.h"
#include "numerics/mass_solver.h"
#include "simulate/run_parts.h"

namespace subimpact::benchmarks {
namespace {

// A beam bent so that the sections near its middle flow, by `depth` times the yield curvature.
State bent(const StruckBeam& beam, const Beam& material, double depth) {
  State y = beam.initial_state();
  const std::size_t n = beam.mesh().n_unknowns();
  const double dx = material.length / 501.0;
  const double reach = 0.1 * material.length;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = static_cast<double>(n - 1 - i) * dx / reach;
    y[i] = -depth * material.yield_curvature() * reach * reach * std::log(std::cosh(x));
  }
  y[n] = y[n - 1] + 1e-5;
  return y;
}

struct Bent {
  Bent(SectionKind section, double depth)
      : input(paper_case(section)),
        run(resolve(input)),
        beam(run.parts().beam),
        y(bent(beam, input.scene.beam, depth)) {}
  Case input;
  ResolvedRun run;
  StruckBeam& beam;
  State y;
};

void acceleration(benchmark::State& state, SectionKind section, double depth) {
  Bent bent(section, depth);
  const std::size_t n = bent.beam.n_positions();
  std::vector<double> result(n);
  for (auto _ : state) {
    bent.beam.acceleration({bent.y.data(), n}, result);
    benchmark::DoNotOptimize(result.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK_CAPTURE(acceleration, elastic, SectionKind::elastic, 0.5);
BENCHMARK_CAPTURE(acceleration, exact_nothing_flows, SectionKind::exact, 0.5);
BENCHMARK_CAPTURE(acceleration, exact_middle_flows, SectionKind::exact, 2.0);
BENCHMARK_CAPTURE(acceleration, layers_middle_flows, SectionKind::layers, 2.0);

void curvature(benchmark::State& state) {
  Bent bent(SectionKind::elastic, 0.5);
  const BeamMesh& mesh = bent.beam.mesh();
  std::vector<double> kappa(mesh.n_sections());
  for (auto _ : state) {
    mesh.curvatures({bent.y.data(), mesh.n_unknowns()}, kappa);
    benchmark::DoNotOptimize(kappa.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(curvature);

void solve(benchmark::State& state) {
  Bent bent(SectionKind::elastic, 0.5);
  const BandedMatrix& mass = bent.beam.mesh().mass();
  const BandedSolver solver(mass);
  const std::vector<double> start(mass.size(), 1.0);
  std::vector<double> x(mass.size());
  for (auto _ : state) {
    x = start;
    solver.solve(x);
    benchmark::DoNotOptimize(x.data());
    benchmark::ClobberMemory();
  }
}
BENCHMARK(solve);

// One section law on a branch behind `reversals` turns.
void section_law(benchmark::State& state, int layers) {
  const Beam beam = paper_case(SectionKind::exact).scene.beam;
  const SectionLaw law(beam, layers == 0 ? Fibres::continuous() : Fibres::layered(layers));
  SectionHistory history;
  double amplitude = 5.0;
  for (int turn = 0; turn < 4; ++turn) {
    law.commit(history, (turn % 2 == 0 ? amplitude : -amplitude) * beam.yield_curvature());
    amplitude *= 0.9;
  }
  double kappa = -1.5 * beam.yield_curvature();
  for (auto _ : state) {
    benchmark::DoNotOptimize(kappa);
    benchmark::DoNotOptimize(law.moment(history, kappa));
  }
}
BENCHMARK_CAPTURE(section_law, exact, 0);
BENCHMARK_CAPTURE(section_law, layers, 40);

// Committing two states in turn, between which the middle flows forth and back.
void commit(benchmark::State& state, SectionKind section, double depth) {
  Bent forth(section, depth);
  const State back = bent(forth.beam, forth.input.scene.beam, -depth);
  for (auto _ : state) {
    benchmark::DoNotOptimize(forth.beam.commit(forth.y));
    benchmark::DoNotOptimize(forth.beam.commit(back));
  }
}
BENCHMARK_CAPTURE(commit, exact_nothing_flows, SectionKind::exact, 0.5);
BENCHMARK_CAPTURE(commit, exact_middle_flows, SectionKind::exact, 2.0);
BENCHMARK_CAPTURE(commit, layers_middle_flows, SectionKind::layers, 2.0);

}  // namespace
}  // namespace subimpact::benchmarks

BENCHMARK_MAIN();
