#pragma once

#include <string>

namespace subimpact {

/// A case file with all required keys and nothing else; line 2 is beam.length.
inline std::string small_case_text() {
  return "[beam]\n"
         "length = 0.7112\n"
         "width = 0.0163\n"
         "thickness = 0.0075\n"
         "density = 2600\n"
         "youngs_modulus = 71.96e9\n"
         "[striker]\n"
         "mass = 0.201\n"
         "nose_radius = 0.01\n"
         "velocity = 15.9\n"
         "[time]\n"
         "end = 2e-5\n";
}

/// The same with one piece of its text replaced.
inline std::string small_case_with(const std::string& from, const std::string& to) {
  std::string text = small_case_text();
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace subimpact
