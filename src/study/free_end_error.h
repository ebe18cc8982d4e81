#pragma once

#include "subimpact/case/case.h"

namespace subimpact {

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

struct ErrorPart;
struct Result;

/// Raises the errors of a mesh part to the first-order part of free ends.
void include_free_ends(ErrorPart& part, const Case& input, const Result& result);

}  // namespace subimpact
