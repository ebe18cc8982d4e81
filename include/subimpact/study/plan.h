#pragma once

/// Cost of a wanted total error, of mesh and time integration together.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "subimpact/study/event_errors.h"
#include "subimpact/study/work_precision.h"

namespace subimpact {

/// One mesh of a sequence, integrated so accurately that the error of the mesh dominates.
struct MeshRun {
  Case input;
  std::string mesh;        ///< "501 cells", "200 elements"
  int count = 0;           ///< cells or elements over the whole length
  double first_end = 0.0;  ///< s, end of the first sub-impact
  EventErrors errors;      ///< against the limit
};

/// The end of the first sub-impact in the limit of one kind of mesh.
struct FirstEndLimit {
  std::string meshes;        ///< its three finest
  double value = 0.0;        ///< s, extrapolated
  double uncertainty = 0.0;  ///< s
  double order = 0.0;        ///< observed
};

/// Event times in the limit of fine meshes.
struct MeshLimit {
  std::string description;               ///< the meshes from which the limit is taken
  std::vector<SubImpact> sub_impacts;    ///< those that count, extrapolated
  std::vector<double> uncertainty;       ///< s, of the times of each
  double horizon = 0.0;                  ///< s
  std::string horizon_reason;            ///< in words
  std::vector<FirstEndLimit> first_end;  ///< cells, then elements
  std::vector<MeshRun> runs;             ///< every mesh, coarse to fine, cells first
};

/// Meshes of a quarter, half, the whole, twice and four times the case's size, of cells and of
/// Hermite elements; the limit is taken from the kind of mesh whose times converge most closely.
/// For layers it is the limit of the exact section, so that errors include the error of the layers.
/// With meshes in the ratio r, times t1, t2, t3 from coarse to fine and the order p of the mesh,
///
///     limit = t3 + (t3 - t2)/(r^p - 1).
///
/// Its uncertainty is the change of the limit with the observed order, log_r (t2 - t1)/(t3 - t2),
/// in place of p, plus half of the extrapolation; it is t3 - t2 where the observed order is not
/// plausible. A sub-impact counts if the three finest meshes all have it and the uncertainty of its
/// times is at most `largest_error` (s). Throws InvalidCase if no sub-impact counts.
MeshLimit mesh_limit(const Case& input, double largest_error);

/// The cheapest setting of one method on one mesh.
struct PlanPoint {
  Case input;
  std::string mesh;
  double mesh_error = 0.0;  ///< s, without any error in time
  WorkPrecisionPoint run;   ///< errors are total ones, against the limit
};

struct Plan {
  double wanted = 0.0;  ///< s
  MeshLimit limit;
  std::vector<PlanPoint> points;        ///< the last setting tried of each method and mesh
  std::optional<std::size_t> cheapest;  ///< index into points; empty if none reaches the error
  bool interrupted = false;
};

/// Total error of event times (mesh, layers, time) against the limit, for the fast methods on every
/// mesh whose own error is below the wanted error (s); each method is run from coarse to fine
/// settings until its total error is within the wanted one. Timed runs run one at a time. Throws
/// InvalidCase.
Plan plan(const Case& input, double wanted,
          const std::function<void(const std::string&)>& announce = {},
          const Progress& progress = {});

}  // namespace subimpact
