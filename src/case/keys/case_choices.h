#pragma once

#include <span>
#include <stdexcept>
#include <string_view>

#include "case/meshes.h"
#include "case/problem.h"
#include "model/contact/contact_laws.h"
#include "simulate/settings/methods.h"

namespace subimpact {

/// An enumerator, its name in case files, and what it stands for.
template <class Enum>
struct Named {
  Enum kind;
  const char* name;
  const char* note;
};

/// The choices of an enumeration; the compiler refuses an enumeration without them.
template <class Enum>
inline constexpr bool choices = false;

template <>
inline constexpr Named<BeamTheory> choices<BeamTheory>[] = {
    {BeamTheory::rayleigh, "rayleigh", "with rotary inertia"},
    {BeamTheory::euler_bernoulli, "euler-bernoulli", "without rotary inertia"},
    {BeamTheory::timoshenko, "timoshenko", "with rotary inertia and elastic shear"},
};

template <>
inline constexpr Named<EndSupport> choices<EndSupport>[] = {
    {EndSupport::free, "free", "neither moment nor shear"},
    {EndSupport::pinned, "pinned", "neither displacement nor moment"},
    {EndSupport::clamped, "clamped", "neither displacement nor rotation"},
};

template <>
inline constexpr Named<AxialEnds> choices<AxialEnds>[] = {
    {AxialEnds::free, "free", "ends may approach each other: no tension"},
    {AxialEnds::held, "held", "ends keep their distance: bending stretches the beam"},
};

template <>
inline constexpr Named<SectionShape> choices<SectionShape>[] = {
    {SectionShape::rectangle, "rectangle", "height, width; or beam.thickness and beam.width"},
    {SectionShape::circle, "circle", "diameter"},
    {SectionShape::tube, "tube", "diameter (outer), wall"},
    {SectionShape::box, "box", "height and width (outer), wall"},
    {SectionShape::i, "i", "height, width, flange, web: about its strong axis"},
};

template <>
inline constexpr Named<NoseShape> choices<NoseShape>[] = {
    {NoseShape::sphere, "sphere", "round both ways"},
    {NoseShape::cylinder, "cylinder", "its axis across the beam, as long as the beam is wide"},
};

template <>
inline constexpr Named<IndentationFrom> choices<IndentationFrom>[] = {
    {IndentationFrom::half_space, "half-space", "as if the beam were a half-space"},
    {IndentationFrom::mid_plane, "mid-plane", "the nose's displacement minus that of the axis"},
};

template <>
inline constexpr Named<BeamStart> choices<BeamStart>[] = {
    {BeamStart::straight, "straight", "without displacement"},
    {BeamStart::equilibrium, "equilibrium", "at rest under the loads of t = 0"},
};

template <>
inline constexpr Named<Face> choices<Face>[] = {
    {Face::front, "front", "the side that is struck"},
    {Face::back, "back", "the side behind"},
};

template <>
inline constexpr Named<CellSpacing> choices<CellSpacing>[] = {
    {CellSpacing::cells, "cells",
     "length/segments: the cells fill the beam, without the rotary inertia of the outer half cells "
     "at free ends"},
    {CellSpacing::whole, "whole", "length/segments, with that inertia; not with shear"},
    {CellSpacing::points, "points",
     "length/(segments - 1): a whole cell at each end, half of it beyond; as the paper's authors "
     "computed, free ends only"},
};

template <>
inline constexpr Named<SymmetryUse> choices<SymmetryUse>[] = {
    {SymmetryUse::automatic, "auto", "one half is modelled if the scene is symmetric"},
    {SymmetryUse::off, "off", "the whole beam is modelled"},
};

template <>
inline constexpr Named<StopRule> choices<StopRule>[] = {
    {StopRule::end_time, "end", "at time.end"},
    {StopRule::no_more_contact, "no-more-contact",
     "as soon as it is proven that striker and beam never touch again, at time.end at the latest"},
};

template <>
inline constexpr Named<EventHandling> choices<EventHandling>[] = {
    {EventHandling::located, "located", "steps end at events"},
    {EventHandling::interpolated, "interpolated", "event times are interpolated within steps"},
    {EventHandling::library, "library",
     "contact events by the root-finding of SUNDIALS: erk, dirk, adams, bdf"},
};

template <>
inline constexpr Named<ReversalHandling> choices<ReversalHandling>[] = {
    {ReversalHandling::located, "located", "located within steps, whose ends are corrected"},
    {ReversalHandling::step_end, "step-end", "section histories advance at step ends only"},
};

template <>
inline constexpr Named<VectorOperationsKind> choices<VectorOperationsKind>[] = {
    {VectorOperationsKind::project, "project", "SUNDIALS on this project's vector operations"},
    {VectorOperationsKind::library, "library", "SUNDIALS on its own serial vector"},
};

template <>
inline constexpr Named<StrikerUpdate> choices<StrikerUpdate>[] = {
    {StrikerUpdate::central, "central", "by central differences, as the beam: second order"},
    {StrikerUpdate::constant_force, "constant-force",
     "by the force at the start of the step: first order; probably the paper's"},
};

// The names of each enumeration of a case, rows like Named; the argument only selects one.
template <class Enum>
std::span<const Named<Enum>> names_of(Enum) {
  return choices<Enum>;
}
inline std::span<const BuiltInContactLaw> names_of(ContactKind) { return built_in_contact_laws(); }
inline std::span<const MeshDescriptor> names_of(MeshKind) { return meshes(); }
inline std::span<const SectionDescriptor> names_of(SectionKind) { return sections(); }
inline std::span<const MethodDescriptor> names_of(Method) { return methods(); }

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
