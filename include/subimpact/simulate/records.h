#pragma once

/// Sub-impacts, assembled from events, their zones, near misses, and force signals.

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "subimpact/simulate/assessment.h"
#include "subimpact/system/readings.h"

namespace subimpact {

/// One contact, from the instant at which it begins to the instant at which its force is zero
/// again.
struct SubImpact : SubImpactAssessment {
  double start = 0.0;                 ///< s
  std::optional<double> end;          ///< s; none: still in contact when the simulation ended
  double peak_force = 0.0;            ///< N
  double peak_time = 0.0;             ///< s, of the largest force: between steps, that of the step
  double impulse = 0.0;               ///< N s, from the striker's velocities at start and end
  double force_integral = 0.0;        ///< N s, the contact force integrated over the sub-impact
  double max_indentation = 0.0;       ///< m, largest within this sub-impact
  double residual_indentation = 0.0;  ///< m, after it
  double striker_velocity = 0.0;      ///< m/s, at its end
  double start_rate = 0.0;            ///< m/s, rate of the indentation at the start
  double end_rate = 0.0;              ///< m/s, the same at the end
  /// m, largest gap between striker and beam after its end, until the next one begins or the
  /// simulation ends; none: still in contact then.
  std::optional<double> opening;
  /// m, largest gap within it, where contacts are joined (OutputOptions::opening); none: it is one.
  std::optional<double> inner_opening;
  int zone = 0;     ///< numbered from 1
  int subzone = 0;  ///< numbered from 1 within the zone
};

/// One contact of the beam with a support that it can lift off (Spring::one_sided), the mirror
/// image of one included where one half of the beam is modelled. Contacts whose force stays below
/// 1e-9 of the largest of the run are left out, with their transitions.
struct SupportContact {
  std::size_t spring = 0;     ///< index of the support in Beam::springs, or of an end that rests
  double position = 0.0;      ///< m, along the beam
  double start = 0.0;         ///< s: it touches; 0: it lay there from the start
  std::optional<double> end;  ///< s: it lifts; none: it lies there when the simulation ended
  double peak_force = 0.0;    ///< N
  double impulse = 0.0;       ///< N s
  std::optional<double> start_error = {}, end_error = {};  ///< s; none: not known
};

/// Smallest gap between the bodies before it grows for good, or until the run ends.
struct ClosestApproach {
  double time = 0.0;            ///< s
  double gap = 0.0;             ///< m
  std::optional<double> error;  ///< m, of the gap
};

/// The event that nearly happened when the indentation came close to the residual one.
enum class NearMissKind {
  opening,  ///< within a contact: a local minimum of the indentation
  closing   ///< within a separation: a local minimum of the gap
};

std::string_view to_string(NearMissKind kind);

/// A local minimum of the distance between the indentation and the residual one. In the exact
/// solution, a contact that nearly opens may be two sub-impacts, and a separation that nearly
/// closes may hold another.
struct NearMiss {
  double time = 0.0;    ///< s
  double margin = 0.0;  ///< m, above 0: |indentation - residual indentation|
  NearMissKind kind = NearMissKind::opening;
};

/// Sets the numbers of zone and sub-zone: a sub-impact that begins sooner than `zone_gap` (s) after
/// the end of the last one belongs to the same zone; `subzone_gap` does the same for sub-zones.
void assign_zones(std::vector<SubImpact>& sub_impacts, double zone_gap, double subzone_gap);

/// Joins sub-impacts that are parted by less than `opening` (m). Joined ones last from the first
/// start to the last end, with the largest force and indentation and the sum of the impulses.
void join_sub_impacts(std::vector<SubImpact>& sub_impacts, double opening);

/// How many sub-impacts remain where those parted by less than `opening` (m) count as one.
std::size_t n_parted_by(double opening, const std::vector<SubImpact>& sub_impacts);

/// A zone in numbers; its end is that of its last sub-impact.
struct ZoneSummary {
  int zone = 0;
  int n_sub_impacts = 0;
  int n_subzones = 0;
  double start = 0.0;                                      ///< s
  std::optional<double> end;                               ///< s; none: still in contact
  std::optional<double> start_error = {}, end_error = {};  ///< s, of these sub-impacts
  double impulse = 0.0;                                    ///< N s
  double peak_force = 0.0;                                 ///< N
};
std::vector<ZoneSummary> summarise_zones(const std::vector<SubImpact>& sub_impacts);

}  // namespace subimpact
