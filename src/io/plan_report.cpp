#include <fmt/format.h>

#include <iterator>

#include "case/case_choices.h"
#include "case/meshes.h"
#include "io/csv_text.h"
#include "io/write_file.h"
#include "subimpact/io/plan.h"
#include "subimpact/io/report.h"

namespace subimpact {
namespace {

constexpr double us = 1e6;  // per second

std::string settings_text(const PlanPoint& point) {
  const ModelOptions& model = point.input.model;
  const std::string method = point.run.setting.method;
  const std::size_t colon = method.find(':');
  std::string text = fmt::format("--method {}", method.substr(0, colon));
  if (colon != std::string::npos) {
    text += fmt::format(" --set solver.table={}", method.substr(colon + 1));
  }
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
  CsvText meshes(
      "mesh,first_separation_s,reference_sub_impacts,corresponding,median_error_s,max_error_s\n");
  for (const MeshRun& run : plan.limit.runs) {
    meshes.word(run.mesh).number(run.first_end).whole(run.errors.n_reference);
    meshes.whole(run.errors.n_corresponding).number(run.errors.median);
    meshes.number(run.errors.maximum).end_row();
  }
  write_file(directory / "meshes.csv", meshes.str());
  CsvText limit("index,start_s,end_s,uncertainty_s\n");
  for (std::size_t i = 0; i < plan.limit.sub_impacts.size(); ++i) {
    const SubImpact& s = plan.limit.sub_impacts[i];
    limit.whole(i + 1).number(s.start).number(s.end).number(plan.limit.uncertainty[i]).end_row();
  }
  write_file(directory / "mesh_limit.csv", limit.str());
  CsvText csv(
      "mesh,method,kind,setting,verdict,mesh_error_s,total_error_s,wall_s,right_hand_sides\n");
  for (const PlanPoint& point : plan.points) {
    csv.word(point.mesh).word(point.run.setting.method);
    csv.word(point.run.setting.fixed_step ? "step" : "rtol").number(point.run.setting.value);
    csv.word(to_string(point.run.verdict)).number(point.mesh_error);
    csv.number(point.run.errors.maximum).number(point.run.seconds);
    csv.whole(static_cast<std::size_t>(point.run.work.right_hand_sides)).end_row();
  }
  write_file(directory / "plan.csv", csv.str());
}

}  // namespace subimpact
