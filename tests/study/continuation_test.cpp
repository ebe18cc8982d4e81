// Runs cut at the end of a step and continued, against runs in one piece.

#include "paper_run.h"
#include "print.h"
#include "runs.h"
#include "settings.h"
#include "subimpact/study/judgement/judgement.h"

namespace subimpact {
namespace {

struct Scene {
  const char* name;
  Method method;
  double end_time;         // s
  Settings settings = {};  // what differs from the paper's scene
  double bound = 1e-12;    // relative; 0: the stated errors in time

  Case input() const {
    Case of_scene = changed(paper_run(SectionKind::exact, end_time, 301, method), settings);
    Striker& striker = of_scene.scene.striker;
    if (striker.fixed) striker.mass = striker.velocity = 0.0;
    return of_scene;
  }
};
void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

constexpr auto central = Method::central_difference;

const Scene scenes[] = {
    {"exact_sections", central, 2e-3},
    {"layers", central, 2e-3, {{"model.section", "layers"}}},
    {"a_cantilever_off_its_middle",
     central,
     2e-3,
     {{"beam.ends", Names{"clamped", "free"}}, {"striker.position", 0.7}}},
    {"with_shear", central, 2e-3, {{"beam.theory", "timoshenko"}, {"beam.poisson", 0.33}}},
    {"elastic_modes", Method::exponential, 2e-3, {{"model.section", "elastic"}}},
    {"elastic_modes_with_damping_and_a_sphere",
     Method::exponential,
     2e-3,
     {{"model.section", "elastic"},
      {"beam.damping.ratio", 0.01},
      {"contact.law", "hertz"},
      {"contact.stiffness", 5e9}}},
    {"a_stop_and_a_turning_beam_under_gravity",
     central,
     2e-3,
     {{"beam.ends", Names{"pinned", "free"}},
      {"beam.angular_velocity", -60.0},
      {"scene.gravity", -500.0},
      {"striker.position", 0.7},
      {"striker.fixed", true}}},
    {"loads_on_a_sprung_beam",
     Method::exponential,
     1.5e-3,
     {{"model.section", "elastic"},
      {"scene.gravity", 200.0},
      {"beam.load", 300.0},
      {"beam.forces",
       PlacedValues{"force", {{0.4, {{0.0, 0.0}, {0.7e-3, 900.0}, {1.2e-3, -500.0}}}}}},
      {"beam.springs", PlacedValues{"stiffness", {{0.3, {{0.0, 2e5}}}}}}}},
    {"runge_kutta_with_damping", Method::erk, 1.5e-3, {{"beam.damping.mass", 200.0}}, 0.0},
    {"nystrom_on_elements",
     Method::nystrom,
     1.5e-3,
     {{"model.mesh", "hermite"}, {"model.elements", 60}},
     0.0},
    {"bdf", Method::bdf, 0.5e-3, {{"model.segments", 101}, {"solver.rtol", 1e-7}}, 0.0},
};

// Ends of steps after which a run is cut: in contact without flow, in flight, while sections flow.
struct Steps final : Observer {
  void on_step(const RunView& end) override {
    const double plastic = end.energies().bending_plastic;
    times.push_back(end.time());
    contact.push_back(end.in_contact());
    flows.push_back(plastic > plastic_before * (1.0 + 1e-9) + 1e-9);
    plastic_before = plastic;
  }
  // The middle one of those of which this and the next step are both so.
  double middle(const std::function<bool(std::size_t)>& is_so) const {
    std::vector<double> found;
    for (std::size_t i = 0; i + 1 < times.size(); ++i) {
      if (is_so(i) && is_so(i + 1)) found.push_back(times[i]);
    }
    return found.empty() ? -1.0 : found[found.size() / 2];
  }
  std::vector<double> times;
  std::vector<bool> contact, flows;
  double plastic_before = 0.0;
};

Result run_in_two(Case input, double cut) {
  const double end = input.end_time;
  input.end_time = cut;
  const Result first = completed(input);
  input.end_time = end;
  input.parts.start = first.end_state;
  return completed(input);
}

void expect_same_within(const Case& input, const Result& whole, const Result& parts, double bound) {
  const auto see = [&](double a, double b, double scale, const char* what, std::size_t k = 0) {
    EXPECT_NEAR(a, b, bound * scale) << what << ' ' << k + 1;
  };
  const Bodies bodies = input.scene.bodies();
  const double v0 = bodies.velocity_scale(), energy = whole.used.initial_energy;
  ASSERT_EQ(whole.sub_impacts.size(), parts.sub_impacts.size());
  for (std::size_t i = 0; i < whole.sub_impacts.size(); ++i) {
    const SubImpact& a = whole.sub_impacts[i];
    const SubImpact& b = parts.sub_impacts[i];
    see(a.start, b.start, input.end_time, "start", i);
    see(whole.end_of(a), parts.end_of(b), input.end_time, "end", i);
    see(a.impulse, b.impulse, v0 * bodies.moving_mass(), "impulse", i);
    see(a.peak_force, b.peak_force, whole.max_force, "peak", i);
    see(a.residual_indentation, b.residual_indentation, whole.max_indentation, "dent", i);
    EXPECT_EQ(a.zone, b.zone);
  }
  ASSERT_EQ(whole.transitions.size(), parts.transitions.size());
  ASSERT_EQ(whole.near_misses.size(), parts.near_misses.size());
  see(whole.striker_velocity, parts.striker_velocity, v0, "velocity of the striker");
  see(whole.beam_mean_velocity, parts.beam_mean_velocity, v0, "velocity of the beam");
  const Energies &a = whole.final_energies, &b = parts.final_energies;
  see(a.beam_kinetic, b.beam_kinetic, energy, "kinetic energy");
  see(a.bending_elastic, b.bending_elastic, energy, "elastic energy");
  see(a.bending_plastic, b.bending_plastic, energy, "plastic work");
  see(a.contact_plastic, b.contact_plastic, energy, "work of the dent");
  see(a.beam_damping, b.beam_damping, energy, "damping");
  EXPECT_NEAR(a.work, b.work, 1e-6 * energy);  // by quadrature, to a share of the largest energy
  EXPECT_EQ(whole.n_yielded_sections, parts.n_yielded_sections);
  EXPECT_EQ(whole.first_section_yield.has_value(), parts.first_section_yield.has_value());
}

// Both runs have the error that is stated, so that two of them lie apart by up to twice as much.
void expect_within_stated_errors(const Result& whole, const Result& parts) {
  ASSERT_EQ(whole.sub_impacts.size(), parts.sub_impacts.size());
  for (std::size_t i = 0; i < whole.sub_impacts.size(); ++i) {
    const SubImpact& a = whole.sub_impacts[i];
    const SubImpact& b = parts.sub_impacts[i];
    ASSERT_TRUE(a.start_error) << i;
    EXPECT_LE(std::abs(a.start - b.start), 2.0 * *a.start_error) << "start " << i + 1;
    if (!a.end) continue;
    EXPECT_LE(std::abs(*a.end - *b.end), 2.0 * *a.end_error) << "end " << i + 1;
  }
}

class ContinuedRun : public testing::TestWithParam<Scene> {
 protected:
  // Cuts a run where `is_so`, if it is anywhere, and compares.
  void compare(const std::function<bool(const Steps&, std::size_t)>& is_so, bool is_possible) {
    const Case input = GetParam().input();
    Steps steps;
    ASSERT_TRUE(simulate(input, steps).outcome.completed());
    Result whole = completed(input);
    const double cut = steps.middle([&](std::size_t i) { return is_so(steps, i); });
    ASSERT_EQ(cut > 0.0, is_possible);
    if (!is_possible) return;
    const Result parts = run_in_two(input, cut);
    if (GetParam().bound > 0.0) return expect_same_within(input, whole, parts, GetParam().bound);
    whole = simulate_judged(input, cases_beside_in_time(input), 1, {}, nullptr);
    expect_within_stated_errors(whole, parts);
  }
};

INSTANTIATE_TEST_SUITE_P(, ContinuedRun, testing::ValuesIn(scenes), NamedAsPrinted{});

TEST_P(ContinuedRun, FromWithinAContactEqualsTheWhole) {
  compare([](const Steps& s, std::size_t i) { return s.contact[i] && !s.flows[i]; }, true);
}

TEST_P(ContinuedRun, FromAFlightEqualsTheWhole) {
  compare([](const Steps& s, std::size_t i) { return !s.contact[i]; }, true);
}

TEST_P(ContinuedRun, FromSectionsThatFlowEqualsTheWhole) {
  compare([](const Steps& s, std::size_t i) { return s.flows[i]; },
          GetParam().input().model.section != SectionKind::elastic);
}

}  // namespace
}  // namespace subimpact
