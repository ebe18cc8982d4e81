// The contact law against what it stands for: a bed of columns, each with its own plastic memory.

#include <gtest/gtest.h>

#include "built_in_law.h"
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
    largest = std::max(largest, std::abs(bed.press(indentation) - force));
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

}  // namespace
}  // namespace subimpact
