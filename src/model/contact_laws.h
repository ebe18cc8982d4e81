#pragma once

#include <memory>
#include <span>

#include "subimpact/model/contact_law.h"
#include "subimpact/model/scene.h"

namespace subimpact {

/// One way to give a law its constants.
struct ContactConstants {
  std::span<const char* const> keys;  ///< of the case file, all needed
  const char* remedy;                 ///< where one is missing
  /// Why a constant of the contact that is not among the keys has no use.
  const char* why_unused;
};

/// A contact law that a scene can name:
///
///     foundation  n = 3/2, K = 4 sqrt(2R) E b/(3h), lambda_s = Y h/E: independent columns of depth
///                 h and modulus E/h, elastic-perfectly plastic at the yield stress Y, pressed by a
///                 rigid cylinder of radius R
///     hertz       n = 3/2, K given or that of a sphere on a flat surface (see hertz_stiffness);
///                 lambda_s infinite
///     linear      n = 1, K given; lambda_s infinite
///
/// (see PowerContact). A new one is a class of its own, an enumerator and a row of
/// built_in_contact_laws().
struct BuiltInContactLaw {
  ContactKind kind;
  const char* name;
  const char* note;
  /// The ways to give its constants; the last one is assumed where none is complete.
  std::span<const ContactConstants> ways;
  /// Throws std::invalid_argument where a constant is missing.
  std::shared_ptr<const ContactLaw> (*make)(const Scene& scene);
};

std::span<const BuiltInContactLaw> built_in_contact_laws();
const BuiltInContactLaw& built_in_contact_law(ContactKind kind);

/// The law that a scene names. Throws std::invalid_argument where a constant is missing.
std::shared_ptr<const ContactLaw> make_contact_law(const Scene& scene);

}  // namespace subimpact
