#pragma once

#include <pybind11/numpy.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "bindings.h"
#include "io/records/csv_columns.h"

namespace subimpact::python {

/// Characters of a column with words, as NumPy's fixed-width texts have them: at least 16, or as
/// many as its longest cell has.
template <class Row>
std::size_t text_width(const Column<Row>& column, const std::vector<Row>& rows) {
  std::size_t width = 16;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Cell cell = column.cell(rows[i], i);
    if (const auto* words = std::get_if<std::string>(&cell)) width = std::max(width, words->size());
  }
  return width;
}

inline void store(const Cell& cell, CellType type, char* place) {
  if (type == CellType::words) {
    const auto* words = std::get_if<std::string>(&cell);
    for (std::size_t i = 0; words != nullptr && i < words->size(); ++i) {
      const auto character = static_cast<char32_t>((*words)[i]);  // names are ASCII
      std::memcpy(place + 4 * i, &character, 4);
    }
  } else if (type == CellType::whole) {
    const auto* whole = std::get_if<std::int64_t>(&cell);
    const std::int64_t value = whole != nullptr ? *whole : -1;
    std::memcpy(place, &value, sizeof value);
  } else {
    const auto* real = std::get_if<double>(&cell);
    const double value = real != nullptr ? *real : std::numeric_limits<double>::quiet_NaN();
    std::memcpy(place, &value, sizeof value);
  }
}

/// A structured array, read-only, with the columns of a CSV table. Empty cells: NaN, -1, "".
template <class Row>
py::array table(const Columns<Row>& columns, const std::vector<Row>& rows) {
  py::list names, formats, offsets;
  std::vector<std::size_t> places;
  std::size_t row_bytes = 0;
  for (const Column<Row>& column : columns) {
    const bool has_words = column.type == CellType::words;
    const std::size_t width = has_words ? text_width(column, rows) : 2;
    names.append(column.name);
    formats.append(has_words                        ? "U" + std::to_string(width)
                   : column.type == CellType::whole ? "i8"
                                                    : "f8");
    offsets.append(row_bytes);
    places.push_back(row_bytes);
    row_bytes += 4 * width;
  }
  py::array array(py::dtype(names, formats, offsets, static_cast<py::ssize_t>(row_bytes)),
                  std::vector<py::ssize_t>{static_cast<py::ssize_t>(rows.size())});
  auto* row_place = static_cast<char*>(array.mutable_data());
  std::memset(row_place, 0, row_bytes * rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i, row_place += row_bytes) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      store(columns[c].cell(rows[i], i), columns[c].type, row_place + places[c]);
    }
  }
  array.attr("flags").attr("writeable") = false;
  return array;
}

}  // namespace subimpact::python
