#pragma once

/// Finished runs as pages of HTML. A page is self-contained: style, figures, data and scripts are
/// in it, nothing is fetched. It is also valid XML.

#include <filesystem>
#include <string>
#include <vector>

#include "subimpact/io/read_results.h"

namespace subimpact {

/// Figures that `subimpact plot` has drawn.
struct DrawnFigures {
  struct Figure {
    std::string name;     ///< of its files, without ending
    std::string caption;  ///< one or two sentences
    std::string svg;
  };
  std::vector<Figure> drawn;
  std::vector<std::string> left_out;  ///< with the reasons
};

/// The figures of the run or sweep of that identity in a directory, as figures.json lists them;
/// those that were changed since are left out. None if there are none, or those of other results.
DrawnFigures read_figures(const std::filesystem::path& directory, const std::string& identity);

/// A run as a page. With scripts it shows the moving beam and panels that share one time; without
/// scripts, or printed, it is a still report, with these figures. The library of the zoomable
/// charts is read from `dygraphs` (empty: where Debian's libjs-dygraphs has it); without it the
/// page lacks those charts and states how to get them. `measured`: a directory in which the Python
/// module subimpact.measured has left measured.json and measured.svg, which get a section of their
/// own; empty: none. Throws ResultsError for files there that cannot be read.
std::string html_report(const FinishedRun& run, const DrawnFigures& figures = {},
                        const std::filesystem::path& dygraphs = {},
                        const std::filesystem::path& measured = {});

/// Why pages have no zoomable charts; empty if they have.
std::string why_no_charts(const std::filesystem::path& dygraphs);

/// A comparison of runs as a page: the keys in which their cases differ, curves in common charts,
/// and the sub-impacts of each run matched with those of the first. `names`: one per run.
std::string comparison_report(const std::vector<FinishedRun>& runs,
                              const std::vector<std::string>& names,
                              const std::filesystem::path& dygraphs = {});

/// A sweep as a page: a map of its runs over two of their keys, which marks runs with uncertain
/// counts, and the numbers and sub-impacts of the run that is chosen on the map. `name`: that of
/// the sweep, for example a directory; `case_file`: the case that its keys change, in commands.
std::string sweep_report(const SweptRuns& runs, const std::string& name,
                         const std::string& case_file);

}  // namespace subimpact
