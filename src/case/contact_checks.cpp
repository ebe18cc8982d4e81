#include "case/contact_checks.h"

#include <fmt/format.h>

#include "case/case_choices.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

constexpr const char* sphere_keys[] = {"contact.striker_modulus", "contact.striker_poisson",
                                       "contact.beam_poisson"};

bool is_given(const Case& input, const char* key) {
  return find_case_key(key)->get(input).has_value();
}

void refuse_unused(const Case& input, const char* key, const std::string& why) {
  if (!is_given(input, key)) return;
  throw InvalidCase(key, fmt::format("is given, but {}; leave it out, or choose another "
                                     "contact.law",
                                     why));
}

void require(const Case& input, const char* name, const char* remedy) {
  if (is_given(input, name)) return;
  const CaseKey& key = *find_case_key(name);
  throw InvalidCase(name, fmt::format("is missing, and contact.law = \"{}\" needs it: {}; allowed: "
                                      "{}; {}",
                                      name_of(input.scene.contact.kind), key.meaning,
                                      allowed_values(key), remedy));
}

}  // namespace

void check_contact(const Case& input) {
  switch (input.scene.contact.kind) {
    case ContactKind::foundation:
      require(input, "striker.nose_radius", "give it in m");
      refuse_unused(input, "contact.stiffness",
                    "\"foundation\" derives its stiffness from beam and striker.nose_radius");
      for (const char* key : sphere_keys) {
        refuse_unused(input, key, "\"foundation\" does not use it");
      }
      return;
    case ContactKind::linear:
      require(input, "contact.stiffness", "give it in N/m");
      for (const char* key : sphere_keys) refuse_unused(input, key, "\"linear\" does not use it");
      return;
    case ContactKind::hertz:
      if (is_given(input, "contact.stiffness")) {
        for (const char* key : sphere_keys) {
          refuse_unused(input, key, "contact.stiffness already says how stiff the contact is");
        }
        return;
      }
      constexpr const char* either =
          "give it, or contact.stiffness in N/m^1.5 in place of a sphere's radius, moduli and "
          "Poisson's ratios";
      require(input, "striker.nose_radius", either);
      for (const char* key : sphere_keys) require(input, key, either);
      return;
  }
}

}  // namespace subimpact
