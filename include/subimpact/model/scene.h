#pragma once

/// The scene as plain data: a uniform beam, at rest, struck sideways by a rigid mass with a round
/// nose. SI units. Nothing here depends on discretisation or time stepping.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace subimpact {

/// Rayleigh keeps the rotary inertia of the sections, Euler-Bernoulli leaves it out; Timoshenko
/// keeps it and lets sections shear, elastically.
enum class BeamTheory { rayleigh, euler_bernoulli, timoshenko };

enum class EndSupport {
  free,    ///< neither moment nor shear force
  pinned,  ///< neither displacement nor moment
  clamped  ///< neither displacement nor rotation
};

/// Whether the ends of a beam may approach each other along it.
enum class AxialEnds {
  free,  ///< the beam keeps its length: no tension
  held   ///< they keep their distance: the beam stretches as it bends (Tension)
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

/// A force on one point of the beam, positive along the strike.
struct PointForce {
  double position = 0.0;  ///< as a fraction of the length
  /// Times (s, from 0 on, not descending) and forces (N): linear between them, constant after the
  /// last, and before the first; a time given twice is a jump. One entry: a constant force.
  std::vector<std::pair<double, double>> table = {};
};

enum class SpringSide {
  behind,  ///< pushes against the strike
  before   ///< pushes along it
};

/// What makes a spring push only: F = k d (1 + chi d') where the beam's displacement towards it
/// exceeds the gap by d > 0, never below 0, else nothing; without memory. Source of the damping: as
/// that of the contact (Contact::damping).
struct OneSided {
  double gap = 0.0;  ///< m, at zero displacement
  SpringSide side = SpringSide::behind;
  double damping = 0.0;  ///< chi, s/m
  bool operator==(const OneSided&) const = default;
};

/// A linear spring between one point of the beam and the ground.
struct Spring {
  double position = 0.0;   ///< as a fraction of the length
  double stiffness = 0.0;  ///< k, N/m
  std::optional<OneSided> one_sided =
      {};  ///< a support that the beam lifts off; none: it pulls, too
};

/// The shape from which a beam starts.
enum class BeamStart {
  straight,    ///< no displacement
  equilibrium  ///< at rest under the loads of t = 0
};

enum class SectionShape {
  rectangle,  ///< height, width; or Beam::thickness and Beam::width
  circle,     ///< diameter
  tube,       ///< diameter (outer), wall
  box,        ///< height and width (outer), wall
  i           ///< height, width (of the flanges), flange and web (their thicknesses); strong axis
};

/// A cross-section by its dimensions (m): heights lie in the direction of the strike. Each shape is
/// one solid or the difference of two, outer minus inner (the two gaps next to the web of an I
/// count as one): sums over them are exact.
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
  /// Whether that free end lies on a support that only pushes, of rest_stiffness().
  std::array<bool, 2> rests{};
  AxialEnds axial = AxialEnds::free;  ///< held: needs supports at both ends
  BeamDamping damping = {};
  CrossSection section = {};
  /// E_t/E of linear kinematic hardening: fibres that yield keep this share of their stiffness.
  double hardening = 0.0;

  double load = 0.0;  ///< p, N/m: uniform, constant, positive along the strike
  std::vector<PointForce> forces = {};
  std::vector<Spring> springs = {};
  double foundation = 0.0;  ///< k_f, N/m2: force per length over displacement
  BeamStart start = BeamStart::straight;
  double velocity = 0.0;             ///< m/s at t = 0, of the pivot, positive along the strike
  double angular_velocity = 0.0;     ///< rad/s at t = 0, about the pivot
  std::optional<double> pivot = {};  ///< as a fraction of the length
  bool fixed = false;                ///< a rigid beam that does not move: a plane or a wall
  std::optional<std::string> material = {};  ///< where values of the material come from; no effect

