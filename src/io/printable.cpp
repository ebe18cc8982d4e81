#include "io/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace subimpact {
namespace {

unsigned byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

// Bytes of the well-formed UTF-8 sequence at the start of the text (Unicode, table 3-7); 0: none.
std::size_t utf8_length(std::string_view text) {
  const unsigned first = byte_at(text, 0);
  if (first < 0x80) return 1;
  const std::size_t n = first < 0xc2   ? 0
                        : first < 0xe0 ? 2
                        : first < 0xf0 ? 3
                        : first < 0xf5 ? 4
                                       : 0;
  if (n == 0 || text.size() < n) return 0;
  const unsigned low = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
  const unsigned high = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
  if (byte_at(text, 1) < low || byte_at(text, 1) > high) return 0;
  for (std::size_t i = 2; i < n; ++i) {
    if ((byte_at(text, i) & 0xc0) != 0x80) return 0;
  }
  return n;
}

// Of characters that are not plain.
bool is_control(std::string_view character) {
  if (character.size() == 2) return byte_at(character, 0) == 0xc2 && byte_at(character, 1) < 0xa0;
  return character.size() == 1;
}

// Characters at the start of the text that are ASCII and no control characters.
std::size_t plain_length(std::string_view text) {
  const auto is_plain = [](char c) { return (c >= 0x20 && c < 0x7f) || c == '\n' || c == '\t'; };
  return static_cast<std::size_t>(
      std::distance(text.begin(), std::find_if_not(text.begin(), text.end(), is_plain)));
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  for (;;) {
    const std::size_t n_plain = plain_length(text);
    result += text.substr(0, n_plain);
    text.remove_prefix(n_plain);
    if (text.empty()) return result;
    const std::size_t n = utf8_length(text);
    const std::string_view character = text.substr(0, n == 0 ? 1 : n);
    if (n > 0 && !is_control(character)) {
      result += character;
    } else {
      for (std::size_t i = 0; i < character.size(); ++i) {
        fmt::format_to(std::back_inserter(result), "\\x{:02x}", byte_at(character, i));
      }
    }
    text.remove_prefix(character.size());
  }
}

}  // namespace subimpact
