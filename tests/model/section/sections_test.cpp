// Sections of every shape, with and without hardening: the law of fibres against return maps at the
// points of a quadrature over the section, and closed forms.

#include "model/section/section_law.h"
#include "numerics/gauss.h"
#include "paper_scene.h"
#include "print.h"
#include "random_walk.h"

namespace subimpact {
namespace {

struct Shaped {
  const char* name;
  CrossSection section;
};

void PrintTo(const Shaped& shape, std::ostream* out) { *out << shape.name; }

const Shaped shapes[] = {
    {"rectangle", {.shape = SectionShape::rectangle, .height = 0.012, .width = 0.02}},
    {"circle", {.shape = SectionShape::circle, .diameter = 0.016}},
    {"tube", {.shape = SectionShape::tube, .diameter = 0.03, .wall = 0.004}},
    {"box", {.shape = SectionShape::box, .height = 0.04, .width = 0.025, .wall = 0.003}},
    {"i",
     {.shape = SectionShape::i, .height = 0.1, .width = 0.055, .flange = 0.0057, .web = 0.0041}},
};

Beam beam_of(const CrossSection& section, double hardening = 0.0) {
  Beam beam = paper_beam();
  beam.width = beam.thickness = 0.0;
  beam.section = section;
  beam.hardening = hardening;
  return beam;
}

// Width at the distance z from the neutral axis.
double width_at(const CrossSection& s, double z) {
  const auto chord = [z](double d) { return 2.0 * std::sqrt(std::max(0.25 * d * d - z * z, 0.0)); };
  switch (s.shape) {
    case SectionShape::rectangle:
      return *s.width;
    case SectionShape::circle:
      return chord(*s.diameter);
    case SectionShape::tube:
      return chord(*s.diameter) - chord(*s.diameter - 2.0 * *s.wall);
    case SectionShape::box:
      return z > 0.5 * *s.height - *s.wall ? *s.width : 2.0 * *s.wall;
    case SectionShape::i:
      return z > 0.5 * *s.height - *s.flange ? *s.width : *s.web;
  }
  return 0.0;
}

/// Points of Gauss's rule on panels of every smooth piece of the width, in the angle where it ends
/// as a square root; at each one a fibre with linear kinematic hardening and its return map.
class QuadratureSection {
 public:
  QuadratureSection(const Beam& beam, int panels) : beam_(beam) {
    const CrossSection& s = beam.section;
    const double half = 0.5 * beam.height();
    const double inner = s.shape == SectionShape::rectangle || s.shape == SectionShape::circle
                             ? 0.0
                             : half - (s.flange ? *s.flange : *s.wall);
    if (inner > 0.0) add_piece(0.0, inner, panels);
    add_piece(inner, half, panels);
  }

  void bend_to(double curvature) {
    const double E = beam_.youngs_modulus, Y = beam_.yield_stress;
    const double H = E * beam_.hardening / (1.0 - beam_.hardening);
    moment_ = 0.0;
    for (Fibre& f : fibres_) {
      f.stress += E * f.z * (curvature - curvature_);
      const double beyond = std::abs(f.stress - f.back_stress) - Y;
      if (beyond > 0.0) {
        const double flow = std::copysign(beyond / (E + H), f.stress - f.back_stress);
        f.stress -= E * flow;
        f.back_stress += H * flow;
        dissipated_ += 2.0 * f.area * Y * std::abs(flow);
      }
      moment_ += 2.0 * f.area * f.z * f.stress;
    }
    work_ += 0.5 * (moment_ + moment_before_) * (curvature - curvature_);
    moment_before_ = moment_;
    curvature_ = curvature;
  }

  double moment() const { return moment_; }
  double dissipated() const { return dissipated_; }
  double second_moment() const {
    double sum = 0.0;
    for (const Fibre& f : fibres_) sum += 2.0 * f.area * f.z * f.z;
    return sum;
  }
  double area() const {
    double sum = 0.0;
    for (const Fibre& f : fibres_) sum += 2.0 * f.area;
    return sum;
  }
  double outer_stress() const { return fibres_.back().stress; }

