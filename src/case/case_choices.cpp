#include "case/case_choices.h"

#include <vector>

#include "case/meshes.h"
#include "case/problem.h"
#include "model/contact_laws.h"
#include "simulate/methods.h"
#include "subimpact/case/case_keys.h"

namespace subimpact {
namespace {

// The names in a table of descriptors.
template <class Enum, class Descriptors>
std::vector<Named<Enum>> names_in(const Descriptors& descriptors) {
  std::vector<Named<Enum>> rows;
  for (const auto& row : descriptors) rows.push_back({row.kind, row.name, row.note});
  return rows;
}

constexpr Named<BeamTheory> beam_theories[] = {
    {BeamTheory::rayleigh, "rayleigh", "with rotary inertia"},
    {BeamTheory::euler_bernoulli, "euler-bernoulli", "without rotary inertia"},
    {BeamTheory::timoshenko, "timoshenko", "with rotary inertia and elastic shear"},
};

constexpr Named<EndSupport> end_supports[] = {
    {EndSupport::free, "free", "neither moment nor shear"},
    {EndSupport::pinned, "pinned", "neither displacement nor moment"},
    {EndSupport::clamped, "clamped", "neither displacement nor rotation"},
};

constexpr Named<CellSpacing> cell_spacings[] = {
    {CellSpacing::cells, "cells", "length/segments: the cells fill the beam"},
    {CellSpacing::points, "points",
     "length/(segments - 1): a whole cell at each end, half of it beyond; as the paper's authors "
     "computed, free ends only"},
};

constexpr Named<SymmetryUse> symmetry_uses[] = {
    {SymmetryUse::automatic, "auto", "one half is modelled if the scene is symmetric"},
    {SymmetryUse::off, "off", "the whole beam is modelled"},
};

constexpr Named<HingeUse> hinge_uses[] = {
    {HingeUse::automatic, "auto", "at the strike and at clamped ends, if the beam may yield"},
    {HingeUse::off, "off", "none: the slope is continuous"},
};

constexpr Named<StopRule> stop_rules[] = {
    {StopRule::end_time, "end", "at time.end"},
    {StopRule::no_more_contact, "no-more-contact",
     "as soon as it is proven that striker and beam never touch again, at time.end at the "
     "latest"},
};

constexpr Named<MassSolverKind> mass_solvers[] = {
    {MassSolverKind::banded, "banded", "own banded factorisation"},
    {MassSolverKind::klu, "klu", "SuiteSparse's general sparse factorisation"},
};

constexpr Named<EventHandling> event_handlings[] = {
    {EventHandling::located, "located", "steps end at events"},
    {EventHandling::interpolated, "interpolated", "event times are interpolated within steps"},
    {EventHandling::library, "library",
     "contact events by the root-finding of SUNDIALS: erk, dirk, imex, adams, bdf"},
};

constexpr Named<ReversalHandling> reversal_handlings[] = {
    {ReversalHandling::located, "located", "located within steps, whose ends are corrected"},
    {ReversalHandling::step_end, "step-end", "section histories advance at step ends only"},
};

constexpr Named<VectorOperationsKind> vector_operations[] = {
    {VectorOperationsKind::project, "project", "SUNDIALS on this project's vector operations"},
    {VectorOperationsKind::library, "library", "SUNDIALS on its own serial vector"},
};

constexpr Named<StrikerUpdate> striker_updates[] = {
    {StrikerUpdate::central, "central", "by central differences, as the beam: second order"},
    {StrikerUpdate::constant_force, "constant-force",
     "by the force at the start of the step: first order; probably the paper's"},
};

}  // namespace

std::span<const Named<BeamTheory>> names_of(BeamTheory) { return beam_theories; }
std::span<const Named<EndSupport>> names_of(EndSupport) { return end_supports; }
std::span<const Named<ContactKind>> names_of(ContactKind) {
  static const auto names = names_in<ContactKind>(built_in_contact_laws());
  return names;
}
std::span<const Named<MeshKind>> names_of(MeshKind) {
  static const auto names = names_in<MeshKind>(meshes());
  return names;
}
std::span<const Named<CellSpacing>> names_of(CellSpacing) { return cell_spacings; }
std::span<const Named<SectionKind>> names_of(SectionKind) {
  static const auto names = names_in<SectionKind>(sections());
  return names;
}
std::span<const Named<SymmetryUse>> names_of(SymmetryUse) { return symmetry_uses; }
std::span<const Named<HingeUse>> names_of(HingeUse) { return hinge_uses; }
std::span<const Named<StopRule>> names_of(StopRule) { return stop_rules; }
std::span<const Named<Method>> names_of(Method) {
  static const auto names = names_in<Method>(methods());
  return names;
}
std::span<const Named<MassSolverKind>> names_of(MassSolverKind) { return mass_solvers; }
std::span<const Named<EventHandling>> names_of(EventHandling) { return event_handlings; }
std::span<const Named<ReversalHandling>> names_of(ReversalHandling) { return reversal_handlings; }
std::span<const Named<VectorOperationsKind>> names_of(VectorOperationsKind) {
  return vector_operations;
}
std::span<const Named<StrikerUpdate>> names_of(StrikerUpdate) { return striker_updates; }

std::string_view to_string(Method method) { return name_of(method); }
std::string_view to_string(EventHandling events) { return name_of(events); }

}  // namespace subimpact
