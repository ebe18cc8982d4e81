#pragma once

#include <span>
#include <stdexcept>
#include <string_view>

#include "case/meshes.h"
#include "case/problem.h"
#include "model/contact_laws.h"
#include "simulate/methods.h"

namespace subimpact {

/// An enumerator, its name in case files, and what it stands for.
template <class Enum>
struct Named {
  Enum kind;
  const char* name;
  const char* note;
};

// The names of each enumeration that a case uses, with rows as those of Named; the argument only
// selects one.

inline std::span<const BuiltInContactLaw> names_of(ContactKind) { return built_in_contact_laws(); }
inline std::span<const MeshDescriptor> names_of(MeshKind) { return meshes(); }
inline std::span<const SectionDescriptor> names_of(SectionKind) { return sections(); }
inline std::span<const MethodDescriptor> names_of(Method) { return methods(); }

inline constexpr Named<BeamTheory> beam_theories[] = {
    {BeamTheory::rayleigh, "rayleigh", "with rotary inertia"},
    {BeamTheory::euler_bernoulli, "euler-bernoulli", "without rotary inertia"},
    {BeamTheory::timoshenko, "timoshenko", "with rotary inertia and elastic shear"},
};
inline std::span<const Named<BeamTheory>> names_of(BeamTheory) { return beam_theories; }

inline constexpr Named<EndSupport> end_supports[] = {
    {EndSupport::free, "free", "neither moment nor shear"},
    {EndSupport::pinned, "pinned", "neither displacement nor moment"},
    {EndSupport::clamped, "clamped", "neither displacement nor rotation"},
};
inline std::span<const Named<EndSupport>> names_of(EndSupport) { return end_supports; }

inline constexpr Named<CellSpacing> cell_spacings[] = {
    {CellSpacing::cells, "cells", "length/segments: the cells fill the beam"},
    {CellSpacing::points, "points",
     "length/(segments - 1): a whole cell at each end, half of it beyond; as the paper's authors "
     "computed, free ends only"},
};
inline std::span<const Named<CellSpacing>> names_of(CellSpacing) { return cell_spacings; }

inline constexpr Named<SymmetryUse> symmetry_uses[] = {
    {SymmetryUse::automatic, "auto", "one half is modelled if the scene is symmetric"},
    {SymmetryUse::off, "off", "the whole beam is modelled"},
};
inline std::span<const Named<SymmetryUse>> names_of(SymmetryUse) { return symmetry_uses; }

inline constexpr Named<HingeUse> hinge_uses[] = {
    {HingeUse::automatic, "auto", "at the strike and at clamped ends, if the beam may yield"},
    {HingeUse::off, "off", "none: the slope is continuous"},
};
inline std::span<const Named<HingeUse>> names_of(HingeUse) { return hinge_uses; }

inline constexpr Named<StopRule> stop_rules[] = {
    {StopRule::end_time, "end", "at time.end"},
    {StopRule::no_more_contact, "no-more-contact",
     "as soon as it is proven that striker and beam never touch again, at time.end at the latest"},
};
inline std::span<const Named<StopRule>> names_of(StopRule) { return stop_rules; }

inline constexpr Named<MassSolverKind> mass_solvers[] = {
    {MassSolverKind::banded, "banded", "own banded factorisation"},
    {MassSolverKind::klu, "klu", "SuiteSparse's general sparse factorisation"},
};
inline std::span<const Named<MassSolverKind>> names_of(MassSolverKind) { return mass_solvers; }

inline constexpr Named<EventHandling> event_handlings[] = {
    {EventHandling::located, "located", "steps end at events"},
    {EventHandling::interpolated, "interpolated", "event times are interpolated within steps"},
    {EventHandling::library, "library",
     "contact events by the root-finding of SUNDIALS: erk, dirk, imex, adams, bdf"},
};
inline std::span<const Named<EventHandling>> names_of(EventHandling) { return event_handlings; }

inline constexpr Named<ReversalHandling> reversal_handlings[] = {
    {ReversalHandling::located, "located", "located within steps, whose ends are corrected"},
    {ReversalHandling::step_end, "step-end", "section histories advance at step ends only"},
};
inline std::span<const Named<ReversalHandling>> names_of(ReversalHandling) {
  return reversal_handlings;
}

inline constexpr Named<VectorOperationsKind> vector_operations[] = {
    {VectorOperationsKind::project, "project", "SUNDIALS on this project's vector operations"},
    {VectorOperationsKind::library, "library", "SUNDIALS on its own serial vector"},
};
inline std::span<const Named<VectorOperationsKind>> names_of(VectorOperationsKind) {
  return vector_operations;
}

inline constexpr Named<StrikerUpdate> striker_updates[] = {
    {StrikerUpdate::central, "central", "by central differences, as the beam: second order"},
    {StrikerUpdate::constant_force, "constant-force",
     "by the force at the start of the step: first order; probably the paper's"},
};
inline std::span<const Named<StrikerUpdate>> names_of(StrikerUpdate) { return striker_updates; }

template <class Enum>
const char* name_of(Enum value) {
  for (const auto& entry : names_of(value)) {
    if (entry.kind == value) return entry.name;
  }
  throw std::logic_error("an enumerator of a case has no name: add it in case_choices.h");
}

template <class Enum>
Enum value_of(std::string_view name) {
  for (const auto& entry : names_of(Enum{})) {
    if (entry.name == name) return entry.kind;
  }
  throw std::logic_error("value_of: the name was not checked against names_of");
}

}  // namespace subimpact
