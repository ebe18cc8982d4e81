#pragma once

#include <filesystem>
#include <string>

#include "subimpact/io/read_results.h"
#include "subimpact/report/figures.h"

namespace subimpact {

/// A run as one page of HTML that needs nothing else: style and figures are in it, nothing is
/// fetched, no script runs. It is XML as well. The figures' SVG files are read from
/// `figure_directory`. Throws ResultsError if one cannot be read.
std::string html_report(const FinishedRun& run, const DrawnFigures& figures,
                        const std::filesystem::path& figure_directory);

struct WrittenReport {
  std::filesystem::path page;
  DrawnFigures figures;
};

/// Draws the figures of a run into the directory and writes report.html beside them, without those
/// that failed. Throws GnuplotMissing, OutputError.
WrittenReport write_html_report(const std::filesystem::path& directory, const FinishedRun& run);

}  // namespace subimpact
