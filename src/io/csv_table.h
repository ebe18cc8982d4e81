#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace subimpact {

/// A CSV file of this program's: a header, then rows of as many cells. No quoting.
class CsvTable {
 public:
  /// Throws ResultsError if the file cannot be read or a row has another number of cells.
  explicit CsvTable(const std::filesystem::path& path);

  std::size_t n_rows() const { return starts_.size(); }
  bool has(std::string_view column) const;
  /// Index of a column. Throws ResultsError if there is none of that name.
  std::size_t column(std::string_view name) const;

  std::string_view text(std::size_t row, std::size_t column) const;
  /// Nothing for an empty cell. Throws ResultsError for what is no number.
  std::optional<double> number(std::size_t row, std::size_t column) const;
  /// Throws ResultsError for an empty cell, too.
  double required(std::size_t row, std::size_t column) const;

 private:
  [[noreturn]] void refuse(std::size_t row, std::size_t column, const char* wanted) const;

  std::string path_;
  std::string content_;
  std::vector<std::string> header_;
  std::vector<std::size_t> starts_;  // of each row's cells in bounds_
  std::vector<std::size_t> bounds_;  // cell k of a row: from bounds_[k] to bounds_[k + 1] - 1
};

/// The whole of a file. Throws ResultsError.
std::string read_whole_file(const std::filesystem::path& path);

}  // namespace subimpact
