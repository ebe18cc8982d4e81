#pragma once

#include <filesystem>
#include <string>

namespace subimpact {

/// dygraphs, which draws zoomable charts, as text that can stand within a page.
struct ChartLibrary {
  std::string script, style;
  std::string missing;  ///< why it is not there and what to do; else empty
};

/// Reads dygraph.min.js and dygraph.css from a directory; an empty path stands for the place where
/// the Debian package libjs-dygraphs has them.
ChartLibrary chart_library(const std::filesystem::path& directory);

}  // namespace subimpact
