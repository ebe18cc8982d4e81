#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "io/write_file.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace fs = std::filesystem;

void write_file(const fs::path& path, const std::string& content) {
  const fs::path partial = path.string() + ".partial";
  const auto fail = [&](const std::string& cause) {
    std::error_code ignored;
    fs::remove(partial, ignored);
    throw OutputError(
        fmt::format("{}: cannot be written ({}); free the disk or choose another "
                    "directory with --out",
                    path.string(), cause));
  };
  errno = 0;
  std::ofstream file(partial, std::ios::binary | std::ios::trunc);
  if (!file) fail(std::strerror(errno));
  file << content;
  file.close();
  if (!file) fail(errno != 0 ? std::strerror(errno) : "only part of the data was written");
  std::error_code error;
  fs::rename(partial, path, error);
  if (error) fail(error.message());
}

void prepare_output_directory(const fs::path& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  if (error || !fs::is_directory(directory)) {
    throw OutputError(
        fmt::format("{}: this output directory cannot be made ({}); choose another "
                    "with --out",
                    directory.string(), error ? error.message() : "a file has that name"));
  }
  const fs::path probe = directory / ".subimpact-probe";
  errno = 0;
  const bool writable = static_cast<bool>(std::ofstream(probe) << "probe" << std::flush);
  const int cause = errno;
  fs::remove(probe, error);
  if (!writable) {
    throw OutputError(
        fmt::format("{}: this output directory cannot be written to ({}); change its "
                    "permissions or choose another with --out",
                    directory.string(), std::strerror(cause)));
  }
}

void write_results(const fs::path& directory, const Case& input, const Result& result) {
  write_file(directory / "events.csv", events_csv(result.sub_impacts));
  write_file(directory / "transitions.csv", transitions_csv(result.transitions));
  write_file(directory / "history.csv", history_csv(result.history));
  if (!input.output.sections.empty()) {
    write_file(directory / "sections.csv", sections_csv(result.section_history));
  } else {
    std::error_code ignored;  // of an earlier run into the same directory
    fs::remove(directory / "sections.csv", ignored);
  }
  write_file(directory / "summary.json", summary_json(input, result));
}

void write_comparison(const fs::path& directory, const Comparison& comparison) {
  write_file(directory / "comparison.csv", comparison_csv(comparison));
  write_file(directory / "matches.csv", matches_csv(comparison));
}

}  // namespace subimpact