  /// By default the pinned end, else the middle.
  double used_pivot() const {
    if (pivot) return *pivot;
    if ((ends[0] == EndSupport::pinned) == (ends[1] == EndSupport::pinned)) return 0.5;
    return ends[0] == EndSupport::pinned ? 0.0 : 1.0;
  }
  bool moves_at_start() const { return velocity != 0.0 || angular_velocity != 0.0; }
  bool has_loads() const { return load != 0.0 || !forces.empty(); }
  bool is_sprung() const {
    return foundation > 0.0 ||
           std::ranges::any_of(springs, [](const Spring& spring) { return !spring.one_sided; });
  }
  /// Whether it lies on, or may meet, supports that only push.
  bool may_lift() const {
    return rests[0] || rests[1] ||
           std::ranges::any_of(springs, [](const Spring& spring) { return !!spring.one_sided; });
  }
  bool has_damped_supports() const {
    return std::ranges::any_of(springs, [](const Spring& spring) {
      return spring.one_sided && spring.one_sided->damping > 0.0;
    });
  }
  /// Whether it has natural modes: neither a tension nor supports that come and go.
  bool has_natural_modes() const { return !stretches() && !may_lift(); }
  /// N/m, of a support on which an end rests: E A/(4 h), the order of rollers of the beam's own
  /// material, which the depth of their dents and their seats leave open by a factor of ten.
  double rest_stiffness() const { return 0.25 * youngs_modulus * area() / height(); }
  /// Velocity (m/s) at t = 0 of a point (a fraction of the length).
  double velocity_at(double position) const {
    return velocity + angular_velocity * length * (position - used_pivot());
  }
  CrossSection::Solid outer_solid() const;  ///< the section without its gaps
  CrossSection::Solid gap() const;          ///< taken out of the outer solid
  /// Height (m) of the section in the direction of the strike.
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
  bool stretches() const { return axial == AxialEnds::held; }
  /// Whether both ends are free.
  bool is_free() const { return ends[0] == EndSupport::free && ends[1] == EndSupport::free; }
  /// Whether only striker and loads act on the beam.
  bool is_unsupported() const { return is_free() && !fixed && !is_sprung() && !may_lift(); }
  /// J = rho I (kg m), or zero in Euler-Bernoulli theory.
  double rotary_inertia() const {
    return theory == BeamTheory::euler_bernoulli ? 0.0 : density * second_moment();
  }
  bool shears() const { return theory == BeamTheory::timoshenko; }
  /// k, if nu is given: shear_coefficient, or by default that of the shape (formulas: scene.cpp).
  /// Source: G. R. Cowper, The shear coefficient in Timoshenko's beam theory, J. Appl. Mech. 33
  /// (1966).
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

/// Rigid mass with a round nose, on which only the contact force and gravity act; or a rigid stop
/// at rest.
struct Striker {
  double mass = 0.0;                  ///< m, kg
  std::optional<double> nose_radius;  ///< R, m
  double velocity = 0.0;              ///< v0, m/s, towards the beam
  double position = 0.5;              ///< struck point as a fraction of the length
  double gap = 0.0;                   ///< m, between nose and beam at t = 0
  /// By default the shape for which the contact law is meant: cylinder (`foundation`, `line`) or
  /// sphere.
  std::optional<NoseShape> nose = {};
  std::optional<double> drop_height = {};  ///< m: v0 is that of a fall from rest (Bodies)
  bool fixed = false;                      ///< a stop: without mass and velocity

  double first_touch() const { return gap > 0.0 ? gap / velocity : 0.0; }  ///< s
  /// m; infinite for a stop.
  double inertia() const { return fixed ? std::numeric_limits<double>::infinity() : mass; }
};

constexpr double standard_gravity = 9.80665;  ///< m/s2

/// The bodies of a strike, without its discretisation and its contact law.
struct Bodies {
  const Beam& beam;
  const Striker& striker;
  double gravity;  ///< g, m/s2, along the strike

