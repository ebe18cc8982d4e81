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
  /// A difference d between the two runs stands for an error gain d of the judged one: 1/(r^p - 1)
  /// for a mesh coarser by the factor r and of the order p, at most 1.
  double gain = 1.0;
  /// Whether sub-impacts carry this part of the error; if not, only totals do.
  bool of_rows = true;
};

struct RunBeside {
  CaseBeside of;
  Result result;
};

/// The cases beside a case that show the error of its mesh and of its integration in time
/// together: meshes coarser by the factors 0.85 and 0.7, with the accuracy in time that goes with
/// them; finer by 1.2 and 1.45 where a strike is too near an end for coarser ones. In time alone
/// where the mesh cannot be coarser.
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

/// Judges `run` by the runs beside it: sets certain, probability, doubt and errors of its
/// sub-impacts, and Result::error_estimate with the totals, by the rules of docs/theory.md, "Error
/// estimates". Errors are meant to cover 95 of 100 true ones, those of times 98
/// (validation/judgement). `probability` is the share of the runs that have the sub-impact. Runs of
/// several parts are judged part by part; errors are the sums.
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

/// Bytes that cases_beside() take beside the run itself, roughly.
double memory_beside(const Case& input);

}  // namespace subimpact
