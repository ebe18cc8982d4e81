#pragma once

/// Figures of a finished run, drawn by gnuplot.

#include <filesystem>
#include <string>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

struct DrawnFigure {
  std::string name;     ///< of its files, without ending: name.svg, name.png, name.gp
  std::string caption;  ///< one or two sentences
};

/// What draw_figures() drew, and figures_left_out().
struct DrawnFigures {
  std::vector<DrawnFigure> drawn;
  std::vector<std::string> left_out;
};

/// What the figures of a run leave out for want of data or room: "bending: ...".
std::vector<std::string> figures_left_out(const Case& input, const Result& result);

/// Draws into a directory, as SVG and PNG: `response` (force and displacements), `first-sub-impact`
/// (force and back stress), `indentation` (force against indentation), `energies` (with zones),
/// `timeline` (start, duration and impulse of every sub-impact), `bending` (moment against
/// curvature of the sections kept). The gnuplot scripts, tables included, stay beside them. Figures
/// of a run that did not complete state this above their panels. Throws OutputError if gnuplot is
/// missing or fails.
DrawnFigures draw_figures(const std::filesystem::path& directory, const Case& input,
                          const Result& result);

}  // namespace subimpact
