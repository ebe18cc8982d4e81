#include "report/page_template.h"

#include <stdexcept>

#include "io/printable.h"

namespace subimpact {
namespace {

// The innermost field of that name.
template <class Value>
const Value& field(const std::vector<const Fields*>& scopes,
                   std::map<std::string, Value> Fields::*kind, const std::string& name) {
  for (auto scope = scopes.rbegin(); scope != scopes.rend(); ++scope) {
    const auto found = ((*scope)->*kind).find(name);
    if (found != ((*scope)->*kind).end()) return found->second;
  }
  throw std::logic_error("a page without the field " + name);
}

// Takes a page up to a mark, and the mark.
std::string_view take(std::string_view& page, const std::string& mark) {
  const std::size_t at = page.find(mark);
  if (at == page.npos) throw std::logic_error("a page without " + mark);
  const std::string_view taken = page.substr(0, at);
  page.remove_prefix(at + mark.size());
  return taken;
}

void fill(std::string& result, std::string_view page, std::vector<const Fields*>& scopes) {
  while (page.find("{{") != page.npos) {
    result += take(page, "{{");
    if (page.front() == '{') {
      result += field(scopes, &Fields::texts, std::string(take(page, "}}}").substr(1)));
    } else if (page.front() == '#') {
      const std::string name(take(page, "}}").substr(1));
      const std::string_view part = take(page, "{{/" + name + "}}");
      for (const Fields& entry : field(scopes, &Fields::lists, name)) {
        scopes.push_back(&entry);
        fill(result, part, scopes);
        scopes.pop_back();
      }
    } else {
      result += escaped(field(scopes, &Fields::texts, std::string(take(page, "}}"))));
    }
  }
  result += page;
}

}  // namespace

std::string filled(std::string_view page, const Fields& fields) {
  std::string result;
  std::vector<const Fields*> scopes = {&fields};
  fill(result, page, scopes);
  return result;
}

std::string escaped(std::string_view text) {
  static const std::map<char, std::string> entities = {
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string result;
  for (const char c : printable(text)) {  // XML allows no control characters
    const auto entity = entities.find(c);
    result += entity != entities.end() ? entity->second : std::string(1, c);
  }
  return result;
}

}  // namespace subimpact
