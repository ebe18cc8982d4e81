#include <fmt/format.h>

#include "subimpact/report/figures.h"

#include "case_with.h"
#include "file_size_limit.h"
#include "io/directory/listed_files.h"
#include "report/figures/figure_script.h"
#include "report/files.h"
#include "sample_result.h"
#include "subimpact/case/simulate.h"
#include "temporary_directory.h"
#include "testing.h"

namespace subimpact {
namespace {

using Timeline = InADirectory;
using Figures = InADirectory;

Case short_case(const std::vector<std::string>& settings = {}) {
  return paper_case_with({"time.end=3e-4", "model.segments=51"}, settings);
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
    if (std::abs(p.x - 5.0) <= 2e-3) continue;  // the jump
    ASSERT_NEAR(drawn, p.y, 2.0 * tolerance) << p.x;
  }
}

TEST(ThinOut, KeepsPeaksOfOnePoint) {
  std::vector<Point> line;
  for (int i = 0; i < 100; ++i) line.push_back({1.0 * i, i == 42 ? 7.0 : 0.0});
  const std::vector<Point> thin = thin_out(line, 1.0, 1.0, 0.1);
  EXPECT_EQ(thin.size(), 5u);
}

double distance(Point p, Point a, Point b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  const double squared = dx * dx + dy * dy;
  const double share =
      squared > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - a.x - share * dx, p.y - a.y - share * dy);
}

// How far the points of a line, and those between them, are at most from another line.
double largest_distance(const std::vector<Point>& from, const std::vector<Point>& line) {
  constexpr int parts = 10;
  double largest = 0.0;
  for (std::size_t i = 1; i < from.size(); ++i) {
    for (int k = 0; k <= parts; ++k) {
      const double s = static_cast<double>(k) / parts;
      const Point p{from[i - 1].x + s * (from[i].x - from[i - 1].x),
                    from[i - 1].y + s * (from[i].y - from[i - 1].y)};
      double nearest = 1e300;
      for (std::size_t j = 1; j < line.size(); ++j) {
        nearest = std::min(nearest, distance(p, line[j - 1], line[j]));
      }
      largest = std::max(largest, nearest);
    }
  }
  return largest;
}

// The rows of the table that a script gives a name, the heading first.
std::vector<std::vector<std::string>> rows_in(const std::string& script, const std::string& name) {
  const std::string start = name + " << EOD\n";
  std::istringstream lines(script.substr(script.find(start) + start.size()));
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(lines, line) && line != "EOD";) {
    std::istringstream text(line);
    std::vector<std::string>& cells = rows.emplace_back();
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
  }
  return rows;
}

// The first two columns.
std::vector<Point> table_in(const std::string& script, const std::string& name) {
  const auto rows = rows_in(script, name);
  std::vector<Point> points;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    points.push_back({std::stod(rows[i].at(0)), std::stod(rows[i].at(1))});
  }
  return points;
}

// The column "certain" of the sub-impacts.
std::vector<int> certain_in(const std::string& script) {
  const auto rows = rows_in(script, "$sub_impacts");
  EXPECT_EQ(rows.at(0).at(5), "certain");
  std::vector<int> certain;
  for (std::size_t i = 1; i < rows.size(); ++i) certain.push_back(std::stoi(rows[i].at(5)));
  return certain;
}

TEST(ThinOut, KeepsTheExtremeOfAPathThatGoesBackAlongItself) {
  // From 0 down to -0.115, back through 0 up to 0.63 and half way back, all on one line.
  std::vector<Point> path;
  const auto go_to = [&](double end) {
    const double start = path.empty() ? 0.0 : path.back().x;
    for (int i = 0; i <= 50; ++i) {
      const double x = start + (end - start) * i / 50.0;
      path.push_back({x, x});
    }
  };
  go_to(-0.115);
  go_to(0.63);
  go_to(-0.05);
  const std::vector<Point> thin = thin_out(path, 1.0, 1.0, 1e-3);
  EXPECT_LE(thin.size(), 6u);
  const auto [low, high] = std::ranges::minmax(thin, {}, &Point::x);
  EXPECT_EQ(low.x, -0.115);
  EXPECT_EQ(high.x, 0.63);
}

