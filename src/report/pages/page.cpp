#include "report/pages/page.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <regex>
#include <stdexcept>
#include <utility>

#include "io/directory/listed_files.h"
#include "io/printable.h"
#include "report/files.h"
#include "subimpact/io/read_results.h"

namespace subimpact {
namespace {

const Json& field(const std::vector<const Json*>& scopes, const std::string& name) {
  if (name == ".") return *scopes.back();
  for (const Json* scope : scopes | std::views::reverse) {
    if (scope->contains(name)) return scope->at(name);
  }
  throw std::logic_error("a page without the field " + name);
}

std::string text_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string_view take(std::string_view& page, const std::string& mark) {
  const std::size_t at = page.find(mark);
  if (at == page.npos) throw std::logic_error("a page without " + mark);
  const std::string_view taken = page.substr(0, at);
  page.remove_prefix(at + mark.size());
  return taken;
}

void fill(std::string& result, std::string_view page, std::vector<const Json*>& scopes) {
  while (page.find("{{") != page.npos) {
    result += take(page, "{{");
    if (page.front() == '{') {
      result += text_of(field(scopes, std::string(take(page, "}}}").substr(1))));
    } else if (page.front() == '#') {
      const std::string name(take(page, "}}").substr(1));
      const std::string_view part = take(page, "{{/" + name + "}}");
      const auto fill_with = [&](const Json& entry) {
        scopes.push_back(&entry);
        fill(result, part, scopes);
        scopes.pop_back();
      };
      const Json& value = field(scopes, name);
      if (value.is_array()) {
        for (const Json& entry : value) fill_with(entry);
      } else if (!value.is_null() && value != false && value != Json("")) {
        fill_with(value);
      }
    } else {
      result += escaped(text_of(field(scopes, std::string(take(page, "}}")))));
    }
  }
  result += page;
}

using Texts = std::pair<const char*, const char*>;

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

void erase_between(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at)) {
    const std::size_t end = text.find(to, at + from.size());
    if (end == text.npos) return;
    text.erase(at, end + to.size() - at);
  }
}

// Ends neither the script element nor its character data, and names no other file.
std::string within_page(std::string text) {
  if (const std::size_t map = text.find("//# sourceMappingURL"); map != text.npos) {
    text.erase(map, text.find('\n', map) - map);
  }
  replace_all(text, "</script", "<\\/script");
  replace_all(text, "]]>", "]] >");
  replace_all(text, "</style", "<\\/style");
  return text;
}

}  // namespace

std::string filled(std::string_view page, const Json& fields) {
  std::string result;
  std::vector<const Json*> scopes = {&fields};
  fill(result, page, scopes);
  return result;
}

std::string escaped(std::string_view text) {
  std::string result = printable(text);  // XML allows no control characters
  for (const auto& [character, entity] :
       {Texts("&", "&amp;"), Texts("<", "&lt;"), Texts(">", "&gt;"), Texts("\"", "&quot;")}) {
    replace_all(result, character, entity);
  }
  return result;
}

std::string in_print(std::string text) {
  static const std::regex micro(" u([sm])(?![0-9A-Za-z])");
  text = std::regex_replace(text, micro, " µ$1");
  replace_all(text, "+-", "±");
  return text;
}

Json headline(bool certain, const std::string& words) {
  return {{"kind", certain ? "certain" : "not"},
          {"about", certain ? "Certain:" : "Not certain:"},
          {"words", in_print(words)}};
}

ChartLibrary chart_library(const std::filesystem::path& directory) {
  const std::filesystem::path place = directory.empty() ? SUBIMPACT_DYGRAPHS : directory;
  try {
    return {within_page(read_whole_file(place / "dygraph.min.js")),
            within_page(read_whole_file(place / "dygraph.css")),
            {}};
  } catch (const ResultsError&) {
    return {{},
            {},
            fmt::format("{} has no dygraph.min.js and dygraph.css; install dygraphs (Debian: "
                        "apt-get install libjs-dygraphs), or name the directory that holds both "
                        "(--dygraphs DIR), and write this page again",
                        place.string())};
  }
}

std::string whole_page(std::string_view name, Json fields, const ChartLibrary& charts,
                       std::initializer_list<std::string_view> scripts) {
  fields["scripts"] = list_of(scripts, embedded_file);
  if (!charts.script.empty()) fields["scripts"].insert(fields["scripts"].begin(), charts.script);
  fields["style"] = std::string(embedded_file("pages/web/report.css")) + charts.style;
  fields["no_charts"] = charts.missing;
  fields["body"] = filled(embedded_file(name), fields);
  return filled(embedded_file("pages/web/page.html"), fields);
}

std::string inlined_svg(const std::string& svg, const std::string& prefix) {
  std::string text = svg.substr(svg.find("<svg"));
  erase_between(text, " xmlns=\"", "\"");
  erase_between(text, " xmlns:xlink=\"", "\"");
  replace_all(text, "xlink:href", "href");
  for (const std::string mark : {"id=\"", "id='", "href=\"#", "href='#", "url(#"}) {
    replace_all(text, mark, mark + prefix + "-");
  }
  return text;
}

std::string base64(std::string_view bytes) {
  std::vector<unsigned char> text(4 * (bytes.size() / 3 + 1) + 1);
  const int n = EVP_EncodeBlock(text.data(), reinterpret_cast<const unsigned char*>(bytes.data()),
                                static_cast<int>(bytes.size()));
  return {text.begin(), text.begin() + n};
}

Json packed_i24(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double x : values) largest = std::max(largest, std::abs(x));
  const double step = largest > 0.0 ? largest / 8388607.0 : 1.0;
  std::string bytes;
  bytes.reserve(3 * values.size());
  for (const double x : values) {
    const auto n = static_cast<unsigned>(static_cast<int>(std::lround(x / step)));
    for (const unsigned shift : {0u, 8u, 16u}) bytes.push_back(static_cast<char>(n >> shift));
  }
  return {{"i24", base64(bytes)}, {"step", step}};
}

std::string within_script(const Json& json) {
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (const auto& [character, code] :
       {Texts("<", "\\u003c"), Texts(">", "\\u003e"), Texts("&", "\\u0026")}) {
    replace_all(text, character, code);
  }
  return text;
}

}  // namespace subimpact
