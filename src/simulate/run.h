#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "simulate/audit.h"
#include "simulate/event_loop.h"
#include "simulate/field_recorder.h"
#include "subimpact/model/scene.h"
#include "subimpact/simulate/observer.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// What a run of parts does beside integrating.
struct RunOptions {
  LoopOptions loop;
  AuditLimits limits;
  double history_interval = 0.0;      ///< s between history rows; 0: none
  std::vector<std::size_t> sections;  ///< indices of those whose bending is kept
  FieldOptions fields;
  double zone_gap = 0.0;             ///< s
  double subzone_gap = 0.0;          ///< s
  std::optional<double> fixed_step;  ///< s, of the integrator; contacts of few steps are noted
  /// The beam's material: the run ends once no more contact can follow; empty: at the end time.
  std::optional<Beam> stops_without_contact;
};

/// Runs a struck beam: the lower half of simulate(Case), for a beam
/// and an integrator made of parts. Result::used stays empty; messages of failures name no remedy.
Result simulate(StruckBeam& beam, Integrator& integrator, const RunOptions& options,
                const Progress& progress = {}, Observer* observer = nullptr,
                RowSink* rows = nullptr);

}  // namespace subimpact
