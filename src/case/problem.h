#pragma once

#include <memory>
#include <optional>
#include <span>

#include "model/contact/contact_laws.h"
#include "subimpact/case/simulate.h"

namespace subimpact {

/// A bending law of sections that a case can name: a row in problem.cpp and a factory of Fibres.
struct SectionDescriptor {
  SectionKind kind;
  const char* name;  ///< in case files
  const char* note;
  bool has_layers;  ///< whether model.layers has an effect: an error that more layers reduce
  /// Nothing: never yields.
  std::optional<Fibres> (*make)(const ModelOptions& model, const Beam& beam);
};

std::span<const SectionDescriptor> sections();
const SectionDescriptor& descriptor_of(SectionKind kind);

/// The beam that a run has: the case's; a plane so stiff that each sub-impact is a zone by itself,
/// and with sizes for its picture in place of those it has not: nothing else depends on them.
Beam sized_beam(const Case& input);
bool may_yield(const Case& input);

/// Whether the scene is its own mirror image about mid-span, where it is struck.
bool is_symmetric(const Case& input);
bool uses_symmetry(const Case& input);

/// The largest step that is left a margin to the critical step of the case, whatever its own step.
double largest_stable_step(Case input);

/// The keys that give the section its height and its width.
const char* height_key(const Beam& beam);
const char* width_key(const Beam& beam);

const ContactConstants& constants_given(const Case& input, const BuiltInContactLaw& law);
bool uses_key(const ContactConstants& way, const char* key);

/// "cylindrical nose of 10 mm, law foundation"; empty with a law that is the caller's own.
std::string contact_words(const Case& input);

/// The contact law of a case: its own part, or the one that the scene names.
std::shared_ptr<const ContactLaw> contact_law_of(const Case& input);

}  // namespace subimpact
