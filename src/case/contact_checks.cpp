#include "case/contact_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

// The keys of which a law may be given more than it uses. The nose's radius describes the striker,
// whether or not the law depends on it.
constexpr const char* keys_of_contact[] = {"contact.stiffness", "contact.striker_modulus",
                                           "contact.striker_poisson", "contact.beam_poisson"};

bool is_given(const Case& input, const char* key) {
  return find_case_key(key)->get(input).has_value();
}

// Under its own name or another one.
bool is_known(const Case& input, std::string_view key) {
  if (key == "contact.beam_poisson" && input.scene.beam.poisson) return true;
  return is_given(input, key.data());
}

void require(const Case& input, const BuiltInContactLaw& law, const char* name,
             const char* remedy) {
  if (is_known(input, name)) return;
  const CaseKey& key = *find_case_key(name);
  throw InvalidCase(name, fmt::format("is missing, and contact.law = \"{}\" needs it: {}; allowed: "
                                      "{}; {}",
                                      law.name, key.meaning, allowed_values(key), remedy));
}

void refuse(const Case& input, const char* key, const char* why) {
  if (!is_given(input, key)) return;
  throw InvalidCase(key, fmt::format("is given, but {}; leave it out, or choose another "
                                     "contact.law",
                                     why));
}

}  // namespace

const ContactConstants& constants_given(const Case& input, const BuiltInContactLaw& law) {
  for (const ContactConstants& way : law.ways) {
    const bool complete = std::all_of(way.keys.begin(), way.keys.end(),
                                      [&](const char* key) { return is_known(input, key); });
    if (complete) return way;
  }
  return law.ways.back();
}

bool uses_key(const ContactConstants& way, const char* key) {
  return std::any_of(way.keys.begin(), way.keys.end(),
                     [&](const char* used) { return std::string_view(used) == key; });
}

void check_contact(const Case& input) {
  if (input.parts.contact_law) return;
  const BuiltInContactLaw& law = built_in_contact_law(input.scene.contact.kind);
  const ContactConstants& way = constants_given(input, law);
  for (const char* key : way.keys) require(input, law, key, way.remedy);
  for (const char* key : keys_of_contact) {
    if (!uses_key(way, key)) refuse(input, key, way.why_unused);
  }
}

}  // namespace subimpact
