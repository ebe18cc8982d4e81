#include "io/record.h"

namespace subimpact {
namespace {

const char* allowed_words(double value, Form form) {
  if (form == Form::plain || form == Form::zero_is_null) return nullptr;
  if (!std::isfinite(value)) return "a finite number";
  if (form == Form::from_zero && value < 0.0) return "a finite number, 0 or above";
  if (form == Form::above_zero && value <= 0.0) return "a finite number above 0";
  return nullptr;
}

}  // namespace

Json json_of(double value, Form form) {
  const bool is_null = !std::isfinite(value) || (form == Form::zero_is_null && value == 0.0);
  return is_null ? Json(nullptr) : Json(value);
}

void assign(double& value, const Json& json, const std::string& name, Form form) {
  const double if_null = form == Form::zero_is_null ? 0.0 : std::numeric_limits<double>::infinity();
  value = json.is_null() ? if_null : json.get<double>();
  if (const char* words = allowed_words(value, form)) {
    throw ResultsError(fmt::format("{} is {:.17g}; allowed: {}", name, value, words));
  }
}

Json json_of(const std::string& text, Form form) {
  return text.empty() && form == Form::empty_is_null ? Json(nullptr) : Json(text);
}

void assign(std::string& text, const Json& json, const std::string&, Form form) {
  text = json.is_null() && form == Form::empty_is_null ? "" : json.get<std::string>();
}

Json& place_in(Json& object, const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == name.npos ? object[name] : object[name.substr(0, dot)][name.substr(dot + 1)];
}

const Json& found_in(const Json& object, const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == name.npos ? object.at(name)
                          : object.at(name.substr(0, dot)).at(name.substr(dot + 1));
}

}  // namespace subimpact
