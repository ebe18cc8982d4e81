#pragma once

#include <filesystem>
#include <string>

#include "subimpact/io/read_results.h"
#include "subimpact/report/figures.h"

namespace subimpact {

/// A run as one page of HTML that needs nothing else: style, figures, data and scripts are in it,
/// nothing is fetched. It is XML as well. With scripts the page shows the beam moving and panels
/// that share one time; without scripts, and printed, it is a still report. The figures' SVG files
/// are read from `figure_directory`, and the library of the zoomable charts from `dygraphs` (empty:
/// where Debian's libjs-dygraphs has it); without the library the page lacks those charts and
/// states how to get them. Throws ResultsError if a figure cannot be read.
std::string html_report(const FinishedRun& run, const DrawnFigures& figures,
                        const std::filesystem::path& figure_directory,
                        const std::filesystem::path& dygraphs = {});

struct WrittenReport {
  std::filesystem::path page;  ///< empty if it could not be written; `figures.failed` has the cause
  DrawnFigures figures;
  std::string charts_missing;  ///< why the page has no zoomable charts; empty: it has
};

/// Draws the figures of a run into the directory and writes report.html beside them, without those
/// that failed. Throws GnuplotMissing.
WrittenReport write_html_report(const std::filesystem::path& directory, const FinishedRun& run,
                                const std::filesystem::path& dygraphs = {});

}  // namespace subimpact
