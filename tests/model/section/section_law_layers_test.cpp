// The section law's closed forms against stacks of layers, fibre by fibre.

#include "model/section/section_law.h"
#include "order_table.h"
#include "paper_scene.h"
#include "random_walk.h"
#include "section/layered_section.h"

namespace subimpact {
namespace {

struct Differences {
  double moment = 0.0;   // in M_y
  double elastic = 0.0;  // in M_y kappa_y
  double plastic = 0.0;  // in M_y kappa_y
  double stress = 0.0;   // in Y
  double plastic_total = 0.0, mean_square_moment = 0.0;
};

// Largest differences over a walk in units of the yield curvature, each state looked at before and
// after it is committed.
Differences compare(const Fibres& fibres, int layers, const std::vector<double>& walk) {
  const Beam beam = paper_beam();
  const SectionLaw law(beam, fibres);
  LayeredSection stack(beam, layers);
  SectionHistory history;
  Differences largest;
  const double moment_unit = beam.yield_moment();
  const double energy_unit = moment_unit * beam.yield_curvature();
  const auto look = [&](double curvature) {
    const double elastic = law.elastic_energy(history, curvature);
    const double plastic = law.work(history, curvature) - elastic;
    const auto keep = [](double& most, double difference) {
      most = std::max(most, std::abs(difference));
    };
    keep(largest.moment, (law.moment(history, curvature) - stack.moment()) / moment_unit);
    keep(largest.elastic, (elastic - stack.elastic_energy()) / energy_unit);
    keep(largest.plastic, (plastic - stack.plastic_work()) / energy_unit);
    keep(largest.stress,
         (law.outer_stress(history, curvature) - stack.outer_stress()) / beam.yield_stress);
  };
  for (const double x : walk) {
    const double curvature = x * beam.yield_curvature();
    stack.bend_to(curvature);
    look(curvature);
    law.commit(history, curvature);
    look(curvature);
    largest.mean_square_moment +=
        std::pow((law.moment(history, curvature) - stack.moment()) / moment_unit, 2) /
        static_cast<double>(walk.size());
  }
  largest.plastic_total = stack.plastic_work() / energy_unit;
  return largest;
}

void expect_rounding(const Differences& found) {
  EXPECT_LE(found.moment, 1e-12);
  EXPECT_LE(found.elastic, 1e-12);
  EXPECT_LE(found.plastic, 1e-13 * std::max(1.0, found.plastic_total));  // a sum over all steps
  EXPECT_LE(found.stress, 1e-12);
}

TEST(SectionLaw, OfLayersIsTheReturnMapOfEveryLayerOnRandomWalks) {
  for (const int layers : {2, 4, 10, 40}) {
    for (unsigned seed = 0; seed < 25; ++seed) {
      SCOPED_TRACE(testing::Message() << layers << " layers, seed " << seed);
      const std::vector<double> walk = nested_walk(seed, 3000, -8.0, 8.0, 6.0);
      expect_rounding(compare(Fibres::layered(layers), layers, walk));
    }
  }
}

TEST(SectionLaw, OfLayersIsTheReturnMapOnSmallLoopsAboutALargeCurvature) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::vector<double> walk{9.0};
    for (const double x : nested_walk(seed, 3000, 3.0, 8.9, 3.0)) walk.push_back(x);
    walk.push_back(-20.0);
    for (const double x : nested_walk(seed + 100, 3000, -19.0, 19.0, 30.0)) walk.push_back(x);
    expect_rounding(compare(Fibres::layered(40), 40, walk));
  }
}

TEST(SectionLaw, OfLayersIsTheReturnMapOnSpiralsInwardsAndOutwards) {
  std::vector<double> walk;
  for (int i = 0; i < 40; ++i) walk.push_back((i % 2 == 0 ? 1.0 : -1.0) * 10.0 * std::pow(0.93, i));
  for (int i = 0; i < 40; ++i) walk.push_back((i % 2 == 0 ? 1.0 : -1.0) * 1.1 * std::pow(1.07, i));
  expect_rounding(compare(Fibres::layered(40), 40, walk));
}

TEST(SectionLaw, OfLayersIsTheReturnMapWhenReversalPointsAreMetExactly) {
  const std::vector<double> walk{3.0,  -3.0, 3.0,  -3.0, 2.0, -1.0, 2.0, -1.0, 2.0,
                                 -3.0, 3.0,  -5.0, 5.0,  0.0, 5.0,  0.0, -5.0, 0.0};
  expect_rounding(compare(Fibres::layered(40), 40, walk));
}

TEST(SectionLaw, OfLayersApproachesTheExactLawAtSecondOrderOnRandomWalks) {
  // Where layers yield relative to the reversals is chance: means over many walks show the order.
  OrderTable moments("bending moment, layers against the exact law over random walks, M_y");
  OrderTable works("plastic work at the walks' ends, the same, M_y kappa_y");
  for (const int layers : {20, 40, 80, 160, 320}) {
    double moment = 0.0, work = 0.0;
    const int n_walks = 40;
    for (unsigned seed = 0; seed < n_walks; ++seed) {
      const std::vector<double> walk = nested_walk(seed, 800, -8.0, 8.0, 6.0);
      const Differences found = compare(Fibres::continuous(), layers, walk);
      moment += found.mean_square_moment / n_walks;
      work += found.plastic / n_walks;
    }
    moments.add(layers, std::sqrt(moment));
    works.add(layers, work);
  }
  moments.expect_every_order_within(1.7, 2.3);
  moments.expect_overall_order_within(1.9, 2.1);
  works.expect_every_order_within(1.7, 2.3);
  works.expect_overall_order_within(1.9, 2.1);
}

}  // namespace
}  // namespace subimpact
