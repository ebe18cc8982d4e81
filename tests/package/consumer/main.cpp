// Uses the library from its top to its bottom, as a project that knows its public headers alone.
#include <cstdio>

#include "subimpact/case/simulate.h"
#include "subimpact/io/results.h"
#include "subimpact/report/text.h"
#include "subimpact/study/studies.h"

static_assert(__cplusplus >= 202002L, "C++20 comes with subimpact::subimpact");
#ifdef FMT_SHARED
#error "what the library is made with is not handed on"
#endif

int main(int argc, char**) {
  subimpact::Case strike;
  strike.scene.beam = {.length = 0.7112,
                       .width = 0.0163,
                       .thickness = 0.0075,
                       .density = 2600.0,
                       .youngs_modulus = 71.96e9,
                       .yield_stress = 150e6};
  strike.scene.striker = {.mass = 0.201, .nose_radius = 0.01, .velocity = 15.9};
  strike.end_time = 5e-4;
  subimpact::Result result = subimpact::simulate(strike);
  subimpact::make_answers(strike, result);
  if (argc > 1) std::puts(subimpact::report_json(strike, result).c_str());
  std::printf("subimpact %s: %zu sub-impacts\n", subimpact::project_version().c_str(),
              result.sub_impacts.size());
  return result.sub_impacts.empty() ? 1 : 0;
}
