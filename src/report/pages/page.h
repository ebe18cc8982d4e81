#pragma once

#include <cstring>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <nlohmann/json.hpp>

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// What a page is made of: the fields of its template, and the data that its scripts draw.
using Json = nlohmann::ordered_json;

/// A page from its template, in the notation of Mustache: `{{name}}` is a text or a number, escaped
/// for HTML; `{{{name}}}` a text as it is. What stands between `{{#name}}` and `{{/name}}` is
/// repeated for each entry of a list, whose fields come before those around it (`{{.}}` is the
/// entry itself); for a field that is no list it is there once, and not at all for an empty text,
/// false or null. Throws std::logic_error for a name without a field.
std::string filled(std::string_view page, const Json& fields);

/// Text as HTML shows it literally.
std::string escaped(std::string_view text);

template <class Range, class Entry>
Json list_of(const Range& range, Entry entry) {
  Json list = Json::array();
  for (const auto& x : range) list.push_back(entry(x));
  return list;
}

/// Words with units and signs as they are set in print: "12 us +- 1" becomes "12 µs ± 1".
std::string in_print(std::string text);

/// One line of a page's headline: what is certain, or what is not.
Json headline(bool certain, const std::string& words);

/// dygraphs, which draws zoomable charts, as text that can stand within a page.
struct ChartLibrary {
  std::string script, style;
  std::string missing;  ///< why it is not there and what to do; else empty
};

/// Reads dygraph.min.js and dygraph.css from a directory; an empty path stands for the place where
/// the Debian package libjs-dygraphs has them.
ChartLibrary chart_library(const std::filesystem::path& directory);

/// A page of pages/: its body from `name`, a template, and `fields` (among them "title" and
/// "data"); around it style and scripts, the chart library, if there is one, and files of pages/,
/// in that order. The field "no_charts" is added: why charts are missing, or empty.
std::string whole_page(std::string_view name, Json fields, const ChartLibrary& charts,
                       std::initializer_list<std::string_view> scripts);

/// An SVG file as an element of an HTML page: without prologue and name spaces, its ids prefixed so
/// that several figures on a page do not share them.
std::string inlined_svg(const std::string& svg, const std::string& prefix);

/// Columns of numbers as the scripts of a page read them (pages/data.js): base64 of little-endian
/// numbers, named by their kind,
///
///     f64, f32: floating-point numbers;  i24: signed 24-bit integers, multiples of `step`.
std::string base64(std::string_view bytes);

/// A column of the value of each row, as double or float; NaN where there is none. `value`: a
/// member of the row, or a function of it.
template <class Number, class Range, class Value = std::identity>
Json packed(const Range& rows, Value value = {}) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::string bytes(rows.size() * sizeof(Number), '\0');
  char* at = bytes.data();
  for (const auto& row : rows) {
    const Number number =
        static_cast<Number>(std::optional<double>(std::invoke(value, row)).value_or(none));
    std::memcpy(at, &number, sizeof number);
    at += sizeof number;
  }
  return {{std::is_same_v<Number, double> ? "f64" : "f32", base64(bytes)}};
}

/// In 24 bits each: exact to 6e-8 of the largest.
Json packed_i24(const std::vector<double>& values);

/// JSON within a script element, where the text would end at "</script": without <, > and &.
std::string within_script(const Json& json);

/// What the scripts of a page draw, and what was left out to keep the page small.
struct PageData {
  std::string json;          ///< to stand within a script element: without <, > and &
  std::string history_note;  ///< one sentence; empty if every row is there
  std::string shapes_note;   ///< one or two sentences
};

/// The data of a run. Columns are packed as above: a value is exact to 6e-8 of itself (f32) or
/// of the largest of its column (i24). Of long histories the rows with the extremes of equal spans
/// are kept, of many or fine shapes those at events and every n-th.
PageData page_data(const Case& input, const Result& result, const Json& overlay = nullptr);

/// The data of several runs for a page that compares them: named columns of their histories.
std::string comparison_data(const std::vector<std::string>& names,
                            const std::vector<const Result*>& results);

}  // namespace subimpact
