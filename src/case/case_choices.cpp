#include "case/case_choices.h"

#include <vector>

#include "case/meshes.h"
#include "case/sections.h"
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

}  // namespace

std::span<const Named<BeamTheory>> names_of(BeamTheory) {
  static constexpr Named<BeamTheory> names[] = {
      {BeamTheory::rayleigh, "rayleigh", "with rotary inertia"},
      {BeamTheory::euler_bernoulli, "euler-bernoulli", "without rotary inertia"},
      {BeamTheory::timoshenko, "timoshenko", "with rotary inertia and elastic shear"},
  };
  return names;
}

std::span<const Named<EndSupport>> names_of(EndSupport) {
  static constexpr Named<EndSupport> names[] = {
      {EndSupport::free, "free", "neither moment nor shear"},
      {EndSupport::pinned, "pinned", "neither displacement nor moment"},
      {EndSupport::clamped, "clamped", "neither displacement nor rotation"},
  };
  return names;
}

std::span<const Named<ContactKind>> names_of(ContactKind) {
  static const auto names = names_in<ContactKind>(built_in_contact_laws());
  return names;
}

std::span<const Named<MeshKind>> names_of(MeshKind) {
  static const auto names = names_in<MeshKind>(meshes());
  return names;
}

std::span<const Named<CellSpacing>> names_of(CellSpacing) {
  static constexpr Named<CellSpacing> names[] = {
      {CellSpacing::cells, "cells", "length/segments: the cells fill the beam"},
      {CellSpacing::points, "points",
       "length/(segments - 1): a whole cell at each end, half of it beyond; as the paper's authors "
       "computed, free ends only"},
  };
  return names;
}

std::span<const Named<SectionKind>> names_of(SectionKind) {
  static const auto names = names_in<SectionKind>(sections());
  return names;
}

std::span<const Named<SymmetryUse>> names_of(SymmetryUse) {
  static constexpr Named<SymmetryUse> names[] = {
      {SymmetryUse::automatic, "auto", "one half is modelled if the scene is symmetric"},
      {SymmetryUse::off, "off", "the whole beam is modelled"},
  };
  return names;
}

std::span<const Named<HingeUse>> names_of(HingeUse) {
  static constexpr Named<HingeUse> names[] = {
      {HingeUse::automatic, "auto", "at the strike and at clamped ends, if the beam may yield"},
      {HingeUse::off, "off", "none: the slope is continuous"},
  };
  return names;
}

std::span<const Named<StopRule>> names_of(StopRule) {
  static constexpr Named<StopRule> names[] = {
      {StopRule::end_time, "end", "at time.end"},
      {StopRule::no_more_contact, "no-more-contact",
       "as soon as it is proven that striker and beam never touch again, at time.end at the "
       "latest"},
  };
  return names;
}

std::span<const Named<Method>> names_of(Method) {
  static const auto names = names_in<Method>(methods());
  return names;
}

std::span<const Named<MassSolverKind>> names_of(MassSolverKind) {
  static constexpr Named<MassSolverKind> names[] = {
      {MassSolverKind::banded, "banded", "own banded factorisation"},
      {MassSolverKind::klu, "klu", "SuiteSparse's general sparse factorisation"},
  };
  return names;
}

std::span<const Named<EventHandling>> names_of(EventHandling) {
  static constexpr Named<EventHandling> names[] = {
      {EventHandling::located, "located", "steps end at events"},
      {EventHandling::interpolated, "interpolated", "event times are interpolated within steps"},
      {EventHandling::library, "library",
       "contact events by the root-finding of SUNDIALS: erk, dirk, imex, adams, bdf"},
  };
  return names;
}

std::span<const Named<ReversalHandling>> names_of(ReversalHandling) {
  static constexpr Named<ReversalHandling> names[] = {
      {ReversalHandling::located, "located", "located within steps, whose ends are corrected"},
      {ReversalHandling::step_end, "step-end", "section histories advance at step ends only"},
  };
  return names;
}

std::span<const Named<VectorOperationsKind>> names_of(VectorOperationsKind) {
  static constexpr Named<VectorOperationsKind> names[] = {
      {VectorOperationsKind::project, "project", "SUNDIALS on this project's vector operations"},
      {VectorOperationsKind::library, "library", "SUNDIALS on its own serial vector"},
  };
  return names;
}

std::span<const Named<StrikerUpdate>> names_of(StrikerUpdate) {
  static constexpr Named<StrikerUpdate> names[] = {
      {StrikerUpdate::central, "central", "by central differences, as the beam: second order"},
      {StrikerUpdate::constant_force, "constant-force",
       "by the force at the start of the step: first order; probably the paper's"},
  };
  return names;
}

std::string_view to_string(Method method) { return name_of(method); }
std::string_view to_string(EventHandling events) { return name_of(events); }

}  // namespace subimpact
