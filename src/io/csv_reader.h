#pragma once

#include <functional>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "io/csv_columns.h"

namespace subimpact {

/// Reads a CSV file of this program: a heading, then rows of as many cells. No quoting. One row is
/// held at a time.
class CsvReader {
 public:
  /// For messages: the file's name, and what to do if it is damaged. Throws ResultsError if there
  /// is no heading.
  CsvReader(std::istream& file, std::string name, std::string remedy = "run the case again");

  const std::vector<std::string>& heading() const { return heading_; }
  /// Whether there was a further row. Throws ResultsError if it has another number of cells.
  bool next();
  /// Of the row.
  std::string_view cell(std::size_t column) const { return cells_[column]; }
  /// Index of a column; the number of columns if there is none of that name.
  std::size_t find(std::string_view column) const;

  [[noreturn]] void refuse_lack_of(std::string_view column) const;
  [[noreturn]] void refuse_cell(std::size_t column, const char* allowed) const;

 private:
  bool read_line();

  std::istream& file_;
  std::string name_, remedy_;
  std::string line_;
  std::size_t n_lines_ = 0;
  std::vector<std::string> heading_;
  std::vector<std::string_view> cells_;
};

/// Calls `use` with every row of a file. Throws ResultsError if the file lacks a column that is not
/// optional or a cell holds another kind of value than its column.
template <class Row, class Use>
void for_each_row(CsvReader& csv, const Columns<Row>& columns, Use use) {
  struct Place {
    std::size_t cell;
    const Column<Row>* column;
  };
  std::vector<Place> places;
  for (const Column<Row>& column : columns) {
    const std::size_t cell = csv.find(column.name);
    const bool is_there = cell < csv.heading().size();
    if (column.read && is_there) places.push_back({cell, &column});
    if (column.read && !is_there && !column.optional) csv.refuse_lack_of(column.name);
  }
  while (csv.next()) {
    Row row{};
    for (const Place& place : places) {
      if (!place.column->read(csv.cell(place.cell), row)) {
        csv.refuse_cell(place.cell, place.column->allowed);
      }
    }
    use(row);
  }
}

template <class Row>
std::vector<Row> read_rows(std::istream& file, std::string name, const Columns<Row>& columns) {
  CsvReader csv(file, std::move(name));
  std::vector<Row> rows;
  for_each_row(csv, columns, [&](const Row& row) { rows.push_back(row); });
  return rows;
}

}  // namespace subimpact
