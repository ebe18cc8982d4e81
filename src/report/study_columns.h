#pragma once

/// Columns of studies: one list gives a study's CSV file and the table that is printed.

#include <fmt/format.h>

#include "io/records/csv_columns.h"
#include "subimpact/study/judgement/event_errors.h"

namespace subimpact {

/// The member of a row that a path of members leads to.
template <auto... members>
constexpr auto member = [](const auto& row) { return (row.*....*members); };

// Of trials: a number of one that ran, or a known error.
template <auto... members>
constexpr auto of_run = [](const auto& trial) {
  return trial.has_run() ? std::optional(member<members...>(trial)) : std::nullopt;
};
template <double EventErrors::*error>
constexpr auto known_error = [](const auto& trial) {
  return trial.has_errors() ? std::optional(trial.errors.*error) : std::nullopt;
};

struct Print {
  std::string heading;      ///< in one line or in two
  std::string width = {};   ///< alignment and width, as in format strings: ">13"
  std::string number = {};  ///< of real numbers: ".6g"
  double unit = 1.0;        ///< what real numbers are multiplied by
};

/// A column of the file (if it has a name), of the printed table (if it has a width), or of both.
template <class Row>
struct StudyColumn : Column<Row> {
  template <class Value>
  StudyColumn(std::string name_in_file, Value value, Print how = {})
      : Column<Row>(std::move(name_in_file), value), print(std::move(how)) {}

  Print print;
};

template <class Row>
using StudyColumns = std::vector<StudyColumn<Row>>;

template <class Row>
Columns<Row> columns_in_file(const StudyColumns<Row>& columns) {
  Columns<Row> in_file;
  for (const StudyColumn<Row>& column : columns) {
    if (!column.name.empty()) in_file.push_back(column);
  }
  return in_file;
}

inline std::string printed(const Print& print, const Cell& cell) {
  const auto text = [&](const std::string& format, const auto& value) {
    return fmt::format(fmt::runtime(fmt::format("{{:{}{}}}", print.width, format)), value);
  };
  if (const auto* real = std::get_if<double>(&cell)) return text(print.number, *real * print.unit);
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) return text("", *whole);
  const auto* words = std::get_if<std::string>(&cell);
  return text("", words ? *words : "");
}

/// A line with `cell_of` each printed column: absent ones are blank, and none at the end.
template <class Row, class CellOf>
std::string printed_line(const StudyColumns<Row>& columns, CellOf cell_of) {
  std::string line, blanks;
  for (const StudyColumn<Row>& column : columns) {
    if (column.print.width.empty()) continue;
    const Cell cell = cell_of(column);
    if (!line.empty() || !blanks.empty()) blanks += ' ';
    blanks += printed(column.print, cell);
    if (std::holds_alternative<std::monostate>(cell)) continue;
    line += std::exchange(blanks, {});
  }
  return line.empty() ? line : line + '\n';
}

template <class Row>
std::string printed_heading(const StudyColumns<Row>& columns) {
  const auto line = [&](bool upper) {
    return printed_line(columns, [&](const StudyColumn<Row>& column) {
      const std::string& heading = column.print.heading;
      const std::size_t end = heading.find('\n');
      const bool is_split = end != std::string::npos;
      const std::string words = upper      ? heading.substr(0, is_split ? end : 0)
                                : is_split ? heading.substr(end + 1)
                                           : heading;
      return words.empty() ? Cell() : Cell(words);
    });
  };
  return line(true) + line(false);
}

template <class Row>
std::string printed_row(const StudyColumns<Row>& columns, const Row& row, std::size_t index = 0) {
  return printed_line(columns,
                      [&](const StudyColumn<Row>& column) { return column.cell(row, index); });
}

template <class Row>
std::string printed_table(const StudyColumns<Row>& columns, const std::vector<Row>& rows) {
  std::string text = printed_heading(columns);
  for (std::size_t i = 0; i < rows.size(); ++i) text += printed_row(columns, rows[i], i);
  return text;
}

}  // namespace subimpact
