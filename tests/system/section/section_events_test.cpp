// What one section does within a step, on a path that is given: when it leaves its piece, where it
// reverses, and the moments of the defect that follows.

#include "system/section/section_events.h"
#include "dense.h"
#include "kinds_of_mesh.h"
#include "order_table.h"

namespace subimpact {
namespace {

// kappa(t) = kappa_y (1 + 0.6 sin(omega t)), a section of the paper's beam that flows from the
// start on its virgin curve where kappa exceeds kappa_y.
class OneSection {
 public:
  static constexpr double omega = 1.0;

  double kappa(double t) const { return kappa_y_ * (1.0 + 0.6 * std::sin(omega * t)); }
  HermiteSeptic path(double t0, double t1) const {
    return {derivatives(t0), derivatives(t1), t1 - t0};
  }
  const SectionLaw& law() const { return law_; }
  double stiffness() const { return law_.stiffness(); }

 private:
  HermiteSeptic::End derivatives(double t) const {
    const double a = 0.6 * kappa_y_;
    return {kappa(t), a * std::cos(t), -a * std::sin(t), -a * std::cos(t)};
  }
  double kappa_y_ = paper_beam().yield_curvature();
  SectionLaw law_{paper_beam(), Fibres::continuous()};
};

// int (t1 - t)^k/k! f(t) dt by Simpson's rule on a fine grid.
template <class F>
double moment_of(F f, double from, double to, double t1, int k) {
  const int n = 2000;
  const double h = (to - from) / n;
  double sum = 0.0;
  for (int i = 0; i <= n; ++i) {
    const double t = from + i * h;
    const double weight = i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * std::pow(t1 - t, k) / std::tgamma(k + 1.0) * f(t);
  }
  return sum * h / 3.0;
}

struct Errors {
  double time, curvature;
  double moments[2];  // relative

