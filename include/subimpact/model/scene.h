#pragma once

/// The scene as plain data: a uniform rectangular beam, at rest, struck sideways by a rigid mass
/// with a round nose. SI units. Nothing here depends on discretisation or time stepping.

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

/// Uniform beam of rectangular section; small displacements.
struct Beam {
  double length = 0.0;          ///< l, m
  double width = 0.0;           ///< b, m
  double thickness = 0.0;       ///< h, m, in the direction of the strike
  double density = 0.0;         ///< rho, kg/m3
  double youngs_modulus = 0.0;  ///< E, Pa
  double yield_stress = std::numeric_limits<double>::infinity();  ///< Y, Pa; infinite: never yields
  BeamTheory theory = BeamTheory::rayleigh;
  std::optional<double> poisson = {};  ///< nu; needed by Timoshenko's theory
  /// k; by default Cowper's for a rectangle.
  std::optional<double> shear_coefficient = {};
  std::array<EndSupport, 2> ends{EndSupport::free, EndSupport::free};  ///< at x = 0 and x = l
  BeamDamping damping = {};

  double area() const { return width * thickness; }                               ///< A, m2
  double mass_per_length() const { return density * area(); }                     ///< rho A, kg/m
  double mass() const { return mass_per_length() * length; }                      ///< kg
  double second_moment() const { return area() * thickness * thickness / 12.0; }  ///< I, m4
  double bending_stiffness() const { return youngs_modulus * second_moment(); }   ///< E I, N m2
  double yield_curvature() const {
    return 2.0 * yield_stress / (youngs_modulus * thickness);
  }  ///< 1/m
  double yield_moment() const {
    return yield_stress * width * thickness * thickness / 6.0;
  }                                                                                  ///< N m
  double radius_of_gyration() const { return std::sqrt(second_moment() / area()); }  ///< r, m
  /// Whether nothing holds the beam, so that it conserves momentum.
  bool is_free() const { return ends[0] == EndSupport::free && ends[1] == EndSupport::free; }
  /// J = rho I (kg m), or zero in Euler-Bernoulli theory.
  double rotary_inertia() const {
    return theory == BeamTheory::euler_bernoulli ? 0.0 : density * second_moment();
  }
  bool shears() const { return theory == BeamTheory::timoshenko; }
  /// k, where nu is given: 10 (1 + nu)/(12 + 11 nu) unless set. Source: G. R. Cowper, The shear
  /// coefficient in Timoshenko's beam theory, J. Appl. Mech. 33 (1966).
  double used_shear_coefficient() const {
    const double nu = poisson.value_or(0.0);
    return shear_coefficient.value_or(10.0 * (1.0 + nu) / (12.0 + 11.0 * nu));
  }
  /// k G A (N), where nu is given.
  double shear_stiffness() const {
    const double shear_modulus = youngs_modulus / (2.0 * (1.0 + poisson.value_or(0.0)));
    return used_shear_coefficient() * shear_modulus * area();
  }
};

/// Rigid mass with a round nose, moving freely but for the contact force.
struct Striker {
  double mass = 0.0;                  ///< m, kg
  std::optional<double> nose_radius;  ///< R, m: of a cylinder across the beam's width under the law
                                      ///< `foundation`, of a sphere under `hertz`
  double velocity = 0.0;              ///< v0, m/s, towards the beam
  double position = 0.5;              ///< struck point as a fraction of the length
  double gap = 0.0;                   ///< m, between nose and beam at t = 0

  double first_touch() const { return gap > 0.0 ? gap / velocity : 0.0; }  ///< s
};

enum class ContactKind {
  foundation,  ///< elasto-plastic columns under a cylinder (see ContactLaw)
  hertz,       ///< F = K lambda^1.5, never yields
  linear,      ///< F = K lambda, never yields
};

/// The contact's own constants; `foundation` has none, its follow from beam and nose radius.
struct Contact {
  ContactKind kind = ContactKind::foundation;
  std::optional<double> stiffness;  ///< K: N/m^1.5 (hertz), N/m (linear)
  // Of a sphere on a flat surface of the beam's modulus, in place of a stiffness (hertz):
  std::optional<double> striker_modulus;  ///< E_s, Pa; infinite: rigid
  std::optional<double> striker_poisson;  ///< nu_s
  std::optional<double> beam_poisson;     ///< nu
  /// chi, s/m: F = K lambda^n (1 + chi lambda') (hertz, linear; Hunt and Crossley 1975)
  double damping = 0.0;
};

struct Scene {
  Beam beam;
  Striker striker;
  Contact contact;

  /// nu of the beam, which theory and contact share.
  std::optional<double> beam_poisson() const {
    return beam.poisson ? beam.poisson : contact.beam_poisson;
  }
};

}  // namespace subimpact