  /// Whether the motion before the first touch must be integrated.
  bool has_approach_to_compute() const {
    const bool forced = gravity != 0.0 || beam.has_loads();
    return striker.gap > 0.0 && (forced || beam.moves_at_start() || striker.fixed);
  }
  /// v0, m/s: given, or that of a fall under |gravity|, or under its standard value if that is 0.
  double striker_velocity() const {
    if (!striker.drop_height) return striker.velocity;
    const double g = gravity != 0.0 ? std::abs(gravity) : standard_gravity;
    return std::sqrt(2.0 * g * *striker.drop_height);
  }
  /// Mass (kg) of the body that moves towards the other: the striker, or a beam on a stop.
  double moving_mass() const { return striker.fixed ? beam.mass() : striker.mass; }
  /// Velocity at which striker and struck point approach at t = 0, m/s.
  double approach() const { return striker_velocity() - beam.velocity_at(striker.position); }
  /// A typical velocity of the strike, m/s: that of the first touch, neglecting the deformation of
  /// the beam before it and the direction of the forces.
  double velocity_scale() const;
};

enum class ContactKind {
  foundation,  ///< elasto-plastic columns (see ContactLaw)
  hertz,       ///< F = K lambda^1.5, never yields
  linear,      ///< F = K lambda, never yields
  sphere,      ///< Hertz up to the yield pressure, Thornton's plastic contact beyond
  line,        ///< a cylinder across the beam, elastic up to the yield pressure, plastic beyond
  curve,       ///< measured: loading and, where given, unloading
};

/// What the nose's displacement is compared with in the laws of a half-space.
enum class IndentationFrom {
  half_space,  ///< the displacement of points far away
  mid_plane    ///< that of the beam's axis, as the equations of motion have it
};

/// The contact's own constants; those of `foundation` follow from beam and nose radius.
struct Contact {
  ContactKind kind = ContactKind::foundation;
  std::optional<double> stiffness;  ///< K: N/m^1.5 (hertz), N/m (linear)
  // Constants of the bodies in contact (sphere, line; hertz in place of a stiffness):
  std::optional<double> striker_modulus;  ///< E_s, Pa; infinite, or left out: rigid
  std::optional<double> striker_poisson;  ///< nu_s
  std::optional<double> beam_poisson;     ///< nu
  /// chi, s/m: F = K lambda^n (1 + chi lambda') (hertz, linear; Hunt and Crossley 1975)
  double damping = 0.0;
  /// e, in place of chi: the coefficient of restitution of two rigid bodies at each touch, from
  /// which chi follows anew (ContactState::touch).
  std::optional<double> restitution = {};
  /// p_y, Pa: contact pressure at which the softer body yields; by default 1.6 Y (sphere), 1.67 Y
  /// (line).
  std::optional<double> yield_pressure = {};
  /// In place of p_y: the mean pressure rises with the depth of the dent, by the model of an
  /// expanding core (sphere, line).
  bool pressure_by_depth = false;
  /// By default the half-space (sphere, hertz); a line contact knows the mid-plane alone.
  std::optional<IndentationFrom> indentation = {};
  /// Points of a measured force (N) over indentation (m), both rising: loading, and unloading from
  /// its last point (curve).
  std::optional<std::vector<double>> curve_indentation = {}, curve_force = {};
  std::optional<std::vector<double>> unloading_indentation = {}, unloading_force = {};

  bool is_from_mid_plane() const {
    return kind == ContactKind::line || indentation == IndentationFrom::mid_plane;
  }
};

struct Scene {
  Beam beam;
  Striker striker;
  Contact contact;
  double gravity = 0.0;  ///< g, m/s2, along the strike, on striker and beam

  Bodies bodies() const { return {beam, striker, gravity}; }
  /// nu of the beam, which theory and contact share.
  std::optional<double> beam_poisson() const {
    return beam.poisson ? beam.poisson : contact.beam_poisson;
  }
  /// chi, s/m: given, or that of the given restitution e, from
  ///
  ///     z (1 + e) = ln((1 + z)/(1 - e z)),   z = chi v,   v the velocity of the first touch,
  ///
  /// which holds for K lambda^n (1 + chi lambda') with any K, n and masses: between two rigid
  /// bodies the work of the damping is what they lose. Source: K. H. Hunt, F. R. E. Crossley,
  /// Coefficient of restitution interpreted as damping in vibroimpact, J. Appl. Mech. 42 (1975),
  /// without its restriction to e near 1.
  double contact_damping() const;
  NoseShape nose() const {
    const bool is_line =
        contact.kind == ContactKind::foundation || contact.kind == ContactKind::line;
    return striker.nose.value_or(is_line ? NoseShape::cylinder : NoseShape::sphere);
  }
};

inline double Bodies::velocity_scale() const {
  const double at_start = std::abs(approach());
  const bool is_set_down = striker.gap == 0.0 && at_start == 0.0;
  if (striker.gap == 0.0 && !is_set_down) return at_start;
  double force = std::abs(beam.load) * beam.length;
  for (const PointForce& one : beam.forces) {
    double largest = 0.0;
    for (const auto& [time, value] : one.table) largest = std::max(largest, std::abs(value));
    force += largest;
  }
  const double acceleration = std::abs(gravity) + force / beam.mass();
  if (acceleration == 0.0) return at_start;
  constexpr double depth_under_weight = 1e-6;  // m, by order of magnitude
  return std::sqrt(at_start * at_start +
                   2.0 * acceleration * (is_set_down ? depth_under_weight : striker.gap));
}

}  // namespace subimpact
