#pragma once

/// Finished runs as pages of HTML. A page is self-contained: style, figures, data and scripts are
/// in it, nothing is fetched. It is also valid XML.

#include <filesystem>
#include <string>
#include <vector>

#include "subimpact/io/read_results.h"
#include "subimpact/report/figures.h"

namespace subimpact {

/// A run as a page. With scripts it shows the moving beam and panels that share one time; without
/// scripts, or printed, it is a still report. The figures' SVG files are read from
/// `figure_directory`, and the library of the zoomable charts from `dygraphs` (empty: where
/// Debian's libjs-dygraphs has it); without the library the page lacks those charts and states how
/// to get them. With `overlay` it has a section on a measured force. Throws ResultsError if a
/// figure cannot be read.
std::string html_report(const FinishedRun& run, const DrawnFigures& figures,
                        const std::filesystem::path& figure_directory,
                        const std::filesystem::path& dygraphs = {},
                        const Overlay* overlay = nullptr);

struct WrittenReport {
  std::filesystem::path page;  ///< empty if it could not be written; `figures.failed` has the cause
  DrawnFigures figures;
  std::string charts_missing;  ///< why the page has no zoomable charts; empty if it has
};

/// Draws the figures of a run into a directory of their own and writes report.html into another,
/// without those that failed. Throws GnuplotMissing.
WrittenReport write_html_report(const std::filesystem::path& directory,
                                const std::filesystem::path& figure_directory,
                                const FinishedRun& run, const std::filesystem::path& dygraphs = {},
                                const Overlay* overlay = nullptr);

/// A comparison of runs as a page: the keys in which their cases differ, curves in common charts,
/// and the sub-impacts of each run matched with those of the first. `names`: one per run.
std::string comparison_report(const std::vector<FinishedRun>& runs,
                              const std::vector<std::string>& names,
                              const std::filesystem::path& dygraphs = {});

/// A sweep as a page: a map of its runs over two of their keys, which marks runs with uncertain
/// counts, and the numbers and sub-impacts of the run that is chosen on the map. `name`: that of
/// the sweep, for example a directory.
std::string sweep_report(const SweptRuns& runs, const std::string& name);

}  // namespace subimpact
