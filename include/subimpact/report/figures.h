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

/// What draw_figures() drew, figures_left_out(), and one message per figure that failed.
struct DrawnFigures {
  std::vector<DrawnFigure> drawn;
  std::vector<std::string> left_out;
  std::vector<std::string> failed;
};

/// What the figures of a run leave out for want of data or room: "bending: ...".
std::vector<std::string> figures_left_out(const Case& input, const Result& result);

/// Writes the gnuplot scripts of a run's figures (response.gp, ..., style.gp, tables.gp) into a
/// directory, made if missing, but for those that it has: to be changed and handed to
/// draw_figures(). Returns the names of the files written. Throws OutputError, also if the
/// directory holds results or the finished scripts of drawn figures.
std::vector<std::string> write_figure_scripts(const std::filesystem::path& directory);

/// Draws into a directory, as SVG, PNG and PDF: `response` (force and displacements),
/// `first-sub-impact` (force and back stress), `indentation` (force against indentation),
/// `energies` (with zones), `timeline` (start, duration and impulse of every sub-impact), `bending`
/// (moment against curvature of the sections kept), `shapes` and `envelope` (along the beam),
/// `strikes` (of repeated ones), and with `overlay` `measured` (a measured force and the computed
/// one). The gnuplot scripts, tables included, stay beside them. Figures of a run that did not
/// complete state this above their panels. A script that the directory `scripts` has replaces that
/// of the library. A figure whose files cannot be written is one that failed. Throws
/// GnuplotMissing, and OutputError if `scripts` holds results or the finished scripts of drawn
/// figures.
DrawnFigures draw_figures(const std::filesystem::path& directory, const Case& input,
                          const Result& result, const std::filesystem::path& scripts = {},
                          const Overlay* overlay = nullptr);

/// Puts figures in place that were drawn into directory.staging(). Where the disk has no room for
/// that, the last figures are given up, and count as failed. Returns whether files are in place.
bool commit_figures(OutputDirectory& directory, DrawnFigures& figures);

/// Throws a FigureError with the messages of the figures that failed, if any did.
void throw_if_failed(const DrawnFigures& figures);

}  // namespace subimpact
