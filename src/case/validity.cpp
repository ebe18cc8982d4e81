#include "subimpact/case/validity.h"

#include <fmt/format.h>

#include <cmath>

namespace subimpact {
namespace {

constexpr double thickest_without_shear = 0.1;  // thickness over length
constexpr double thickest_with_shear = 1.0 / 3.0;
constexpr double largest_rotation = 0.1;     // rad
constexpr double largest_deflection = 0.5;   // over the thickness, of a beam held at both ends
constexpr double deepest_indentation = 0.1;  // over the nose radius
constexpr double highest_pressure = 1.6;     // over the yield stress

constexpr double mm = 1e3;

class Limits {
 public:
  Limits(const Case& input, const Result& result)
      : beam_(input.scene.beam),
        scene_(input.scene),
        is_rigid_(input.model.mesh == MeshKind::rigid),
        result_(result) {
    rotation();
    if (input.model.mesh != MeshKind::rigid) {
      thickness();
      stretching();
    }
    indentation();
    pressure();
  }

  std::vector<std::string> sentences() { return std::move(sentences_); }

 private:
  template <class... Values>
  void add(fmt::format_string<const Values&...> text, const Values&... values) {
    sentences_.push_back(fmt::format(text, values...));
  }

  void thickness() {
    const double ratio = beam_.thickness / beam_.length;
    if (beam_.shears() && ratio > thickest_with_shear) {
      add("the beam's thickness is {:.2g} of its length: plane sections, as in every beam theory, "
          "do not describe so thick a body",
          ratio);
    } else if (!beam_.shears() && ratio > thickest_without_shear) {
      add("the beam's thickness is {:.2g} of its length, and its theory leaves out shear; use "
          "beam.theory = \"timoshenko\"",
          ratio);
    }
  }

  void rotation() {
    if (!(result_.largest_rotation > largest_rotation)) return;
    add("{} by up to {:.2g} rad: the model is for small rotations (below {} rad)",
        is_rigid_ ? "the beam turns" : "sections turn", result_.largest_rotation, largest_rotation);
  }

  void stretching() {
    const bool is_held = beam_.ends[0] != EndSupport::free && beam_.ends[1] != EndSupport::free;
    const double ratio = result_.largest_displacement / beam_.thickness;
    if (!is_held || !(ratio > largest_deflection)) return;
    add("the struck point moves by {:.3g} mm, {:.2g} of the thickness, on a beam held at both "
        "ends: "
        "if its supports cannot approach each other, stretching, which the model leaves out, "
        "stiffens it",
        mm * result_.largest_displacement, ratio);
  }

  void indentation() {
    if (!scene_.striker.nose_radius) return;
    const double ratio = result_.max_indentation / *scene_.striker.nose_radius;
    if (!(ratio > deepest_indentation)) return;
    add("the indentation reaches {:.3g} mm, {:.2g} of the nose radius: contact laws are for small "
        "indentations (below {} of it)",
        mm * result_.max_indentation, ratio, deepest_indentation);
  }

  void pressure() {
    if (scene_.contact.kind != ContactKind::hertz || !scene_.striker.nose_radius) return;
    const double area = M_PI * *scene_.striker.nose_radius * result_.max_indentation;
    const double pressure = 1.5 * result_.max_force / area;
    if (!(pressure > highest_pressure * beam_.yield_stress)) return;
    add("the contact pressure reaches {:.3g} MPa, {:.2g} times the beam's yield stress: a Hertz "
        "contact yields from {} times on, and contact.law = \"hertz\" leaves that out",
        1e-6 * pressure, pressure / beam_.yield_stress, highest_pressure);
  }

  const Beam& beam_;
  const Scene& scene_;
  bool is_rigid_;
  const Result& result_;
  std::vector<std::string> sentences_;
};

}  // namespace

std::vector<std::string> beyond_the_model(const Case& input, const Result& result) {
  return Limits(input, result).sentences();
}

}  // namespace subimpact
