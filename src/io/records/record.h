#pragma once

#include <fmt/format.h>

#include <functional>
#include <type_traits>

#include "case/keys/case_choices.h"
#include "io/records/values_of_keys.h"
#include "subimpact/io/read_results.h"

namespace subimpact {

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

/// Calls `use` with what a JSON file holds. Throws ResultsError with the file's path, what is wrong
/// (what `use` throws, or that the file is not `what`) and the remedy.
void read_json(const std::filesystem::path& path, const std::string& text, const char* what,
               const char* remedy, const std::function<void(const Json&)>& use);

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
inline Json json_of(const Reason& reason, Form) { return words_of(reason); }
inline void assign(Reason& reason, const Json& json, const std::string&, Form) {
  reason = {Reason::Kind::in_words, json.get<std::string>()};
}
inline Json json_of(const Interval& times, Form) { return {times.from, times.to}; }
inline void assign(Interval& times, const Json& json, const std::string& name, Form form) {
  assign(times.from, json.at(0), name, form);
  assign(times.to, json.at(1), name, form);
}
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

template <class Row>
struct Entry;
template <class Row>
using Record = std::vector<Entry<Row>>;

/// The object's place for a name, made if it is not there: a.b is the member b of the object a.
Json& place_in(Json& object, const std::string& name);
const Json& found_in(const Json& object, const std::string& name);

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
template <class Row>
void assign(const Record<Row>& record, const Json& object, Row& row) {
  for (const Entry<Row>& entry : record) {
    if (entry.read) entry.read(object, row);
  }
}
template <class Row>
void assign(const Record<Row>& record, const Json& list, std::vector<Row>& rows) {
  for (const Json& json : list) assign(record, json, rows.emplace_back());
}
template <class Row>
void assign(const Record<Row>& record, const Json& json, std::optional<Row>& row) {
  if (json.is_null()) return row.reset();
  if (!row) row = Row{};
  assign(record, json, *row);
}

/// A member of an object in a JSON file: written into the object, and read from it.
template <class Row>
struct Entry {
  Entry(const char* name_with_unit, const char* meaning_of_value)
      : name(name_with_unit), meaning(meaning_of_value) {}
  /// A value. `access`: a pointer to a member or a function of the row; it returns a reference to
  /// what the entry holds, or a value, which is then written and never read.
  template <class Access>
  Entry(const char* name_with_unit, const char* meaning_of_value, Access access,
        Form form = Form::plain)
      : Entry(name_with_unit, meaning_of_value) {
    write = [=, name = name](Json& object, const Row& row) {
      place_in(object, name) = json_of(std::invoke(access, row), form);
    };
    if constexpr (is_held<Access>) {
      read = [=, name = name](const Json& object, Row& row) {
        assign(std::invoke(access, row), found_in(object, name), name, form);
      };
    }
  }
  /// A value that is read in another way than it is written.
  template <class Access, std::invocable<const Json&, Row&> Use>
  Entry(const char* name_with_unit, const char* meaning_of_value, Access access, Use use)
      : Entry(name_with_unit, meaning_of_value, access) {
    read = [=, name = name](const Json& object, Row& row) { use(found_in(object, name), row); };
  }
  /// An object or null, or a list of objects: `access` leads to an optional or a vector. `use`
  /// reads it in another way.
  template <class Access, class Inner>
  Entry(const char* name_with_unit, const char* meaning_of_value, Access access,
        const Record<Inner>& record, void (*use)(const Json&, Row&) = nullptr)
      : Entry(name_with_unit, meaning_of_value) {
    using Held = std::remove_cvref_t<std::invoke_result_t<Access, const Row&>>;
    const bool is_list = std::is_same_v<Held, std::vector<Inner>>;
    parts = listing_of(record, name + (is_list ? "[]." : "."));
    write = [=, name = name](Json& object, const Row& row) {
      place_in(object, name) = json_of(record, std::invoke(access, row));
    };
    if (use != nullptr) {
      read = [=, name = name](const Json& object, Row& row) { use(found_in(object, name), row); };
    } else if constexpr (is_held<Access>) {
      read = [=, name = name](const Json& object, Row& row) {
        assign(record, found_in(object, name), std::invoke(access, row));
      };
    }
  }

  std::string name, meaning;
  std::function<void(Json& object, const Row& row)> write;
  std::function<void(const Json& object, Row& row)> read;  // none: it follows from other entries
  std::vector<std::pair<std::string, std::string>> parts = {};  // names and meanings within it

 private:
  template <class Access>
  static constexpr bool is_held = [] {
    if constexpr (!std::is_invocable_v<Access, Row&>) {
      return false;
    } else {
      using Held = std::invoke_result_t<Access, Row&>;
      return std::is_lvalue_reference_v<Held> && !std::is_const_v<std::remove_reference_t<Held>>;
    }
  }();
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
