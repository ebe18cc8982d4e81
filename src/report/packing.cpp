#include "report/packing.h"

#include <algorithm>
#include <cmath>

namespace subimpact {

std::string base64(std::string_view bytes) {
  static constexpr char digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(4 * (bytes.size() / 3 + 1));
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text.push_back(k <= n ? digits[group >> (18 - 6 * k) & 63u] : '=');
    }
  }
  return text;
}

Json packed_i24(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double x : values) largest = std::max(largest, std::abs(x));
  const double step = largest > 0.0 ? largest / 8388607.0 : 1.0;
  std::string bytes;
  bytes.reserve(3 * values.size());
  for (const double x : values) {
    const auto n = static_cast<unsigned>(static_cast<int>(std::lround(x / step)));
    for (const unsigned shift : {0u, 8u, 16u}) bytes.push_back(static_cast<char>(n >> shift));
  }
  return {{"i24", base64(bytes)}, {"step", step}};
}

}  // namespace subimpact
