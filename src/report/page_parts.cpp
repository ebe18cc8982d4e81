#include "report/page_parts.h"

#include <cctype>

#include "report/files.h"

namespace subimpact {

std::string in_print(std::string text) {
  for (const std::string_view unit : {" us", " um"}) {
    for (std::size_t at = text.find(unit); at != std::string::npos; at = text.find(unit, at + 1)) {
      const std::size_t next = at + unit.size();
      const bool ends =
          next == text.size() || !std::isalnum(static_cast<unsigned char>(text[next]));
      if (ends) text.replace(at + 1, 1, "µ");
    }
  }
  for (std::size_t at = text.find("+-"); at != std::string::npos; at = text.find("+-", at)) {
    text.replace(at, 2, "±");
  }
  return text;
}

void add_own_scripts(Fields& page, std::initializer_list<std::string_view> names) {
  FieldList& scripts = page.lists["scripts"];
  for (const std::string_view name : names) {
    scripts.push_back({{{"script", std::string(embedded_file(name))}}, {}});
  }
  page.texts["style"] = std::string(embedded_file("pages/report.css"));
}

void add_scripts(Fields& page, const ChartLibrary& charts, std::string_view main_script) {
  if (charts.missing.empty()) page.lists["scripts"] = {{{{"script", charts.script}}, {}}};
  add_own_scripts(
      page, {"pages/data.js", "pages/axes.js", "pages/motion.js", "pages/panels.js", main_script});
  page.lists["no_charts"] =
      if_given(!charts.missing.empty(), {{{"no_charts_reason", charts.missing}}, {}});
  page.texts["style"] += charts.style;
}

}  // namespace subimpact
