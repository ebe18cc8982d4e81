// The contact law against what it stands for: a bed of columns, each with its own plastic memory.

#include "built_in_law.h"
#include "order_table.h"
#include "paper_scene.h"
#include "random_walk.h"

namespace subimpact {
namespace {

/// Columns of depth h and modulus E/h, elastic-perfectly plastic at Y, side by side along one half
/// of the contact, under a rigid cylinder in the parabolic approximation. A column is pressed by
/// lambda - s^2/(2R), carries no tension, and keeps the shortening it has flowed.
class ColumnBed {
 public:
  ColumnBed(const Scene& scene, std::size_t n_columns, double deepest)
      : radius_(scene.striker.nose_radius.value()),
        modulus_(scene.beam.youngs_modulus / scene.beam.thickness),
        yield_stress_(scene.beam.yield_stress),
        width_(scene.beam.width),
        spacing_(std::sqrt(2.0 * radius_ * deepest) / static_cast<double>(n_columns)),
        flowed_(n_columns, 0.0) {}

  double press(double indentation) {
    double sum = 0.0;
    for (std::size_t i = 0; i < flowed_.size(); ++i) {
      const double s = (static_cast<double>(i) + 0.5) * spacing_;
      const double shortening = indentation - s * s / (2.0 * radius_);
      double stress = modulus_ * (shortening - flowed_[i]);
      if (stress > yield_stress_) {
        flowed_[i] += (stress - yield_stress_) / modulus_;
        stress = yield_stress_;
      }
      sum += std::max(stress, 0.0);
    }
    return 2.0 * width_ * spacing_ * sum;
  }

  /// The midpoint rule's error on a stress that is a parabola with kinks: each kink, where the
  /// slope changes by at most that of the parabola's rim, costs at most 1/8 of it times the spacing
  /// squared. Three kinks (rim of the contact, of the flow now, of the flow before), and the
  /// parabola's own 1/24.
  double error_bound() const {
    const double rim = spacing_ * static_cast<double>(flowed_.size());
    const double steepest = modulus_ * rim / radius_;
    return 2.0 * width_ * steepest * spacing_ * spacing_ * (3.0 / 8.0 + 1.0 / 24.0);
  }

 private:
  double radius_, modulus_, yield_stress_, width_, spacing_;
  std::vector<double> flowed_;
};

double largest_difference(std::size_t n_columns, const std::vector<double>& walk, double deepest) {
  const Scene scene = paper_scene();
  const PowerContact law = law_of(scene);
  ColumnBed bed(scene, n_columns, deepest);
  ContactHistory history;
  double largest = 0.0;
  for (const double indentation : walk) {
    const double force = law.contact_force(history, indentation);
    history = law.commit(history, indentation);
    const double difference = std::abs(bed.press(indentation) - force);
    EXPECT_LE(difference, bed.error_bound());
    largest = std::max(largest, difference);
  }
  return largest;
}

TEST(ContactLaw, IsTheSumOverAThousandColumnsOnRandomHistories) {
  const double unit = law_of(paper_scene()).yield_indentation();
  const double deepest = 12.0 * unit;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::vector<double> walk = nested_walk(seed, 1000, -unit, deepest, 5.0 * unit);
    const double force_at_yield = 1822.90;
    EXPECT_LE(largest_difference(1000, walk, deepest), 1e-4 * force_at_yield) << "seed " << seed;
  }
}

// Under noses that are round both ways, columns at equal gaps x^2/(2 R_1) + y^2/(2 R_2) = g are
// pressed alike, and the area between two gaps is 2 pi sqrt(R_1 R_2) dg.
TEST(ContactLaw, UnderARoundNoseIsTheSumOverRingsOfColumns) {
  Scene scene = paper_scene();
  const double R = scene.striker.nose_radius.value();
  const auto check = [&](double area_per_gap) {
    const PowerContact law = law_of(scene);
    const double unit = law.yield_indentation(), deepest = 12.0 * unit;
    const double modulus = scene.beam.youngs_modulus / scene.beam.height();
    constexpr int n = 4000;
    std::vector<double> flowed(n, 0.0);
    ContactHistory history;
    for (const double indentation : nested_walk(3, 500, -unit, deepest, 5.0 * unit)) {
      double sum = 0.0;
      for (int i = 0; i < n; ++i) {
        const double shortening = indentation - (i + 0.5) * deepest / n;
        double& rest = flowed[static_cast<std::size_t>(i)];
        rest = std::max(rest, shortening - unit);
        sum += std::max(modulus * (shortening - rest), 0.0) * area_per_gap * deepest / n;
      }
      const double force = law.contact_force(history, indentation);
      history = law.commit(history, indentation);
      EXPECT_NEAR(force, sum, 1e-5 * law.plastic_force(deepest));
    }
  };
  scene.striker.nose = NoseShape::sphere;
  check(2.0 * M_PI * R);
  scene.beam.section = {.shape = SectionShape::circle, .diameter = 0.03};
  check(2.0 * M_PI * std::sqrt(R / (1.0 / R + 1.0 / 0.015)));
  scene.striker.nose = NoseShape::cylinder;
  check(2.0 * M_PI * std::sqrt(R * 0.015));
}

TEST(ContactLaw, IsTheLimitOfManyColumnsApproachedAtSecondOrder) {
  const double unit = law_of(paper_scene()).yield_indentation();
  const double deepest = 12.0 * unit;
  const std::vector<double> walk = nested_walk(1, 3000, -unit, deepest, 5.0 * unit);
  OrderTable table("columns under the nose against the contact law, N");
  for (const std::size_t n : {250u, 500u, 1000u, 2000u, 4000u}) {
    table.add(static_cast<double>(n), largest_difference(n, walk, deepest));
  }
  // Where the kinks fall between the columns makes the single ratios swing.
  table.expect_every_order_within(1.7, 2.3);
  table.expect_overall_order_within(1.9, 2.1);
}

}  // namespace
}  // namespace subimpact
