#pragma once

#include <string>
#include <vector>

#include "subimpact/case/case.h"
#include "subimpact/simulate/result.h"

namespace subimpact {

/// Errors of the sub-impacts and near misses of a run, from one refined or coarser run.
struct ErrorPart {
  std::string name;            ///< "time", "mesh", "layers"
  std::string refined_run;     ///< the refined run, in words
  std::vector<double> errors;  ///< s, of the leading sub-impacts that correspond
  /// m, of the gap at the leading near misses, those in the contacts and separations of the above.
  std::vector<double> gap_errors;
  std::size_t n_refined = 0;  ///< sub-impacts the refined run has
  std::string failure;        ///< why the refined run did not complete; empty: it did
  std::string open_contact;   ///< why the next sub-impact is unknown where only one run ends it
};

/// The error of each leading sub-impact that both runs have: `factor` times the largest difference
/// of starts and ends over it and its neighbours, so that a difference that happens to pass through
/// zero is not taken for accuracy. A contact that ends in one of the runs alone is not of both.
///
/// The error of the gap at each near miss: `factor` times the difference of the two runs' margins.
/// Where the other run has no such near miss, it is `factor` times the difference of the nearest
/// start or end in time, times the rate of the indentation there.
ErrorPart compare_events(const Result& result, const Result& refined_run, std::string name,
                         std::string description, double factor);

/// Gives every sub-impact its errors, part by part and in sum, and finds the first one from which
/// neither count nor order is certain: Result::error_estimate. That is the first one
///
///   - that one of the runs does not have,
///   - whose error is not small beside its duration or beside a separation next to it, or
///   - with a near miss within it or before it whose margin is below the error of the gap: in truth
///     the contact may open, or the separation close.
void set_error_bars(Result& result, const std::vector<ErrorPart>& parts);

/// The first-order part of the error that cells with free ends leave in an event time: s, for an
/// event at `time` (s) of a run with this `contact_time` (s, ResolvedSettings). 0 for other meshes,
/// for supported ends and in Euler-Bernoulli theory.
///
/// The outer half of an end cell has no rotary inertia (CellMesh). By Rayleigh's quotient, a mode
/// phi that lacks the inertia J dx/2 at each of n free ends has a frequency too high by
///
///     d omega/omega = (J dx/4) sum phi'^2(ends)/integral of (rho A phi^2 + J phi'^2)
///                   = (n/N) x/(1 + x),   x = (r beta)^2,
///
/// the latter for wave numbers beta whose decaying waves do not reach the other end, where
/// phi'^2(end) is four times the mean of phi'^2. beta follows from omega by
/// (omega r/c)^2 = x^2/(1 + x), with the radius of gyration r and c = sqrt(E/rho). The shift grows
/// with omega; the modes that matter go up to 1/contact_time.
///
/// Times shorten in the same proportion, on average. The shift is made where waves are reflected:
/// each time T = 2 l/c_g, with the group velocity c_g, brings one reflection from each end, the
/// first of them after 2 a/c_g, with the distance a of the strike from the nearest free end. So the
/// shift is at most
///
///     x/(1 + x) min(n t + T, t l/a)/N.
///
/// All else of the mesh's error is of second order and falls faster, so that on fine meshes of
/// thick beams this part takes over, with the other sign: in between, two meshes may agree by
/// chance.
double free_end_error(const Case& input, double contact_time, double time);

/// Raises the errors of a mesh part to the first-order part of free ends.
void include_free_ends(ErrorPart& part, const Case& input, const Result& result);

}  // namespace subimpact
