#include "predictability/support.h"

#include <array>

#include "draws.h"
#include "subimpact/case/simulate.h"
#include "subimpact/io/case_file.h"

namespace subimpact::predictability {
namespace {

constexpr std::size_t fewest_contacts = 4;

Case with_section(Case input, SectionKind section) {
  input.model.section = section;
  input.solver = {};
  input.solver.method = section == SectionKind::elastic ? Method::exponential : Method::nystrom;
  input.output.interval = 0.0;
  return input;
}

Case draw(Random& random, SectionKind section, BeamTheory theory) {
  Case input = with_section(read_case_file(SUBIMPACT_PAPER_CASE).value, section);
  Beam& beam = input.scene.beam;
  Striker& striker = input.scene.striker;
  const auto vary = [&](double& x, double factor) {
    x *= random.log_uniform(1.0 / factor, factor);
  };
  vary(beam.length, 1.5);
  vary(beam.width, 2.0);
  vary(beam.thickness, 1.5);
  vary(beam.density, 2.0);
  vary(beam.youngs_modulus, 2.0);
  vary(beam.yield_stress, 1.5);
  vary(striker.mass, 2.0);
  vary(*striker.nose_radius, 2.0);
  vary(striker.velocity, 1.5);
  constexpr std::array kinds{EndSupport::free, EndSupport::pinned, EndSupport::clamped};
  beam.ends = {random.one_of(kinds), random.one_of(kinds)};
  if (random.chance(0.5)) beam.ends[1] = beam.ends[0];
  if (random.chance(0.5)) striker.position = random.uniform(0.2, 0.8);
  beam.theory = theory;
  if (beam.shears()) beam.poisson = 0.33;
  input.model.segments = 101;
  return input;
}

}  // namespace

Case paper_strike(SectionKind section) {
  return with_section(read_case_file(SUBIMPACT_PAPER_CASE).value, section);
}

Case random_strike(int number, SectionKind section, BeamTheory theory) {
  Random random(1700 + static_cast<std::uint64_t>(number));
  for (;;) {
    Case input = draw(random, section, theory);
    input.end_time = 0.3 * resolve(input).settings().first_period;
    if (simulate(input).sub_impacts.size() >= fewest_contacts) return input;
  }
}

}  // namespace subimpact::predictability
