#include "case/sections.h"

#include <stdexcept>

namespace subimpact {
namespace {

using Section = std::optional<Fibres>;

constexpr SectionDescriptor rows[] = {
    {SectionKind::elastic, "elastic", "the beam never yields (the contact still may)", false,
     [](const ModelOptions&) -> Section { return std::nullopt; }},
    {SectionKind::layers, "layers", "elastic-perfectly plastic layers, stress at mid-layer", true,
     [](const ModelOptions& model) -> Section { return Fibres::layered(model.layers); }},
    {SectionKind::exact, "exact", "the limit of infinitely many layers, in closed form", false,
     [](const ModelOptions&) -> Section { return Fibres::continuous(); }},
};

}  // namespace

std::span<const SectionDescriptor> sections() { return rows; }

const SectionDescriptor& descriptor_of(SectionKind kind) {
  for (const SectionDescriptor& row : rows) {
    if (row.kind == kind) return row;
  }
  throw std::logic_error("a section has no descriptor: add a row in sections.cpp");
}

}  // namespace subimpact
