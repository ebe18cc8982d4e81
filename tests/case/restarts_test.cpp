// Where a run begins anew: after flights, at corners of the loads, at times that all but coincide.

#include <cmath>
#include <random>

#include "linear_case.h"
#include "rigid_case.h"
#include "runs.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

constexpr Method adaptive[] = {Method::erk,  Method::nystrom, Method::exponential,
                               Method::dirk, Method::adams,   Method::bdf};

// A mass of 0.1 g to 10 kg that falls for 1 mm to 10 m onto a rigid plane and bounces.
Case drop(ContactKind kind, bool damped, std::mt19937& random) {
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, std::uniform_real_distribution<>()(random));
  };
  Case input = rigid_case(kind, 0.0, 1.0);
  input.scene.beam.fixed = true;
  input.scene.beam.thickness = 1.0;
  input.scene.gravity = 9.81;
  input.scene.striker.mass = between(1e-4, 10.0);
  input.scene.striker.drop_height = between(1e-3, 10.0);
  if (kind == ContactKind::sphere) {
    input.scene.striker.nose_radius = between(1e-3, 0.1);
    input.scene.contact = {ContactKind::sphere, {}, 2e11, 0.3, 0.3};
  } else {
    input.scene.contact.stiffness = between(1e5, 1e8) * (kind == ContactKind::hertz ? 1e2 : 1.0);
    if (damped) input.scene.contact.damping = between(1e-3, 0.3);
  }
  input.end_time = 3.0 * std::sqrt(2.0 * *input.scene.striker.drop_height / 9.81);
  input.output.interval = 0.0;
  return input;
}

TEST(Restarts, AfterFlightsUnderGravitySucceedWithEveryAdaptiveMethodAndLaw) {
  for (const ContactKind kind : {ContactKind::linear, ContactKind::hertz, ContactKind::sphere}) {
    for (const bool damped : {false, true}) {
      if (damped && kind == ContactKind::sphere) continue;
      for (const Method method : adaptive) {
        if (damped && (method == Method::exponential || method == Method::nystrom)) continue;
        std::mt19937 random(1);
        for (int i = 0; i < 40; ++i) {
          Case input = drop(kind, damped, random);
          input.solver.method = method;
          const Result result = simulate(input);
          EXPECT_TRUE(result.outcome.completed())
              << to_string(method) << ' ' << i << ' ' << static_cast<int>(kind) << ' '
              << input.scene.striker.mass << " kg from " << *input.scene.striker.drop_height
              << " m, " << input.scene.contact.damping << " s/m: " << result.outcome.message;
          EXPECT_GE(result.sub_impacts.size(), 2u) << to_string(method) << ' ' << i;
        }
      }
    }
  }
}

TEST(Restarts, AtCornersBesideRowsOneUlpAway) {
  const double row = 3e-4;
  const double beside[] = {1e-300, 1e-20, std::nextafter(row, 0.0), row, std::nextafter(row, 1.0)};
  for (const double corner : beside) {
    for (const Method method : adaptive) {
      Case input = rigid_case(ContactKind::linear, 1.0, 2e-3);
      input.scene.striker.mass = 1.0;
      input.scene.beam.forces = {{0.5, {{0.0, 0.0}, {corner, 1.0}, {2e-3, 0.0}}}};
      input.solver.method = method;
      input.output.interval = 1e-4;
      const Result result = simulate(input);
      EXPECT_TRUE(result.outcome.completed())
          << to_string(method) << ' ' << corner << ": " << result.outcome.message;
      EXPECT_LT(result.max_energy_error, 1e-6) << to_string(method) << ' ' << corner;
    }
  }
}

TEST(Ends, AtAnEventOrTwoUlpBesideItHaveNoRowThatTheWholeRunLacks) {
  for (const ContactKind kind : {ContactKind::linear, ContactKind::foundation}) {
    for (const Method method : {Method::nystrom, Method::exponential, Method::dirk}) {
      Case input = linear_case(MeshKind::hermite, 8, 0.5, EndSupport::free);
      input.scene.contact.kind = kind;
      input.scene.contact.stiffness.reset();
      if (kind == ContactKind::linear) input.scene.contact.stiffness = 2e7;
      input.solver.method = method;
      input.solver.rtol = 1e-8;
      const Result whole = completed(input);
      std::vector<double> times;
      for (const SubImpact& s : whole.sub_impacts) {
        if (s.start > 0.0) times.push_back(s.start);
        if (s.end) times.push_back(*s.end);
      }
      ASSERT_GE(times.size(), 3u);
      for (const double event : times) {
        double end = std::nextafter(std::nextafter(event, 0.0), 0.0);
        for (int ulp = -2; ulp <= 2; ++ulp, end = std::nextafter(end, 1.0)) {
          input.end_time = end;
          const Result cut = completed(input);
          ASSERT_LE(cut.sub_impacts.size(), whole.sub_impacts.size());
          for (std::size_t i = 0; i < cut.sub_impacts.size(); ++i) {
            EXPECT_NEAR(cut.sub_impacts[i].start, whole.sub_impacts[i].start, 1e-15)
                << to_string(method) << ", " << event << " s and " << ulp << " ulp";
          }
        }
      }
    }
  }
}

