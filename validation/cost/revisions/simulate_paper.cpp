// One run of the paper's example: METHOD SECTION END. Compiles against the library of either
// revision of the table in README.md, whose headers moved in between.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#if __has_include("subimpact/case/case_keys.h")
#include "subimpact/case/case_keys.h"
#include "subimpact/case/simulate.h"
#else
#include "subimpact/simulate/case_keys.h"
#include "subimpact/simulate/simulate.h"
#endif

namespace {

void set(subimpact::Case& input, const char* name, const subimpact::KeyValue& value) {
  subimpact::find_case_key(name)->set(input, value);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  subimpact::Case paper;
  set(paper, "beam.length", 0.7112);
  set(paper, "beam.width", 0.0163);
  set(paper, "beam.thickness", 0.0075);
  set(paper, "beam.density", 2600.0);
  set(paper, "beam.youngs_modulus", 71.96e9);
  set(paper, "beam.yield_stress", 150e6);
  set(paper, "beam.theory", std::string("rayleigh"));
  set(paper, "striker.mass", 0.201);
  set(paper, "striker.nose_radius", 0.01);
  set(paper, "striker.velocity", 15.9);
  set(paper, "striker.position", 0.5);
  set(paper, "contact.law", std::string("foundation"));
  set(paper, "model.mesh", std::string("cells"));
  set(paper, "model.segments", std::int64_t{501});
  set(paper, "model.section", std::string(argv[2]));
  set(paper, "model.layers", std::int64_t{40});
  set(paper, "model.symmetry", std::string("auto"));
  set(paper, "solver.method", std::string(argv[1]));
  set(paper, "solver.rtol", 1e-8);
  set(paper, "time.end", std::atof(argv[3]));
  set(paper, "output.interval", 1e-6);
  set(paper, "output.zone_gap", 0.1);
  set(paper, "output.subzone_gap", 0.02);
  const subimpact::Result result = subimpact::simulate(paper);
  std::printf("%ld steps, %zu sub-impacts\n", result.work.steps, result.sub_impacts.size());
  return result.outcome.completed() ? 0 : 1;
}
