#pragma once

#include <string>
#include <vector>

#include "subimpact/model/scene.h"

namespace subimpact {

/// A strip of a section, of one width and material, the same above and below the neutral axis.
/// Distances are fractions of half the beam's thickness, other members fractions of the beam's
/// values.
struct FibreStrip {
  double from = 0.0;     ///< distance from the neutral axis, 0 to 1
  double to = 1.0;       ///< distance, above `from`
  double width = 1.0;    ///< over Beam::width
  double modulus = 1.0;  ///< over Beam::youngs_modulus
  double yield = 1.0;    ///< yield stress over Beam::yield_stress
};

/// The bending law of a section: the distribution of fibres over one half of the section.
///
/// A user-defined section is a list of strips (`strips`), assigned to `Case::parts.section`: any
/// section that is symmetric about its neutral axis, of elastic-perfectly plastic materials. The
/// sections of a case file use the same interface: `continuous`, the exact section, and `layered`,
/// p layers of equal thickness per half whose stress is taken at mid-layer.
///
/// Model (docs/theory/bending.md): every fibre is linear elastic-perfectly plastic, strains are
/// linear over the thickness. With the curvature x = kappa/kappa_y and the moment m = M/M_y in
/// units of the beam of one material, kappa_y = 2 Y/(E h) and M_y = 2 Y I/h, a fibre at the
/// distance z from the neutral axis, of modulus E_z and yield stress Y_z, yields at x = 1/zeta with
///
///     zeta = (2 z/h) (E_z/E) (Y/Y_z),   weight  w dzeta = (h^2 dA/(6 I)) (E/E_z) (Y_z/Y)^2,
/// dA the area on one side of the axis (zeta = 2 z/h and w = 1 for the rectangle). The law needs
/// only the cumulative moments of the distribution, S_i(zeta) = integral of w zeta^i from 0 to
/// zeta; unloading and reloading follow by Masing's rules. Hardening is one fibre at zeta = 0 with
/// h S_2, which never yields, and the others with weights times 1 - h. Mass and rotary inertia
/// remain those of Beam: choose its density so that the mass per length is that of the section.
/// Shear deformation is left out, so a core that is soft in shear is not covered.
class Fibres {
 public:
  struct Moments {
    double s0, s1, s2;
  };

  /// The fibres of a beam's section; by default of a rectangle.
  static Fibres continuous(const Beam& beam = {});
  /// `layers` over the whole thickness: even, at least 2; throws std::invalid_argument otherwise.
  static Fibres layered(int layers, const Beam& beam = {});
  /// A section made of strips, which may lie side by side at the same distance (their widths add
  /// up) or leave gaps. `name` is for summaries. Throws std::invalid_argument for no strips, for
  /// distances outside 0 to 1 and for a width, modulus or yield stress that is not positive and
  /// finite.
  static Fibres strips(std::vector<FibreStrip> strips, std::string name);

  /// The same fibres with linear kinematic hardening, 0 <= h < 1.
  Fibres hardened(double h) const;

  const std::string& name() const { return name_; }

  /// S_0, S_1, S_2 up to and including zeta >= 0 (constant above extent()).
  Moments up_to(double zeta) const;

  double slope() const { return slope_; }  ///< dm/dx while elastic
  /// Largest |m| without hardening, the shape factor: 3/2 for the rectangle.
  double shape_factor() const { return 3.0 * whole_.s1 / (1.0 - hardening_); }
  double hardening() const { return hardening_; }  ///< h
  /// slope() of the section that the fibres approximate: layers approximate the exact one.
  double represented_slope() const { return half_layers_ > 0.0 ? 1.0 : slope_; }
  double first_yield() const { return first_yield_; }  ///< x at which the first fibre yields
  double outermost() const { return outermost_; }      ///< zeta of the fibre farthest from the axis
  double extent() const { return extent_; }            ///< no fibre has a zeta above it
  /// Yield stress and modulus of the fibre farthest from the axis, over those of the beam.
  double outer_yield() const { return outer_yield_; }
  double outer_modulus() const { return outer_modulus_; }

  /// The virgin curve m(x), odd in x, and its integral from 0 to x.
  struct Response {
    double moment, work;
  };
  Response response(double x) const;
  double tangent(double x) const;  ///< dm/dx of the virgin curve

  /// Elastic energy, in units of M_y kappa_y per length, of the fibres from zeta `a` to `b` whose
  /// stress is (constant + slope * zeta) times their yield stress: 3/2 the integral of its square.
  double energy(double a, double b, double constant, double slope) const;

 private:
  // The fibres between two zeta: of constant weight; or, in a circle of the radius `to`, of a
  // weight that falls as its chords, from `weight` at 0.
  struct Band {
    double from, to, weight;
    bool is_round = false;
  };

  explicit Fibres(int half_layers);  // of a rectangle; 0: continuous
  Fibres(std::vector<Band> bands, double extent);
  Moments of_bands_up_to(double zeta) const;
  void tabulate_layers(const Fibres& exact);

  double half_layers_;       // 0: continuous; negative: bands
  std::vector<Band> bands_;  // else empty
  // Up to each layer; empty for a rectangle without hardening, which has closed forms.
  std::vector<Moments> of_layers_;
  double hardening_ = 0.0;
  double never_yields_ = 0.0;  // S_2 of the elastic fibre
  Moments whole_;
  double slope_;
  double first_yield_;
  double outermost_;
  double extent_ = 1.0;
  double outer_yield_ = 1.0;
  double outer_modulus_ = 1.0;
  std::string name_;
};

}  // namespace subimpact
