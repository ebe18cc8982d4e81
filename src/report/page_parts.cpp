#include "report/page_parts.h"

#include "report/files.h"

namespace subimpact {

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
