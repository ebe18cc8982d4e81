#include "stability/steps.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <random>

#include "integrate/central_difference.h"
#include "integrate/sundials.h"
#include "numerics/bracketed_root.h"
#include "simulate/run_parts.h"
#include "stability/coefficients.h"
#include "stability/free_vibration.h"
#include "study/method_choice.h"
#include "study/parallel.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/simulate/options.h"
#include "subimpact/study/model.h"
#include "system/contact/contact_resonance.h"

namespace subimpact {
namespace {

constexpr int n_steps = 32;  // of a trial
// omega h: looked at from the first to the last in these factors, then halved.
constexpr double first_angle = 0.05;
constexpr double last_angle = 30.0;
constexpr double scan_factor = 1.02;
constexpr double limit_tolerance = 2e-11;  // relative
constexpr double fine_scan = 1e-4;

// The smallest angle whose growth is not tolerated; `last_angle` if there is none.
double first_unstable(const std::function<double(double)>& growth) {
  const auto is_stable = [&](double angle) { return !(growth(angle) > 1.0 + tolerated_growth); };
  double stable = 0.0;
  double unstable = first_angle;
  while (is_stable(unstable)) {
    stable = unstable;
    unstable *= scan_factor;
    if (unstable > last_angle) return last_angle;
  }
  return bisect(is_stable, stable, unstable, limit_tolerance).second;
}

std::vector<std::string> explicit_methods() {
  std::vector<std::string> methods = {"central-difference"};
  for (const MethodTable& table : method_tables()) {
    if (table.method == Method::erk || table.method == Method::nystrom) {
      methods.push_back(std::string(to_string(table.method)) + ":" + table.name);
    }
  }
  return methods;
}

// Growth a step from the coefficients, as a function of omega h.
std::function<double(double)> predicted_growth(const std::string& method) {
  const Case chosen = with_method({}, method);
  const std::string table = chosen.solver.table.value_or("");
  if (chosen.solver.method == Method::erk && !table.empty()) {
    return [table](double y) { return std::abs(explicit_stability(table, {0.0, y})); };
  }
  if (chosen.solver.method == Method::nystrom && !table.empty()) {
    return [table](double y) { return nystrom_growth(table, y); };
  }
  throw InvalidCase("solver.method", "is \"" + method +
                                         "\", which has no stability limit to look for; allowed: "
                                         "central-difference, or erk or nystrom with a table");
}

// Odd, as one half of a symmetric beam needs.
int odd(double segments) { return 2 * static_cast<int>(segments / 2.0) + 1; }

constexpr double newton_tolerance = 1e-10;  // of implicit methods
constexpr int angles_a_decade = 4;

constexpr int n_steps_in_contact = 600;
constexpr double blown_up = 1e6;  // of the energy at the start; bounded motion stays near it
constexpr double contact_tolerance = 1e-4;  // relative
constexpr double decades[] = {-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5, 2.0};

// Beam and striker, held together by a spring that pulls as well as it pushes.
StruckBeam held_together(const Case& input, double stiffness) {
  Case trial = with_method(input, "central-difference");
  trial.model.section = SectionKind::elastic;
  trial.scene.contact = {};
  trial.parts.contact_law = nullptr;
  trial.scene.contact.kind = ContactKind::linear;
  trial.scene.contact.stiffness = stiffness;
  trial.scene.striker.nose_radius.reset();
  StruckBeam beam = make_struck_beam(problem_of(trial), trial, Coordinates::of_mesh);
  beam.contact().set(ContactBranch::elastic, {});
  return beam;
}

// Whether central differences blow up from a state that holds something of every mode.
bool blows_up(StruckBeam& beam, double step) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> velocity(-1.0, 1.0);
  const std::size_t n = beam.n_positions();
  State y(2 * n, 0.0);
  for (std::size_t i = n; i < 2 * n; ++i) y[i] = velocity(random);
  double size = 0.0;
  for (const double v : y) size += v * v;
  CentralDifference method(beam, step);
  method.restart(0.0, y);
  for (int i = 0; i < n_steps_in_contact; ++i) method.step();
  double end = 0.0;
  for (std::size_t i = n; i < 2 * n; ++i) end += method.state()[i] * method.state()[i];
  return !(end < blown_up * size);
}

}  // namespace

static bool is_central(const std::string& method) {
  return with_method({}, method).solver.method == Method::central_difference;
}

double stability_limit(const std::string& method) {
  if (is_central(method)) return 2.0;
  return first_unstable(predicted_growth(method));
}

