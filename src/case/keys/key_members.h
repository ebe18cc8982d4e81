#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "case/keys/case_choices.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {

/// How a member of a case of each type is a value of a key, and back.
template <class T>
struct Member {  // an enumeration
  static constexpr KeyType type = KeyType::choice;
  using Choices = T;
  static KeyValue to_value(T x) { return std::string(name_of(x)); }
  static T from_value(const KeyValue& v) { return value_of<T>(std::get<std::string>(v)); }
};
template <class T, KeyType key_type>
struct HeldMember {
  static constexpr KeyType type = key_type;
  static KeyValue to_value(const T& x) { return x; }
  static T from_value(const KeyValue& v) { return std::get<T>(v); }
};
template <>
struct Member<bool> : HeldMember<bool, KeyType::flag> {};
template <>
struct Member<std::string> : HeldMember<std::string, KeyType::text> {};
template <>
struct Member<double> : HeldMember<double, KeyType::number> {
  static double from_value(const KeyValue& v) {
    if (const auto* whole = std::get_if<std::int64_t>(&v)) return static_cast<double>(*whole);
    return std::get<double>(v);
  }
};
template <>
struct Member<int> {
  static constexpr KeyType type = KeyType::count;
  static KeyValue to_value(int x) { return std::int64_t{x}; }
  static int from_value(const KeyValue& v) { return static_cast<int>(std::get<std::int64_t>(v)); }
};
template <>
struct Member<std::vector<double>> : HeldMember<std::vector<double>, KeyType::numbers> {
  static std::vector<double> from_value(const KeyValue& v) {
    // An empty list in a case file has no element type.
    const auto* numbers = std::get_if<std::vector<double>>(&v);
    return numbers != nullptr ? *numbers : std::vector<double>{};
  }
};
template <class T>
struct Member<std::array<T, 2>> {
  static constexpr KeyType type = KeyType::pair;
  using Choices = T;
  static KeyValue to_value(const std::array<T, 2>& x) {
    return std::vector<std::string>{name_of(x[0]), name_of(x[1])};
  }
  static std::array<T, 2> from_value(const KeyValue& v) {
    const auto& names = std::get<std::vector<std::string>>(v);
    return {value_of<T>(names[0]), value_of<T>(names[1])};
  }
};

// Things at points, each as an entry of a list and back.
using Entry = PlacedValues::Entry;
inline Entry entry_of(const Spring& x) {
  return {x.position, {{0.0, x.stiffness}}, {}, false, x.one_sided};
}
inline Entry entry_of(const PointForce& x) { return {x.position, x.table}; }
inline Entry entry_of(const Gauge& x) { return {x.position, {}, name_of(x.face)}; }
inline void read(const Entry& entry, Spring& x) {
  x = {entry.position, entry.table.front().second, entry.one_sided};
}
inline void read(const Entry& entry, PointForce& x) { x = {entry.position, entry.table}; }
inline void read(const Entry& entry, Gauge& x) { x = {entry.position, value_of<Face>(entry.word)}; }

inline const char* quantity_of(const Spring&) { return "stiffness"; }
inline const char* quantity_of(const PointForce&) { return "force"; }
inline const char* quantity_of(const Gauge&) { return "face"; }

template <class T>
struct PlacedMember {
  static constexpr KeyType type = KeyType::placed;
  static KeyValue to_value(const std::vector<T>& x) {
    PlacedValues value{quantity_of(T{}), {}};
    for (const T& one : x) value.entries.push_back(entry_of(one));
    return value;
  }
  static std::vector<T> from_value(const KeyValue& v) {
    std::vector<T> things;
    for (const Entry& entry : std::get<PlacedValues>(v).entries) read(entry, things.emplace_back());
    return things;
  }
};
template <>
struct Member<std::vector<Spring>> : PlacedMember<Spring> {};
template <>
struct Member<std::vector<PointForce>> : PlacedMember<PointForce> {};
template <>
struct Member<std::vector<Gauge>> : PlacedMember<Gauge> {
  using Choices = Face;
};

}  // namespace subimpact
