#include "contestants.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "peer.h"
#include "simulate/run_parts.h"
#include "subimpact/study/judgement/event_errors.h"

namespace subimpact::peers {
namespace {

constexpr double us = 1e-6;

Case with(const Case& input, Method method, const std::string& table, double rtol) {
  Case changed = input;
  changed.solver.method = method;
  if (!table.empty()) changed.solver.table = table;
  changed.solver.rtol = rtol;
  return changed;
}

Attempt attempt_of(std::string text, const Case& input) {
  return {.text = std::move(text), .run = [input] { return simulate(input); }};
}

// Tolerances, a half or a whole decade apart.
std::vector<double> tolerances(double from, double to, double factor) {
  std::vector<double> list;
  const int steps = static_cast<int>(std::lround(std::log(to / from) / std::log(factor)));
  for (int i = 0; i <= steps; ++i) list.push_back(from * std::pow(factor, i));
  return list;
}

bool is_elastic(const Case& input) { return input.model.section == SectionKind::elastic; }

std::vector<Attempt> by_tolerance(const Case& input, Method method, const std::string& table) {
  std::vector<Attempt> sweep;
  for (const double rtol : tolerances(1e-4, 1e-10, is_elastic(input) ? 0.316227766 : 0.1)) {
    sweep.push_back(attempt_of(fmt::format("rtol {:.0e}", rtol), with(input, method, table, rtol)));
  }
  return sweep;
}

Contestant own(const Case& input, const char* name, Method method,
               const std::vector<std::string>& tables) {
  Contestant contestant{.name = name, .ours = true, .sweeps = {}};
  for (const std::string& table : tables) {
    contestant.sweeps.push_back(by_tolerance(input, method, table));
    for (Attempt& attempt : contestant.sweeps.back()) {
      if (!table.empty()) attempt.text = table + ", " + attempt.text;
    }
  }
  return contestant;
}

Contestant central_difference(const Case& input) {
  Contestant contestant{.name = "subimpact central-difference", .ours = true, .sweeps = {{}}};
  Case changed = input;
  changed.solver.method = Method::central_difference;
  const double critical = resolve(changed).settings().critical_step;
  for (int i = 0; i <= 10; ++i) {
    const double part = 0.9 * std::pow(0.6, i);
    changed.solver.step = part * critical;
    contestant.sweeps[0].push_back(
        attempt_of(fmt::format("step {:.3g} us", part * critical / us), changed));
  }
  return contestant;
}

// Where sections yield: accounts of sections as here, or at the ends of steps, which must then be
// short.
struct SectionWay {
  ReversalHandling reversals;
  std::vector<std::pair<double, std::optional<double>>> steps;  // rtol, longest step in s
};
std::vector<SectionWay> section_ways(const Case& input) {
  const auto located = ReversalHandling::located;
  SectionWay corrected{located, {}};
  if (is_elastic(input)) {
    for (const double rtol : tolerances(1e-4, 1e-10, 0.316227766)) {
      corrected.steps.push_back({rtol, {}});
    }
    return {corrected};
  }
  for (const double rtol : tolerances(1e-5, 1e-10, 0.1)) corrected.steps.push_back({rtol, {}});
  SectionWay at_ends{ReversalHandling::step_end, {}};
  for (const double rtol : {1e-6, 1e-7, 1e-8}) at_ends.steps.push_back({rtol, {}});
  SectionWay capped{ReversalHandling::step_end,
                    {{1e-7, 0.1 * us}, {1e-8, 0.05 * us}, {1e-9, 0.025 * us}, {1e-9, 0.0125 * us}}};
  return {corrected, at_ends, capped};
}

std::string text_of(double rtol, std::optional<double> longest) {
  const std::string cap = longest ? fmt::format(", steps up to {:.3g} us", *longest / us) : "";
  return fmt::format("rtol {:.0e}{}", rtol, cap);
}

// Peers as their users have them, and where sections yield once more with the section correction of
// this program.
bool is_corrected(const SectionWay& way, const Case& input) {
  return !is_elastic(input) && way.reversals == ReversalHandling::located;
}
Contestant& of_way(std::vector<Contestant>& list, const std::string& name, const SectionWay& way,
                   const Case& input) {
  const std::string full = is_corrected(way, input) ? name + ", section correction" : name;
  for (Contestant& contestant : list) {
    if (contestant.name == full) return contestant;
  }
  return list.emplace_back(Contestant{.name = full, .ours = false, .sweeps = {}});
}

// A peer in this program's loop.
void add_in_loop(std::vector<Contestant>& list, const Case& input, const Peer& peer) {
  for (const SectionWay& way : section_ways(input)) {
    auto& sweep = of_way(list, peer.name, way, input).sweeps.emplace_back();
    for (const auto& [rtol, longest] : way.steps) {
      Case changed = with(input, Method::erk, {}, rtol);
      changed.solver.reversals = way.reversals;
      const StepControl control{rtol, longest};
      sweep.push_back({.text = text_of(rtol, longest), .run = [changed, control, make = peer.make] {
                         ResolvedRun run = resolve(changed);
                         run.parts().complete();
                         const auto integrator = make(run.parts().beam, control);
                         return simulate(run.parts(), *integrator);
                       }});
    }
  }
}

// SUNDIALS as packaged: its vector operations, its root-finding.
void add_plain_sundials(std::vector<Contestant>& list, const Case& input, const char* name,
                        Method method, const std::string& table) {
  for (const SectionWay& way : section_ways(input)) {
    // A multistep method that stops at every section event begins again at order one each time.
    if (method == Method::adams && is_corrected(way, input)) continue;
    auto& sweep = of_way(list, name, way, input).sweeps.emplace_back();
    for (const auto& [rtol, longest] : way.steps) {
      if (method == Method::adams && rtol > 1.1e-7) continue;  // grows without bound
      Case changed = with(input, method, table, rtol);
      changed.solver.events = EventHandling::library;
      changed.solver.reversals = way.reversals;
      changed.solver.max_step = longest;
      changed.study.vector_operations = VectorOperationsKind::library;
      sweep.push_back(attempt_of(text_of(rtol, longest), changed));
    }
  }
}

}  // namespace

std::vector<Contestant> contestants(const Case& input, std::vector<std::string>& skipped) {
  std::vector<Contestant> list;
  list.push_back(own(input, "subimpact exponential", Method::exponential, {""}));
  list.push_back(own(input, "subimpact nystrom", Method::nystrom, {"dprkn8", "dprkn12"}));
  list.push_back(own(input, "subimpact erk", Method::erk, {"dop853", "dormand-prince"}));
  list.push_back(central_difference(input));
  const auto add = [&](const char* library, const std::vector<Peer>& peers) {
    if (peers.empty()) skipped.emplace_back(library);
    for (const Peer& peer : peers) add_in_loop(list, input, peer);
  };
  add("Boost.odeint", odeint_peers());
  add("GSL", gsl_peers());
  add("PETSc", petsc_peers());
  add_plain_sundials(list, input, "ARKODE dormand-prince", Method::erk, "dormand-prince");
  add_plain_sundials(list, input, "ARKODE dop853", Method::erk, "dop853");
  add_plain_sundials(list, input, "CVODE Adams", Method::adams, {});
  return list;
}

void judge(Attempt& attempt, const std::vector<SubImpact>& found,
           const std::vector<SubImpact>& reference) {
  const EventErrors errors = event_errors(found, reference);
  attempt.error = errors.overall();
  attempt.right = errors.all_correspond();
}

Contestant read_contestant(const std::string& name, const std::string& file,
                           const std::vector<SubImpact>& reference) {
  Contestant contestant{.name = name, .ours = false, .sweeps = {{}}};
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file + ": cannot be read");
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    Attempt attempt;
    std::size_t count = 0;
    words >> attempt.text >> attempt.seconds >> count;
    std::vector<SubImpact> found(count);
    for (SubImpact& hit : found) {
      double end = 0.0;
      words >> hit.start >> end;
      if (end > 0.0) hit.end = end;
    }
    if (!words) throw std::runtime_error(file + ": a line is not of the form expected");
    judge(attempt, found, reference);
    contestant.sweeps[0].push_back(attempt);
  }
  return contestant;
}

}  // namespace subimpact::peers
