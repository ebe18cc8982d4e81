#include <fmt/format.h>

#include "simulate/methods.h"
#include "subimpact/simulate/result.h"

namespace subimpact {
namespace {

std::string text_of(EventHandling events) {
  if (events == EventHandling::library) return "library";
  return events == EventHandling::located ? "located" : "interpolated";
}
std::string text_of(ReversalHandling reversals) {
  return reversals == ReversalHandling::located ? "located" : "step-end";
}
std::string text_of(const std::string& text) { return text; }
template <class Number>
std::string text_of(Number number) {
  return fmt::format("{:.6g}", static_cast<double>(number));
}
template <class Value>
std::string text_of(const std::optional<Value>& value) {
  return value ? text_of(*value) : "-";
}

}  // namespace

std::string Result::brief_report() const {
  return fmt::format("{} at {:.6g} s: {} sub-impacts, energy error {:.1e}, {} steps, {:.3g} s",
                     to_string(outcome.kind), outcome.time, sub_impacts.size(), max_energy_error,
                     work.steps, work.wall_seconds);
}

std::string Result::full_report() const {
  std::string text = brief_report() + "\n" + outcome.message + "\n";
  for (const std::string& warning : warnings) text += warning + "\n";
  const auto row = [&](const char* name, const std::string& asked, const std::string& in_force) {
    text += fmt::format("{:<24} {:>16}  {}\n", name, asked, in_force);
  };
  row("", "given", "used");
  row("method", descriptor_of(given.solver.method).name, descriptor_of(given.solver.method).name);
  row("table", text_of(given.solver.table), text_of(used.table));
  row("highest order", text_of(given.solver.max_order), text_of(used.max_order));
  row("step, s", text_of(given.solver.step), used.step ? text_of(*used.step) : "adaptive");
  row("tolerance", text_of(given.solver.rtol),
      fmt::format("{:.3g} m, {:.3g} m/s", used.position_tolerance, used.velocity_tolerance));
  row("events", text_of(given.solver.events), text_of(used.events));
  row("reversals", text_of(given.solver.reversals), text_of(used.reversals));
  row("energy error allowed", text_of(given.accuracy.energy), text_of(used.energy_tolerance));
  row("end, s", text_of(given.end_time), text_of(outcome.time));
  row("mesh", "", used.mesh);
  row("section", "", used.section);
  row("contact law", "", used.contact_law);
  row("critical step, s", "", text_of(used.critical_step));
  row("set-up, whole, s", "", fmt::format("{:.3g}, {:.3g}", work.setup_seconds, work.wall_seconds));
  return text;
}

std::string_view to_string(OutcomeKind kind) {
  static constexpr std::string_view names[] = {"completed",    "stopped",    "inaccurate",
                                               "unstable",     "chattering", "solver-failed",
                                               "left-validity"};
  return names[static_cast<std::size_t>(kind)];
}

std::string_view to_string(NearMissKind kind) {
  return kind == NearMissKind::opening ? "opening" : "closing";
}

void assign_zones(std::vector<SubImpact>& sub_impacts, double zone_gap, double subzone_gap) {
  int zone = 0;
  int subzone = 0;
  const SubImpact* previous = nullptr;
  for (SubImpact& here : sub_impacts) {
    const double gap = previous && previous->end ? here.start - *previous->end : 0.0;
    if (!previous || gap >= zone_gap) {
      ++zone;
      subzone = 1;
    } else if (gap >= subzone_gap) {
      ++subzone;
    }
    here.zone = zone;
    here.subzone = subzone;
    previous = &here;
  }
}

}  // namespace subimpact
