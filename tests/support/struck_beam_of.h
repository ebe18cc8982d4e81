#pragma once

#include <memory>
#include <utility>

#include "model/contact/contact_laws.h"
#include "system/struck_beam.h"

namespace subimpact {

/// A beam struck by the striker of a scene, with the scene's contact law.
inline StruckBeam struck_beam_of(const Scene& scene, std::shared_ptr<const BeamMesh> mesh,
                                 SectionField sections) {
  BandedSolver solver(mesh->mass());
  return StruckBeam(StruckBeamParts{std::move(mesh), std::move(sections), make_contact_law(scene),
                                    scene.striker.mass, scene.striker.velocity,
                                    0.5 * scene.beam.youngs_modulus * scene.beam.thickness,
                                    std::move(solver), 0.0, scene.beam.damping});
}

}  // namespace subimpact
