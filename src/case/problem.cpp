#include "case/problem.h"

#include <cmath>

#include "case/meshes.h"
#include "case/sections.h"
#include "model/contact_laws.h"

namespace subimpact {

bool may_yield(const Case& input) {
  return input.model.section != SectionKind::elastic &&
         (input.parts.mesh || descriptor_of(input.model.mesh).bends) &&
         std::isfinite(input.scene.beam.yield_stress);
}

bool uses_symmetry(const Case& input) {
  const auto& ends = input.scene.beam.ends;
  return input.model.symmetry == SymmetryUse::automatic && input.scene.striker.position == 0.5 &&
         ends[0] == ends[1];
}

std::shared_ptr<const ContactLaw> contact_law_of(const Case& input) {
  return input.parts.contact_law ? input.parts.contact_law : make_contact_law(input.scene);
}

Problem problem_of(const Case& input) {
  Problem problem;
  problem.beam = input.scene.beam;
  problem.striker = input.scene.striker;
  problem.mesh = input.parts.mesh ? input.parts.mesh : descriptor_of(input.model.mesh).make(input);
  problem.contact_law = contact_law_of(input);
  problem.contact_damping = input.scene.contact.damping;
  problem.check_contact_law = input.parts.contact_law != nullptr;
  problem.may_yield = may_yield(input);
  problem.section = input.parts.section;
  if (!problem.section && problem.may_yield) {
    problem.section = descriptor_of(input.model.section).make(input.model);
  }
  return problem;
}

}  // namespace subimpact
