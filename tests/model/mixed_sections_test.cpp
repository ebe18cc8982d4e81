// The bending of mixed cells at given displacements.

#include "model/mixed_sections.h"

#include "paper_scene.h"
#include "testing.h"

namespace subimpact {
namespace {

class BentMixedCells : public testing::Test {
 protected:
  // The middle displaced sharply, times `size`: elastic up to 0.02, a hinge above 1.
  std::vector<double> bent(double size) const {
    std::vector<double> w(mesh_.n_unknowns());
    for (std::size_t i = 0; i < w.size(); ++i) {
      const double x = (mesh_.node_position(i) - 0.5 * beam_.length) / 0.01;
      w[i] = size * 1e-4 * std::exp(-std::abs(x)) * (1.0 + std::abs(x));
    }
    return w;
  }
  double largest_moment() const {
    double largest = 0.0;
    for (const double k : sections_.elastic_curvatures()) largest = std::max(largest, std::abs(k));
    return largest / beam_.yield_curvature();
  }

  Beam beam_ = paper_beam();
  MixedMesh mesh_{beam_, 0.5, 200, MixedMesh::Extent::half};
  MixedSections sections_{mesh_, beam_.bending_stiffness(),
                          SectionLaw(beam_, Fibres::continuous())};
};

TEST_F(BentMixedCells, CarryNoMomentAboveTheFullPlasticOne) {
  for (const double size : {0.01, 0.05, 0.2, 0.5, 1.0, 2.0, 4.0}) {
    std::vector<double> w = bent(size);
    ASSERT_TRUE(sections_.settle(w)) << size;
    EXPECT_LE(largest_moment(), 1.5 + 1e-5) << size;
    sections_.commit(0.0);
  }
  EXPECT_GT(largest_moment(), 1.49);
  EXPECT_GE(sections_.n_yielded(), 3u);
}

TEST_F(BentMixedCells, HaveTheSameMomentsWhenEvaluatedWhereTheyHaveSettled) {
  for (const double size : {0.05, 0.2, 0.6, 0.4, -0.3}) {
    std::vector<double> w = bent(size);
    ASSERT_TRUE(sections_.settle(w));
    const std::vector<double> settled(sections_.elastic_curvatures().begin(),
                                      sections_.elastic_curvatures().end());
    ASSERT_TRUE(sections_.evaluate(w));
    for (std::size_t i = 0; i < settled.size(); ++i) {
      EXPECT_NEAR(sections_.elastic_curvatures()[i], settled[i], 1e-4 * beam_.yield_curvature());
    }
    sections_.commit(0.0);
  }
}

TEST_F(BentMixedCells, StayPutWhileNothingFlows) {
  const std::vector<double> straight(mesh_.n_unknowns(), 0.25);
  std::vector<double> w = straight;
  ASSERT_TRUE(sections_.settle(w));
  EXPECT_EQ(w, straight);
  EXPECT_FALSE(sections_.commit(0.0));
  EXPECT_EQ(sections_.energies().plastic, 0.0);
}

TEST_F(BentMixedCells, ForgetWhatWasNotCommitted) {
  std::vector<double> small = bent(0.05), far = bent(1.0);
  ASSERT_TRUE(sections_.settle(far));
  EXPECT_GT(sections_.energies().plastic, 0.0);
  const std::vector<double> straight(mesh_.n_unknowns(), 0.0);
  ASSERT_TRUE(sections_.evaluate(straight));
  EXPECT_EQ(largest_moment(), 0.0);
  EXPECT_EQ(sections_.energies().plastic, 0.0);
}

// What bends the beam by force and lets go leaves the plastic work behind, and no less.
TEST_F(BentMixedCells, LoseNoPlasticWork) {
  double before = 0.0;
  for (const double size : {0.1, 0.3, 0.1, -0.2, 0.5, 0.0}) {
    std::vector<double> w = bent(size);
    ASSERT_TRUE(sections_.settle(w));
    EXPECT_GE(sections_.energies().plastic, before - 1e-12);
    before = sections_.energies().plastic;
    sections_.commit(0.0);
    EXPECT_NEAR(sections_.energies().plastic, before, 1e-9 * (1.0 + before));
  }
}

}  // namespace
}  // namespace subimpact
