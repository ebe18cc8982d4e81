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

/// The order at which event times of a case converge with its mesh: 2 for cells; 4 for Hermite
/// elements, or 1 if sections may yield; nothing for a rigid beam.
std::optional<int> mesh_order(const Case& input);

/// The case on a mesh with `factor` times as many cells or elements, as nearly as the mesh allows;
/// nothing for a rigid beam or if too few would be left. A fixed step is reduced to 0.9 of the
/// stability limit of the mesh, where it is above.
std::optional<Case> on_other_mesh(const Case& input, double factor);

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
/// on coarser meshes with a matching accuracy in time (docs/theory/errors.md), or on finer ones if
/// the strike is too near an end. If the mesh cannot be coarser, they differ in time only.
std::vector<CaseBeside> cases_beside(const Case& input);
/// The cases that show the error in time only, on the mesh of the case.
std::vector<CaseBeside> cases_beside_in_time(const Case& input);

/// The cases for a mesh that is given: cases in time, for the errors of sub-impacts, and one on
/// another mesh, for totals and the effect of finer meshes.
std::vector<CaseBeside> cases_beside_on_given_mesh(const Case& input);

/// Judges `run` by the runs beside it (docs/theory/errors.md; measured in
/// validation/truth/judgement): sets certain, probability (the share of the runs that have the
/// sub-impact), doubt and errors of its sub-impacts, Result::contact_over, and
/// Result::error_estimate with the totals. Errors are safety factors times the differences between
/// the runs; those of times are also as large as the error of the indentation makes them.
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
