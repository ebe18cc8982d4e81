// The section correction on a "beam" of one mass on one yielding section, kappa = w, against the
// same motion followed through its events in small steps.

#include "system/section/section_correction.h"

#include "lumped_mesh.h"
#include "order_table.h"
#include "paper_scene.h"
#include "struck_beam_of.h"

namespace subimpact {
namespace {

struct Motion {
  double w, v;
};

// m w'' = -M(w) with omega = 1 while nothing flows.
class OneMass {
 public:
  OneMass() : law_(paper_beam(), Fibres::continuous()) {}
  const SectionLaw& law() const { return law_; }
  double mass() const { return law_.stiffness(); }
  double kappa_y() const { return paper_beam().yield_curvature(); }

  StruckBeam beam() const {
    auto mesh = std::make_unique<LumpedMesh>(mass());
    StruckBeam beam = struck_beam_of(paper_scene(), std::move(mesh), SectionField(1, law_));
    beam.set_section_evaluation(Evaluation::smooth);
    return beam;
  }
  static State state(const Motion& at) { return {at.w, -1.0, at.v, 0.0}; }

  using Moment = std::function<double(double)>;
  // The classical method of fourth order.
  Motion step(const Moment& moment, Motion y, double h) const {
    const auto rates = [&](const Motion& at) { return Motion{at.v, -moment(at.w) / mass()}; };
    const auto along = [](const Motion& at, const Motion& rate, double by) {
      return Motion{at.w + by * rate.w, at.v + by * rate.v};
    };
    const Motion a = rates(y);
    const Motion b = rates(along(y, a, 0.5 * h));
    const Motion c = rates(along(y, b, 0.5 * h));
    const Motion d = rates(along(y, c, h));
    return {y.w + h / 6.0 * (a.w + 2.0 * b.w + 2.0 * c.w + d.w),
            y.v + h / 6.0 * (a.v + 2.0 * b.v + 2.0 * c.v + d.v)};
  }
  // Over a time in which no section event happens.
  Motion smooth(const Moment& moment, Motion y, double time) const {
    constexpr int n = 400;
    for (int i = 0; i < n; ++i) y = step(moment, y, time / n);
    return y;
  }
  // The time, at most `latest`, after which `passed` holds.
  double until(const Moment& moment, const Motion& y, double latest,
               const std::function<bool(const Motion&)>& passed) const {
    double before = 0.0;
    double after = latest;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (before + after);
      (passed(smooth(moment, y, middle)) ? after : before) = middle;
    }
    return after;
  }

 private:
  SectionLaw law_;
};

struct Ends {
  Motion start, uncorrected, exact;
};

// A step in which the section begins to flow at 0.4 of it.
Ends onset(const OneMass& mass, double h) {
  const SectionHistory virgin;
  const auto whole = [&](double w) { return mass.law().moment(virgin, w); };
  const auto elastic = [&](double w) { return mass.law().stiffness() * w; };
  const Motion edge{mass.kappa_y(), 2.0 * mass.kappa_y()};
  const Motion start = mass.smooth(elastic, edge, -0.4 * h);
  return {start, mass.smooth(elastic, start, h), mass.smooth(whole, edge, 0.6 * h)};
}

// A step that begins in flow and reverses at about 0.4 of it.
Ends reversal(const OneMass& mass, double h) {
  const double w0 = 1.6 * mass.kappa_y();
  SectionHistory history;
  const auto moment = [&](double w) { return mass.law().moment(history, w); };
  const Motion start{w0, 0.4 * h * moment(w0) / mass.mass()};
  mass.law().commit(history, w0);
  const SectionBranch branch = mass.law().branch_from_edge(history);
  const auto piece = [&](double w) { return mass.law().moment_on(branch, w); };
  const Motion uncorrected = mass.smooth(piece, start, h);
  const double turns = mass.until(piece, start, h, [](const Motion& at) { return at.v < 0.0; });
  const Motion top = mass.smooth(piece, start, turns);
  mass.law().commit(history, top.w);
  return {start, uncorrected, mass.smooth(moment, top, h - turns)};
}

double corrected_error(const OneMass& mass, const Ends& ends, double h, double tolerance) {
  StruckBeam beam = mass.beam();
  const State y0 = OneMass::state(ends.start);
  State y1 = OneMass::state(ends.uncorrected);
  beam.commit(y0);
  SectionCorrector corrector(beam, tolerance);
  SectionCorrection correction;
  corrector.correct({0.0, h, y0, y1}, correction);
  EXPECT_EQ(correction.events.size(), 1u);
  correction.add_to(y1);
  return std::abs(y1[2] - ends.exact.v);
}

constexpr double first_term_only = std::numeric_limits<double>::infinity();
constexpr double all_terms = 0.0;

struct Orders {
  OrderTable uncorrected, first_term, all;
  Orders(const char* what, double longest, Ends (*ends_of)(const OneMass&, double))
      : uncorrected(std::string(what) + ", not corrected"),
        first_term(std::string(what) + ", corrected by the first term"),
        all(std::string(what) + ", corrected by all terms") {
    const OneMass mass;
    for (const double h : {longest, longest / 2.0, longest / 4.0}) {
      const Ends ends = ends_of(mass, h);
      uncorrected.add(1.0 / h, std::abs(ends.uncorrected.v - ends.exact.v));
      first_term.add(1.0 / h, corrected_error(mass, ends, h, first_term_only));
      all.add(1.0 / h, corrected_error(mass, ends, h, all_terms));
    }
  }
};

// The defect grows as the square of the time: its zeroth moment, all that is corrected first, with
// the third power of the step. Left out then is the second, with the fifth, and in the end the
// sixth, with the ninth.
TEST(TheSectionCorrection, RaisesTheOrderOfAStepInWhichASectionReverses) {
  const Orders orders("reversal", 0.8, reversal);
  orders.uncorrected.expect_every_order_within(2.8, 3.2);
  orders.first_term.expect_every_order_within(4.8, 5.2);
  orders.all.expect_every_order_within(8.5, 9.5);
}

// Here the section's own flow moves its path, by a response that is taken to be of a given shape.
TEST(TheSectionCorrection, RaisesTheOrderOfAStepInWhichASectionBeginsToFlow) {
  const Orders orders("onset", 0.2, onset);
  orders.uncorrected.expect_every_order_within(2.6, 3.2);
  orders.first_term.expect_every_order_within(4.2, 5.2);
  orders.all.expect_every_order_within(5.5, 7.5);
}

TEST(TheSectionCorrection, ChangesNothingInTheBeam) {
  const OneMass mass;
  const Ends ends = reversal(mass, 0.4);
  StruckBeam beam = mass.beam();
  const State y0 = OneMass::state(ends.start);
  const State y1 = OneMass::state(ends.uncorrected);
  beam.commit(y0);
  const double edge = beam.sections().history(0).edge.x;
  SectionCorrector corrector(beam, all_terms);
  SectionCorrection once, twice;
  corrector.correct({0.0, 0.4, y0, y1}, once);
  corrector.correct({0.0, 0.4, y0, y1}, twice);
  EXPECT_EQ(beam.sections().history(0).edge.x, edge);
  EXPECT_EQ(once.velocity_change, twice.velocity_change);
  ASSERT_TRUE(once.events.front().reversal);
  EXPECT_GT(once.reversed(beam.sections()).history(0).edge.x, edge);
}

}  // namespace
}  // namespace subimpact
