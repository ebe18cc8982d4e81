#pragma once

/// The course of a strike: which body gained or lost energy, and when.

#include <cstddef>
#include <optional>
#include <vector>

#include "subimpact/simulate/result.h"

namespace subimpact {

/// A part of the strike: a zone, a sub-zone, or the separation after one.
struct StrikePart {
  enum class Kind { zone, subzone, separation, subzone_separation };
  Kind kind = Kind::zone;
  int zone = 0;                ///< of a separation: the zone before it
  int subzone = 0;             ///< 0 for zones and the separations between them
  double start = 0.0;          ///< s
  double end = 0.0;            ///< s
  double elastic_start = 0.0;  ///< U_e, J
  double elastic_end = 0.0;    ///< J

  double elastic_change() const { return elastic_end - elastic_start; }
};

/// In order of time; a zone before its sub-zones. Zones and sub-zones run from their first contact
/// to their last separation; separations lie between them. Elastic energies are left 0.
std::vector<StrikePart> strike_parts(const Result& result);

/// Poisson's division of an impact, applied to the elastic energy U_e of the beam: compression
/// while U_e rises overall, recovery while U_e falls.
struct StrikeAccount {
  std::vector<StrikePart> parts;    ///< strike_parts() with their elastic energies
  double strike_end = 0.0;          ///< s, last separation (or the end of the run)
  double largest_elastic = 0.0;     ///< J, of U_e
  double largest_elastic_at = 0.0;  ///< s: compression before, recovery after
  double elastic_at_end = 0.0;      ///< J, at strike_end
  /// The largest rise of the striker's energy above an earlier value, J; 0, up to rounding, if the
  /// striker never gains energy.
  double striker_gain = 0.0;
  double striker_loss = 0.0;  ///< J, from the first touch to strike_end
};

/// Nothing for a run without history or sub-impacts.
std::optional<StrikeAccount> account_of(const Result& result);

}  // namespace subimpact
