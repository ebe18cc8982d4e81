#pragma once

/// What is certain of a run: runs of the same scene beside it, and the judgement that follows.

#include <span>
#include <string>
#include <vector>

#include "subimpact/case/simulate.h"

namespace subimpact {

/// A case beside another one, from which it differs in mesh, time steps or section.
struct CaseBeside {
  Case input;
  std::string part;         ///< of the error that it shows: "mesh and time", "time", "layers" ...
  std::string description;  ///< in words: "2787 cells"
  /// A difference d between the two runs stands for an error gain d of the judged one:
  /// 1/|r^p - 1|, at most 2, for a mesh coarser by the factor r (finer: r < 1) and of the order p.
  double gain = 1.0;
  /// Whether sub-impacts carry this part of the error; if not, only totals do.
  bool of_rows = true;
  /// Whether a certain sub-impact must exist there; if not, it shows errors alone.
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

/// The cases beside a case that show the error of its mesh and of its integration in time
/// together: meshes coarser by the factors 0.85 and 0.7, and by 0.5 for errors alone, with the
/// accuracy in time that goes with them; finer by 1.2 and 1.45 where a strike is too near an end
/// for coarser ones. In time alone where the mesh cannot be coarser.
std::vector<CaseBeside> cases_beside(const Case& input);
/// Those that show the error in time alone, on the mesh of the case; none where the step belongs to
/// the mesh.
std::vector<CaseBeside> cases_beside_in_time(const Case& input);

/// Those for a mesh that is given: those in time, which rows carry, and another mesh for the totals
/// and what finer meshes would change: twice as many cells by central differences, or 0.7 times as
/// many parts where the method is that already or the mesh another one. Where the step belongs to
/// the mesh, those of cases_beside().
std::vector<CaseBeside> cases_beside_on_given_mesh(const Case& input);

/// Those that show each source of error by itself: "time", "mesh" (a third mesh, coarser by 0.5,
/// shows whether times converge at its order) and, where the case has layers, "layers".
std::vector<CaseBeside> cases_beside_by_part(const Case& input);

/// Judges `run` by the runs beside it: sets certain, probability (the share of the runs that have
/// the sub-impact), doubt and errors of its sub-impacts, and Result::error_estimate with the totals
/// (docs/theory.md, "Error estimates"; measured in validation/judgement).
///
/// e: the largest gain |difference| over the runs beside; d: the median of e |indentation rate|
/// over seven events. Errors: of a time 2.4 max(e, d/rate), at least what free ends leave; of a
/// value 2.8 times its e, at least the median of seven; of totals as set_totals(). A sub-impact is
/// certain if each run that counts for existence has one counterpart, if 0.75 d is below its
/// indentation and the openings of the gap beside it, if its errors are below its duration and the
/// separations, and near misses within it keep margins above 2.5 e; after an uncertain one of its
/// sub-zone all this with 1.5 times the errors. A flight is certain by its near misses. Where one
/// run alone shows a part, factors are 1.5 times as large. Contact is over where that is proven for
/// all runs that count for existence and the final velocities of their strikers differ by less than
/// 2.5 % of the strike's. Several parts are judged one by one; errors are the sums.
void judge(const Case& input, Result& run, std::span<const RunBeside> beside);

/// Threads that a function may use for runs beside one another; results do not depend on it.
using Jobs = unsigned;

/// Runs a case into `run` and the others beside it; returns these, or none if the run was stopped
/// or memory did not suffice, for which the run has a warning. `progress` and `rows` are those of
/// the case. Throws InvalidCase.
std::vector<RunBeside> simulate_beside(const Case& input, const std::vector<CaseBeside>& cases,
                                       Jobs jobs, const Progress& progress, RowSink* rows,
                                       Result& run);

/// Runs a case beside others and judges it by them. Without others errors are not known.
Result simulate_judged(const Case& input, const std::vector<CaseBeside>& cases, Jobs jobs,
                       const Progress& progress = {}, RowSink* rows = nullptr);

}  // namespace subimpact
