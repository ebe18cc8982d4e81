#include <string>
#include <vector>

#include "io/printable.h"
#include "subimpact/io/case_file.h"
#include "targets.h"

namespace subimpact::fuzz {

void case_text(Bytes bytes) {
  const std::string all(bytes.begin(), bytes.end());
  const std::size_t end = std::min(all.find('\0'), all.size());
  try {
    std::vector<Override> settings;
    for (std::size_t start = end + 1; start < all.size();) {
      const std::size_t next = std::min(all.find('\0', start), all.size());
      settings.push_back(parse_override(all.substr(start, next - start)));
      start = next + 1;
    }
    printable(read_case_text(all.substr(0, end), "case.toml", settings).value.title);
  } catch (const CaseFileError& error) {
    printable(error.what());
  }
}

}  // namespace subimpact::fuzz
