#pragma once

#include <string>
#include <vector>

#include "subimpact/io/case_file.h"

namespace subimpact {

/// Settings as the command line takes them.
inline std::vector<Override> overrides(const std::vector<std::string>& settings) {
  std::vector<Override> all;
  for (const std::string& setting : settings) all.push_back(parse_override(setting));
  return all;
}

#ifdef SUBIMPACT_PAPER_CASE
/// The paper's case file with such settings, the later ones in force.
inline Case paper_case_with(std::vector<std::string> settings,
                            const std::vector<std::string>& more = {}) {
  settings.insert(settings.end(), more.begin(), more.end());
  return read_case_file(SUBIMPACT_PAPER_CASE, overrides(settings)).value;
}
#endif

}  // namespace subimpact
