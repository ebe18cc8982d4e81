#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/io/results.h"
#include "subimpact/simulate/result.h"
#include "subimpact/study/overlay.h"

namespace subimpact {

struct DrawnFigure {
  std::string name;     ///< of its files, without ending: name.svg, .png, .pdf, .gp
  std::string caption;  ///< one or two sentences
};

/// The figures that draw_figures() drew, figures_left_out(), and one message per failed figure.
struct DrawnFigures {
  std::vector<DrawnFigure> drawn;
  std::vector<std::string> left_out;
  std::vector<std::string> failed;
};

/// The figures that are left out for lack of data or room, with the reason: "bending: ...".
std::vector<std::string> figures_left_out(const Case& input, const Result& result);

/// Writes the gnuplot scripts of a run's figures (response.gp, ..., style.gp, tables.gp) into a
/// directory, made if missing, except those that it already has: to be changed and passed to
/// draw_figures(). Returns the names of the files written. Throws OutputError, also if the
/// directory holds results or the finished scripts of drawn figures.
std::vector<std::string> write_figure_scripts(const std::filesystem::path& directory);

/// Draws into a directory, as SVG, PNG and PDF: `response` (force and displacements),
/// `first-sub-impact` (force and back stress), `indentation` (force against indentation),
/// `energies` (with zones), `timeline` (start, duration and impulse of every sub-impact), `bending`
/// (moment against curvature of the sections kept), `shapes` and `envelope` (along the beam),
/// `strikes` (of repeated ones), and with `overlay` `measured` (a measured force and the computed
/// one). The gnuplot scripts, with their tables, are kept next to the figures. Figures of a run
/// that did not complete state this above their panels. A script in the directory `scripts`
/// replaces that of the library. A figure whose files cannot be written counts as failed. Throws
/// GnuplotMissing, and OutputError if `scripts` holds results or the finished scripts of drawn
/// figures.
DrawnFigures draw_figures(const std::filesystem::path& directory, const Case& input,
                          const Result& result, const std::filesystem::path& scripts = {},
                          const Overlay* overlay = nullptr);

/// Puts the figures drawn into directory.staging() in place. If the disk has no room, the last
/// figures are dropped and count as failed. Returns whether files are in place.
bool commit_figures(OutputDirectory& directory, DrawnFigures& figures);

/// Throws a FigureError with the messages of the figures that failed, if any did.
void throw_if_failed(const DrawnFigures& figures);

}  // namespace subimpact
