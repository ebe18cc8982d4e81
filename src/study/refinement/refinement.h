#pragma once

#include <optional>

#include "subimpact/study/run_as_asked.h"

namespace subimpact {

/// Default tolerance, as a share of the time scale of the shortest contacts.
inline constexpr double default_share_of_contact = 0.1;
/// Exponent with which the work of a run grows with the number of cells or elements, usually.
inline constexpr double usual_growth = 2.5;

/// Work of a run and of those beside it over that of the run; on fine meshes of low order.
inline constexpr double work_with_others = 2.4;
inline constexpr double work_with_others_if_fine = 2.0;

/// A case on finer and finer meshes, with the accuracy in time that goes with each: the default
/// step of the mesh or, where the contact limits the step, one that shrinks as the mesh does; rtol
/// divided by ten for every doubling. What is not open stays.
class Refinement {
 public:
  Refinement(const Case& input, const OpenChoices& open);

  /// The coarsest case worth a run (parts_at_first).
  const Case& first() const { return first_; }
  /// ResolvedSettings::contact_time, s, of a mesh that takes the strike.
  double contact_time() const { return contact_time_; }
  /// Nothing if the mesh would be finer than allowed, or no finer than `from`.
  std::optional<Case> finer(const Case& from, double ratio) const;

  /// The case on a mesh resized by any ratio, in the same way.
  std::optional<Case> resized(const Case& from, double ratio) const;

  double order() const { return order_; }
  const char* size_key() const;
  /// The key that keeps the case from being refined, if any.
  const char* fixed_key() const;

 private:
  void choose_count(const ResolvedSettings& used);

  Case first_;
  OpenChoices open_;
  double contact_time_ = 0.0;
  double order_ = 1.0;
  std::optional<double> first_step_;  // s, where the contact limits the step
};

}  // namespace subimpact
