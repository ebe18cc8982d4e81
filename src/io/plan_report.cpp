#include <fmt/format.h>

#include <iterator>

#include "case/case_choices.h"
#include "case/meshes.h"
#include "io/csv_columns.h"
#include "io/write_file.h"
#include "subimpact/io/plan.h"
#include "subimpact/io/report.h"

namespace subimpact {
namespace {

constexpr double us = 1e6;  // per second

std::string settings_text(const PlanPoint& point) {
  const ModelOptions& model = point.input.model;
  const auto [method, table, events] = parse_method_name(point.run.setting.method);
  std::string text = fmt::format("--method {}", method);
  if (table) text += fmt::format(" --set solver.table={}", *table);
  if (events) text += fmt::format(" --set solver.events={}", *events);
  const MeshDescriptor& mesh = descriptor_of(model.mesh);
  text += fmt::format(" --set model.mesh={} --set {}={}", mesh.name, mesh.refinement->key,
                      model.*(mesh.refinement->count));
  if (model.strike_refinement != 1.0 && mesh_uses(point.input, "model.strike_refinement")) {
    text += fmt::format(" --set model.strike_refinement={:g} --set model.refined_length={:g}",
                        model.strike_refinement, model.refined_length);
  }
  text += fmt::format(" --set model.section={}", name_of(model.section));
  text += fmt::format(" --set solver.{}={:.6g}", point.run.setting.fixed_step ? "step" : "rtol",
                      point.run.setting.value);
  return text;
}

}  // namespace

std::string mesh_limit_table(const MeshLimit& limit) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "event times in the limit of fine meshes, from {}\n", limit.description);
  for (const FirstEndLimit& family : limit.first_end) {
    fmt::format_to(out, "first separation from {}: {:.5f} +- {:.1e} us, observed order {:.2f}\n",
                   family.meshes, family.value * us, family.uncertainty * us, family.order);
  }
  fmt::format_to(out, "{:>4} {:>14} {:>14} {:>11}\n", "no.", "start, us", "end, us", "+- us");
  for (std::size_t i = 0; i < limit.sub_impacts.size(); ++i) {
    fmt::format_to(out, "{:>4} {:>14.5f} {:>14.5f} {:>11.1e}\n", i + 1,
                   limit.sub_impacts[i].start * us, *limit.sub_impacts[i].end * us,
                   limit.uncertainty[i] * us);
  }
  fmt::format_to(out, "horizon: {:.3f} us ({})\n\n", limit.horizon * us, limit.horizon_reason);
  fmt::format_to(out, "{:>15} {:>20} {:>12} {:>12} {:>12}\n", "mesh", "first separation, us",
                 "correspond", "median, us", "largest, us");
  for (const MeshRun& run : limit.runs) {
    fmt::format_to(out, "{:>15} {:>20.5f} {:>9}/{:<2} {:>12.2e} {:>12.2e}\n", run.mesh,
                   run.first_end * us, run.errors.n_corresponding, run.errors.n_reference,
                   run.errors.median * us, run.errors.maximum * us);
  }
  return fmt::to_string(text);
}

std::string plan_table(const Plan& plan) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "{:>15} {:<20} {:<16} {:<12} {:>13} {:>14} {:>11}\n", "mesh", "method",
                 "setting", "verdict", "mesh, us", "in all, us", "wall time");
  for (const PlanPoint& point : plan.points) {
    fmt::format_to(out, "{:>15} {:<20} {:<16} {:<12} {:>13.2e} {:>14.2e} {:>11} {}\n", point.mesh,
                   point.run.setting.method, point.run.setting.text(), to_string(point.run.verdict),
                   point.mesh_error * us, point.run.errors.maximum * us,
                   duration_text(point.run.seconds),
                   point.run.reaches(plan.wanted) ? "" : "not within");
  }
  if (plan.cheapest) {
    const PlanPoint& best = plan.points[*plan.cheapest];
    fmt::format_to(
        out, "\ncheapest within {:g} us in all: {}, {} at {}: {}, error {:.1e} us\n  {}\n",
        plan.wanted * us, best.mesh, best.run.setting.method, best.run.setting.text(),
        duration_text(best.run.seconds), best.run.errors.maximum * us, settings_text(best));
  } else {
    fmt::format_to(out, "\nno combination that was tried is within {:g} us\n", plan.wanted * us);
  }
  return fmt::to_string(text);
}

void write_plan(const std::filesystem::path& directory, const Plan& plan) {
  const Columns<MeshRun> meshes = {
      {"mesh", &MeshRun::mesh},
      {"first_separation_s", &MeshRun::first_end},
      {"reference_sub_impacts", [](const MeshRun& run) { return run.errors.n_reference; }},
      {"corresponding", [](const MeshRun& run) { return run.errors.n_corresponding; }},
      {"median_error_s", [](const MeshRun& run) { return run.errors.median; }},
      {"max_error_s", [](const MeshRun& run) { return run.errors.maximum; }}};
  write_file(directory / "meshes.csv", csv_text(meshes, plan.limit.runs));
  const Columns<SubImpact> limit = {
      {"index", [](const SubImpact&, std::size_t i) { return i + 1; }},
      {"start_s", &SubImpact::start},
      {"end_s", &SubImpact::end},
      {"uncertainty_s",
       [&](const SubImpact&, std::size_t i) { return plan.limit.uncertainty[i]; }}};
  write_file(directory / "mesh_limit.csv", csv_text(limit, plan.limit.sub_impacts));
  const Columns<PlanPoint> points = {
      {"mesh", &PlanPoint::mesh},
      {"method", [](const PlanPoint& p) { return p.run.setting.method; }},
      {"kind", [](const PlanPoint& p) { return p.run.setting.fixed_step ? "step" : "rtol"; }},
      {"setting", [](const PlanPoint& p) { return p.run.setting.value; }},
      {"verdict", [](const PlanPoint& p) { return p.run.verdict; }},
      {"mesh_error_s", &PlanPoint::mesh_error},
      {"total_error_s", [](const PlanPoint& p) { return p.run.errors.maximum; }},
      {"wall_s", [](const PlanPoint& p) { return p.run.seconds; }},
      {"right_hand_sides", [](const PlanPoint& p) { return p.run.work.right_hand_sides; }}};
  write_file(directory / "plan.csv", csv_text(points, plan.points));
}

}  // namespace subimpact
