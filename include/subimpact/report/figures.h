#pragma once

/// Figures of a finished run, drawn by gnuplot.

#include <filesystem>
#include <string>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/io/results.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// A figure that gnuplot does not draw. Tables and other figures are not affected.
class FigureError : public OutputError {
 public:
  using OutputError::OutputError;
};

/// gnuplot cannot be started, for this figure or any other.
class GnuplotMissing : public FigureError {
 public:
  using FigureError::FigureError;
};

struct DrawnFigure {
  std::string name;     ///< of its files, without ending: name.svg, name.png, name.gp
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

/// Draws into a directory, as SVG and PNG: `response` (force and displacements), `first-sub-impact`
/// (force and back stress), `indentation` (force against indentation), `energies` (with zones),
/// `timeline` (start, duration and impulse of every sub-impact), `bending` (moment against
/// curvature of the sections kept), `shapes` and `envelope` (along the beam). The gnuplot scripts,
/// tables included, stay beside them. Figures of a run that did not complete state this above their
/// panels. Throws GnuplotMissing, and OutputError if a file cannot be written.
DrawnFigures draw_figures(const std::filesystem::path& directory, const Case& input,
                          const Result& result);

/// Throws a FigureError with the messages of the figures that failed, if any did.
void throw_if_failed(const DrawnFigures& figures);

}  // namespace subimpact
