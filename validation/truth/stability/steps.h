#pragma once

/// The largest stable steps of methods, their damping and their growth, as measured on the beam of
/// a case and as predicted from their coefficients.

#include <string>
#include <vector>

#include "subimpact/study/studies.h"

namespace subimpact {

/// A method counts as stable if no mode's amplitude grows by more than this per step.
constexpr double tolerated_growth = 1e-6;

/// The largest stable step of an explicit method on one mesh of an elastic beam.
struct CriticalStep {
  std::string method;  ///< "central-difference", "erk:dop853"
  BeamTheory theory = BeamTheory::rayleigh;
  int segments = 0;
  double highest_frequency = 0.0;  ///< rad/s, of the mesh
  double limit = 0.0;      ///< of omega h, from the table's coefficients alone (see growth below)
  double predicted = 0.0;  ///< s, limit/highest_frequency
  double measured = 0.0;   ///< s, by stepping the highest mode and bisection
};

/// omega h up to which a method lets no undamped oscillation grow by more than tolerated_growth per
/// step, from its coefficients: central differences 2; Runge-Kutta tables by |R(i omega h)|;
/// Nystroem tables by the spectral radius of a step. Throws InvalidCase for other methods.
double stability_limit(const std::string& method);

/// Narrow ranges of omega h below stability_limit() in which the solution still grows: where a step
/// advances an oscillation by nearly half a period, the two eigenvalues of the step meet and
/// separate again. The search has increments of 1e-4.
struct Resonance {
  double from = 0.0, to = 0.0;  ///< omega h
  double growth = 0.0;          ///< largest, per step
};
std::vector<Resonance> resonances(const std::string& method);

/// Central differences and every explicit table, both beam theories, meshes of about a fifth, two
/// fifths, four fifths and eight fifths of the case's cells.
std::vector<CriticalStep> critical_steps(const Case& input,
                                         const std::vector<std::string>& methods = {},
                                         Jobs jobs = 0);

/// The critical step of central differences while a linear spring holds the striker in contact.
struct StiffContact {
  double stiffness = 0.0;  ///< of the spring, N/m
  double beam_only = 0.0;  ///< s, 2/omega_max without the contact
  double predicted = 0.0;  ///< s, 2/omega_max of beam, spring and striker together
  double measured = 0.0;   ///< s
};
std::vector<StiffContact> stiff_contact(const Case& input, Jobs jobs = 0);

/// The share of an oscillation's amplitude that remains after one step of an implicit table.
struct Damping {
  std::string method;      ///< "dirk:esdirk547"
  double angle = 0.0;      ///< omega h
  double predicted = 0.0;  ///< |R(i omega h)|
  double measured = 0.0;   ///< on a mode of the case's beam
};
std::vector<Damping> damping_of_implicit_tables(const Case& input, Jobs jobs = 0);

/// Growth per step of backward differentiation on an undamped oscillation, from the coefficients.
struct MultistepGrowth {
  int order = 0;
  double angle = 0.0;   ///< omega h
  double growth = 0.0;  ///< above 1: the oscillation grows
};
std::vector<MultistepGrowth> bdf_growths();

}  // namespace subimpact
