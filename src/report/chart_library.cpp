#include "report/chart_library.h"

#include <fmt/format.h>

#include "io/sealed_files.h"
#include "subimpact/io/read_results.h"

namespace subimpact {
namespace {

// Ends neither the script element nor its character data, and names no other file.
std::string within_page(std::string text) {
  if (const std::size_t map = text.find("//# sourceMappingURL"); map != std::string::npos) {
    text.erase(map, text.find('\n', map) - map);
  }
  for (const auto& [end, harmless] : {std::pair("</script", "<\\/script"), std::pair("]]>", "]] >"),
                                      std::pair("</style", "<\\/style")}) {
    for (std::size_t at = text.find(end); at != std::string::npos; at = text.find(end, at)) {
      text.replace(at, std::string(end).size(), harmless);
    }
  }
  return text;
}

}  // namespace

ChartLibrary chart_library(const std::filesystem::path& directory) {
  const std::filesystem::path place = directory.empty() ? SUBIMPACT_DYGRAPHS : directory;
  try {
    return {within_page(read_whole_file(place / "dygraph.min.js")),
            within_page(read_whole_file(place / "dygraph.css")),
            {}};
  } catch (const ResultsError&) {
    return {{},
            {},
            fmt::format("{} has no dygraph.min.js and dygraph.css; install dygraphs (Debian: "
                        "apt-get install libjs-dygraphs), or name the directory that holds both "
                        "(--dygraphs DIR), and write this page again",
                        place.string())};
  }
}

}  // namespace subimpact
