#pragma once

/// Mesh and time together: what a wanted total error costs.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "subimpact/study/event_errors.h"
#include "subimpact/study/work_precision.h"

namespace subimpact {

/// One mesh of a sequence, integrated so accurately that only the mesh's error is left.
struct MeshRun {
  Case input;
  std::string mesh;        ///< "501 cells", "200 elements"
  int count = 0;           ///< cells or elements over the whole length
  double first_end = 0.0;  ///< s, end of the first sub-impact
  EventErrors errors;      ///< against the limit
};

/// What one kind of mesh says of the end of the first sub-impact.
struct FirstEndLimit {
  std::string meshes;        ///< its three finest
  double value = 0.0;        ///< s, extrapolated
  double uncertainty = 0.0;  ///< s
  double order = 0.0;        ///< observed
};

/// Event times in the limit of fine meshes.
struct MeshLimit {
  std::string description;               ///< the meshes it is taken from
  std::vector<SubImpact> sub_impacts;    ///< those that count, extrapolated
  std::vector<double> uncertainty;       ///< s, of each one's times
  double horizon = 0.0;                  ///< s
  std::string horizon_reason;            ///< in words
  std::vector<FirstEndLimit> first_end;  ///< cells, then elements
  std::vector<MeshRun> runs;             ///< every mesh, coarse to fine, cells first
};

/// Meshes of a quarter, half, the whole, twice and four times the case's size, of cells and
/// of Hermite elements; those whose times converge closest tell the limit.
/// For layers it is the limit of the exact section, so that errors hold the layers' share. With
/// meshes in the ratio r, times t1, t2, t3 from coarse to fine and the order p of the mesh,
///
///     limit = t3 + (t3 - t2)/(r^p - 1),
///
/// uncertain by how much the observed order, log_r (t2 - t1)/(t3 - t2), would move it, and by half
/// of the extrapolation; by t3 - t2 where the observed order makes no sense. A sub-impact counts if
/// the three finest meshes all have it and its times are certain to `largest_error` (s). Throws
/// InvalidCase if none is.
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
  std::optional<std::size_t> cheapest;  ///< of points; nothing if none reaches the error
  bool interrupted = false;
};

/// Total error of event times (mesh, layers, time) against the limit, for the fast methods on every
/// mesh whose own error leaves room; each swept from coarse to fine until it is within the wanted
/// error (s). Timed runs run alone. Throws InvalidCase.
Plan plan(const Case& input, double wanted,
          const std::function<void(const std::string&)>& announce = {},
          const Progress& progress = {});

}  // namespace subimpact
