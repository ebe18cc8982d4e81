#include "report/inlined_svg.h"

namespace subimpact {
namespace {

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

void erase_between(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    const std::size_t end = text.find(to, at + from.size());
    if (end == std::string::npos) return;
    text.erase(at, end + to.size() - at);
  }
}

}  // namespace

std::string inlined_svg(const std::string& svg, const std::string& prefix) {
  std::string text = svg.substr(svg.find("<svg"));
  erase_between(text, " xmlns=\"", "\"");
  erase_between(text, " xmlns:xlink=\"", "\"");
  erase_between(text, "<title>", "</title>");  // "gnuplot_plot_1"
  erase_between(text, "<desc>", "</desc>");
  replace_all(text, "xlink:href", "href");
  for (const std::string mark : {"id=\"", "id='", "href=\"#", "href='#", "url(#"}) {
    replace_all(text, mark, mark + prefix + "-");
  }
  return text;
}

}  // namespace subimpact
