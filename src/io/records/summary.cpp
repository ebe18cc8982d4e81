#include <fmt/format.h>

#include <toml++/toml.h>
#include <Eigen/Core>

#include "integrate/sundials.h"
#include "io/records/run_record.h"
#include "subimpact/io/results.h"

namespace subimpact {

std::string summary_json(const Case& input, const Result& result) {
  // A title may hold bytes that are no UTF-8; they are replaced rather than the file lost.
  const DescribedRun run = {&input, &result, project_version(), library_versions()};
  const Json json = json_of(run_record(), run);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string project_version() { return SUBIMPACT_VERSION; }

std::vector<std::pair<std::string, std::string>> library_versions() {
  return {
      {"SUNDIALS", sundials_version()},
      {"KLU", klu_version()},
      {"Eigen",
       fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"fmt",
       fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"nlohmann-json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR,
                                    NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
      {"toml++", fmt::format("{}.{}.{}", TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH)},
  };
}

}  // namespace subimpact
