#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "case/case_choices.h"
#include "subimpact/io/read_results.h"

namespace subimpact {

using Json = nlohmann::ordered_json;  // readers see members in the order written

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

/// How a member stands in a file where this is not plain, and which values are allowed.
enum class Form {
  plain,          ///< a number that is not finite is null, and null is read as infinity
  finite,         ///< a number that must be finite
  from_zero,      ///< finite, 0 or above
  above_zero,     ///< finite and above 0
  zero_is_null,   ///< null: does not apply, held as 0
  empty_is_null,  ///< null: no text
  from_one        ///< an index, held from 0 and written from 1
};

// One pair of functions for each type that a record may hold; `name` is for messages.
Json json_of(double value, Form form);
void assign(double& value, const Json& json, const std::string& name, Form form);
Json json_of(const std::string& text, Form form);
void assign(std::string& text, const Json& json, const std::string& name, Form form);
inline Json json_of(bool value, Form) { return value; }
inline void assign(bool& value, const Json& json, const std::string&, Form) {
  value = json.get<bool>();
}
inline Json json_of(const std::vector<std::string>& texts, Form) { return texts; }
inline void assign(std::vector<std::string>& texts, const Json& json, const std::string&, Form) {
  texts = json.get<std::vector<std::string>>();
}
inline Json json_of(const Json& json, Form) { return json; }

template <std::integral Int>
Json json_of(Int value, Form form) {
  return form == Form::from_one ? value + 1 : value;
}
template <std::integral Int>
void assign(Int& value, const Json& json, const std::string&, Form form) {
  value = integer<Int>(json);
  if (form == Form::from_one) --value;
}

template <class Enum>
requires std::is_enum_v<Enum> Json json_of(Enum value, Form) { return name_of(value); }
template <class Enum>
requires std::is_enum_v<Enum>
void assign(Enum& value, const Json& json, const std::string&, Form) {
  value = value_of<Enum>(json.get<std::string>());
}

template <class Value>
Json json_of(const std::optional<Value>& value, Form form) {
  return value ? json_of(*value, form) : Json(nullptr);
}
template <class Value>
void assign(std::optional<Value>& value, const Json& json, const std::string& name, Form form) {
  value.reset();
  if (!json.is_null()) assign(value.emplace(), json, name, form);
}

/// A member of an object in a JSON file: written into the object, and read from it.
template <class Row>
struct Entry {
  Entry(std::string name_with_unit, std::string meaning_of_value)
      : name(std::move(name_with_unit)), meaning(std::move(meaning_of_value)) {}

  /// A value. `access`: a pointer to a member or a function of the row; it returns a reference to
  /// what the entry holds, or a value, which is then written and never read. A name of the form
  /// a.b is the member b of the object a.
  template <class Access>
  Entry(std::string name_with_unit, std::string meaning_of_value, Access access,
        Form form = Form::plain)
      : Entry(std::move(name_with_unit), std::move(meaning_of_value)) {
    write = [=, name = name](Json& object, const Row& row) {
      place_in(object, name) = json_of(std::invoke(access, row), form);
    };
    if constexpr (std::is_invocable_v<Access, Row&>) {
      using Held = std::invoke_result_t<Access, Row&>;
      if constexpr (std::is_lvalue_reference_v<Held> &&
                    !std::is_const_v<std::remove_reference_t<Held>>) {
        read = [=, name = name](const Json& object, Row& row) {
          assign(std::invoke(access, row), found_in(object, name), name, form);
        };
      }
    }
  }

  /// The object's place for a name, made if it is not there.
  static Json& place_in(Json& object, const std::string& name) {
    const std::size_t dot = name.rfind('.');
    return dot == name.npos ? object[name] : object[name.substr(0, dot)][name.substr(dot + 1)];
  }
  static const Json& found_in(const Json& object, const std::string& name) {
    const std::size_t dot = name.rfind('.');
    return dot == name.npos ? object.at(name)
                            : object.at(name.substr(0, dot)).at(name.substr(dot + 1));
  }

  std::string name, meaning;
  std::function<void(Json& object, const Row& row)> write;
  std::function<void(const Json& object, Row& row)> read;  // none: it follows from other entries
  std::vector<std::pair<std::string, std::string>> parts = {};  // names and meanings within it
};

template <class Row>
using Record = std::vector<Entry<Row>>;

template <class Row>
Json json_of(const Record<Row>& record, const Row& row) {
  Json object;
  for (const Entry<Row>& entry : record) entry.write(object, row);
  return object;
}

template <class Row>
void assign(const Record<Row>& record, const Json& object, Row& row) {
  for (const Entry<Row>& entry : record) {
    if (entry.read) entry.read(object, row);
  }
}

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

/// A list of objects: `access` returns a vector by reference, or a value, which is never read.
template <class Row, class Access, class Inner>
Entry<Row> list_entry(const std::string& name, const std::string& meaning, Access access,
                      const Record<Inner>& record) {
  Entry<Row> entry(name, meaning);
  entry.parts = listing_of(record, name + "[].");
  entry.write = [=](Json& object, const Row& row) {
    Json list = Json::array();
    for (const Inner& inner : std::invoke(access, row)) list.push_back(json_of(record, inner));
    Entry<Row>::place_in(object, name) = std::move(list);
  };
  if constexpr (std::is_lvalue_reference_v<std::invoke_result_t<Access, Row&>>) {
    entry.read = [=](const Json& object, Row& row) {
      for (const Json& json : Entry<Row>::found_in(object, name)) {
        assign(record, json, std::invoke(access, row).emplace_back());
      }
    };
  }
  return entry;
}

/// An object or null: `access` returns a std::optional, by reference or as a value.
template <class Row, class Access, class Inner>
Entry<Row> object_entry(const std::string& name, const std::string& meaning, Access access,
                        const Record<Inner>& record) {
  Entry<Row> entry(name, meaning);
  entry.parts = listing_of(record, name + ".");
  entry.write = [=](Json& object, const Row& row) {
    const auto& inner = std::invoke(access, row);
    object[name] = inner ? json_of(record, *inner) : Json(nullptr);
  };
  if constexpr (std::is_lvalue_reference_v<std::invoke_result_t<Access, Row&>>) {
    entry.read = [=](const Json& object, Row& row) {
      const Json& json = object.at(name);
      auto& inner = std::invoke(access, row);
      if (json.is_null()) return inner.reset();
      if (!inner) inner.emplace();
      assign(record, json, *inner);
    };
  }
  return entry;
}

}  // namespace subimpact
