#pragma once

/// Which results of a run are certain: runs of the same scene beside it, mostly on other meshes,
/// and the judgement by them.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/case/simulate.h"

namespace subimpact {

struct RefinedRun {
  Case input;
  std::string description;
};

/// The order at which event times of a case converge with its mesh: 2 for cells; 4 for Hermite
/// elements, or 1 if sections may yield; nothing for a rigid beam.
std::optional<int> mesh_order(const Case& input);

/// The case on a mesh with `factor` times as many cells or elements, as nearly as the mesh allows;
/// nothing for a rigid beam or if too few would be left. A fixed step above
/// the stability limit of the finer mesh is reduced to 0.9 of that limit.
std::optional<RefinedRun> on_other_mesh(const Case& input, double factor);

/// Number of cells or elements over the whole length; 1 for a rigid beam.
int mesh_count(const Case& input);

/// "501 cells", "200 elements"; "rigid", "a mesh of its own".
std::string mesh_words(const Case& input);

/// A case to be run beside another one, from which it differs in mesh, time steps or section.
struct CaseBeside {
  Case input;
  ErrorSource source;       ///< of the error that it shows
  std::string description;  ///< in words: "2787 cells"
  /// A difference d between the two runs corresponds to an error gain d of the judged run: gain is
  /// 1/|r^p - 1|, at most 2, for a mesh coarser by the factor r (finer: r < 1) and of the order p.
  double gain = 1.0;
  /// Whether errors of sub-impacts include this part; if not, only errors of totals do.
  bool of_rows = true;
  /// Whether a certain sub-impact must exist in this run; if not, only where twice the run's own
  /// error is below the indentation and the openings next to it.
  bool of_existence = true;
};

/// Takes no rows into memory.
class NoRows final : public RowSink {
 public:
  void add(const HistoryRow&) override {}
  void add(const SectionRow&) override {}
  bool takes_shapes() const override { return false; }
};

struct RunBeside {
  CaseBeside of;
  Result result;
};

/// The cases beside a case that show the error of its mesh and of its integration in time together,
/// with a matching accuracy in time: on meshes coarser by the factors 0.85, 0.7 (unless sections
/// may yield and the mesh resolves contacts 2.5 times) and 0.5; finer by 1.2 and 1.45 if the strike
/// is too near an end for coarser ones. If the mesh cannot be coarser, they differ in time only.
std::vector<CaseBeside> cases_beside(const Case& input);
/// The cases that show the error in time only, on the mesh of the case.
std::vector<CaseBeside> cases_beside_in_time(const Case& input);

/// The cases for a mesh that is given: cases in time, for the errors of sub-impacts, and one on
/// another mesh, for totals and the effect of finer meshes: twice as many cells by central
/// differences, or 0.7 times as many parts if the method is that already or the mesh has no cells.
std::vector<CaseBeside> cases_beside_on_given_mesh(const Case& input);

/// Judges `run` by the runs beside it: sets certain, probability (the share of the runs that have
/// the sub-impact), doubt and errors of its sub-impacts, and Result::error_estimate with the totals
/// (docs/theory.md, "Error estimates"; measured in validation/truth/judgement). e: the largest gain
/// |difference| over the runs beside; d: the median of e |indentation rate| over seven events.
/// Errors: for a time 2.7 max(e, d/rate), at least the bound due to free ends; for a value 3.2
/// times its e, at least the median of seven; for totals see set_totals(). A sub-impact is certain
/// if each run that counts for existence has one counterpart, as has any other whose own error is
/// small enough, if 0.8 d is below its indentation and the openings of the gap next to it, if its
/// errors (at most twice the median of seven) are below its duration and the separations, and if
/// near misses within it keep margins above 2.5 e; after an uncertain one of its sub-zone, errors
/// count 1.5 times. Near misses
/// decide whether a flight is certain. Where only one run shows a part, factors are 1.5 times as
/// large. Contact is over if this is proven for all runs that count for existence and the final
/// velocities of their strikers differ by less than 2.5 % of the strike's.
void judge(const Case& input, Result& run, std::span<const RunBeside> beside);

/// Number of threads for parallel runs; results do not depend on it.
using Jobs = unsigned;

/// Runs a case into `run` and `cases` beside it; returns the latter, or none if the run was stopped
/// or memory did not suffice (then with a warning in `run`). `progress` and `rows` are those of the
/// case. Throws InvalidCase.
std::vector<RunBeside> simulate_beside(const Case& input, const std::vector<CaseBeside>& cases,
                                       Jobs jobs, const Progress& progress, RowSink* rows,
                                       Result& run);

/// Runs a case with `cases` beside it and judges it by them. Without `cases`, errors are not known.
Result simulate_judged(const Case& input, const std::vector<CaseBeside>& cases, Jobs jobs,
                       const Progress& progress = {}, RowSink* rows = nullptr);

}  // namespace subimpact
