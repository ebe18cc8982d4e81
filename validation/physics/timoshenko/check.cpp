// Timoshenko's steel ball on a simply supported steel bar.

#include <fmt/format.h>

#include "outcome.h"
#include "subimpact/case/simulate.h"

namespace subimpact::validation {
namespace {

struct Strike {
  Result result;
  double unit;  // s: 1/180 of the bar's first period
};

Strike strike(const std::vector<std::string>& scene, int segments) {
  std::vector<std::string> settings = scene;
  settings.push_back(fmt::format("model.segments={}", segments));
  const Case input = case_of("timoshenko", settings);
  Strike found{simulate(input), 0.0};
  found.unit = found.result.used.first_period / 180.0;
  return found;
}

}  // namespace

Outcome check_timoshenko() {
  Outcome outcome{"Timoshenko 1913", {}, {}};
  const Strike one = strike({}, 1001);
  const SubImpact& hit = one.result.sub_impacts.at(0);
  outcome.rows = {{"case 1: stiffness K_H, N/m^1.5", 1.580559e10, one.result.used.contact_stiffness,
                   Bound::relative, 1e-6},
                  {"case 1: first period of the bar, s", 9.980961e-4, one.result.used.first_period,
                   Bound::relative, 1e-6},
                  {"case 1: contacts", 1.0, static_cast<double>(one.result.sub_impacts.size()),
                   Bound::absolute, 0.0},
                  {"case 1: contact ends, units (published)", 28.0, hit.end.value() / one.unit,
                   Bound::absolute, 0.5},
                  {"case 1: contact ends, units (recomputed)", 28.206, hit.end.value() / one.unit,
                   Bound::absolute, 0.2},
                  {"case 1: peak force, N", 4.97714, hit.peak_force, Bound::relative, 0.003},
                  {"case 1: impulse, N s", 4.3423e-4, hit.impulse, Bound::relative, 0.003},
                  {"case 1: final velocity of the ball, m/s", -3.023244e-3,
                   one.result.striker_velocity, Bound::relative, 0.003}};
  const std::vector<std::string> doubled = {"beam.length=0.307", "striker.nose_radius=0.02",
                                            "striker.mass=0.2667422"};
  const Strike two = strike(doubled, 1001);
  const auto& hits = two.result.sub_impacts;
  outcome.rows.push_back(
      {"case 2: contacts", 2.0, static_cast<double>(hits.size()), Bound::absolute, 0.0});
  outcome.rows.push_back({"case 2: first contact ends, units", 19.5,
                          hits.at(0).end.value() / two.unit, Bound::absolute, 0.7});
  if (hits.size() > 1) {
    outcome.rows.push_back({"case 2: second contact begins, units", 60.0, hits[1].start / two.unit,
                            Bound::absolute, 0.7});
    outcome.rows.push_back({"case 2: second contact ends, units", 80.0,
                            hits[1].end.value_or(0.0) / two.unit, Bound::absolute, 0.7});
  }
  std::string study =
      "| cells | case 1: end, units | peak, N | impulse, 1e-4 N s | case 2: end | begins | ends |\n"
      "|---|---|---|---|---|---|---|\n";
  for (const int segments : {251, 501, 1001, 2001}) {
    const Strike a = strike({}, segments);
    const Strike b = strike(doubled, segments);
    const SubImpact& first = a.result.sub_impacts.at(0);
    study +=
        fmt::format("| {} | {:.4f} | {:.5f} | {:.5f} | {:.4f} | {} | {} |\n", segments,
                    first.end.value() / a.unit, first.peak_force, 1e4 * first.impulse,
                    b.result.sub_impacts.at(0).end.value() / b.unit,
                    b.result.sub_impacts.size() > 1
                        ? fmt::format("{:.4f}", b.result.sub_impacts[1].start / b.unit)
                        : "-",
                    b.result.sub_impacts.size() > 1
                        ? fmt::format("{:.4f}", b.result.sub_impacts[1].end.value_or(0) / b.unit)
                        : "-");
  }
  outcome.notes.push_back(study);
  return outcome;
}

}  // namespace subimpact::validation
