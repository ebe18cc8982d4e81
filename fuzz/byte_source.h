#pragma once

#include <cstddef>
#include <iterator>

#include "targets.h"

namespace subimpact::fuzz {

/// Choices read off the input; zeros when it has ended.
class ByteSource {
 public:
  explicit ByteSource(Bytes bytes) : bytes_(bytes) {}

  bool at_end() const { return at_ >= bytes_.size(); }
  std::size_t byte() { return at_end() ? 0 : bytes_[at_++]; }
  std::size_t below(std::size_t n) {
    const std::size_t high = byte();
    return (256 * high + byte()) % n;
  }
  template <class List>
  const auto& one_of(const List& list) {
    return *std::next(std::begin(list), static_cast<std::ptrdiff_t>(below(std::size(list))));
  }

 private:
  Bytes bytes_;
  std::size_t at_ = 0;
};

}  // namespace subimpact::fuzz
