#pragma once

#include <memory>
#include <optional>

#include "ode/integrator.h"
#include "simulate/event_loop.h"
#include "subimpact/case/case.h"
#include "subimpact/case/simulate.h"
#include "subimpact/model/contact_law.h"
#include "subimpact/model/fibres.h"
#include "subimpact/simulate/result.h"
#include "system/struck_beam.h"

namespace subimpact {

/// Whether a section of the beam may ever yield.
bool may_yield(const Case& input);

/// Whether the case is modelled by one half.
bool uses_symmetry(const Case& input);

/// The contact law of a case: its own part, or the one that the scene names.
std::shared_ptr<const ContactLaw> contact_law_of(const Case& input);
/// Likewise the fibres of its sections; nothing where it asks for an elastic rectangle.
std::optional<Fibres> fibres_of(const Case& input);

/// In which unknowns a beam is integrated.
enum class Coordinates {
  chosen,  ///< natural modes for an elastic beam where the method asks for them or they are cheaper
  of_mesh  ///< the mesh's own
};

/// The struck beam of a case. Throws InvalidCase where mesh and scene do not go together. `storage`
/// is for comparisons of lazily and eagerly stored sections.
StruckBeam make_struck_beam(const Case& input,
                            SectionField::Storage storage = SectionField::Storage::when_yielded,
                            Coordinates coordinates = Coordinates::chosen);

/// What is derived from the case. Throws InvalidCase for settings that do not go together and
/// for a step beyond the stability limit.
Used describe(const Case& input, const StruckBeam& beam);

/// How the event loop is to treat the case.
LoopOptions loop_options(const Case& input, const Used& used);

/// What the run's accounts must come up to.
AuditLimits audit_limits(const Used& used);

/// The integrator the case asks for.
std::unique_ptr<Integrator> make_integrator(const Case& input, const Used& used, StruckBeam& beam);

}  // namespace subimpact
