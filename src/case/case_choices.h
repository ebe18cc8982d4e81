#pragma once

#include <span>
#include <stdexcept>
#include <string_view>

#include "subimpact/case/case.h"

namespace subimpact {

/// An enumerator, its name in case files, and what it stands for.
template <class Enum>
struct Named {
  Enum value;
  const char* name;
  const char* note;
};

// The names of each enumeration that a case uses; the argument only selects one.
std::span<const Named<BeamTheory>> names_of(BeamTheory);
std::span<const Named<EndSupport>> names_of(EndSupport);
std::span<const Named<ContactKind>> names_of(ContactKind);
std::span<const Named<MeshKind>> names_of(MeshKind);
std::span<const Named<CellSpacing>> names_of(CellSpacing);
std::span<const Named<SectionKind>> names_of(SectionKind);
std::span<const Named<SymmetryUse>> names_of(SymmetryUse);
std::span<const Named<HingeUse>> names_of(HingeUse);
std::span<const Named<StopRule>> names_of(StopRule);
std::span<const Named<Method>> names_of(Method);
std::span<const Named<MassSolverKind>> names_of(MassSolverKind);
std::span<const Named<EventHandling>> names_of(EventHandling);
std::span<const Named<ReversalHandling>> names_of(ReversalHandling);
std::span<const Named<VectorOperationsKind>> names_of(VectorOperationsKind);
std::span<const Named<StrikerUpdate>> names_of(StrikerUpdate);

template <class Enum>
const char* name_of(Enum value) {
  for (const auto& entry : names_of(value)) {
    if (entry.value == value) return entry.name;
  }
  throw std::logic_error("an enumerator of a case has no name: add it in case_choices.cpp");
}

template <class Enum>
Enum value_of(std::string_view name) {
  for (const auto& entry : names_of(Enum{})) {
    if (entry.name == name) return entry.value;
  }
  throw std::logic_error("value_of: the name was not checked against names_of");
}

}  // namespace subimpact