TEST(ThinOut, StaysWithinTheToleranceOfALoopInBothDirections) {
  std::vector<Point> loop;  // loading along a curve, unloading along lines, with small reversals
  for (int i = 0; i <= 300; ++i) {
    const double t = 0.01 * i;
    const double x = t + 0.4 * std::sin(7.0 * t);
    loop.push_back({x, std::pow(std::abs(x), 1.5)});
  }
  for (int i = 0; i <= 300; ++i) {
    const double x = loop[300].x - 0.005 * i + 0.2 * std::sin(0.1 * i);
    loop.push_back({x, 2.0 * x - 1.0});
  }
  const double tolerance = 0.01;
  const std::vector<Point> thin = thin_out(loop, 1.0, 1.0, tolerance);
  EXPECT_LT(thin.size(), loop.size() / 4);
  EXPECT_LE(largest_distance(loop, thin), tolerance * (1.0 + 1e-9));
  EXPECT_LE(largest_distance(thin, loop), tolerance * (1.0 + 1e-9));
}

TEST(ThinForPanel, ThinsALineByWhatThePanelShowsAndNotByWhatLiesOutside) {
  std::vector<Point> line;  // visible from 0 to 1; far excursions beyond
  for (int i = 0; i <= 100; ++i) line.push_back({0.01 * i, std::pow(0.01 * i, 1.5)});
  line.push_back({-1000.0, 0.0});
  for (int i = 0; i <= 100; ++i) line.push_back({0.01 * i, std::pow(0.01 * i, 1.5)});
  const std::vector<Point> drawn = thin_for_panel(line, {800, 500}, AxisRange{0.0, 1.0});
  for (const Point& p : line) {
    if (p.x < 0.0) continue;
    double nearest = 1e300;  // in pixels
    for (std::size_t j = 1; j < drawn.size(); ++j) {
      const auto pixels = [](Point q) { return Point{800.0 * q.x, 500.0 * q.y}; };
      nearest = std::min(nearest, distance(pixels(p), pixels(drawn[j - 1]), pixels(drawn[j])));
    }
    EXPECT_LT(nearest, 1.0) << p.x;
  }
}

TEST_F(Figures, DrawElasticContactAlongItsLaw) {
  const double K = 1e10;
  const Case input = short_case(
      {"contact.law=hertz", "contact.stiffness=1e10", "model.section=elastic", "time.end=2e-3"});
  const Result result = simulate(input);
  ASSERT_GT(result.sub_impacts.size(), 2u);
  const std::string script = indentation_figure(input, result).text();
  for (const std::string name : {"$later", "$first"}) {  // sub-impacts
    const std::vector<Point> drawn = table_in(script, name);
    for (std::size_t j = 1; j < drawn.size(); ++j) {
      const double middle = 0.5 * (drawn[j - 1].x + drawn[j].x);
      if (drawn[j - 1].x < 0.0 || drawn[j].x < 0.0) continue;
      const double force = K * std::pow(middle, 1.5);
      ASSERT_NEAR(0.5 * (drawn[j - 1].y + drawn[j].y), force, 2e-3 * result.max_force);
    }
  }
}

TEST_F(Figures, ShowTheBendingOfEverySectionAskedFor) {
  const Case input = short_case({"output.sections=0.5,0.45,0.4,0.3,0.2,0.1,0.05"});
  const std::string script = bending_figure(input, simulate(input)).text();
  EXPECT_EQ(rows_in(script, "$sections").size(), 1u + 7u);  // below the heading
  EXPECT_TRUE(figures_left_out(input, simulate(input)).empty());
}

TEST_F(Figures, SayWhichSectionsTheyHaveNoRoomFor) {
  std::string sections = "output.sections=0.5";
  for (int i = 1; i < 30; ++i) sections += ",0.25";
  const Case input = short_case({sections});
  const Result result = simulate(input);
  expect_in(bending_figure(input, result).text(), "left out: sections 25 to 30 of output.sections");
  const std::vector<std::string> left_out = figures_left_out(input, result);
  ASSERT_EQ(left_out.size(), 1u);
  expect_in(left_out[0], "bending: sections 25 to 30 of output.sections (0.25, 0.25");
}

