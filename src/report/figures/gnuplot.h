#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "subimpact/report/figures.h"

namespace subimpact {

/// Size of a figure on the screen, in pixels of the PNG at a scale of 1.
struct FigureSize {
  int width = 900;
  int height = 600;
};

/// The script of a figure, <name>.gp, after the style (style.gp), what scripts share (tables.gp)
/// and the `settings` of this drawing: variables and tables of data. Each file is taken from the
/// directory `scripts` if it is there, else from the library.
std::string figure_script(const std::string& name, const std::string& settings = {},
                          const std::filesystem::path& scripts = {});

/// Whether a text is of figure_script(), with the data of a figure within it.
bool is_finished_script(const std::string& text);

/// A figure takes about a second.
inline constexpr std::chrono::seconds most_drawing_time{120};

/// Draws a figure with gnuplot as directory/name.svg, name.png and name.pdf. `script` sets no
/// terminal and no output; data are in it (`$data << EOD`) or in files named relative to the
/// directory. It is left as directory/name.gp, so that a figure can be changed and drawn again:
///
///     gnuplot -d -e "set terminal svg; set output 'name.svg'" name.gp
///
/// A figure appears whole or not at all. gnuplot is ended when `most_time` is over. Throws
/// GnuplotMissing if gnuplot cannot be started; FigureError if it does not take the script, with
/// what it printed, or takes too long; OutputError if a file cannot be written (no script is left).
void draw_figure(const std::filesystem::path& directory, const std::string& name,
                 const std::string& script, FigureSize size = {},
                 std::chrono::milliseconds most_time = most_drawing_time);

void remove_figure(const std::filesystem::path& directory, const std::string& name);

}  // namespace subimpact
