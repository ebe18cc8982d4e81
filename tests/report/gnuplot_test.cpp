#include "report/gnuplot.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "subimpact/io/results.h"
#include "temporary_directory.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(AFigure, IsDrawnAsSvgAndAsPngOfTwiceThePixels) {
  const TemporaryDirectory directory;
  const fs::path place = directory.path / "it's a place";  // which a shell would trip over
  fs::create_directory(place);
  draw_figure(place, "parabola", figure_style() + "plot x**2 title 'parabola'\n", {400, 300});
  const std::string svg = content(place / "parabola.svg");
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_NE(svg.find("parabola"), std::string::npos);
  const std::string png = content(place / "parabola.png");
  ASSERT_GT(png.size(), 24u);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  const auto big_endian = [&](std::size_t at) {
    return 256 * static_cast<unsigned char>(png[at + 2]) + static_cast<unsigned char>(png[at + 3]);
  };
  EXPECT_EQ(big_endian(16), 800);
  EXPECT_EQ(big_endian(20), 600);
}

TEST(AFigureGnuplotCannotDraw, IsReportedWithWhatGnuplotSaid) {
  const TemporaryDirectory directory;
  try {
    draw_figure(directory.path, "nonsense", "plot of nothing at all\n");
    FAIL() << "no error";
  } catch (const OutputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("nonsense.svg"), std::string::npos) << message;
    EXPECT_NE(message.find("line 1"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace subimpact