TEST_F(Figures, OfARunThatDidNotCompleteSaySoAboveTheirPanels) {
  const Case input = short_case({"output.sections=0.5"});
  Result result = simulate(input);
  result.outcome.kind = OutcomeKind::inaccurate;
  result.outcome.first_failure = Interval{1e-4, 1.5e-4};
  for (const DrawnFigure& figure : draw_figures(directory.path, input, result).drawn) {
    expect_in(directory.read(figure.name + ".gp"),
              "inaccurate: results up to 100 us passed every check");
    expect_in(directory.read(figure.name + ".svg"), "first failure between 100 and 150 us");
  }
}

TEST_F(Figures, SetUncertainSubImpactsApartAndSayHowManyThereAre) {
  const Case input = short_case();
  Result among_certain_ones = sample_result_with_errors(1);
  among_certain_ones.sub_impacts[2].certain = true;
  struct Marked {
    Result result;
    std::string words;
    std::vector<int> certain;
  };
  for (const auto& [result, words, certain] :
       {Marked{sample_result_with_errors(1), "2 of 3 sub-impacts are not certain", {1, 0, 0}},
        Marked{among_certain_ones, "1 of 3 sub-impacts is not certain", {1, 0, 1}},
        Marked{sample_result_with_an_uncertain_flight(1), "there may be another", {1, 1, 1}}}) {
    for (const FigureScript& figure : figure_scripts(input, result)) {
      expect_in(figure.text(), words);
    }
    const std::string response = response_figure(input, result).text();
    EXPECT_EQ(certain_in(response), certain) << words;
    EXPECT_EQ(certain_in(timeline_figure(input, result).text()), certain) << words;
    expect_in(response, fmt::format("n_uncertain = {}.0", std::ranges::count(certain, 0)));
  }
  draw_figure(directory.path, "response",
              response_figure(input, sample_result_with_errors(1)).text());
  expect_in(directory.read("response.svg"), "not certain");
}

TEST_F(Timeline, HasBarsOfErrorAndScatterAndMarksTheHorizonOfPrediction) {
  const Case input = short_case();
  Result result = sample_result_with_errors(3);
  const std::string without = timeline_figure(input, result).text();
  expect_in(without, "horizon = NaN");
  result.sub_impacts[1].start_scatter = 2.5e-6;
  result.predictability =
      Predictability{1, "contacts merge", 1e-3 / 3.0, 2.5e-6, {}, {}, {}, 0, ""};
  const FigureScript figure = timeline_figure(input, result);
  expect_in(figure.text(), ",1,2.6e-07,2.5e-06\n");  // of a sub-impact: certain, error, scatter
  expect_in(figure.text(), "horizon = 0.0003333333");
  expect_in(figure.caption, "Purple bars: its standard deviation");
  draw_figure(directory.path, "timeline", figure.text());
  const std::string svg = directory.read("timeline.svg");
  expect_in(svg, "error of the start", "its scatter", "not predictable");
  draw_figure(directory.path, "plain", timeline_figure(input, sample_result()).text());
  expect_not_in(directory.read("plain.svg"), "error of the start");
}

TEST_F(Figures, OfARunWithoutErrorBarsSetNoSubImpactApart) {
  const Case input = short_case();
  for (const FigureScript& figure : figure_scripts(input, sample_result())) {
    expect_not_in(figure.text(), "are not certain\"");
  }
  const std::string response = response_figure(input, sample_result()).text();
  EXPECT_EQ(certain_in(response), (std::vector<int>{1, 1, 1}));
  expect_in(response, "n_uncertain = 0.000000\n");
}

