#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace subimpact {

/// What a page template is filled with.
struct Fields {
  std::map<std::string, std::string> texts;
  std::map<std::string, std::vector<Fields>> lists;
};

/// A page from its template, in the notation of Mustache: `{{name}}` is a text, escaped for HTML;
/// `{{{name}}}` a text as it is; what stands between `{{#name}}` and `{{/name}}` is repeated for
/// each entry of a list, whose fields come before those around it. Throws std::logic_error for a
/// name without a field.
std::string filled(std::string_view page, const Fields& fields);

/// Text as HTML shows it literally.
std::string escaped(std::string_view text);

}  // namespace subimpact
