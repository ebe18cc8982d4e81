#pragma once

#include <cmath>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace subimpact {

/// Copies numbers into named lists, or back from them, in one order: a class names its members
/// once, in `void exchange(Snapshot& snapshot) { snapshot(a, b, c); }`, and is written and read by
/// that. Members are numbers, enumerations, optionals, arrays and vectors of these, and classes
/// with such a function. Reading throws std::runtime_error where numbers do not fit.
class Snapshot {
 public:
  using Lists = std::map<std::string, std::vector<double>>;

  static Snapshot writing(Lists& lists) { return Snapshot(lists, false); }
  /// The lists are not changed.
  static Snapshot reading(const Lists& lists) { return Snapshot(const_cast<Lists&>(lists), true); }

  bool reads() const { return reads_; }

  /// What follows stands in the list of this name.
  void begin(const std::string& name) {
    if (reads_) finish();
    if (reads_ && !lists_.contains(name)) throw std::runtime_error("it has no \"" + name + '"');
    list_ = &lists_[name];
    name_ = name;
    next_ = 0;
  }
  /// Throws if numbers of the last list are left.
  void finish() const {
    if (list_ != nullptr && next_ != list_->size()) fail();
  }

  template <class... Values>
  void operator()(Values&... values) {
    (pass(values), ...);
  }
  /// Throws unless `fits`.
  void require(bool fits) const {
    if (!fits) fail();
  }

 private:
  Snapshot(Lists& lists, bool reads) : lists_(lists), reads_(reads) {}

  [[noreturn]] void fail() const {
    throw std::runtime_error("its numbers of \"" + name_ + "\" do not fit");
  }

  template <class Value>
  void pass(Value& value) {
    if constexpr (std::is_arithmetic_v<Value> || std::is_enum_v<Value>) {
      pass_number(value);
    } else if constexpr (requires { value.emplace_back(); }) {
      std::size_t n = value.size();
      pass_number(n);
      if (reads_) {
        require(n <= list_->size() - next_);
        value.assign(n, {});
      }
      for (auto& one : value) pass(one);
    } else if constexpr (requires { value.has_value(); }) {
      bool is_there = value.has_value();
      pass_number(is_there);
      if (reads_ && !is_there) value.reset();
      if (reads_ && is_there) value.emplace();
      if (is_there) pass(*value);
    } else if constexpr (requires { value.begin(); }) {
      for (auto& one : value) pass(one);
    } else if constexpr (requires { value.exchange(*this); }) {
      value.exchange(*this);
    } else {
      exchange(*this, value);
    }
  }

  template <class Number>
  void pass_number(Number& number) {
    if (!reads_) {
      list_->push_back(static_cast<double>(number));
      return;
    }
    require(next_ < list_->size());
    const double value = (*list_)[next_++];
    if constexpr (!std::is_floating_point_v<Number>) {
      constexpr double most = 4503599627370496.0;  // whole numbers up to it are exact
      require(std::trunc(value) == value && std::abs(value) <= most);
      require(std::is_signed_v<Number> || value >= 0.0);
    }
    number = static_cast<Number>(value);
  }

  Lists& lists_;
  bool reads_;
  std::string name_;
  std::vector<double>* list_ = nullptr;
  std::size_t next_ = 0;
};

}  // namespace subimpact
