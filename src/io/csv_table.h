#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/csv_columns.h"

namespace subimpact {

/// A CSV file of this program: a heading, then rows of as many cells. No quoting.
class CsvTable {
 public:
  /// Throws ResultsError if the file cannot be read or a row has another number of cells.
  explicit CsvTable(const std::filesystem::path& path);
  /// The same for a text; `name` stands for the file in messages.
  CsvTable(std::string name, std::string content);

  std::size_t n_rows() const { return starts_.size(); }
  bool has(std::string_view column) const;
  /// Index of a column. Throws ResultsError if there is none of that name.
  std::size_t column(std::string_view name) const;

  std::string_view text(std::size_t row, std::size_t column) const;
  /// Throws a ResultsError that names the cell.
  [[noreturn]] void refuse(std::size_t row, std::size_t column, const char* allowed) const;

 private:
  std::string path_;
  std::string content_;
  std::vector<std::string> header_;
  std::vector<std::size_t> starts_;  // of each row's cells in bounds_
  std::vector<std::size_t> bounds_;  // cell k of a row: from bounds_[k] to bounds_[k + 1] - 1
};

/// The rows of a table. Throws ResultsError if the file lacks a column that is not optional or a
/// cell holds another kind of value than its column.
template <class Row>
std::vector<Row> rows_of(const CsvTable& csv, const Columns<Row>& columns) {
  std::vector<Row> rows(csv.n_rows());
  for (const Column<Row>& column : columns) {
    if (!column.read || (column.optional && !csv.has(column.name))) continue;
    const std::size_t k = csv.column(column.name);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (!column.read(csv.text(i, k), rows[i])) csv.refuse(i, k, column.allowed);
    }
  }
  return rows;
}
template <class Row>
std::vector<Row> read_rows(const std::filesystem::path& path, const Columns<Row>& columns) {
  return rows_of(CsvTable(path), columns);
}

/// The whole of a file. Throws ResultsError.
std::string read_whole_file(const std::filesystem::path& path);

}  // namespace subimpact
