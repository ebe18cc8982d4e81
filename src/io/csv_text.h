#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

namespace subimpact {

/// A row after the other, numbers with the 17 digits that determine a double.
class CsvText {
 public:
  explicit CsvText(std::string_view header) { text_.append(header); }

  CsvText& number(double value) { return put("{:.17g}", value); }
  CsvText& number(const std::optional<double>& value) { return value ? number(*value) : empty(); }
  CsvText& whole(std::size_t value) { return put("{}", value); }
  CsvText& word(std::string_view value) { return put("{}", value); }
  /// Words that may hold commas, which become semicolons: no column is quoted.
  CsvText& text(std::string words) {
    std::replace(words.begin(), words.end(), ',', ';');
    std::replace(words.begin(), words.end(), '\n', ' ');
    return word(words);
  }
  CsvText& empty() { return word(""); }
  CsvText& end_row() {
    text_.push_back('\n');
    at_start_ = true;
    return *this;
  }
  std::string str() const { return fmt::to_string(text_); }

 private:
  template <class T>
  CsvText& put(fmt::format_string<const T&> format, const T& value) {
    if (!at_start_) text_.push_back(',');
    at_start_ = false;
    fmt::format_to(std::back_inserter(text_), format, value);
    return *this;
  }

  fmt::memory_buffer text_;
  bool at_start_ = true;
};

}  // namespace subimpact