// Corners of a load, rows, the first touch and the end of a run that all but meet.
TEST(Restarts, WhereTimesOfDifferentKindsMeet) {
  const double at = 3e-4;
  const double close[] = {std::nextafter(at, 0.0), at, std::nextafter(at, 1.0)};
  const auto complete = [](Case input, const char* what, double t) {
    for (const Method method : adaptive) {
      // Open: a touch within a rounding of a corner ends where it begins by multistep methods.
      const bool is_multistep = method == Method::adams || method == Method::bdf;
      if (is_multistep && std::string_view(what).starts_with("touch")) continue;
      input.solver.method = method;
      input.solver.rtol = 1e-10;
      const Result result = simulate(input);
      EXPECT_TRUE(result.outcome.completed())
          << to_string(method) << ", " << what << ' ' << t << ": " << result.outcome.message;
      EXPECT_LT(result.max_energy_error, 1e-6) << to_string(method) << ", " << what << ' ' << t;
    }
  };
  for (const double t : close) {
    Case input = rigid_case(ContactKind::linear, 1.0, 2e-3);
    input.scene.striker.mass = 1.0;
    input.output.interval = 1e-4;
    Case two = input;
    two.scene.beam.forces = {{0.5, {{0.0, 0.0}, {t, 1.0}, {at, 2.0}, {2e-3, 0.0}}}};
    if (t <= at) complete(two, "two corners", t);
    Case end = input;
    end.end_time = t;
    end.scene.beam.forces = {{0.5, {{0.0, 0.0}, {at, 1.0}, {2e-3, 0.0}}}};
    complete(end, "end beside a corner and a row", t);
    Case start = input;
    start.scene.striker.gap = t;  // at 1 m/s
    start.scene.beam.forces = {{0.5, {{0.0, 0.0}, {at, 0.0}, {2e-3, 1.0}}}};
    complete(start, "touch beside a corner and a row", t);
  }
  for (const double tiny : {1e-300, 5e-324}) {
    Case input = rigid_case(ContactKind::linear, 1.0, 2e-3);
    input.output.interval = 1e-4;
    input.scene.striker.gap = 1e-50;
    complete(input, "gap beside", tiny);
    input.scene.striker.gap = 0.0;
    input.scene.beam.forces = {{0.5, {{0.0, 0.0}, {tiny, 1.0}, {2.0 * tiny, 0.0}, {2e-3, 1.0}}}};
    complete(input, "corners", tiny);
  }
}

// m g d = K d^(n + 1)/(n + 1) at the largest indentation d.
TEST(Restarts, AStrikerSetDownPressesWithItsWeightTimesNPlus1) {
  for (const auto& [kind, n] : {std::pair{ContactKind::linear, 1.0}, {ContactKind::hertz, 1.5}}) {
    Case input = rigid_case(kind, 0.0, 0.05);
    input.scene.beam.fixed = true;
    input.scene.gravity = 9.81;
    const double weight = input.scene.striker.mass * 9.81;
    for (const double v : {0.0, 1e-20, 1e-12, 1e-9, 1e-6}) {
      for (const Method method : adaptive) {
        input.scene.striker.velocity = v;
        input.solver.method = method;
        const Result result = simulate(input);
        EXPECT_TRUE(result.outcome.completed()) << v << ": " << result.outcome.message;
        EXPECT_NEAR(result.max_force, (n + 1.0) * weight, 2e-3 * weight)
            << v << ' ' << to_string(method);
        EXPECT_TRUE(v > 0.0 || !result.restitution);
      }
    }
  }
}

TEST(Restarts, AStrikerSetDownNeedsABeamAtRestUnderItsOwnWeight) {
  Case input = rigid_case(ContactKind::hertz, 0.0, 2e-2);
  input.model.mesh = MeshKind::cells;
  input.model.elements = 100;
  input.scene.beam.ends = {EndSupport::pinned, EndSupport::pinned};
  input.scene.gravity = 9.81;
  EXPECT_THROW(simulate(input), InvalidCase);
  input.scene.beam.start = BeamStart::equilibrium;
  const Result result = simulate(input);
  EXPECT_TRUE(result.outcome.completed()) << result.outcome.message;
  ASSERT_FALSE(result.sub_impacts.empty());
  EXPECT_EQ(result.sub_impacts[0].start, 0.0);
  EXPECT_GT(result.max_force, input.scene.striker.mass * 9.81);
  input.scene.contact.restitution = 0.5;
  EXPECT_THROW(simulate(input), InvalidCase);
}

}  // namespace
}  // namespace subimpact
