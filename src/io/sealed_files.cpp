#include "io/sealed_files.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <sstream>

#include "subimpact/io/read_results.h"

namespace subimpact {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse_to_read(const fs::path& path, const char* cause) {
  throw ResultsError(
      fmt::format("{}: cannot be read ({}); give the output directory of "
                  "`subimpact run`",
                  path.string(), cause));
}

// A pipe or a device may never end.
void check_is_regular(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    refuse_to_read(path, "it is no regular file");
  }
}

std::ifstream open_file(const fs::path& path) {
  check_is_regular(path);
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse_to_read(path, std::strerror(errno));
  return file;
}

std::string text_of(std::istream& file, const fs::path& path) {
  std::ostringstream text;
  errno = 0;
  if (!(text << file.rdbuf())) {
    refuse_to_read(path, errno != 0 ? std::strerror(errno) : "it is empty");
  }
  return std::move(text).str();
}

}  // namespace

std::string read_whole_file(const fs::path& path) {
  std::ifstream file = open_file(path);
  return text_of(file, path);
}

void throw_always_replaced(const fs::path& directory) {
  throw ResultsError(fmt::format(
      "{}: is written anew again and again; read it when the runs have ended", directory.string()));
}

SealedFiles::SealedFiles(fs::path directory)
    : directory_(std::move(directory)), manifest_(read_manifest(directory_)) {}

bool SealedFiles::are_sealed() const {
  return manifest_ && manifest_->kind != "figures" && manifest_->kind != "report";
}

std::ifstream SealedFiles::open(const std::string& name) const {
  const fs::path path = directory_ / name;
  if (!are_sealed()) return open_file(path);
  const auto listed = manifest_->files.find(name);
  if (listed == manifest_->files.end()) {
    throw ResultsError(fmt::format("{}: is not among the results of `subimpact {}` that {} lists",
                                   path.string(), manifest_->kind, manifest_name));
  }
  // A file that is not yet in its place waits under the name of its commit.
  for (const fs::path& place : {path, staging_of(directory_, manifest_->commit) / name, path}) {
    check_is_regular(place);
    errno = 0;
    std::ifstream file(place, std::ios::binary);
    if (!file && errno == EACCES) refuse_to_read(place, std::strerror(errno));
    if (file && seal_of(file) == listed->second) return file;
  }
  const std::optional<Manifest> now = read_manifest(directory_);
  if (now && now->commit != manifest_->commit) throw ReplacedMeanwhile();
  throw ResultsError(fmt::format(
      "{}: is not the file that the run wrote (its length or checksum differs from {}): "
      "it was changed or cut short since; run the case again",
      path.string(), manifest_name));
}

std::string SealedFiles::text(const std::string& name) const {
  std::ifstream file = open(name);
  return text_of(file, directory_ / name);
}

}  // namespace subimpact
