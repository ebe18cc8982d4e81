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
  return text;
}

void add_scripts(Fields& page, const ChartLibrary& charts, std::string_view main_script) {
  FieldList scripts;
  const auto add = [&](std::string_view text) {
    scripts.push_back({{{"script", std::string(text)}}, {}});
  };
  if (charts.missing.empty()) add(charts.script);
  for (const char* name :
       {"pages/data.js", "pages/axes.js", "pages/motion.js", "pages/panels.js"}) {
    add(embedded_file(name));
  }
  add(embedded_file(main_script));
  page.lists["scripts"] = scripts;
  page.lists["no_charts"] =
      if_given(!charts.missing.empty(), {{{"no_charts_reason", charts.missing}}, {}});
  page.texts["style"] = std::string(embedded_file("pages/report.css")) + charts.style;
}

}  // namespace subimpact
