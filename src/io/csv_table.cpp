#include "io/csv_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>

#include "case/counted.h"
#include "subimpact/io/read_results.h"

namespace subimpact {
namespace {

// The most rows that a run may keep take some 2e9 bytes.
constexpr std::uintmax_t largest_file = 4'000'000'000;
constexpr std::size_t longest_quotation = 80;

}  // namespace

std::string read_whole_file(const std::filesystem::path& path) {
  const auto fail = [&](const char* cause) {
    throw ResultsError(
        fmt::format("{}: cannot be read ({}); give the output directory of `subimpact run`",
                    path.string(), cause));
  };
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    fail("it is no regular file");  // a pipe or a device may never end
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(std::strerror(errno));
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) fail(error.message().c_str());
  if (size == 0) fail("it is empty");
  if (size > largest_file) fail("it is larger than any table of a run");
  std::string text(size, '\0');
  file.read(text.data(), static_cast<std::streamsize>(size));
  if (!file) fail("it became shorter meanwhile");
  return text;
}

CsvTable::CsvTable(const std::filesystem::path& path)
    : CsvTable(path.string(), read_whole_file(path)) {}

CsvTable::CsvTable(std::string name, std::string content)
    : path_(std::move(name)), content_(std::move(content)) {
  std::size_t line_start = 0;
  for (bool in_header = true; line_start < content_.size(); in_header = false) {
    std::size_t line_end = content_.find('\n', line_start);
    if (line_end == std::string::npos) line_end = content_.size();
    starts_.push_back(bounds_.size());
    bounds_.push_back(line_start);
    for (std::size_t i = line_start; i < line_end; ++i) {
      if (content_[i] == ',') bounds_.push_back(i + 1);
    }
    bounds_.push_back(line_end + 1);
    const std::size_t n_cells = bounds_.size() - starts_.back() - 1;
    if (in_header) {
      for (std::size_t k = 0; k < n_cells; ++k) header_.emplace_back(text(0, k));
      starts_.clear();
      bounds_.clear();
    } else if (n_cells != header_.size()) {
      throw ResultsError(fmt::format("{}:{}: has {} where the header has {}; run the case again",
                                     path_, starts_.size() + 1, counted(n_cells, "cell"),
                                     header_.size()));
    }
    line_start = line_end + 1;
  }
}

bool CsvTable::has(std::string_view column) const {
  return std::find(header_.begin(), header_.end(), column) != header_.end();
}

std::size_t CsvTable::column(std::string_view name) const {
  const auto found = std::find(header_.begin(), header_.end(), name);
  if (found == header_.end()) {
    throw ResultsError(fmt::format("{}: has no column {}; its columns are {}; run the case again",
                                   path_, name, fmt::join(header_, ", ")));
  }
  return static_cast<std::size_t>(found - header_.begin());
}

std::string_view CsvTable::text(std::size_t row, std::size_t column) const {
  const std::size_t k = starts_[row] + column;
  return std::string_view(content_).substr(bounds_[k], bounds_[k + 1] - 1 - bounds_[k]);
}

void CsvTable::refuse(std::size_t row, std::size_t column, const char* allowed) const {
  throw ResultsError(fmt::format("{}:{}: {} is \"{}\"; allowed: {}; run the case again", path_,
                                 row + 2, header_[column],
                                 text(row, column).substr(0, longest_quotation), allowed));
}

}  // namespace subimpact
