#include <fmt/format.h>

#include <sstream>

#include <nlohmann/json.hpp>

#include "io/sealed_files.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/case_file.h"
#include "subimpact/io/versions.h"
#include "subimpact/study/within.h"

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

std::string case_identity(const Case& input, const GivenKeys& given, const std::string& how) {
  constexpr std::size_t n_digits = 32;
  std::string text = project_version() + '\n';
  for (const CaseKey& key : case_keys()) {
    if (key.name == "title") continue;
    const auto value = key.get(input);
    text += key.name + '=' + (value ? to_text(*value) : std::string()) + '\n';
  }
  const OpenChoices open = open_choices(given);
  text +=
      fmt::format("open: {} {} {} {}\n{}", open.mesh, open.size, open.method, open.tolerance, how);
  std::istringstream stream(text);
  return seal_of(stream).sha256.substr(0, n_digits);
}

}  // namespace subimpact
