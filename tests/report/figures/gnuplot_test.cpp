#include "report/figures/gnuplot.h"

#include <thread>

#include "fake_gnuplot.h"
#include "file_size_limit.h"
#include "report/files.h"
#include "subimpact/io/results.h"
#include "temporary_directory.h"
#include "testing.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

using AFigureGnuplotCannotDraw = InADirectory;
using AFigure = InADirectory;

TEST_F(AFigure, IsDrawnAsSvgAndAsPngOfTwiceThePixels) {
  const fs::path place = directory.path / "it's a place";  // which a shell would trip over
  fs::create_directory(place);
  draw_figure(place, "parabola",
              std::string(embedded_file("figures/style.gp")) + "plot x**2 title 'parabola'\n",
              {400, 300});
  const std::string svg = read_file(place / "parabola.svg");
  expect_in(svg, "</svg>", "parabola");
  const std::string png = read_file(place / "parabola.png");
  ASSERT_GT(png.size(), 24u);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  const auto big_endian = [&](std::size_t at) {
    return 256 * static_cast<unsigned char>(png[at + 2]) + static_cast<unsigned char>(png[at + 3]);
  };
  EXPECT_EQ(big_endian(16), 800);
  EXPECT_EQ(big_endian(20), 600);
}

TEST_F(AFigureGnuplotCannotDraw, IsReportedWithWhatGnuplotSaid) {
  expect_in(message_of<OutputError>(
                [&] { draw_figure(directory.path, "nonsense", "plot of nothing at all\n"); }),
            "nonsense.svg", "line 1");
}

// The message of a drawing that fails.
std::string failure(const fs::path& directory, const std::string& script,
                    std::chrono::milliseconds most_time) {
  return message_of<FigureError>([&] { draw_figure(directory, "figure", script, {}, most_time); });
}

// Within a second, because a process that is killed needs a moment to end.
bool ends(const fs::path& number) {
  for (int i = 0; i < 100 && is_running(number); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return !is_running(number);
}

TEST(AFigureThatTakesTooLong, IsGivenUpWithTheCauseAndWhatDrawsItIsEnded) {
  const TemporaryDirectory directory;
  for (const char* waiting : {"sleep 300 & echo $! > number; wait\n",
                              "echo $$ > number; exec sleep 300 > /dev/null 2>&1\n"}) {
    const FakeGnuplot gnuplot(directory.path / "bin", waiting);
    const std::string message = failure(directory.path, "plot x\n", std::chrono::milliseconds(500));
    expect_in(message, "figure.svg: gnuplot was ended", "within 0.5 s");
    ASSERT_TRUE(fs::exists(directory.path / "number"));
    EXPECT_TRUE(ends(directory.path / "number")) << waiting;
    fs::remove(directory.path / "number");
  }
}

TEST_F(AFigure, IsDrawnWithoutTheSettingsOfItsUser) {
  const std::string script =
      "set title 'obeyed: '.system('env | grep -cE \"^(GNUTERM|GNUPLOT_|GDFONTPATH)\"')\n"
      "plot [1:10] x\n";
  draw_figure(directory.path, "plain", script);
  fs::create_directory(directory.path / "home");
  std::ofstream(directory.path / "home" / ".gnuplot")
      << "set logscale y\nset datafile separator ';'\nprint 'hello'\n";
  const Environment home("HOME", directory.path / "home"), terminal("GNUTERM", "dumb"),
      library("GNUPLOT_LIB", "dumb"), fonts("GDFONTPATH", "dumb");
  draw_figure(directory.path, "figure", script);
  const std::string svg = read_file(directory.path / "figure.svg");
  expect_in(svg, "obeyed: 0");
  EXPECT_EQ(svg, read_file(directory.path / "plain.svg"));
}

TEST(AFigureThatCannotBeWritten, LeavesNoneOfItsFiles) {
  const TemporaryDirectory directory;
  draw_figure(directory.path, "whole", "plot x\n");
  const auto longest = std::max({fs::file_size(directory.path / "whole.svg"),
                                 fs::file_size(directory.path / "whole.png"),
                                 fs::file_size(directory.path / "whole.pdf")});
  const fs::path place = directory.path / "place";
  fs::create_directory(place);
  const FileSizeLimit limit(longest - 1);
  EXPECT_THROW(draw_figure(place, "part", "plot x\n"), OutputError);
  EXPECT_TRUE(fs::is_empty(place));
}

TEST_F(AFigureGnuplotCannotDraw, IsReportedWithTheLastTwelveLinesGnuplotSaid) {
  const auto said = [&](const std::string& script) {
    const FakeGnuplot gnuplot(directory.path / "bin", script);
    return failure(directory.path, "plot x\n", most_drawing_time);
  };
  const std::string all = said("seq 201 212 >&2; exit 1\n");
  expect_in(all, "figure.gp: 201\n202\n");
  const std::string last = said("seq 1 212 >&2; exit 1\n");
  expect_in(last, "figure.gp: ...\n201\n202\n", "\n212\n");
  expect_in(said("exit 1\n"), "status 1 on figure.gp: ");
}

TEST(AFigureThatFailsInOneFormat, IsInNone) {
  const TemporaryDirectory directory;
  failure(directory.path, "plot x\nif (GPVAL_TERM eq 'pdfcairo') { nonsense }\n",
          most_drawing_time);
  EXPECT_TRUE(fs::exists(directory.path / "figure.gp"));
  EXPECT_FALSE(fs::exists(directory.path / "figure.svg"));
  EXPECT_FALSE(fs::exists(directory.path / "figure.png"));
}

}  // namespace
}  // namespace subimpact
