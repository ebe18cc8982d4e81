#include <fmt/format.h>

#include <iterator>

#include "case/case_choices.h"
#include "case/meshes.h"
#include "io/csv_columns.h"
#include "io/write_file.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/plan.h"
#include "subimpact/io/report.h"

namespace subimpact {
namespace {

constexpr double us = 1e6;  // per second

// The options that make of the case that was asked about the run that is advised.
std::string settings_text(const Case& asked, const PlanPoint& advised) {
  std::string text = "--method " + advised.method;
  for (const CaseKey& key : case_keys()) {
    const std::string table = key.table();
    if (table == "output" || table == "accuracy" || key.name == "solver.method") continue;
    const std::optional<KeyValue> value = key.get(advised.input);
    if (value == key.get(asked)) continue;
    const auto* word = value ? std::get_if<std::string>(&*value) : nullptr;
    text += fmt::format(" --set {}={}", key.name,
                        word    ? *word
                        : value ? to_text(*value)
                                : "default");
  }
  return text;
}

// "nystrom/graded-elements"
std::string sequence_of(const PlanPoint& point) {
  const ModelOptions& model = point.input.model;
  return fmt::format("{}/{}{}", point.method, model.strike_refinement != 1.0 ? "graded-" : "",
                     descriptor_of(model.mesh).refinement->parts);
}

}  // namespace

std::string plan_reference_table(const Plan& plan) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "reference: {}, {}\n", plan.reference.result.used.mesh,
                 name_of(plan.reference.input.solver.method));
  fmt::format_to(out, "{:>4} {:>14} {:>14} {:>11}\n", "no.", "start, us", "end, us", "+- us");
  for (std::size_t i = 0; i < plan.sub_impacts.size(); ++i) {
    const SubImpact& s = plan.sub_impacts[i];
    fmt::format_to(out, "{:>4} {:>14.5f} {:>14} {:>11.1e}\n", i + 1, s.start * us,
                   s.end ? fmt::format("{:.5f}", *s.end * us) : "(open)",
                   us * s.end_error.value_or(s.start_error.value_or(0.0)));
  }
  return fmt::to_string(text);
}

std::string plan_table(const Plan& plan) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{:>44} {:<20} {:<12} {:>12} {:>9} {:>11}\n", "mesh", "method", "verdict",
                 "error, us", "work", "wall time");
  for (const PlanPoint& point : plan.points) {
    fmt::format_to(out, "{:>44} {:<20} {:<12} {:>12.2e} {:>9.1e} {:>11} {}\n", point.mesh,
                   point.method, to_string(point.verdict), point.errors.maximum * us, point.work,
                   duration_text(point.seconds),
                   point.admitted ? "within, as are all finer ones"
                   : point.within ? "within by chance: a finer one is not"
                                  : "not within");
  }
  if (plan.cheapest) {
    const PlanPoint& best = plan.points[*plan.cheapest];
    fmt::format_to(out,
                   "\ncheapest within {:g} us in all: {}, {}: {}, error {:.1e} us beside a "
                   "reference known to {:.1e} us; with this case, run\n  {}\n",
                   plan.wanted * us, best.mesh, best.method, duration_text(best.seconds),
                   best.errors.maximum * us, plan.reference_error * us,
                   settings_text(plan.asked, best));
  } else {
    fmt::format_to(out, "\nno mesh that was tried is within {:g} us together with all finer ones\n",
                   plan.wanted * us);
  }
  fmt::format_to(out, "judged up to {:.3f} us ({})\n", plan.horizon * us, plan.horizon_reason);
  return fmt::to_string(text);
}

void write_plan(const std::filesystem::path& directory, const Plan& plan) {
  const Columns<SubImpact> reference = {
      {"index", [](const SubImpact&, std::size_t i) { return i + 1; }},
      {"start_s", &SubImpact::start},
      {"end_s", &SubImpact::end},
      {"start_error_s", &SubImpact::start_error},
      {"end_error_s", &SubImpact::end_error}};
  write_file(directory / "reference.csv", csv_text(reference, plan.sub_impacts));
  const Columns<PlanPoint> points = {
      {"sequence", [](const PlanPoint& p) { return sequence_of(p); }},
      {"mesh", &PlanPoint::mesh},
      {"method", &PlanPoint::method},
      {"verdict", [](const PlanPoint& p) { return p.verdict; }},
      {"error_s", [](const PlanPoint& p) { return p.errors.maximum; }},
      {"within", [](const PlanPoint& p) { return p.within ? 1 : 0; }},
      {"admitted", [](const PlanPoint& p) { return p.admitted ? 1 : 0; }},
      {"cheapest", [&](const PlanPoint&, std::size_t i) { return plan.cheapest == i ? 1 : 0; }},
      {"counted_work", &PlanPoint::work},
      {"wall_s", &PlanPoint::seconds}};
  write_file(directory / "plan.csv", csv_text(points, plan.points));
}

}  // namespace subimpact
