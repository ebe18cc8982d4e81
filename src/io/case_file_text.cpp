#include <fmt/format.h>

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"

namespace subimpact {
namespace {

// A text as TOML writes it on one line; JSON escapes the same way, but for DEL.
std::string toml_text(const std::string& text) {
  std::string result;
  for (const char c :
       nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)) {
    result += c == '\x7f' ? std::string("\\u007f") : std::string(1, c);
  }
  return result;
}

bool is_empty_list(const KeyValue& value) {
  const auto* numbers = std::get_if<std::vector<double>>(&value);
  return numbers != nullptr && numbers->empty();
}

}  // namespace

std::string case_file_text(const Case& input) {
  std::string text, table;
  for (const CaseKey& key : case_keys()) {
    const std::optional<KeyValue> value = key.get(input);
    if (!value || is_empty_list(*value)) continue;
    if (key.table() != table) {
      table = key.table();
      text += fmt::format("{}[{}]\n", text.empty() ? "" : "\n", table);
    }
    const auto* words = std::get_if<std::string>(&*value);
    text += fmt::format("{} = {}{}\n", key.leaf(), words ? toml_text(*words) : to_text(*value),
                        key.unit.empty() ? "" : "  # " + key.unit);
  }
  return text;
}

}  // namespace subimpact
