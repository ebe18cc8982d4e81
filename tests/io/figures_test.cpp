#include "subimpact/io/figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "io/figure_script.h"
#include "subimpact/io/case_file.h"
#include "subimpact/simulate/simulate.h"
#include "temporary_directory.h"

namespace subimpact {
namespace {

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

void expect_in(const std::string& text, const std::string& piece) {
  EXPECT_NE(text.find(piece), std::string::npos) << '"' << piece << "\" is not there";
}

Case short_case(const std::vector<Override>& settings) {
  std::vector<Override> all = {parse_override("time.end=3e-4"),
                               parse_override("model.segments=51")};
  all.insert(all.end(), settings.begin(), settings.end());
  return read_case_file(SUBIMPACT_PAPER_CASE, all).value;
}

TEST(ThinOut, KeepsEveryPointWithinTheToleranceOfTheLineAndDropsWhatAddsNothing) {
  std::vector<Point> line;
  for (int i = 0; i <= 10000; ++i) {
    const double x = 1e-3 * i;
    line.push_back({x, x < 5.0 ? std::sin(x) : -1.0});
  }
  const double tolerance = 1e-3;
  const std::vector<Point> thin = thin_out(line, 1.0, 1.0, tolerance);
  EXPECT_LT(thin.size(), 100u);
  EXPECT_EQ(thin.front().x, 0.0);
  EXPECT_EQ(thin.back().x, 10.0);
  std::size_t k = 0;
  for (const Point& p : line) {
    while (thin[k + 1].x < p.x) ++k;
    const double share = (p.x - thin[k].x) / (thin[k + 1].x - thin[k].x);
    const double drawn = thin[k].y + share * (thin[k + 1].y - thin[k].y);
    if (std::abs(p.x - 5.0) > 2e-3) {
      ASSERT_NEAR(drawn, p.y, 2.0 * tolerance) << p.x;
    }
  }
}

TEST(ThinOut, KeepsPeaksOfOnePoint) {
  std::vector<Point> line;
  for (int i = 0; i < 100; ++i) line.push_back({1.0 * i, i == 42 ? 7.0 : 0.0});
  const std::vector<Point> thin = thin_out(line, 1.0, 1.0, 0.1);
  EXPECT_EQ(thin.size(), 5u);
}

TEST(TicSpacing, IsRoundAndCutsTheExtentIntoAboutAsManyParts) {
  EXPECT_DOUBLE_EQ(tic_spacing(8.0, 8), 1.0);
  EXPECT_DOUBLE_EQ(tic_spacing(0.18, 4), 0.05);
  EXPECT_DOUBLE_EQ(tic_spacing(234.0, 6), 50.0);
  EXPECT_DOUBLE_EQ(tic_spacing(9.0, 10), 1.0);
  EXPECT_GT(tic_spacing(0.0, 5), 0.0);
}

TEST(Figures, OfARunAreSixEachAsSvgAndPngAndScript) {
  const TemporaryDirectory directory;
  const Case input = short_case({parse_override("output.sections=0.5,0.4,0.3")});
  const DrawnFigures figures = draw_figures(directory.path, input, simulate(input));
  EXPECT_EQ(figures.drawn.size(), 6u);
  EXPECT_TRUE(figures.left_out.empty());
  for (const DrawnFigure& figure : figures.drawn) {
    expect_in(content(directory.path / (figure.name + ".svg")), "</svg>");
    EXPECT_EQ(content(directory.path / (figure.name + ".png")).substr(1, 3), "PNG") << figure.name;
    EXPECT_GT(content(directory.path / (figure.name + ".gp")).size(), 500u);
    EXPECT_GT(figure.caption.size(), 40u);
  }
  const std::string svg = content(directory.path / "first-sub-impact.svg");
  for (const char* piece : {"first fibre yields", "yield stress, 150 MPa", "back stress, MPa"}) {
    expect_in(svg, piece);
  }
  expect_in(content(directory.path / "indentation.svg"), "A: contact yields");
  expect_in(content(directory.path / "energies.svg"), "sub-zones");
}

TEST(Figures, ThatLackDataAreLeftOutAndTheReasonIsGiven) {
  const TemporaryDirectory directory;
  const Case input = short_case({parse_override("output.interval=0")});
  const DrawnFigures figures = draw_figures(directory.path, input, simulate(input));
  ASSERT_EQ(figures.drawn.size(), 1u);
  EXPECT_EQ(figures.drawn[0].name, "timeline");
  ASSERT_EQ(figures.left_out.size(), 2u);
  expect_in(figures.left_out[0], "output.interval above 0");
  expect_in(figures.left_out[1], "output.sections=0.5");
}

TEST(Figures, AreDrawnForElasticRigidAndOpenRunsToo) {
  const std::vector<std::vector<Override>> runs = {
      {parse_override("beam.yield_stress=inf"), parse_override("output.sections=0.5")},
      {parse_override("model.mesh=rigid"), parse_override("output.sections=0.5")},
      {parse_override("time.end=1e-5")},
      {parse_override("contact.law=linear"), parse_override("contact.stiffness=1e7")}};
  for (const auto& settings : runs) {
    const TemporaryDirectory directory;
    const Case input = short_case(settings);
    EXPECT_NO_THROW(draw_figures(directory.path, input, simulate(input))) << settings[0].value;
  }
}

}  // namespace
}  // namespace subimpact
