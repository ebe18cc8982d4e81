#pragma once

/// The scene as plain data: a uniform rectangular beam, at rest, struck sideways by a rigid mass
/// with a cylindrical nose. SI units. Nothing here knows about discretisation or time stepping.

#include <array>
#include <limits>

namespace subimpact {

/// Rayleigh keeps the rotary inertia of the sections, Euler-Bernoulli leaves it out.
enum class BeamTheory { rayleigh, euler_bernoulli };

/// Support of one end of the beam.
enum class EndSupport { free };

/// Uniform beam of rectangular section; no shear deformation, small displacements.
struct Beam {
  double length = 0.0;          ///< l, m
  double width = 0.0;           ///< b, m
  double thickness = 0.0;       ///< h, m, in the direction of the strike
  double density = 0.0;         ///< rho, kg/m3
  double youngs_modulus = 0.0;  ///< E, Pa
  double yield_stress = std::numeric_limits<double>::infinity();  ///< Y, Pa; infinite: never yields
  BeamTheory theory = BeamTheory::rayleigh;
  std::array<EndSupport, 2> ends{EndSupport::free, EndSupport::free};  ///< at x = 0 and x = l

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
  }                                   ///< N m
  double radius_of_gyration() const;  ///< r, m
  /// J = rho I (kg m), or zero in Euler-Bernoulli theory.
  double rotary_inertia() const {
    return theory == BeamTheory::rayleigh ? density * second_moment() : 0.0;
  }
};

/// Rigid mass with a cylindrical nose across the beam's width, moving freely but for the contact
/// force.
struct Striker {
  double mass = 0.0;         ///< m, kg
  double nose_radius = 0.0;  ///< R, m
  double velocity = 0.0;     ///< v0, m/s, towards the beam
  double position = 0.5;     ///< struck point as a fraction of the length
};

/// Which relation holds between contact force and indentation.
enum class ContactKind {
  foundation,  ///< elasto-plastic columns under a cylinder (see ContactLaw)
};

struct Contact {
  ContactKind kind = ContactKind::foundation;
};

struct Scene {
  Beam beam;
  Striker striker;
  Contact contact;
};

}  // namespace subimpact
