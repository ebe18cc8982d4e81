#include "subimpact/io/figures.h"

#include "io/figure_script.h"

namespace subimpact {

DrawnFigures draw_figures(const std::filesystem::path& directory, const Case& input,
                          const Result& result) {
  DrawnFigures figures;
  const auto draw = [&](const FigureScript& figure) {
    draw_figure(directory, figure.name(), figure.text(), figure.size());
    figures.drawn.push_back({figure.name(), figure.caption()});
  };
  if (result.history.empty()) {
    figures.left_out.push_back(
        "response, first-sub-impact, indentation, energies: the run kept no history; run it again "
        "with output.interval above 0");
  } else {
    draw(response_figure(input, result));
    draw(first_sub_impact_figure(input, result));
    draw(indentation_figure(input, result));
    draw(energies_figure(input, result));
  }
  draw(timeline_figure(input, result));
  if (result.section_history.empty()) {
    figures.left_out.push_back(
        "bending: the run kept the bending of no section; run it again with --set "
        "output.sections=0.5 (or more positions, as fractions of the length)");
  } else {
    draw(bending_figure(input, result));
  }
  return figures;
}

}  // namespace subimpact
