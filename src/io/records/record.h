#pragma once

#include <fmt/format.h>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <type_traits>

#include "case/keys/case_choices.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {

using Json = nlohmann::ordered_json;  // readers see members in the order written

/// A value of a key: a number, a text, a list; things at points are a list of objects.
Json json_of(const KeyValue& value);
/// Its inverse, also for what a case file holds. Nothing if no key can hold it (a mixed list).
std::optional<KeyValue> key_value_of(const CaseKey& key, const Json& json);

/// The integer that a JSON value holds. Throws std::out_of_range for 1e300, 0.5 or -1 where they do
/// not fit: their conversion is undefined.
template <class Int>
Int integer(const nlohmann::json& json) {
  if (json.is_number_unsigned()) {
    const auto value = json.get<std::uint64_t>();
    if (std::in_range<Int>(value)) return static_cast<Int>(value);
  } else if (json.is_number_integer()) {
    const auto value = json.get<std::int64_t>();
    if (std::in_range<Int>(value)) return static_cast<Int>(value);
  }
  throw std::out_of_range(fmt::format("{} is not an integer that fits", json.dump()));
}

/// How a member stands in a file where this is not plain.
enum class Form {
  plain,          ///< a number that is not finite is null
  zero_is_null,   ///< null: does not apply, held as 0
  empty_is_null,  ///< null: no text
  from_one        ///< an index, held from 0 and written from 1
};

// A function for each type that a record may hold.
Json json_of(double value, Form form);
Json json_of(const std::string& text, Form form);
inline Json json_of(const Reason& reason, Form) { return words_of(reason); }
inline Json json_of(const Interval& times, Form) { return {times.from, times.to}; }
inline Json json_of(bool value, Form) { return value; }
inline Json json_of(const std::vector<std::string>& texts, Form) { return texts; }
inline Json json_of(const Json& json, Form) { return json; }

template <std::integral Int>
Json json_of(Int value, Form form) {
  return form == Form::from_one ? value + 1 : value;
}
template <class Enum>
requires std::is_enum_v<Enum> Json json_of(Enum value, Form) {
  if constexpr (requires { to_string(value); }) {
    return std::string(to_string(value));
  } else {
    return name_of(value);
  }
}
template <class Value>
Json json_of(const std::optional<Value>& value, Form form) {
  return value ? json_of(*value, form) : Json(nullptr);
}

template <class Row>
struct Entry;
template <class Row>
using Record = std::vector<Entry<Row>>;

/// The object's place for a name, made if it is not there: a.b is the member b of the object a.
Json& place_in(Json& object, const std::string& name);

template <class Row>
Json json_of(const Record<Row>& record, const Row& row) {
  Json object;
  for (const Entry<Row>& entry : record) entry.write(object, row);
  return object;
}
template <class Row>
Json json_of(const Record<Row>& record, const std::vector<Row>& rows) {
  Json list = Json::array();
  for (const Row& row : rows) list.push_back(json_of(record, row));
  return list;
}
template <class Row>
Json json_of(const Record<Row>& record, const std::optional<Row>& row) {
  return row ? json_of(record, *row) : Json(nullptr);
}

/// A member of an object in a JSON file, as it is written.
template <class Row>
struct Entry {
  Entry(const char* name_with_unit, const char* meaning_of_value)
      : name(name_with_unit), meaning(meaning_of_value) {}
  /// A value. `access`: a pointer to a member or a function of the row.
  template <class Access>
  Entry(const char* name_with_unit, const char* meaning_of_value, Access access,
        Form form = Form::plain)
      : Entry(name_with_unit, meaning_of_value) {
    write = [=, name = name](Json& object, const Row& row) {
      place_in(object, name) = json_of(std::invoke(access, row), form);
    };
  }
  /// An object or null, or a list of objects: `access` leads to a row, an optional or a vector.
  template <class Access, class Inner>
  Entry(const char* name_with_unit, const char* meaning_of_value, Access access,
        const Record<Inner>& record)
      : Entry(name_with_unit, meaning_of_value) {
    using Held = std::remove_cvref_t<std::invoke_result_t<Access, const Row&>>;
    const bool is_list = std::is_same_v<Held, std::vector<Inner>>;
    parts = listing_of(record, name + (is_list ? "[]." : "."));
    write = [=, name = name](Json& object, const Row& row) {
      place_in(object, name) = json_of(record, std::invoke(access, row));
    };
  }

  std::string name, meaning;
  std::function<void(Json& object, const Row& row)> write;
  std::vector<std::pair<std::string, std::string>> parts = {};  // names and meanings within it
};

/// Names and meanings of all that a record holds.
template <class Row>
std::vector<std::pair<std::string, std::string>> listing_of(const Record<Row>& record,
                                                            const std::string& prefix = {}) {
  std::vector<std::pair<std::string, std::string>> list;
  for (const Entry<Row>& entry : record) {
    if (!entry.meaning.empty()) list.emplace_back(prefix + entry.name, entry.meaning);
    for (const auto& [name, meaning] : entry.parts) list.emplace_back(prefix + name, meaning);
  }
  return list;
}

}  // namespace subimpact
