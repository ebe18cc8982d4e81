#pragma once

/// The scene as plain data: a uniform beam, at rest, struck sideways by a rigid mass with a round
/// nose. SI units. Nothing here depends on discretisation or time stepping.

#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace subimpact {

/// Rayleigh keeps the rotary inertia of the sections, Euler-Bernoulli leaves it out; Timoshenko
/// keeps it and lets sections shear, elastically.
enum class BeamTheory { rayleigh, euler_bernoulli, timoshenko };

enum class EndSupport {
  free,    ///< neither moment nor shear force
  pinned,  ///< neither displacement nor moment
  clamped  ///< neither displacement nor rotation
};

/// Damping of the beam. The force on the beam is -(mass Mass + stiffness K) v with the elastic
/// stiffness K (Rayleigh's damping): mode k, of frequency omega, has the damping ratio
/// mass/(2 omega) + stiffness omega/2. `ratio` adds the same damping ratio to all modes that bend.
struct BeamDamping {
  double ratio = 0.0;      ///< zeta, of critical
  double mass = 0.0;       ///< alpha, 1/s
  double stiffness = 0.0;  ///< beta, s

  bool is_none() const { return ratio == 0.0 && mass == 0.0 && stiffness == 0.0; }
};

enum class SectionShape {
  rectangle,  ///< height, width; or Beam::thickness and Beam::width
  circle,     ///< diameter
  tube,       ///< diameter (outer), wall
  box,        ///< height and width (outer), wall
  i           ///< height, width (of the flanges), flange and web (their thicknesses); strong axis
};

/// A cross-section by its dimensions (m): heights lie in the direction of the strike. Each shape is
/// one solid or the difference of two, outer less inner (the two gaps beside the web of an I count
/// as one): sums over them are exact.
struct CrossSection {
  SectionShape shape = SectionShape::rectangle;
  std::optional<double> height = {}, width = {}, diameter = {}, wall = {}, flange = {}, web = {};

  struct Solid {
    bool is_round;
    double height, width;  ///< both the diameter where it is round

    double area() const { return (is_round ? 0.25 * M_PI : 1.0) * width * height; }
    double second_moment() const {  ///< about the neutral axis
      return is_round ? area() * height * height / 16.0 : area() * height * height / 12.0;
    }
  };
};

/// Uniform beam; small displacements. The section is a rectangle of `width` and `thickness` unless
/// `section` gives dimensions.
struct Beam {
  double length = 0.0;          ///< l, m
  double width = 0.0;           ///< b, m; 0 where `section` gives the dimensions
  double thickness = 0.0;       ///< h, m, in the direction of the strike; likewise
  double density = 0.0;         ///< rho, kg/m3
  double youngs_modulus = 0.0;  ///< E, Pa
  double yield_stress = std::numeric_limits<double>::infinity();  ///< Y, Pa; infinite: never yields
  BeamTheory theory = BeamTheory::rayleigh;
  std::optional<double> poisson = {};  ///< nu; needed by Timoshenko's theory
  /// k; by default Cowper's for the shape of the section.
  std::optional<double> shear_coefficient = {};
  std::array<EndSupport, 2> ends{EndSupport::free, EndSupport::free};  ///< at x = 0 and x = l
  BeamDamping damping = {};
  CrossSection section = {};
  /// E_t/E of linear kinematic hardening: fibres that yield keep this share of their stiffness.
  double hardening = 0.0;

  CrossSection::Solid outer_solid() const;  ///< the section without its gaps
  CrossSection::Solid gap() const;          ///< what is taken out of it; of no area in solid ones
  /// Of the section in the direction of the strike, m.
  double height() const { return outer_solid().height; }
  bool is_round() const { return outer_solid().is_round; }

