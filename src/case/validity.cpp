#include "subimpact/case/validity.h"

#include <fmt/format.h>

#include <cmath>

#include "numerics/units.h"

namespace subimpact {
namespace {

constexpr double thickest_without_shear = 0.1;  // thickness over length
constexpr double thickest_with_shear = 1.0 / 3.0;
constexpr double largest_rotation = 0.1;     // rad
constexpr double largest_deflection = 0.5;   // over the thickness, of a beam held at both ends
constexpr double deepest_indentation = 0.1;  // over the nose radius
constexpr double highest_pressure = 1.6;     // over the yield stress

bool is_held(const Beam& beam) {
  return beam.ends[0] != EndSupport::free && beam.ends[1] != EndSupport::free;
}

}  // namespace

std::vector<std::string> beyond_the_model(const Case& input, const Result& result) {
  const Beam& beam = input.scene.beam;
  const std::optional<double>& nose = input.scene.striker.nose_radius;
  const bool is_rigid = input.model.mesh == MeshKind::rigid;
  const double indentation = result.max_indentation, set = result.largest_displacement;
  std::vector<std::string> sentences;
  const auto add = [&]<class... Values>(bool beyond, fmt::format_string<const Values&...> text,
                                        const Values&... values) {
    if (beyond) sentences.push_back(fmt::format(text, values...));
  };
  add(result.largest_rotation > largest_rotation,
      "{} by up to {:.2g} rad: the model is for small rotations (below {} rad)",
      is_rigid ? "the beam turns" : "sections turn", result.largest_rotation, largest_rotation);
  const double thickness = beam.thickness / beam.length;
  add(!is_rigid && beam.shears() && thickness > thickest_with_shear,
      "the beam's thickness is {:.2g} of its length: plane sections, as in every beam theory, do "
      "not describe so thick a body",
      thickness);
  add(!is_rigid && !beam.shears() && thickness > thickest_without_shear,
      "the beam's thickness is {:.2g} of its length, and its theory leaves out shear; use "
      "beam.theory = \"timoshenko\"",
      thickness);
  add(!is_rigid && is_held(beam) && set / beam.thickness > largest_deflection,
      "the struck point moves by {:.3g} mm, {:.2g} of the thickness, on a beam held at both ends: "
      "if its supports cannot approach each other, stretching, which the model leaves out, "
      "stiffens it",
      mm * set, set / beam.thickness);
  if (!nose) return sentences;
  add(indentation / *nose > deepest_indentation,
      "the indentation reaches {:.3g} mm, {:.2g} of the nose radius: contact laws are for small "
      "indentations (below {} of it)",
      mm * indentation, indentation / *nose, deepest_indentation);
  const double pressure = 1.5 * result.max_force / (M_PI * *nose * indentation);
  add(input.scene.contact.kind == ContactKind::hertz &&
          pressure > highest_pressure * beam.yield_stress,
      "the contact pressure reaches {:.3g} MPa, {:.2g} times the beam's yield stress: a Hertz "
      "contact yields from {} times on, and contact.law = \"hertz\" leaves that out",
      MPa * pressure, pressure / beam.yield_stress, highest_pressure);
  return sentences;
}

}  // namespace subimpact
