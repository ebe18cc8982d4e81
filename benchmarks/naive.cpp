// Central differences of the library against the same scheme written down plainly.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "naive_central_difference.h"
#include "parts.h"

namespace subimpact::benchmarks {
namespace {

constexpr double step = 1e-7;
constexpr std::size_t n_compared = 9;  // sub-impacts before which rounding does not matter

double largest_difference(const Result& result, const std::vector<NaiveSubImpact>& naive) {
  double largest = 0.0;
  for (std::size_t i = 0; i < n_compared; ++i) {
    largest = std::max({largest, std::abs(result.sub_impacts.at(i).start - naive.at(i).start),
                        std::abs(result.sub_impacts.at(i).end.value_or(0.0) - naive.at(i).end)});
  }
  return largest;
}

}  // namespace

void measure_naive(const Settings& settings) {
  Case input = paper_case(SectionKind::layers);
  input.solver.method = Method::central_difference;
  input.solver.step = step;
  NaiveOptions plain;
  plain.step = step;
  plain.end_time = input.end_time;
  NaiveOptions layer_by_layer = plain;
  layer_by_layer.layers_outside = true;

  Result ours;
  std::vector<NaiveSubImpact> naive, naive_by_layers;
  const std::vector<double> seconds = seconds_side_by_side(
      settings, {[&] { ours = run_to_end(input); },
                 [&] { naive = naive_central_difference(input.scene, plain); },
                 [&] { naive_by_layers = naive_central_difference(input.scene, layer_by_layer); }});

  fmt::print(
      "40 layers, 501 cells, 2 ms in steps of 0.1 us, no history rows.\n"
      "naive: whole beam, return map in every layer of every cell at every step;\n"
      "the second one has the cells in its inner loop, which vectorises better.\n"
      "difference: largest of start and end of the first {} sub-impacts.\n\n",
      n_compared);
  fmt::print("{:34} {:>10} {:>12} {:>12} {:>16} {:>14}\n", "", "seconds", "us a step", "ratio",
             "sub-impacts", "difference us");
  const double n_steps = input.end_time / step;
  const auto row = [&](const char* name, double time, std::size_t count, double difference) {
    fmt::print("{:34} {:10.4f} {:12.3f} {:12.2f} {:16} {:14.1e}\n", name, time,
               1e6 * time / n_steps, time / seconds[0], count, 1e6 * difference);
  };
  row("central-difference", seconds[0], ours.sub_impacts.size(), 0.0);
  row("naive, cell by cell (bar: 8)", seconds[1], naive.size(), largest_difference(ours, naive));
  row("naive, layer by layer", seconds[2], naive_by_layers.size(),
      largest_difference(ours, naive_by_layers));
}

}  // namespace subimpact::benchmarks
