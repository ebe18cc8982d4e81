// The strike behind a C interface, for programs in Python: equations, event functions, accounts of
// sections.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string_view>

#include "peer.h"
#include "simulate/run_parts.h"

namespace {

using namespace subimpact;

struct Strike {
  explicit Strike(const Case& input) : run(resolve(input)), equations(run.parts().beam) {
    run.parts().complete();
    beam().contact().set_evaluation(Evaluation::smooth);
    beam().set_section_evaluation(Evaluation::switching);
  }
  StruckBeam& beam() { return run.parts().beam; }
  const State& read(const double* y) {
    equations.from_peer(y, state);
    return state;
  }
  ResolvedRun run;
  peers::Equations equations;
  State state;
};

}  // namespace

// States are [q, tau v] in m over times in tau (see Equations).
extern "C" {

/// `name`: of one of peers::peer_scenes; else null.
void* strike_make(const char* name) {
  const auto scene = std::ranges::find(peers::peer_scenes, std::string_view(name),
                                       [](const auto& s) { return std::string_view(s.name); });
  if (scene == std::end(peers::peer_scenes)) return nullptr;
  Case input = peers::case_of(*scene);
  input.solver.method = Method::erk;
  return new Strike(input);
}
void strike_free(void* strike) { delete static_cast<Strike*>(strike); }
int strike_size(void* strike) {
  return static_cast<int>(static_cast<Strike*>(strike)->equations.size());
}
double strike_unit(void* strike) { return static_cast<Strike*>(strike)->equations.unit(); }
double strike_scale(void* strike) { return static_cast<Strike*>(strike)->equations.scale(); }

/// The state at the first touch; the contact begins.
void strike_start(void* of, double* y) {
  Strike& strike = *static_cast<Strike*>(of);
  const State initial = strike.beam().initial_state();
  strike.beam().commit(initial);
  strike.beam().contact().pass({EventKind::contact_begins}, strike.beam().indentation(initial));
  strike.equations.to_peer(initial, y);
}
void strike_rate(void* strike, const double* y, double* rate) {
  static_cast<Strike*>(strike)->equations(y, rate);
}
/// Values of the event functions of the branch in force, which rise through zero; at most four.
/// Returns how many.
int strike_events(void* of, const double* y, double* values) {
  Strike& strike = *static_cast<Strike*>(of);
  const State& state = strike.read(y);
  const ContactState& contact = strike.beam().contact();
  int n = 0;
  for (const EventFunction& function : contact.event_functions()) {
    if (n == 4) break;
    values[n++] = contact
                      .event_function(function, strike.beam().indentation(state),
                                      strike.beam().indentation_rate(state))
                      .value;
  }
  return n;
}
/// An event has happened at y. Returns 1 where the contact begins, -1 where it ends, else 0.
int strike_pass(void* of, int event, const double* y) {
  Strike& strike = *static_cast<Strike*>(of);
  const State& state = strike.read(y);
  const EventFunction function =
      strike.beam().contact().event_functions()[static_cast<std::size_t>(event)];
  strike.beam().commit(state);
  strike.beam().contact().pass(function, strike.beam().indentation(state));
  if (function.kind == EventKind::contact_begins) return 1;
  return function.kind == EventKind::contact_ends ? -1 : 0;
}
/// A step has ended at y: histories advance.
void strike_commit(void* of, const double* y) {
  Strike& strike = *static_cast<Strike*>(of);
  strike.beam().commit(strike.read(y));
}
}
