#pragma once

#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "model/contact/curves.h"
#include "subimpact/model/contact/contact_law.h"
#include "subimpact/model/scene.h"

namespace subimpact {

/// 1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2, 1/Pa; an infinite modulus is a rigid body.
double contact_compliance(double modulus_1, double poisson_1, double modulus_2, double poisson_2);

/// Radii (m) of the gap between two surfaces that touch, along the beam and across it; infinite
/// where the gap is straight.
struct GapRadii {
  double along, across;
  /// Equal but for rounding.
  bool is_circle() const { return std::abs(along - across) <= 1e-12 * along; }
  /// Whether the surfaces touch in an ellipse, neither in a circle nor along a line.
  bool is_ellipse() const { return std::isfinite(across) && !is_circle(); }
};
/// Radii of the gap between the nose (its radius is needed) and the struck surface, flat or round.
GapRadii gap_radii(const Scene& scene);

/// K (N/m^1.5) of Hertz's contact of finite radii: 4/3 E* sqrt(R) where they are equal; otherwise
/// the surfaces touch in an ellipse. Source: K. L. Johnson, Contact Mechanics, equations 4.25-4.28.
double hertz_stiffness(GapRadii radii, double compliance);

struct ContactConstants {
  std::span<const char* const> keys;  ///< of the case file, all needed
  const char* remedy;                 ///< where one is missing
  /// Why a constant of the contact that is not among the keys has no use.
  const char* why_unused;
  /// Keys that may be given as well.
  std::span<const char* const> optional = {};
};

/// A contact law that a scene can name (docs/theory.md, "Contact"). A new one is a class of its
/// own, an enumerator and a row of built_in_contact_laws().
struct BuiltInContactLaw {
  ContactKind kind;
  const char* name;
  const char* note;
  bool yields;
  /// The ways to give its constants; the last one is assumed where none is complete.
  std::span<const ContactConstants> ways;
  /// Throws std::invalid_argument where a constant is missing.
  std::shared_ptr<const ContactLaw> (*make)(const Scene& scene);
  /// Why the law does not describe the nose on the beam's section; empty where it does. The radii
  /// of the gap are NaN without a nose radius.
  std::string (*why_not)(const Scene& scene, GapRadii radii) = nullptr;
};

std::span<const BuiltInContactLaw> built_in_contact_laws();
const BuiltInContactLaw& built_in_contact_law(ContactKind kind);

/// The law that a scene names. Throws std::invalid_argument where a constant is missing.
std::shared_ptr<const ContactLaw> make_contact_law(const Scene& scene);

/// The velocity (m/s) from which a strike yields the contact of a beam that does not give way, so
/// that any slower strike leaves it elastic: that of the law; of an elastic Hertz contact with a
/// nose radius that of its material. Nothing where nothing yields or too little is given.
std::optional<double> contact_yield_velocity(const Scene& scene, const ContactLaw& law);

/// The pressure under a round nose of known moduli.
struct ContactPressure {
  double at_force;  ///< Pa: the largest one, in the middle; once the contact has yielded, the mean
  bool is_mean;
  double first_yield;  ///< Pa: a largest pressure; infinite where nothing that yields is given
};
/// At the largest force (N) of a strike. Nothing for laws without such a pressure: with a given
/// stiffness, columns.
std::optional<ContactPressure> contact_pressure(const Scene& scene, double force);

}  // namespace subimpact