  template <class Event, class Defect>
  void see(const Event& event, const Defect& defect, double from, double t1) {
    for (const int k : {0, 1}) {
      moments[k] = std::abs(event.defect_moments[static_cast<std::size_t>(k)] /
                                moment_of(defect, from, t1, t1, k) -
                            1.0);
    }
  }
};

// A step in which the section begins to flow, at the part `before` of it, t = 0.
Errors onset(double step, double before) {
  const OneSection section;
  const double t0 = -before * step;
  const double t1 = t0 + step;
  const SectionField sections(1, section.law());
  SectionPath path;
  path.reset(section.path(t0, t1));
  const auto event =
      follow_section(sections, {0, nullptr, 1.0, before, {}}, path, 0.0, 1.0, t0, step);
  EXPECT_TRUE(event && !event->reversal);
  Errors errors{std::abs(event->start), 0.0, {}};
  const auto defect = [&](double t) {
    return section.law().moment({}, section.kappa(t)) - section.stiffness() * section.kappa(t);
  };
  errors.see(*event, defect, 0.0, t1);
  return errors;
}

// A step in which the section, flowing, reverses at the part `before` of it, t = pi/2.
Errors reversal(double step, double before) {
  const OneSection section;
  const double turns = 0.5 * std::numbers::pi;
  const double t0 = turns - before * step;
  const double t1 = t0 + step;
  SectionField sections(1, section.law());
  const double start = section.kappa(t0);
  sections.commit({&start, 1}, std::vector<double>{1.0});
  SectionPath path;
  path.reset(section.path(t0, t1));
  const SectionBranch& branch = sections.flowing().front().branch;
  const auto event =
      follow_section(sections, {0, &branch, 1.0, before, before}, path, 0.0, 1.0, t0, step);
  EXPECT_TRUE(event && event->reversal);
  Errors errors{std::abs(event->reversal->time - turns),
                std::abs(event->reversal->curvature - section.kappa(turns)),
                {}};
  SectionHistory after = sections.history(0);
  section.law().commit(after, section.kappa(turns));
  const auto defect = [&](double t) {
    return section.law().moment(after, section.kappa(t)) -
           section.law().moment_on(branch, section.kappa(t));
  };
  errors.see(*event, defect, turns, t1);
  return errors;
}

// The path is a polynomial of degree seven, off by h^8; a reversal is where its slope vanishes. The
// defect grows as the square of the time.
TEST(OneSectionOnAKnownPath, ReversesWhereTheSepticThroughTheEndsDoes) {
  OrderTable times("reversal: time");
  OrderTable curvatures("reversal: curvature");
  OrderTable zeroth("reversal: zeroth moment, relative");
  OrderTable first("reversal: first moment, relative");
  for (const double step : {1.6, 1.13, 0.8}) {
    const Errors errors = reversal(step, 0.4);
    times.add(1.0 / step, errors.time);
    curvatures.add(1.0 / step, errors.curvature);
    zeroth.add(1.0 / step, errors.moments[0]);
    first.add(1.0 / step, errors.moments[1]);
  }
  times.expect_every_order_within(6.5, 7.5);
  curvatures.expect_every_order_within(7.5, 8.5);
  zeroth.expect_every_order_within(5.5, 6.5);
  first.expect_every_order_within(5.5, 6.5);
}

TEST(OneSectionOnAKnownPath, HasTheDefectThatFollowsItsFirstFlow) {
  OrderTable zeroth("onset: zeroth moment, relative");
  OrderTable first("onset: first moment, relative");
  for (const double step : {1.6, 1.13, 0.8}) {
    const Errors errors = onset(step, 0.4);
    EXPECT_LT(errors.time, 1e-15);
    zeroth.add(1.0 / step, errors.moments[0]);
    first.add(1.0 / step, errors.moments[1]);
  }
  zeroth.expect_every_order_within(7.5, 8.8);
  first.expect_every_order_within(7.5, 8.8);
}

TEST(OneSectionOnAKnownPath, StaysOnItsPieceIfAnEarlierEventKeepsItInItsWindow) {
  const OneSection section;
  const SectionField sections(1, section.law());
  const double length = 2.6;
  const double t0 = -0.3 * length;
  const double top = (0.5 * std::numbers::pi - t0) / length;
  const auto follow = [&](double pushed_back) {
    SectionPath path;
    path.reset(section.path(t0, t0 + length));
    path.add_other({0.0, 1.0, length, -1.0, 3.0 * pushed_back / length, pushed_back});
    return follow_section(sections, {0, nullptr, 1.0, 0.3, top}, path, 0.0, 0.0, t0, length);
  };
  EXPECT_TRUE(follow(0.0).has_value());
  EXPECT_FALSE(follow(5.0 * paper_beam().yield_curvature()).has_value());
}

// What one section's moment does to the beam, worked out once a section.

// Calls check(mesh, solver, influence) on meshes with a banded mass.
template <class Check>
void on_every_mesh(Check check) {
  const auto on = [&](const std::shared_ptr<const BeamMesh>& mesh) {
    SCOPED_TRACE(mesh->description());
    const BandedSolver solver(mesh->mass());
    SectionInfluence influence(*mesh, solver);
    check(*mesh, solver, influence);
  };
  for (const Kind kind : {Kind::cells, Kind::hermite, Kind::timoshenko}) {
    Beam beam = beam_with(free_ends, kind);
    on(make_mesh(kind, beam, 0.5, has_cells(kind) ? 201 : 40, true));
    on(make_mesh(kind, beam_with({pinned, clamped}, kind), 0.317, 60));
    if (shears(kind)) continue;
    beam.theory = BeamTheory::euler_bernoulli;
    on(make_mesh(kind, beam, 0.5, has_cells(kind) ? 201 : 40, true));
  }
}

TEST(SectionInfluence, GivesTheCurvatureAccelerationsThatAMassSolveGives) {
  on_every_mesh([](const BeamMesh& mesh, const BandedSolver& solver, SectionInfluence& influence) {
    const std::vector<double> moments = random_numbers(7, mesh.n_sections());
    constexpr double force = 3.0;
    std::vector<double> accelerations = bending_forces_of(mesh, moments);
    mesh.struck_point().add_to(accelerations, force);
    std::vector<double> shear_forces(mesh.shears() ? mesh.n_unknowns() : 0, 0.0);
    mesh.add_shear_forces(random_numbers(8, mesh.n_unknowns(), 1e-9), shear_forces);
    for (std::size_t i = 0; i < shear_forces.size(); ++i) accelerations[i] += shear_forces[i];
    solver.solve(accelerations);
    const std::vector<double> expected = curvatures_of(mesh, accelerations);
    std::vector<double> weighted = moments;
    for (std::size_t i = 0; i < weighted.size(); ++i) weighted[i] *= mesh.section_weights()[i];
    const double largest = largest_of(expected);
    for (std::size_t i = 0; i < weighted.size(); ++i) {
      EXPECT_NEAR(influence.curvature_acceleration(i, weighted, force, shear_forces), expected[i],
                  1e-13 * largest)
          << "section " << i;
    }
  });
}

TEST(SectionInfluence, AddsUpToTheAccelerationsOfAllMoments) {
  on_every_mesh([](const BeamMesh& mesh, const BandedSolver& solver, SectionInfluence& influence) {
    const std::vector<double> moments = random_numbers(11, mesh.n_sections());
    std::vector<double> expected = bending_forces_of(mesh, moments);
    solver.solve(expected);
    std::vector<double> sum(mesh.n_unknowns(), 0.0);
    for (std::size_t i = 0; i < moments.size(); ++i) {
      influence.add_accelerations(i, moments[i], sum);
    }
    expect_near(sum, expected, 1e-13 * largest_of(expected));
  });
}

TEST(SectionInfluence, OfOneSectionOnAnotherIsTheCurvatureOfItsAccelerations) {
  on_every_mesh([](const BeamMesh& mesh, const BandedSolver&, SectionInfluence& influence) {
    for (const std::size_t section : {std::size_t{0}, mesh.n_sections() / 3}) {
      std::vector<double> accelerations(mesh.n_unknowns(), 0.0);
      influence.add_accelerations(section, 1.0, accelerations);
      const std::vector<double> curvatures = curvatures_of(mesh, accelerations);
      const double own = std::abs(curvatures[section]);
      for (std::size_t other = 0; other < mesh.n_sections(); ++other) {
        EXPECT_NEAR(influence.curvature_acceleration_at(other, section), curvatures[other],
                    1e-13 * own);
      }
    }
  });
}

}  // namespace
}  // namespace subimpact
