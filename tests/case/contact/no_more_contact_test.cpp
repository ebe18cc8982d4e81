// The proof that striker and beam never touch again, and attempts to break it.

#include "system/flight/no_more_contact.h"
#include "model/mesh/cell_mesh.h"
#include "paper_case.h"
#include "random_walk.h"
#include "simulate/run_parts.h"

namespace subimpact {
namespace {

// Scenes unlike each other, coarse and quick.
Case random_case(unsigned seed) {
  const std::vector<double> c = random_numbers(seed, 6);  // in [-1, 1]
  Case input = paper_case(c[0] < 0.0 ? SectionKind::exact : SectionKind::elastic, 60e-3);
  Striker& striker = input.scene.striker;
  striker.mass = 0.05 * std::pow(4.0, c[1]);
  striker.velocity = 8.0 * std::pow(2.0, c[2]);
  striker.position = c[3] < 0.0 ? 0.5 : 0.5 + 0.2 * c[4];
  input.model.segments = 61;
  if (c[5] > 0.4) input.scene.beam.ends = {pinned, pinned};
  input.solver.method = Method::nystrom;
  input.solver.rtol = 1e-7;
  return input;
}

TEST(NoMoreContact, IsNeverFollowedByOne) {
  int proven = 0;
  constexpr unsigned n_scenes = 40;
  for (unsigned seed = 1; seed <= n_scenes; ++seed) {
    Case input = random_case(seed);
    const Result whole = completed(input);
    input.stop = StopRule::no_more_contact;
    const Result stopped = simulate(input);
    if (!stopped.no_more_contact) continue;
    ++proven;
    EXPECT_LT(stopped.outcome.time, input.end_time);
    ASSERT_TRUE(stopped.sub_impacts.back().end.has_value());
    EXPECT_EQ(stopped.sub_impacts.size(), whole.sub_impacts.size()) << "seed " << seed;
  }
  EXPECT_GT(proven, static_cast<int>(n_scenes / 3));
}

// The worst a beam can do: all its energy in the shape that brings the struck point farthest out.
TEST(NoMoreContact, HoldsAgainstABeamBentTheWorstWay) {
  for (const char* mesh : {"cells", "modal"}) {
    SCOPED_TRACE(mesh);
    const bool modal = mesh == std::string("modal");
    Case input = paper_case(SectionKind::elastic, 1e-3, 61);
    if (modal) input.solver.method = Method::exponential;
    ResolvedRun run = resolve(input);
    StruckBeam& beam = run.parts().beam;
    beam.contact().set(ContactBranch::separated, {});
    NoMoreContact proof(beam, input.scene.beam, run.parts().settings.first_period);
    // That shape, u = sum S phi/omega^2 phi, from the modes of the physical mesh.
    Case physical = input;
    if (modal) physical.solver.method = Method::nystrom;
    ResolvedRun other_run = resolve(physical);
    const StruckBeam& other = other_run.parts().beam;
    const NaturalModes modes = other.mesh().natural_modes(other.sections().stiffness());
    const std::size_t n = beam.mesh().n_unknowns();
    double compliance = 0.0;
    std::vector<double> shape(n, 0.0);
    for (std::size_t k = 0; k < n; ++k) {
      if (modes.frequencies[k] == 0.0) continue;
      const double share = other.mesh().struck_point()(modes.shape(k));
      const double amount = share / (modes.frequencies[k] * modes.frequencies[k]);
      compliance += share * amount;
      for (std::size_t i = 0; i < n; ++i) {
        if (modal) {
          shape[k] = amount / std::sqrt(beam.mesh().mass().at(k, k));
        } else {
          shape[i] += amount * modes.shape(k)[i];
        }
      }
    }
    // Bent away from the striker by 1 mm, it can come as far the other way, and no farther.
    const double amplitude = 1e-3;
    State y(2 * (n + 1), 0.0);
    for (std::size_t i = 0; i < n; ++i) y[i] = amplitude / compliance * shape[i];
    y.back() = -1e-9;
    y[n] = -1.001 * amplitude;
    EXPECT_TRUE(proof.is_proven(beam, y));
    y[n] = -0.999 * amplitude;
    EXPECT_FALSE(proof.is_proven(beam, y));
    y[n] = -1.0;
    y.back() = 1e-9;  // but it approaches
    EXPECT_FALSE(proof.is_proven(beam, y));
  }
}

}  // namespace
}  // namespace subimpact
