#pragma once

/// Columns of CSV tables. A column stands in one place, with its name, its meaning and the member
/// that it holds; heading, writer and documentation follow from the list of columns.
///
/// Numbers have the 17 digits that determine a double, unless their column has fewer. A value that
/// is absent is an empty cell. A text with a comma or a quote is quoted, its quotes doubled; an end
/// of a line in it becomes a space, so that each row is one line.

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "subimpact/simulate/assessment.h"

namespace subimpact {

/// A cell as a value; std::monostate: empty.
using Cell = std::variant<std::monostate, double, std::int64_t, std::string>;
enum class CellType { real, whole, words };

inline Cell to_cell(double value) { return value; }
inline Cell to_cell(std::integral auto value) { return static_cast<std::int64_t>(value); }
inline Cell to_cell(std::string_view words) { return std::string(words); }
inline Cell to_cell(const Reason& reason) { return words_of(reason); }
template <class Enum>
requires std::is_enum_v<Enum> Cell to_cell(Enum value) { return std::string(to_string(value)); }
template <class Value>
Cell to_cell(const std::optional<Value>& value) {
  return value ? to_cell(*value) : Cell();
}

/// Writes numbers, with the texts of those written last at hand: rows repeat times, places, zeros
/// and what symmetry gives.
class NumberWriter {
 public:
  void append(std::string& text, double value, int digits) {
    const double magnitude = std::abs(value);
    const auto bits = std::bit_cast<std::uint64_t>(magnitude);
    Entry& entry = entries_[(bits * 0x9E3779B97F4A7C15u) >> (64 - n_bits)];  // Fibonacci hashing
    if (entry.bits != bits || entry.digits != digits) {
      char* const first = entry.text.data();
      char* last = std::to_chars(first, first + entry.text.size(), magnitude,
                                 std::chars_format::general, digits)
                       .ptr;
      if (first[0] == '0' && last - first > digits + 2) last = without_leading_zeros(first, last);
      entry.bits = bits;
      entry.digits = digits;
      entry.size = static_cast<std::size_t>(last - first);
    }
    if (std::signbit(value)) text.push_back('-');
    text.append(entry.text.data(), entry.size);
  }

 private:
  // 0.00ddd becomes d.dde-03: readers that are quick rather than exact, as pandas is, count leading
  // zeros as digits.
  static char* without_leading_zeros(char* first, char* last) {
    char* const digit = std::find_if(first + 2, last, [](char c) { return c != '0'; });
    const auto exponent = static_cast<char>('0' + (digit - first - 1));
    if (digit == first + 2) return last;
    first[0] = *digit;
    char* const end = std::copy(digit + 1, last, first + 2);
    return std::ranges::copy(std::array{'e', '-', '0', exponent}, end).out;
  }

  static constexpr int n_bits = 9;
  struct Entry {
    std::uint64_t bits = 0;
    int digits = 0;  // 0: none yet
    std::size_t size = 0;
    std::array<char, 24> text{};  // holds 17 digits, point and exponent
  };
  std::array<Entry, 1 << n_bits> entries_{};
};

inline void append_cell(std::string& text, const Cell& cell, int digits, NumberWriter& numbers) {
  if (const auto* real = std::get_if<double>(&cell)) numbers.append(text, *real, digits);
  if (const auto* whole = std::get_if<std::int64_t>(&cell)) text += std::to_string(*whole);
  if (const auto* words = std::get_if<std::string>(&cell)) {
    const bool is_quoted = words->find_first_of(",\"") != words->npos;
    if (is_quoted) text.push_back('"');
    for (const char c : *words) {
      text.push_back(c == '\n' || c == '\r' ? ' ' : c);
      if (c == '"') text.push_back(c);
    }
    if (is_quoted) text.push_back('"');
  }
}

template <class Value>
constexpr CellType cell_type = std::is_floating_point_v<Value> ? CellType::real
                               : std::is_integral_v<Value>     ? CellType::whole
                                                               : CellType::words;
template <class Value>
constexpr CellType cell_type<std::optional<Value>> = cell_type<Value>;

template <class Row>
struct Column {
  /// `value`: a pointer to a member of the row, or a function of the row, or of the row and its
  /// index.
  template <class Value>
  Column(std::string name_with_unit, std::string meaning_of_value, Value value)
      : name(std::move(name_with_unit)), meaning(std::move(meaning_of_value)) {
    const auto held = [value](const Row& row,
                              [[maybe_unused]] std::size_t index) -> decltype(auto) {
      if constexpr (std::is_invocable_v<Value, const Row&, std::size_t>) {
        return std::invoke(value, row, index);
      } else {
        return std::invoke(value, row);
      }
    };
    type = cell_type<std::remove_cvref_t<decltype(held(std::declval<const Row&>(), 0))>>;
    if constexpr (std::is_same_v<Value, double Row::*>) member = value;
    cell = [held](const Row& row, std::size_t index) { return to_cell(held(row, index)); };
  }

  template <class Value>
  Column(std::string name_with_unit, Value value) : Column(std::move(name_with_unit), "", value) {}

  std::string name;     ///< with its unit
  std::string meaning;  ///< for the documentation
  CellType type = CellType::real;
  int digits = 17;                ///< of real numbers in the file
  double Row::*member = nullptr;  ///< that the column holds, if it is a number that is always there
  std::function<Cell(const Row&, std::size_t index)> cell;
};

template <class Row>
using Columns = std::vector<Column<Row>>;

template <class Row>
std::string csv_heading(const Columns<Row>& columns) {
  std::string text;
  for (const Column<Row>& column : columns) text += (text.empty() ? "" : ",") + column.name;
  return text + '\n';
}

template <class Row>
void append_row(std::string& text, const Columns<Row>& columns, const Row& row,
                NumberWriter& numbers, std::size_t index = 0) {
  for (const Column<Row>& column : columns) {
    if (&column != &columns.front()) text.push_back(',');
    if (column.member != nullptr) {
      numbers.append(text, row.*column.member, column.digits);
    } else {
      append_cell(text, column.cell(row, index), column.digits, numbers);
    }
  }
  text.push_back('\n');
}

template <class Row>
std::string csv_text(const Columns<Row>& columns, const std::vector<Row>& rows) {
  std::string text = csv_heading(columns);
  NumberWriter numbers;
  for (std::size_t i = 0; i < rows.size(); ++i) append_row(text, columns, rows[i], numbers, i);
  return text;
}

}  // namespace subimpact
