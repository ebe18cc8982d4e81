#pragma once

#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "io/records/csv_columns.h"
#include "subimpact/simulate/records.h"

namespace subimpact {

/// Reads a CSV file of this program, row by row: a heading, then as many cells; no quoting.
class CsvReader {
 public:
  /// For messages: the file's name, and a remedy. Throws ResultsError if there is no heading.
  CsvReader(std::istream& file, std::string name, std::string remedy = "run the case again");

  const std::vector<std::string>& heading() const { return heading_; }
  /// Whether there was a further row. Throws ResultsError if it has another number of cells.
  bool next();
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

/// Calls `use` with every row of a file. Throws ResultsError if the file lacks a column
/// or a cell holds another kind of value than its column.
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
    if (column.read && !is_there) csv.refuse_lack_of(column.name);
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

/// Refuses what no run can have written, row by row, in the order of a table: times that are
/// negative or decrease, zones that are not numbered from 1. Throws ResultsError with file, line,
/// value and what is allowed.
class RowOrder {
 public:
  explicit RowOrder(std::string file) : file_(std::move(file)) {}

  template <class Row>
  void check(const Row& row) {
    ++line_;
    if constexpr (requires { row.time; }) check_time("time_s", row.time);
  }
  void check(const SubImpact& row);

 private:
  void check_time(const char* column, double time);
  void check_number(const char* column, int number, int& last) const;
  [[noreturn]] void refuse(const char* column, double value, const char* allowed) const;

  std::string file_;
  std::size_t line_ = 1;  // the heading
  double last_time_ = 0.0;
  int last_zone_ = 0, last_subzone_ = 0;
};

}  // namespace subimpact