TEST(SpacingOfTics, IsRoundAndCutsTheExtentIntoAboutAsManyParts) {
  const TemporaryDirectory directory;
  draw_figure(
      directory.path, "tics",
      std::string(embedded_file("figures/tables.gp")) +
          "set title sprintf('[%g %g %g %g %g]', tics(8.0, 8), tics(0.18, 4), tics(234, 6), "
          "tics(9, 10), tics(0.0, 5))\nplot x\n");
  expect_in(directory.read("tics.svg"), "[1 0.05 50 1 1]");
}

TEST_F(Figures, AreDrawnAgainFromTheirScriptsAlone) {
  const Case input = short_case({"output.sections=0.5"});
  const DrawnFigures figures = draw_figures(directory.path, input, simulate(input));
  const TemporaryDirectory other;
  for (const DrawnFigure& figure : figures.drawn) {
    draw_figure(other.path, figure.name, directory.read(figure.name + ".gp"));
    EXPECT_GT(other.read(figure.name + ".svg").size(), 1000u) << figure.name;
  }
}

TEST_F(Figures, OfARunAreEightEachAsSvgAndPngAndScript) {
  const Case input = short_case({"output.sections=0.5,0.4,0.3"});
  const DrawnFigures figures = draw_figures(directory.path, input, simulate(input));
  EXPECT_EQ(figures.drawn.size(), 8u);
  EXPECT_TRUE(figures.left_out.empty());
  for (const DrawnFigure& figure : figures.drawn) {
    expect_in(directory.read(figure.name + ".svg"), "</svg>");
    EXPECT_EQ(directory.read(figure.name + ".png").substr(1, 3), "PNG") << figure.name;
    EXPECT_EQ(directory.read(figure.name + ".pdf").substr(0, 5), "%PDF-");
    EXPECT_GT(directory.read(figure.name + ".gp").size(), 500u);
    EXPECT_GT(figure.caption.size(), 40u);
  }
  const std::string svg = directory.read("first-sub-impact.svg");
  expect_in(svg, "first fibre yields", "yield stress, 150 MPa", "back stress, MPa");
  expect_in(directory.read("indentation.svg"), "A: contact yields");
  expect_in(directory.read("energies.svg"), "sub-zones");
}

TEST_F(Figures, AreDrawnWithAUsersScripts) {
  const std::filesystem::path mine = directory.path / "my scripts";
  EXPECT_EQ(write_figure_scripts(mine).size(), 11u);
  std::ofstream(mine / "style.gp", std::ios::app) << "set linetype 1 lc rgb '#123456'\n";
  EXPECT_TRUE(write_figure_scripts(mine).empty());  // what is there stays
  std::filesystem::remove(mine / "timeline.gp");    // that of the library is used
  const Case input = short_case();
  draw_figures(directory.path, input, simulate(input), mine);
  const std::string svg = directory.read("response.svg");
  EXPECT_TRUE(svg.find("#123456") != std::string::npos ||
              svg.find("rgb( 18,  52,  86)") != std::string::npos);
  expect_in(directory.read("timeline.svg"), "</svg>");
}

// The message with which a directory of scripts is refused.
std::string refusal(const std::filesystem::path& scripts) {
  const TemporaryDirectory directory;
  const std::string message =
      message_of<OutputError>([&] { draw_figures(directory.path, {}, sample_result(), scripts); });
  EXPECT_TRUE(std::filesystem::is_empty(directory.path));
  return message;
}

TEST(ADirectoryOfScripts, IsRefusedIfTheyHoldTheDataOfADrawnFigure) {
  const TemporaryDirectory mine;
  const std::string finished = response_figure({}, sample_result()).text();
  const std::string older = finished.substr(finished.find("# Lines and points"));
  for (const std::string& script : {finished, older, figure_script("response")}) {
    std::ofstream(mine.path / "response.gp") << script;
    expect_in(refusal(mine.path), (mine.path / "response.gp").string(), "finished script");
    EXPECT_THROW(write_figure_scripts(mine.path), OutputError);
    EXPECT_FALSE(std::filesystem::exists(mine.path / "style.gp"));
  }
}

TEST(ADirectoryOfScripts, IsRefusedIfItHoldsResults) {
  const TemporaryDirectory results;
  std::ofstream(results.path / manifest_name) << "{}";
  expect_in(refusal(results.path), results.path.string(), "holds results");
  EXPECT_THROW(write_figure_scripts(results.path), OutputError);
  EXPECT_FALSE(std::filesystem::exists(results.path / "style.gp"));
}