std::vector<Resonance> resonances(const std::string& method) {
  std::vector<Resonance> list;
  if (is_central(method)) return list;
  const auto growth = predicted_growth(method);
  const double limit = stability_limit(method);
  bool inside = false;
  for (double y = fine_scan; y < limit - 2.0 * fine_scan; y += fine_scan) {
    const double here = growth(y);
    const bool grows = here > 1.0 + tolerated_growth;
    if (grows && !inside) list.push_back({y, y, here});
    if (grows) {
      list.back().to = y;
      list.back().growth = std::max(list.back().growth, here);
    }
    inside = grows;
  }
  return list;
}

std::vector<CriticalStep> critical_steps(const Case& input, const std::vector<std::string>& methods,
                                         Jobs jobs) {
  std::vector<CriticalStep> list;
  for (const std::string& method : explicit_methods()) {
    if (!asked_for(methods, method)) continue;
    const double limit = stability_limit(method);
    for (const BeamTheory theory :
         {BeamTheory::rayleigh, BeamTheory::euler_bernoulli, BeamTheory::timoshenko}) {
      for (const double part : {0.2, 0.4, 0.8, 1.6}) {
        CriticalStep row;
        row.method = method;
        row.theory = theory;
        row.segments = std::max(9, odd(part * input.model.segments));
        row.limit = limit;
        list.push_back(row);
      }
    }
  }
  in_parallel(list.size(), jobs, [&](std::size_t i) {
    CriticalStep& row = list[i];
    Case trial = with_method(input, row.method);
    trial.scene.beam.theory = row.theory;
    if (trial.scene.beam.shears() && !trial.scene.beam.poisson)
      trial.scene.beam.poisson = usual_poisson;
    trial.model.segments = row.segments;
    FreeVibration beam(trial);
    row.highest_frequency = beam.highest_frequency();
    row.predicted = row.limit / row.highest_frequency;
    const std::size_t top = beam.n_modes() - 1;
    const double angle = first_unstable(
        [&](double y) { return beam.growth(top, y / row.highest_frequency, n_steps); });
    row.measured = angle / row.highest_frequency;
  });
  return list;
}

std::vector<StiffContact> stiff_contact(const Case& input, Jobs jobs) {
  std::vector<StiffContact> list(std::size(decades));
  in_parallel(list.size(), jobs, [&](std::size_t i) {
    StiffContact& row = list[i];
    Case trial = with_method(input, "central-difference");
    trial.model.section = SectionKind::elastic;
    const double beam_alone = resolve(trial).settings().highest_frequency;
    row.beam_only = 2.0 / beam_alone;
    // The unit is the spring that alone oscillates as fast as the mesh on a cell's mass.
    const double cell_mass = trial.scene.beam.mass() / trial.model.segments;
    row.stiffness = std::pow(10.0, decades[i]) * cell_mass * beam_alone * beam_alone;
    StruckBeam beam = held_together(trial, row.stiffness);
    row.predicted =
        2.0 / contact_resonance(beam, std::numeric_limits<double>::infinity()).highest_frequency;
    const auto is_stable = [&](double step) { return !blows_up(beam, step); };
    row.measured =
        bisect(is_stable, 0.05 * row.predicted, 1.5 * row.beam_only, contact_tolerance).first;
  });
  return list;
}

std::vector<Damping> damping_of_implicit_tables(const Case& input, Jobs jobs) {
  std::vector<Damping> list;
  for (const MethodTable& table : method_tables()) {
    if (table.method != Method::dirk) continue;
    for (int i = -angles_a_decade; i <= 2 * angles_a_decade; ++i) {
      const double angle = std::pow(10.0, static_cast<double>(i) / angles_a_decade);
      list.push_back(
          {"dirk:" + table.name, angle, std::abs(dirk_stability(table.name, {0.0, angle})), 0.0});
    }
  }
  in_parallel(list.size(), jobs, [&](std::size_t i) {
    Case trial = with_method(input, list[i].method);
    trial.solver.rtol = newton_tolerance;
    FreeVibration beam(trial);
    // Any mode will do: only omega h counts.
    const std::size_t mode = beam.n_modes() / 2;
    list[i].measured = beam.growth(mode, list[i].angle / beam.frequency(mode), 1);
  });
  return list;
}

std::vector<MultistepGrowth> bdf_growths() {
  std::vector<MultistepGrowth> list;
  for (int order = 1; order <= 5; ++order) {
    for (int i = -32; i <= 64; ++i) {
      const double angle = std::pow(10.0, i / 32.0);
      list.push_back({order, angle, bdf_growth(order, angle)});
    }
  }
  return list;
}

}  // namespace subimpact