  double area() const { return outer_solid().area() - gap().area(); }  ///< A, m2
  double mass_per_length() const { return density * area(); }          ///< rho A, kg/m
  double mass() const { return mass_per_length() * length; }           ///< kg
  double second_moment() const {
    return outer_solid().second_moment() - gap().second_moment();
  }                                                                              ///< I, m4
  double bending_stiffness() const { return youngs_modulus * second_moment(); }  ///< E I, N m2
  double yield_curvature() const {
    return 2.0 * yield_stress / (youngs_modulus * height());
  }  ///< 1/m
  /// Y I/(h/2), N m: the moment at which the outermost fibre yields.
  double yield_moment() const;
  double radius_of_gyration() const { return std::sqrt(second_moment() / area()); }  ///< r, m
  /// Whether nothing holds the beam, so that it conserves momentum.
  bool is_free() const { return ends[0] == EndSupport::free && ends[1] == EndSupport::free; }
  /// J = rho I (kg m), or zero in Euler-Bernoulli theory.
  double rotary_inertia() const {
    return theory == BeamTheory::euler_bernoulli ? 0.0 : density * second_moment();
  }
  bool shears() const { return theory == BeamTheory::timoshenko; }
  /// k, where nu is given: that of the shape unless set (scene.cpp has the formulas). Source: G. R.
  /// Cowper, The shear coefficient in Timoshenko's beam theory, J. Appl. Mech. 33 (1966).
  double used_shear_coefficient() const;
  /// k G A (N), where nu is given.
  double shear_stiffness() const {
    const double shear_modulus = youngs_modulus / (2.0 * (1.0 + poisson.value_or(0.0)));
    return used_shear_coefficient() * shear_modulus * area();
  }
};

enum class NoseShape {
  sphere,
  cylinder  ///< its axis lies across the beam
};

/// Rigid mass with a round nose, moving freely but for the contact force.
struct Striker {
  double mass = 0.0;                  ///< m, kg
  std::optional<double> nose_radius;  ///< R, m
  double velocity = 0.0;              ///< v0, m/s, towards the beam
  double position = 0.5;              ///< struck point as a fraction of the length
  double gap = 0.0;                   ///< m, between nose and beam at t = 0
  /// By default that which the contact law is for: a cylinder for `foundation`, else a sphere.
  std::optional<NoseShape> nose = {};

  double first_touch() const { return gap > 0.0 ? gap / velocity : 0.0; }  ///< s
};

enum class ContactKind {
  foundation,  ///< elasto-plastic columns (see ContactLaw)
  hertz,       ///< F = K lambda^1.5, never yields
  linear,      ///< F = K lambda, never yields
  sphere,      ///< Hertz up to the yield pressure, Thornton's plastic contact beyond
};

/// The contact's own constants; `foundation` has none, its follow from beam and nose radius.
struct Contact {
  ContactKind kind = ContactKind::foundation;
  std::optional<double> stiffness;  ///< K: N/m^1.5 (hertz), N/m (linear)
  // Of the nose's body against the beam's surface (sphere; hertz in place of a stiffness):
  std::optional<double> striker_modulus;  ///< E_s, Pa; infinite: rigid
  std::optional<double> striker_poisson;  ///< nu_s
  std::optional<double> beam_poisson;     ///< nu
  /// chi, s/m: F = K lambda^n (1 + chi lambda') (hertz, linear; Hunt and Crossley 1975)
  double damping = 0.0;
  /// p_y, Pa: contact pressure at which the softer body yields (sphere); by default 1.6 Y.
  std::optional<double> yield_pressure = {};
};

struct Scene {
  Beam beam;
  Striker striker;
  Contact contact;

  /// nu of the beam, which theory and contact share.
  std::optional<double> beam_poisson() const {
    return beam.poisson ? beam.poisson : contact.beam_poisson;
  }
  NoseShape nose() const {
    return striker.nose.value_or(contact.kind == ContactKind::foundation ? NoseShape::cylinder
                                                                         : NoseShape::sphere);
  }
};

}  // namespace subimpact
