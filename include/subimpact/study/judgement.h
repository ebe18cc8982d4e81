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
/// them; finer by 1.2 and 1.45 where a strike is too near an end for coarser ones. In time alone where the mesh cannot be coarser.
std::vector<CaseBeside> cases_beside(const Case& input);
/// Those that show the error in time alone, on the mesh of the case.
std::vector<CaseBeside> cases_beside_in_time(const Case& input);

/// Those for a mesh that is given: those in time, which rows carry, and another mesh for the totals
/// and what finer meshes would change: twice as many cells by central differences, or 0.7 times as
/// many parts where the method is that already or the mesh another one.
std::vector<CaseBeside> cases_beside_on_given_mesh(const Case& input);

/// Those that show each source of error by itself: "time", "mesh" (a third mesh, coarser by 0.5,
/// shows whether times converge at its order) and, where the case has layers, "layers".
std::vector<CaseBeside> cases_beside_by_part(const Case& input);

/// Judges `run` by the runs beside it: sets certain, probability, doubt and errors of its
/// sub-impacts, and Result::error_estimate with the totals. Errors are meant to cover 95 of 100
/// true ones, those of times 98 (validation/judgement).
///
/// **Times.** Sub-impacts are matched with those of every run beside. With d the difference of a
/// time, e = gain d is an error of the time, and e |u'| one of the indentation u. The latter
/// changes slowly from event to event; its median over the events around, delta, bounds e from
/// below by delta/|u'|, so that a difference that happens to be small is not taken for accuracy.
/// Stated is 3.2 times the largest e over the runs, and at least what free ends of a mesh of cells
/// leave.
///
/// **Values** (force, impulse ...): 6 times the largest gain |difference|, and at least what delta
/// leaves of indentations and forces.
///
/// **Existence.** A sub-impact is certain if each run beside has exactly one that corresponds to
/// it; if the indentation goes beyond the residual one by more than 1.2 delta, and the gap opens by
/// more than 1.2 delta before and after; if its errors are below its duration and the separations
/// next to it; and if every near miss within it stays farther from opening than 3.5 times what its
/// depth differs by. A flight is certain to hold no other sub-impact by the same rule for near
/// misses. What precedes plays no part but by these. `probability` is the share of the runs that
/// have the sub-impact. On a mesh that does not resolve the waves of a contact, or whose part under
/// the striker is as heavy as a fifth of the striker, nothing is certain, whatever runs agree on.
///
/// **The end.** contact_over: the proof of every run, whose velocities at the end agree within 2.5 %
/// of that of the strike. closest_approach: the error is that of a near miss.
///
/// **Parts.** Runs of several parts are judged part by part; errors are the sums.
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
