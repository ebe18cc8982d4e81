#pragma once

#include <optional>
#include <span>

#include "subimpact/case/case.h"

namespace subimpact {

/// A bending law of sections that a case can name: its own row here and a factory of Fibres.
struct SectionDescriptor {
  SectionKind kind;
  const char* name;  ///< in case files
  const char* note;
  bool has_layers;  ///< whether model.layers has an effect: an error that more layers reduce
  /// Nothing: never yields.
  std::optional<Fibres> (*make)(const ModelOptions& model);
};

std::span<const SectionDescriptor> sections();
const SectionDescriptor& descriptor_of(SectionKind kind);

}  // namespace subimpact
