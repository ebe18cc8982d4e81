#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/records/record.h"
#include "subimpact/io/results.h"

namespace subimpact {

/// What summary.json describes: a run and the programs that made it.
struct DescribedRun {
  const Case* input;
  const Result* result;
  std::string program_version;
  std::vector<std::pair<std::string, std::string>> libraries;  // name and version
};

const Record<DescribedRun>& run_record();

}  // namespace subimpact
