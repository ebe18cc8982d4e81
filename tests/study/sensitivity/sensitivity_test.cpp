#include "subimpact/study/sensitivity/sensitivity.h"
#include "elastic_case.h"
#include "refusal.h"
#include "rigid_case.h"
#include "study/sensitivity/stencil.h"
#include "testing.h"

namespace subimpact {
namespace {

double beam_share(const Case& input) {
  const double beam = input.scene.beam.mass();
  return beam / (input.scene.striker.mass + beam);
}

double derivative(const Sensitivity& study, EventQuantity quantity, const std::string& key,
                  std::size_t sub_impact = 0) {
  const SensitivityRow* row = study.find(quantity, sub_impact);
  for (std::size_t k = 0; row != nullptr && k < study.keys.size(); ++k) {
    if (study.keys[k] == key && row->by_key[k]) return row->by_key[k]->value;
  }
  ADD_FAILURE() << "no derivative by " << key;
  return std::nan("");
}

Sensitivity study_of(const Case& input, std::vector<std::string> keys = {}, Jobs jobs = 2) {
  return sensitivity(input, {std::move(keys), jobs, {}, {}});
}

std::string flag_of(const Sensitivity& study, std::size_t sub_impact) {
  return study.find(EventQuantity::end, sub_impact)->flag;
}

// --- closed forms -------------------------------------------------------------------------------

// Under F = K lambda^n the contact of the reduced mass m' lasts T ~ (m'/K)^(1/(n+1))
// v^((1-n)/(n+1)), with the peak F ~ K (m' v^2/K)^(n/(n+1)).
TEST(Sensitivity, OfTwoRigidBodiesUnderAPowerLawIsThatOfTheClosedForm) {
  for (const auto& [kind, n] : {std::pair(ContactKind::hertz, 1.5), {ContactKind::linear, 1.0}}) {
    const Case input = rigid_case(kind, 2.0, 5e-3);
    const Sensitivity study = study_of(input);
    ASSERT_EQ(study.base.sub_impacts.size(), 1u);
    const double t = *study.base.sub_impacts[0].end;
    const double peak = study.base.sub_impacts[0].peak_force;
    const double striker = beam_share(input);  // d ln m'/d ln m
    const EventQuantity end = EventQuantity::end, force = EventQuantity::peak_force;
    const double by_mass = 1.0 / (n + 1.0);
    EXPECT_NEAR(derivative(study, end, "striker.velocity"), t * (1.0 - n) / (n + 1.0), 1e-6 * t);
    EXPECT_NEAR(derivative(study, end, "contact.stiffness"), -t * by_mass, 1e-6 * t);
    EXPECT_NEAR(derivative(study, end, "striker.mass"), t * by_mass * striker, 1e-6 * t);
    EXPECT_NEAR(derivative(study, end, "beam.density"), t * by_mass * (1.0 - striker), 1e-6 * t);
    EXPECT_NEAR(derivative(study, force, "striker.velocity"), peak * 2.0 * n / (n + 1.0),
                1e-6 * peak);
    EXPECT_NEAR(derivative(study, force, "contact.stiffness"), peak * by_mass, 1e-6 * peak);
    for (const SensitivityRow& row : study.rows) EXPECT_EQ(row.flag, "");
  }
}

// The striker's velocity after an elasto-plastic impact at v, where x is the largest indentation
// over the one at first yield.
double closed_velocity(const Case& input, double unit_energy, double v) {
  const double share = beam_share(input);
  const double energy = 0.5 * input.scene.striker.mass * share * v * v / unit_energy;
  const auto work = [](double x) {
    return 0.4 * (std::pow(x, 2.5) - std::pow(std::max(x - 1.0, 0.0), 2.5));
  };
  double low = 0.0, high = 1e3;
  for (int i = 0; i < 200; ++i) {
    const double x = 0.5 * (low + high);
    (work(x) < energy ? low : high) = x;
  }
  const double e = std::sqrt(1.0 - std::pow(low - 1.0, 1.5) / work(low));
  return v * (1.0 - share - e * share);
}

TEST(Sensitivity, OfAnElastoPlasticImpactIsThatOfTheClosedFormsRestitution) {
  for (const double v : {3.0, 15.9}) {
    const Case input = rigid_case(ContactKind::foundation, v, 5e-3);
    const Sensitivity study = study_of(input, {"striker.velocity"});
    const ResolvedSettings& used = study.base.used;
    const double unit = used.contact_stiffness * std::pow(used.yield_indentation, 2.5);
    const auto f = [&](double h) { return closed_velocity(input, unit, v * std::exp(h)); };
    const double h = 1e-3;
    const double expected = (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h);
    EXPECT_NEAR(derivative(study, EventQuantity::striker_velocity, "striker.velocity"), expected,
                1e-6 * v);
  }
}

// --- identities ---------------------------------------------------------------------------------

// Of all starts and ends before `until`: what time, mass and length leave of their identities, as a
// share of the time.
double largest_defect(const Sensitivity& study, double until) {
  double largest = 0.0;
  for (const SensitivityRow& row : study.rows) {
    const double t = row.value;
    if (row.quantity != EventQuantity::start && row.quantity != EventQuantity::end) continue;
    if (t == 0.0 || t > until || !row.flag.empty()) continue;
    const auto by = [&](const char* key) {
      return derivative(study, row.quantity, key, row.sub_impact) / t;
    };
    const double of_time = 2.0 * by("beam.youngs_modulus") + 2.0 * by("beam.yield_stress") +
                           by("striker.velocity") + 1.0;
    const double of_mass = by("beam.density") + by("striker.mass") + by("beam.youngs_modulus") +
                           by("beam.yield_stress");
    const double of_length = by("beam.length") + by("beam.width") + by("beam.thickness") +
                             by("striker.nose_radius") + 3.0 * by("striker.mass") - 1.0;
    largest = std::max({largest, std::abs(of_time), std::abs(of_mass), std::abs(of_length)});
  }
  return largest;
}

// Touch at t = asin(x)/w, x = w gap/v, with w^2 of spring and mass.
TEST(Sensitivity, OfABodyOnASpringThrownAgainstAStopIsThatOfTheClosedForm) {
  Case input = rigid_case(ContactKind::linear, 0.0, 8e-3);
  const double v = 2.0, gap = 3e-3, spring = 4e4;
  input.scene.striker = {};
  input.scene.striker.fixed = true;
  input.scene.striker.gap = gap;
  input.scene.beam.velocity = -v;
  input.scene.beam.springs = {{0.5, spring}};
  const Sensitivity study = study_of(input);
  const double w = std::sqrt(spring / input.scene.beam.mass());
  const double by_gap = gap / v / std::sqrt(1.0 - std::pow(w * gap / v, 2));
  const double touch = std::asin(w * gap / v) / w;
  const EventQuantity start = EventQuantity::start;
  EXPECT_NEAR(derivative(study, start, "striker.gap"), by_gap, 1e-6 * touch);
  EXPECT_NEAR(derivative(study, start, "beam.velocity"), -by_gap, 1e-6 * touch);
  EXPECT_NEAR(derivative(study, start, "beam.springs"), 0.5 * (by_gap - touch), 1e-6 * touch);
}

TEST(Sensitivity, HoldsTheIdentitiesOfTimeMassAndLength) {
  Case elastic = elastic_case(1e-3, 101, Method::exponential);
  Case yielding = elastic;
  yielding.model.section = SectionKind::exact;
  yielding.solver.method = Method::nystrom;
  for (const Case& input : {elastic, yielding}) {
    const Sensitivity study = study_of(input);
    EXPECT_EQ(study.keys.size(), 9u);
    EXPECT_GE(study.base.sub_impacts.size(), 5u);
    EXPECT_LT(largest_defect(study, 1e-3), 1e-5);
  }
}

// --- what is not differentiable -----------------------------------------------------------------

// Those that begin before the last tenth of the run.
std::size_t count_at(Case input, double velocity) {
  input.scene.striker.velocity = velocity;
  const Result result = simulate(sensitivity_case(input));
  return static_cast<std::size_t>(std::ranges::count_if(
      result.sub_impacts, [&](const SubImpact& s) { return s.start < 0.9 * input.end_time; }));
}

bool starts_at(const Case& input, double velocity, double time) {
  Case moved = input;
  moved.scene.striker.velocity = velocity;
  return std::ranges::any_of(
      simulate(sensitivity_case(moved)).sub_impacts,
      [&](const SubImpact& s) { return std::abs(s.start / time - 1.0) < 1e-6; });
}

// A velocity at which the number of sub-impacts changes, to rounding.
double edge_of_count(const Case& input, double low, double high) {
  const std::size_t n = count_at(input, low);
  while (high - low > 4.0 * std::numeric_limits<double>::epsilon() * low) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (count_at(input, middle) == n ? low : high) = middle;
  }
  return low;
}

TEST(Sensitivity, FlagsAContactThatMergesOrAppearsWithinTheShifts) {
  Case input = elastic_case(2e-3, 51, Method::exponential);
  const double first = 10.0;
  double second = first;
  double edge = 0.0;
  do {  // not a contact that moves across the limit of what is counted
    const std::size_t n = count_at(input, second);
    const double last = second;
    while (count_at(input, second) == n) second *= 1.01;
    edge = edge_of_count(input, std::max(last, second / 1.01), second);
  } while (starts_at(input, edge, 0.9 * input.end_time));
  for (const double distance : {-5e-6, -5e-7, 5e-7, 5e-6}) {
    input.scene.striker.velocity = edge * (1.0 + distance);
    const Sensitivity study = study_of(input, {"striker.velocity"});
    const bool flagged = std::any_of(study.rows.begin(), study.rows.end(),
                                     [](const SensitivityRow& row) { return !row.flag.empty(); });
    EXPECT_TRUE(flagged) << distance;
  }
}

TEST(Sensitivity, FlagsTheKinkOfAStruckPointAtTheCentreOfACell) {
  Case input = elastic_case(4e-4, 101, Method::exponential);
  input.scene.striker.position = 40.5 / 101.0;  // a centre
  expect_in(flag_of(study_of(input, {"striker.position"}), 0), "kink");
  input.scene.striker.position = 40.75 / 101.0;
  EXPECT_EQ(flag_of(study_of(input, {"striker.position"}), 0), "");
}

// --- keys ---------------------------------------------------------------------------------------

TEST(Sensitivity, TakesTheNineNumbersOfThePapersExample) {
  Case input = elastic_case(1e-3);
  input.model.section = SectionKind::exact;
  const std::vector<std::string> nine = {"beam.length",  "beam.width",          "beam.thickness",
                                         "beam.density", "beam.youngs_modulus", "beam.yield_stress",
                                         "striker.mass", "striker.nose_radius", "striker.velocity"};
  EXPECT_EQ(sensitivity_keys(input), nine);
}

TEST(Sensitivity, RefusesByNameAKeyWithoutADerivative) {
  Case input = elastic_case(1e-4, 51);
  input.scene.beam.poisson = 0.3;
  input.scene.beam.yield_stress = std::numeric_limits<double>::infinity();
  for (const auto& [key, words] :
       {std::pair("striker.gap", "logarithm"), std::pair("striker.position", "symmetric"),
        std::pair("contact.stiffness", "not given"), std::pair("model.segments", "not a number"),
        std::pair("solver.rtol", "not a number"), std::pair("model.strike_refinement", "an end"),
        std::pair("beam.yield_stress", "logarithm"), std::pair("beam.poisson", "no effect")}) {
    const auto [found, message] = refusal_of([&] { study_of(input, {key}); });
    EXPECT_EQ(found, key);
    expect_in(message, words);
  }
}

TEST(Sensitivity, OfACaseByCentralDifferencesIsMadeByNystromAndRemarksThat) {
  Case input = elastic_case(3e-4, 51, Method::central_difference);
  const Sensitivity study = study_of(input, {"striker.mass"});
  EXPECT_EQ(study.input.solver.method, Method::nystrom);
  ASSERT_EQ(study.remarks.size(), 1u);
  expect_in(study.remarks[0], "by nystrom in place of central-difference");
}

TEST(Sensitivity, DoesNotDependOnTheNumberOfJobs) {
  Case input = elastic_case(5e-4, 51, Method::exponential);
  const Sensitivity one = study_of(input, {"striker.mass"}, 1);
  const Sensitivity three = study_of(input, {"striker.mass"}, 3);
  ASSERT_EQ(one.rows.size(), three.rows.size());
  for (std::size_t i = 0; i < one.rows.size(); ++i) {
    EXPECT_EQ(one.rows[i].by_key[0]->value, three.rows[i].by_key[0]->value);
    EXPECT_EQ(one.rows[i].by_key[0]->error, three.rows[i].by_key[0]->error);
  }
}

TEST(Sensitivity, KeepsTheKeysWhoseRunsHadEndedWhenItIsStopped) {
  Case input = elastic_case(5e-4, 51, Method::nystrom);
  std::size_t n_ended = 0;
  SensitivityOptions options;
  options.keys = {"striker.mass", "striker.velocity"};
  options.finished = [&](std::size_t n, std::size_t n_all) {
    n_ended = n;
    EXPECT_EQ(n_all, 10u);
  };
  options.progress = [&](double) { return n_ended < 7; };
  const Sensitivity study = sensitivity(input, options);
  EXPECT_TRUE(study.interrupted);
  EXPECT_EQ(study.keys, std::vector<std::string>{"striker.mass"});
}

TEST(Sensitivity, HasNoKeysWhereItsBaseRunIsStopped) {
  SensitivityOptions options;
  options.keys = {"striker.mass"};
  options.progress = [](double) { return false; };
  const Sensitivity study = sensitivity(elastic_case(1e-3), options);
  EXPECT_TRUE(study.interrupted);
  EXPECT_TRUE(study.keys.empty());
  EXPECT_TRUE(study.rows.empty());
}

// A number that changes as the root of the distance d from a graze, whose slope is -1/(2 d).
Stencil of_root(double d) {
  Stencil s;
  s.base = 1.0;
  for (std::size_t i = 0; i < sensitivity_shifts.size(); ++i) {
    s.plus[i] = std::sqrt(1.0 - sensitivity_shifts[i] / d);
    s.minus[i] = std::sqrt(1.0 + sensitivity_shifts[i] / d);
  }
  return s;
}

TEST(Stencil, ExtrapolatesWhereNumbersAreSmooth) {
  const double d = 1e-4;
  const Stencil s = of_root(d);
  const double exact = -0.5 / d;
  const Derivative smooth = derivative_of(s, 1e-16, Smoothness::everywhere);
  EXPECT_NEAR(smooth.value, exact, 1e-2 * std::abs(s.slope(1) - exact) + 1e-9 / d);
  EXPECT_GE(smooth.error, std::abs(smooth.value - exact));
  EXPECT_EQ(derivative_of(s, 1e-16, Smoothness::between_thresholds).value, s.slope(1));
}

TEST(Stencil, ShowsTheBendOfASlopeBeyondTheErrorsOfRuns) {
  EXPECT_GT(bend_of_slope(of_root(2e-5), 1e-16), 0.01 * 0.5 / 2e-5);
  EXPECT_EQ(bend_of_slope(of_root(2e-5), 1.0), 0.0);
}

}  // namespace
}  // namespace subimpact
