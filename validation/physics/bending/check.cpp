// Bending beyond yield, monotonic and cyclic, against the closed forms of the rectangular section.

#include <fmt/format.h>

#include <cmath>

#include "model/section/section_law.h"
#include "outcome.h"

namespace subimpact::validation {
namespace {

// Bending work of a cycle from x to -x and back, by Simpson's rule on the moments alone.
double loop_area(const SectionLaw& law, SectionHistory history, double x, double unit) {
  constexpr int n = 4000;
  double area = 0.0;
  for (const double end : {-x, x}) {
    const double start = -end;
    const double h = (end - start) / n;
    for (int k = 0; k < n; ++k) {
      const auto m = [&](double at) { return law.moment(history, (start + at * h) * unit); };
      area += h * unit / 6.0 * (m(k) + 4.0 * m(k + 0.5) + m(k + 1.0));
    }
    law.commit(history, end * unit);
  }
  return area;
}

}  // namespace

Outcome check_bending() {
  const Beam beam = case_of("bending").scene.beam;
  const double unit = beam.yield_curvature();
  const double moment = beam.yield_moment();
  const SectionLaw exact(beam, Fibres::continuous());
  const SectionLaw layers(beam, Fibres::layered(40));
  Outcome outcome{"closed form", {}, {}};
  const double virgin[][3] = {{1.0, 1.0, 0.999375},   {1.5, 1.277778, 1.2775781},
                              {2.0, 1.375, 1.374375}, {3.0, 1.444444, 1.4442187},
                              {5.0, 1.48, 1.479375},  {10.0, 1.495, 1.494375}};
  for (const auto& [x, m, m40] : virgin) {
    outcome.rows.push_back({fmt::format("M/M_y at κ/κ_y = {}", x), m,
                            exact.moment({}, x * unit) / moment, Bound::absolute, 0.6e-6});
    outcome.rows.push_back({fmt::format("the same, 40 layers"), m40,
                            layers.moment({}, x * unit) / moment, Bound::absolute, 0.6e-7});
  }
  for (const double x : {1.5, 3.0, 10.0}) {
    SectionHistory history;
    exact.commit(history, x * unit);
    double residual = 0.0, above = x;  // where the moment has gone
    while (above - residual > 1e-13 * x) {
      const double middle = 0.5 * (residual + above);
      (exact.moment(history, middle * unit) < 0.0 ? residual : above) = middle;
    }
    outcome.rows.push_back({fmt::format("residual κ/κ_y after κ/κ_y = {}", x),
                            x - (1.5 - 0.5 / (x * x)), residual, Bound::relative, 1e-12});
    exact.commit(history, -x * unit);
    exact.commit(history, x * unit);
    outcome.rows.push_back(
        {fmt::format("area of the loop ± {}, M_y κ_y", x), 6.0 * (x - 1.0) * (x - 1.0) / x,
         loop_area(exact, history, x, unit) / (moment * unit), Bound::relative, 1e-6});
  }
  return outcome;
}

}  // namespace subimpact::validation