 private:
  struct Fibre {
    double z, area, stress = 0.0, back_stress = 0.0;
  };
  void add_piece(double from, double to, int panels) {
    const bool is_round = beam_.is_round();
    const double first = is_round ? std::asin(from / to) : from, last = is_round ? 0.5 * M_PI : to;
    for (int panel = 0; panel < panels; ++panel) {
      for (std::size_t i = 0; i < gauss<5>.points.size(); ++i) {
        const double t = first + (last - first) * (panel + gauss<5>.points[i]) / panels;
        const double z = is_round ? to * std::sin(t) : t;
        const double weight =
            gauss<5>.weights[i] * (last - first) / panels * (is_round ? to * std::cos(t) : 1.0);
        fibres_.push_back({z, weight * width_at(beam_.section, z)});
      }
    }
  }

  const Beam& beam_;
  std::vector<Fibre> fibres_;
  double curvature_ = 0.0, moment_ = 0.0, moment_before_ = 0.0, work_ = 0.0, dissipated_ = 0.0;
};

// Where a fibre begins to flow the stress has a kink, which costs the rule an error of second
// order.
int panels_of(const CrossSection& section) { return section.diameter ? 20000 : 8000; }

class EveryShape : public testing::TestWithParam<Shaped> {};

TEST_P(EveryShape, HasTheAreaAndSecondMomentOfItsQuadrature) {
  const Beam beam = beam_of(GetParam().section);
  const QuadratureSection points(beam, panels_of(GetParam().section));
  const double accuracy = GetParam().section.shape == SectionShape::tube ? 1e-7 : 1e-12;
  EXPECT_NEAR(beam.area(), points.area(), accuracy * beam.area());
  EXPECT_NEAR(beam.second_moment(), points.second_moment(), accuracy * beam.second_moment());
}

TEST_P(EveryShape, BendsCyclicallyAsTheReturnMapAtThePointsOfAQuadrature) {
  for (const double hardening : {0.0, 0.07, 0.5}) {
    SCOPED_TRACE(hardening);
    const Beam beam = beam_of(GetParam().section, hardening);
    const SectionLaw law(beam, Fibres::continuous(beam).hardened(hardening));
    QuadratureSection points(beam, panels_of(GetParam().section));
    SectionHistory history;
    const double unit = beam.yield_moment(), size = beam.yield_curvature();
    for (const double x : nested_walk(7, 60, -6.0, 6.0, 5.0)) {
      points.bend_to(x * size);
      EXPECT_NEAR(law.moment(history, x * size), points.moment(), 1e-9 * unit);
      law.commit(history, x * size);
      EXPECT_NEAR(law.moment(history, x * size), points.moment(), 1e-9 * unit);
      // The last point is not quite the outermost fibre.
      EXPECT_NEAR(law.outer_stress(history, x * size), -points.outer_stress(),
                  1e-3 * beam.yield_stress);
      const double dissipated = law.work(history, x * size) - law.elastic_energy(history, x * size);
      EXPECT_NEAR(dissipated, points.dissipated(), 1e-8 * std::max(dissipated, unit * size));
    }
  }
}

TEST_P(EveryShape, OfManyLayersTendsToTheExactSection) {
  const Beam beam = beam_of(GetParam().section);
  const Fibres exact = Fibres::continuous(beam);
  double last = 1.0;
  for (const int layers : {50, 200, 800}) {
    const Fibres of_layers = Fibres::layered(layers, beam);
    double worst = 0.0;
    for (const double x : {0.5, 1.1, 1.7, 4.0, 30.0}) {
      worst = std::max(worst, std::abs(of_layers.response(x).moment - exact.response(x).moment));
    }
    EXPECT_LT(worst, std::min(5.0 / layers, 0.5 * last));
    last = worst;
  }
}

INSTANTIATE_TEST_SUITE_P(Sections, EveryShape, testing::ValuesIn(shapes), NamedAsPrinted{});

TEST(Sections, HaveTheShapeFactorsOfTextbooks) {
  const auto factor = [](const CrossSection& section) {
    return Fibres::continuous(beam_of(section)).shape_factor();
  };
  EXPECT_DOUBLE_EQ(factor(shapes[0].section), 1.5);
  EXPECT_NEAR(factor(shapes[1].section), 16.0 / (3.0 * M_PI), 1e-14);
  EXPECT_NEAR(factor({.shape = SectionShape::tube, .diameter = 1.0, .wall = 1e-7}), 4.0 / M_PI,
              1e-6);
  const double ratio = (0.03 - 0.008) / 0.03;  // of the tube, inner over outer
  EXPECT_NEAR(factor(shapes[2].section),
              16.0 / (3.0 * M_PI) * (1.0 - std::pow(ratio, 3)) / (1.0 - std::pow(ratio, 4)), 1e-13);
  // The plastic modulus of an I, (b h^2 - (b - t) h_i^2)/4, over its elastic one.
  const double b = 0.055, h = 0.1, inner = h - 2.0 * 0.0057, gap = b - 0.0041;
  const double plastic = 0.25 * (b * h * h - gap * inner * inner);
  const double elastic = (b * h * h * h - gap * inner * inner * inner) / (6.0 * h);
  EXPECT_NEAR(factor(shapes[4].section), plastic / elastic, 1e-13);
}

TEST(Sections, GivenAsARectangleOfAnotherFormAreTheShortForm) {
  const Beam brief = paper_beam();
  Beam beam =
      beam_of({.shape = SectionShape::rectangle, .height = brief.thickness, .width = brief.width});
  EXPECT_EQ(beam.area(), brief.area());
  EXPECT_EQ(beam.second_moment(), brief.second_moment());
  EXPECT_EQ(beam.yield_moment(), brief.yield_moment());
  EXPECT_EQ(beam.yield_curvature(), brief.yield_curvature());
}

// Shear flow of thin walls at nu = 0, where Cowper's coefficient is that of the shear energy:
// k = V^2/(A integral of q^2/t ds), q = V Q/I, by quadrature along the walls.
double energy_coefficient(const CrossSection& s) {
  const bool is_box = s.shape == SectionShape::box;
  const double flange = is_box ? *s.wall : *s.flange, webs = is_box ? 2.0 * *s.wall : *s.web;
  const double h = *s.height - flange, b = *s.width - (is_box ? *s.wall : 0.0);
  const double area = 2.0 * b * flange + webs * h;
  const double second = webs * h * h * h / 12.0 + 0.5 * b * flange * h * h;
  double sum = 0.0;
  constexpr int n = 2000;
  for (int i = 0; i < n; ++i) {
    const double part = (i + 0.5) / n;
    const double y = h * (part - 0.5);
    const double of_web = 0.5 * b * flange * h + 0.5 * webs * (0.25 * h * h - y * y);
    sum += of_web * of_web / webs * h / n;
    const double of_flange = 0.5 * flange * h * (0.5 * b * part);  // four halves, from their tips
    sum += 4.0 * of_flange * of_flange / flange * 0.5 * b / n;
  }
  return second * second / (area * sum);
}

TEST(Sections, HaveCowpersShearCoefficients) {
  for (const Shaped& shape : {shapes[3], shapes[4]}) {
    Beam beam = beam_of(shape.section);
    beam.poisson = 0.0;
    EXPECT_NEAR(beam.used_shear_coefficient(), energy_coefficient(shape.section), 1e-6)
        << shape.name;
  }
  const auto coefficient = [](const CrossSection& section, double nu) {
    Beam beam = beam_of(section);
    beam.poisson = nu;
    return beam.used_shear_coefficient();
  };
  EXPECT_DOUBLE_EQ(coefficient(shapes[0].section, 0.3), 13.0 / 15.3);
  EXPECT_DOUBLE_EQ(coefficient(shapes[1].section, 0.3), 7.8 / 8.8);
  // A thin tube, 2 (1 + nu)/(4 + 3 nu); an I or box whose flanges vanish is a rectangle.
  EXPECT_NEAR(coefficient({.shape = SectionShape::tube, .diameter = 1.0, .wall = 1e-6}, 0.3),
              2.6 / 4.9, 1e-5);
  EXPECT_NEAR(
      coefficient(
          {.shape = SectionShape::i, .height = 0.1, .width = 0.01, .flange = 1e-7, .web = 0.005},
          0.3),
      13.0 / 15.3, 1e-4);
}

}  // namespace
}  // namespace subimpact
