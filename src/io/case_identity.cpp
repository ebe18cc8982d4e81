#include "subimpact/io/case_identity.h"

#include <fmt/format.h>

#include <sstream>

#include "io/manifest.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/versions.h"
#include "subimpact/study/within.h"

namespace subimpact {

namespace {

constexpr std::size_t n_digits = 32;

}  // namespace

std::string case_identity(const Case& input, const GivenKeys& given, const std::string& how) {
  std::string text = project_version() + '\n';
  for (const CaseKey& key : case_keys()) {
    if (key.name == "title") continue;
    const auto value = key.get(input);
    text += key.name + '=' + (value ? to_text(*value) : std::string()) + '\n';
  }
  const OpenChoices open = open_choices(given);
  text +=
      fmt::format("open: {} {} {} {}\n{}", open.mesh, open.size, open.method, open.tolerance, how);
  std::istringstream stream(text);
  return seal_of(stream).sha256.substr(0, n_digits);
}

}  // namespace subimpact
