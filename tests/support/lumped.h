#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "integrate/central_difference.h"
#include "integrate/exponential.h"
#include "integrate/nystrom.h"
#include "integrate/sundials.h"
#include "lumped_mesh.h"
#include "model/mesh/modal_mesh.h"
#include "simulate/loop/event_loop.h"
#include "simulate/records/recorder.h"
#include "struck_beam_of.h"
#include "system/contact/contact_events.h"
#include "system/modal_beam.h"

namespace subimpact {

/// Two bodies and the law between them.
struct TwoBodies {
  double striker_mass = 1.0, target_mass = 1.0;
  double spring = 0.0;              ///< of the target, N/m
  double contact_stiffness = 1e8;   ///< K, N/m^1.5
  double yield_indentation = 1e30;  ///< lambda_s, m
  double velocity = 1.0;            ///< of the striker, m/s

  double reduced_mass() const { return striker_mass * target_mass / (striker_mass + target_mass); }
  /// d_max of an elastic impact on a free target.
  double largest_indentation() const {
    return std::pow(1.25 * reduced_mass() * velocity * velocity / contact_stiffness, 0.4);
  }
  /// Duration of an elastic impact on a free target.
  double duration() const { return 2.943275184 * largest_indentation() / velocity; }

  /// `in_modes`: on the target's natural mode, as the exponential method needs it.
  StruckBeam make(bool in_modes = false) const {
    Scene scene;  // whose contact law has these two constants: b = h = 1 m, R = 1/2 m
    scene.beam.length = scene.beam.width = scene.beam.thickness = 1.0;
    scene.beam.density = target_mass;
    scene.beam.youngs_modulus = 0.75 * contact_stiffness;
    scene.beam.yield_stress = yield_indentation * scene.beam.youngs_modulus;
    scene.striker = {
        .mass = striker_mass, .nose_radius = 0.5, .velocity = velocity, .position = 0.5};
    std::unique_ptr<BeamMesh> mesh = std::make_unique<LumpedMesh>(target_mass);
    if (in_modes) mesh = std::make_unique<ModalMesh>(std::move(mesh), spring);
    return struck_beam_of(scene, std::move(mesh), SectionField(1, spring));
  }
};

/// How a two-body problem is integrated.
struct Way {
  /// Of erk or nystrom, "dirk:" and a table, or a method without tables.
  std::string table = "dop853";
  double rtol = 1e-10;
  std::optional<double> fixed_step;
  EventHandling events = EventHandling::located;

  bool in_modes() const { return table == "exponential"; }

  std::unique_ptr<Integrator> make(StruckBeam& beam) const {
    if (in_modes()) {
      return std::make_unique<Exponential>(std::make_unique<ModalBeam>(beam),
                                           IntegratorOptions{rtol, fixed_step});
    }
    if (table == "central-difference") {
      return std::make_unique<CentralDifference>(beam, fixed_step.value());
    }
    if (table.rfind("dprkn", 0) == 0) {
      return std::make_unique<Nystrom>(beam, IntegratorOptions{rtol, fixed_step, {}, table});
    }
    IntegratorOptions options;
    options.relative_tolerance = rtol;
    options.fixed_step = fixed_step;
    if (events == EventHandling::library) {
      options.event_functions = std::make_shared<ContactEventFunctions>(beam, true);
    }
    if (table == "adams" || table == "bdf") {
      options.max_order = table == "bdf" ? bdf_order_limit : adams_order_limit;
      return table == "bdf" ? make_cvode_bdf(beam, options) : make_cvode_adams(beam, options);
    }
    const std::size_t colon = table.find(':');
    options.table = table.substr(colon == std::string::npos ? 0 : colon + 1);
    if (table.rfind("dirk:", 0) == 0) return make_arkode_dirk(beam, options);
    return make_arkode_erk(beam, options);
  }
};

/// A state [w, w_m, v, v_m] in the beam's own unknowns.
inline State in_unknowns_of(const StruckBeam& beam, const State& y) {
  const auto* modal = dynamic_cast<const ModalMesh*>(&beam.mesh());
  if (modal == nullptr) return y;
  State z = y;
  modal->to_modal({&y[0], 1}, {&z[0], 1});
  modal->to_modal({&y[2], 1}, {&z[2], 1});
  return z;
}

/// Runs from a state [w, w_m, v, v_m], or from the first touch if it is empty.
inline Result run_two_bodies(StruckBeam& beam, const Way& way, double end_time,
                             const State& from = {}, AuditLimits limits = {}) {
  const auto integrator = way.make(beam);
  Result result;
  const State initial = from.empty() ? beam.initial_state() : in_unknowns_of(beam, from);
  Audit audit(beam, initial, limits);
  Recorder recorder(beam, 0.0, way.events, audit, result);
  EventLoop loop(beam, *integrator, recorder, audit,
                 {end_time, way.events, std::numeric_limits<double>::infinity(), 1e30});
  if (from.empty()) {
    loop.start();
  } else {
    if (beam.contact().is_closed()) {
      const Transition begins{0.0, EventKind::contact_begins, {}, beam.indentation(initial)};
      recorder.before_event(begins, initial, beam);
      recorder.after_event(begins, initial, beam);
    }
    loop.start_from(initial);
  }
  while (!loop.finished()) loop.advance();
  recorder.finish(loop.time(), loop.state(), beam, true);
  return result;
}

}  // namespace subimpact
