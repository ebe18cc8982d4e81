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

// Whether a character, or a byte that is none, is shown as it is.
bool is_plain(std::string_view character) {
  const unsigned first = byte_at(character, 0);
  if (character.size() == 2) return first != 0xc2 || byte_at(character, 1) >= 0xa0;
  return character.size() > 2 || (first >= 0x20 && first < 0x7f) || first == '\n' || first == '\t';
}

}  // namespace

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const auto character = text.substr(0, std::max<std::size_t>(1, utf8_length(text)));
    text.remove_prefix(character.size());
    if (is_plain(character)) {
      result += character;
      continue;
    }
    for (const char byte : character) {
      fmt::format_to(std::back_inserter(result), "\\x{:02x}", static_cast<unsigned char>(byte));
    }
  }
  return result;
}

}  // namespace subimpact
