// Damping of the beam: a ratio of all modes, and Rayleigh's.

#include "paper_case.h"
#include "simulate/run_parts.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/model/mesh/beam_mesh.h"

namespace subimpact {
namespace {

Case elastic_case(const BeamDamping& damping, double end_time = 0.4e-3) {
  Case input = paper_case(SectionKind::elastic, end_time, 101);
  input.scene.beam.damping = damping;
  return input;
}

struct Decay {
  const char* name;
  Method method;
  double rtol;
  BeamDamping damping;
  BeamTheory theory = BeamTheory::rayleigh;
};

std::ostream& operator<<(std::ostream& out, const Decay& decay) { return out << decay.name; }

class AModeInFreeDecay : public testing::TestWithParam<Decay> {};

constexpr BeamDamping rayleigh{0.0, 400.0, 2e-7};
constexpr BeamDamping ratio{0.01, 0.0, 0.0};
constexpr BeamDamping all_three{0.02, 400.0, 2e-7};

const Decay decays[] = {{"exponential", Method::exponential, 1e-8, all_three},
                        {"erk", Method::erk, 1e-13, rayleigh},
                        {"erk_in_modes", Method::erk, 1e-13, ratio},
                        {"dirk", Method::dirk, 1e-12, rayleigh},
                        {"adams", Method::adams, 1e-13, rayleigh},
                        {"bdf", Method::bdf, 1e-13, rayleigh},
                        {"erk_timoshenko", Method::erk, 1e-13, rayleigh, BeamTheory::timoshenko},
                        {"dirk_timoshenko", Method::dirk, 1e-12, rayleigh, BeamTheory::timoshenko}};
INSTANTIATE_TEST_SUITE_P(, AModeInFreeDecay, testing::ValuesIn(decays), NamedAsPrinted{});

TEST_P(AModeInFreeDecay, FollowsTheClosedFormTo1e9OfItsAmplitude) {
  const Decay& decay = GetParam();
  Case input = elastic_case(decay.damping);
  input.model.segments = 31;
  input.solver.method = decay.method;
  input.solver.rtol = decay.rtol;
  input.scene.beam.theory = decay.theory;
  input.scene.beam.poisson = 0.33;
  input.model.symmetry = SymmetryUse::off;
  ResolvedRun run = resolve(input);
  StruckBeam& beam = run.parts().beam;
  beam.contact().set(ContactBranch::separated, {});
  const NaturalModes modes = beam.mesh().natural_modes(beam.sections().stiffness());
  const std::size_t n = modes.size();
  for (const std::size_t k : {2, 3, 6}) {
    const double w = modes.frequencies[k];
    ASSERT_GT(w, 0.0);
    const BeamDamping& d = decay.damping;
    const double delta = d.ratio * w + 0.5 * d.mass + 0.5 * d.stiffness * w * w;
    const double wd = std::sqrt(w * w - delta * delta);
    State y(2 * beam.n_positions(), 0.0);
    for (std::size_t i = 0; i < n; ++i) y[n + 1 + i] = modes.shape(k)[i];
    y[n] = -1.0;  // the striker is far away, at rest
    const auto integrator = run.parts().make_integrator();
    integrator->restart(0.0, y);
    const double t = 2.3 * 2.0 * M_PI / w;
    while (integrator->time() < t) integrator->step();
    State end;
    integrator->state_at(t, end);
    const double q = std::exp(-delta * t) * std::sin(wd * t) / wd;
    const double v = std::exp(-delta * t) * (std::cos(wd * t) - delta / wd * std::sin(wd * t));
    double size = 0.0;
    for (const double x : modes.shape(k)) size = std::max(size, std::abs(x));
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_NEAR(end[i], q * modes.shape(k)[i], 1e-9 * size / w) << k;
      EXPECT_NEAR(end[n + 1 + i], v * modes.shape(k)[i], 1e-9 * size) << k;
    }
  }
}

// Stiffness damping of 8 % in the first mode leaves high modes without oscillation: they follow at
// once, and the steps of a free flight need not follow them.
TEST(ABeamWithModesFarBeyondCriticalDamping, IsIntegratedInFewSteps) {
  Case input = elastic_case({0.0, 0.0, 1e-4}, 2e-3);
  input.model.mesh = MeshKind::hermite;
  input.model.elements = 52;
  input.solver.method = Method::exponential;
  input.output.keep_no_rows();
  const Result result = completed(input);
  EXPECT_LT(result.max_energy_error, 1e-6);
  EXPECT_LT(result.work.steps + result.work.rejected_steps, 1000);
}

// Methods that need forces of positions, and those that do not integrate modes, name those that
// take it; beams that yield have no modes.
TEST(ADampedBeam, IsRefusedByMethodsThatCannotTakeItsDamping) {
  const BeamDamping of_mass{0.0, 400.0, 0.0};
  const std::string others = "erk, exponential, dirk, adams, bdf";
  const std::tuple<BeamDamping, Method, SectionKind, const char*, std::string> refused[] = {
      {of_mass, Method::nystrom, SectionKind::elastic, "beam.damping.mass", others},
      {of_mass, Method::central_difference, SectionKind::elastic, "beam.damping.mass", others},
      {of_mass, Method::exponential, SectionKind::exact, "solver.reversals", "elastic"},
      {ratio, Method::bdf, SectionKind::elastic, "beam.damping.ratio", "erk, exponential"},
      {ratio, Method::erk, SectionKind::exact, "beam.damping.ratio",
       "model.section = \"elastic\""}};
  for (const auto& [damping, method, section, key, words] : refused) {
    SCOPED_TRACE(to_string(method));
    Case input = elastic_case(damping);
    input.solver.method = method;
    input.model.section = section;
    expect_refused(input, key, words);
  }
}

TEST(ADampedBeam, HasNoContactAfterTheTimeFromWhichNoneIsProven) {
  Case input = elastic_case({0.0, 3000.0, 2e-8}, 8e-3);
  input.solver.method = Method::exponential;
  const Result whole = simulate(input);
  input.stop = StopRule::no_more_contact;
  const Result stopped = simulate(input);
  ASSERT_TRUE(whole.outcome.completed());
  ASSERT_EQ(stopped.sub_impacts.size(), whole.sub_impacts.size());
}

}  // namespace
}  // namespace subimpact
