#pragma once

#include <string>
#include <utility>
#include <vector>

namespace subimpact {

std::string project_version();

/// Name and version of every library the program is made of.
std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace subimpact
