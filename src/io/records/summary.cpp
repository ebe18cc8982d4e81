#include <fmt/format.h>

#include <algorithm>

#include <toml++/toml.h>
#include <Eigen/Core>

#include "case/problem.h"
#include "case/refuse.h"
#include "integrate/sundials.h"
#include "io/records/run_record.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace {

void check_layout(const Json& json) {
  const Json& layout = json.at("layout");
  if (layout == summary_layout) return;
  fail<ResultsError>(
      "has layout {}, but this program reads layout {}; use the program that wrote it",
      layout.dump(), summary_layout);
}

// Entries reach what they hold by pointers that serve reading too; writing changes nothing.
Json json_of_run(const Case& input, const Result& result, const std::string& version,
                 const std::vector<std::pair<std::string, std::string>>& libraries) {
  const DescribedRun run = {const_cast<Case*>(&input), const_cast<Result*>(&result), version,
                            libraries};
  return json_of(run_record(), run);
}

}  // namespace

std::string summary_json(const Case& input, const Result& result) {
  // A title may hold bytes that are no UTF-8; they are replaced rather than the file lost.
  const Json json = json_of_run(input, result, project_version(), library_versions());
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<NamedScalar> scalars_of(const FinishedRun& run) {
  const Json flat =
      json_of_run(run.input, run.result, run.program_version, run.libraries).flatten();
  std::vector<NamedScalar> scalars;
  for (const auto& [name, meaning] : listing_of(run_record())) {
    std::string path = '/' + name;
    std::ranges::replace(path, '.', '/');
    const auto found = flat.find(path);
    if (found == flat.end() || found->is_null() || found->is_structured()) continue;
    scalars.push_back(
        {name, meaning, found->is_string() ? found->get<std::string>() : found->dump()});
  }
  return scalars;
}

void read_summary(const std::filesystem::path& path, const std::string& text, FinishedRun& run) {
  const auto read = [&](const Json& json) {
    check_layout(json);
    DescribedRun described = {&run.input, &run.result, {}, {}};
    try {
      assign(run_record(), json, described);
    } catch (const InvalidCase& error) {
      fail<ResultsError>("the case in this file is not valid: {} {}", error.key, error.what());
    }
    run.program_version = std::move(described.program_version);
    run.libraries = std::move(described.libraries);
    try {
      contact_law_of(run.input);  // of which figures draw branches
    } catch (const std::invalid_argument& error) {
      fail<ResultsError>("the case in this file is not valid: {}", error.what());
    }
  };
  read_json(path, text, "the summary of a run", "; run the case again", read);
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