// Figures as files of a few bytes.
DrawnFigures staged_figures(const OutputDirectory& directory, int count) {
  DrawnFigures figures;
  for (int i = 0; i < count; ++i) {
    const std::string name = "figure-" + std::to_string(i);
    for (const char* ending : {".svg", ".png", ".pdf", ".gp"}) {
      std::ofstream(directory.staging() / (name + ending)) << name;
    }
    figures.drawn.push_back({name, "a caption"});
  }
  return figures;
}

TEST(DrawnFigures, AreKeptAsFarAsTheDiskHasRoomForTheirManifest) {
  const TemporaryDirectory place;
  OutputDirectory directory(place.path / "figures", "figures");
  DrawnFigures figures = staged_figures(directory, 4);
  {
    const FileSizeLimit limit(1500);  // room for two figures
    EXPECT_TRUE(commit_figures(directory, figures));
  }
  ASSERT_GE(figures.drawn.size(), 1u);
  ASSERT_GE(figures.failed.size(), 1u);
  EXPECT_EQ(figures.drawn.size() + figures.failed.size(), 4u);
  expect_in(figures.failed[0], "figure-3: was removed to make room for the others");
  const auto manifest = read_manifest(directory.path());
  ASSERT_TRUE(manifest.has_value());
  EXPECT_EQ(manifest->files.size(), 4 * figures.drawn.size());
  EXPECT_TRUE(std::filesystem::exists(directory.path() / "figure-0.gp"));
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "figure-3.gp"));
}

TEST(DrawnFigures, ThatCannotBePutInPlaceAreReportedEach) {
  const TemporaryDirectory place;
  OutputDirectory directory(place.path / "figures", "figures");
  DrawnFigures figures = staged_figures(directory, 2);
  const FileSizeLimit limit(50);  // no manifest is that short
  EXPECT_FALSE(commit_figures(directory, figures));
  EXPECT_TRUE(figures.drawn.empty());
  EXPECT_EQ(figures.failed.size(), 3u);  // the last is of the manifest alone
}

TEST_F(Timeline, HasTwoLabelledTicksAtLeastOnItsLogarithmicAxes) {
  const Case input = short_case({"time.end=1e-4"});  // one sub-impact
  draw_figure(directory.path, "timeline", timeline_figure(input, simulate(input)).text());
  const std::string svg = directory.read("timeline.svg");
  std::size_t decades = 0;
  for (const char* label : {">1<", ">10<", ">100<", ">1000<", ">10000<"}) {
    decades += count_in(svg, label);
  }
  EXPECT_GE(decades, 4u);  // of two panels
}

TEST_F(Figures, ThatLackDataAreLeftOutAndTheReasonIsGiven) {
  const Case input = short_case({"output.interval=0"});
  const DrawnFigures figures = draw_figures(directory.path, input, simulate(input));
  ASSERT_EQ(figures.drawn.size(), 1u);
  EXPECT_EQ(figures.drawn[0].name, "timeline");
  ASSERT_EQ(figures.left_out.size(), 3u);
  expect_in(figures.left_out[0], "output.interval above 0");
  expect_in(figures.left_out[1], "output.sections=0.5");
  expect_in(figures.left_out[2], "output.shapes above 0");
}

TEST_F(Figures, AreDrawnForElasticRigidAndOpenRunsToo) {
  const std::vector<std::vector<std::string>> runs = {
      {"beam.yield_stress=inf", "output.sections=0.5"},
      {"model.mesh=rigid", "output.sections=0.5"},
      {"time.end=1e-5"},
      {"contact.law=linear", "contact.stiffness=1e7"}};
  for (const auto& settings : runs) {
    const TemporaryDirectory directory;
    const Case input = short_case(settings);
    EXPECT_NO_THROW(draw_figures(directory.path, input, simulate(input))) << settings[0];
  }
}

}  // namespace
}  // namespace subimpact
