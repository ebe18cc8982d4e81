#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "report/chart_library.h"
#include "report/page_template.h"

namespace subimpact {

/// Parts that pages have in common, as the fields of a template.
using FieldList = std::vector<Fields>;

/// A list of one text per entry.
template <class Range>
FieldList list_of(const std::string& name, const Range& texts) {
  FieldList list;
  for (const std::string& text : texts) list.push_back({{{name, text}}, {}});
  return list;
}

/// A part of the page that is there or not.
inline FieldList if_given(bool given, const Fields& fields = {}) {
  return given ? FieldList{fields} : FieldList{};
}

/// Words of the program with units and signs as they are set in print: "12 us +- 1" becomes "12 µs
/// ± 1".
std::string in_print(std::string text);

/// One line of a page's headline: what is certain, or what is not.
inline Fields headline(bool certain, const std::string& words) {
  return {{{"kind", certain ? "certain" : "not"},
           {"about", certain ? "Certain:" : "Not certain:"},
           {"words", in_print(words)}},
          {}};
}

/// Adds "style" and "scripts": files of pages/, in that order.
void add_own_scripts(Fields& page, std::initializer_list<std::string_view> names);

/// Adds "style", "scripts" and "no_charts": the chart library, if there is one, and the page's own
/// scripts, the last of which is `main_script`.
void add_scripts(Fields& page, const ChartLibrary& charts, std::string_view main_script);

}  // namespace subimpact
