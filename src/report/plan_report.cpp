#include <fmt/format.h>

#include <algorithm>

#include "case/case_choices.h"
#include "case/meshes.h"
#include "io/listed_files.h"
#include "numerics/units.h"
#include "report/gnuplot.h"
#include "report/study_columns.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/report/studies.h"
#include "subimpact/report/text.h"

namespace subimpact {
namespace {

// What --set gives a key, so that the case that was asked about becomes the one that is advised;
// none where it has that value already.
std::optional<std::string> new_value(const CaseKey& key, const Case& asked, const Case& advised) {
  const char* name = key.name.c_str();
  const bool is_of_a_mesh = std::ranges::any_of(meshes(), [&](const MeshDescriptor& mesh) {
    return std::ranges::find(mesh.keys, key.name) != mesh.keys.end();
  });
  if (is_of_a_mesh && !mesh_uses(advised, name)) {
    // The count of parts may be given even where it has the default, others where they differ.
    const auto& refinement = descriptor_of(asked.model.mesh).refinement;
    const bool may_be_given =
        (refinement && key.name == refinement->key) || key.get(asked) != key.get(Case());
    return mesh_uses(asked, name) && may_be_given ? std::optional("default") : std::nullopt;
  }
  const std::optional<KeyValue> value = key.get(advised);
  if (value == key.get(asked)) return std::nullopt;
  if (!value) return "default";
  const auto* word = std::get_if<std::string>(&*value);
  return word ? *word : to_text(*value);
}

// The options that make of the case that was asked about the run that is advised.
std::string settings_text(const Case& asked, const PlanPoint& advised) {
  std::string text = "--method " + advised.setting.method;
  for (const CaseKey& key : case_keys()) {
    const std::string table = key.table();
    if (table == "output" || table == "accuracy" || key.name == "solver.method") continue;
    const auto value = new_value(key, asked, advised.input);
    if (value) text += fmt::format(" --set {}={}", key.name, *value);
  }
  return text;
}

// "nystrom/graded-elements"
std::string sequence_of(const PlanPoint& point) {
  const ModelOptions& model = point.input.model;
  return fmt::format("{}/{}{}", point.setting.method,
                     model.strike_refinement != 1.0 ? "graded-" : "",
                     descriptor_of(model.mesh).refinement->parts);
}

std::string judgement_on(const PlanPoint& point) {
  if (point.admitted) return "within, as are all finer ones";
  return point.within ? "within by chance: a finer one is not" : "not within";
}

StudyColumns<PlanPoint> columns_of(const Plan& plan) {
  return {{"sequence", sequence_of},
          {"mesh", &PlanPoint::mesh, {"mesh", ">44"}},
          {"method", member<&PlanPoint::setting, &Setting::method>, {"method", "<20"}},
          {"verdict", [](const PlanPoint& p) { return p.verdict; }, {"verdict", "<12"}},
          {"error_s",
           member<&PlanPoint::errors, &EventErrors::maximum>,
           {"error, us", ">12", ".2e", us}},
          {"within", [](const PlanPoint& p) { return p.within ? 1 : 0; }},
          {"admitted", [](const PlanPoint& p) { return p.admitted ? 1 : 0; }},
          {"cheapest", [&](const PlanPoint&, std::size_t i) { return plan.cheapest == i ? 1 : 0; }},
          {"counted_work", &PlanPoint::counted, {"work", ">9", ".1e"}},
          {"wall_s", &PlanPoint::seconds},
          {"", [](const PlanPoint& p) { return duration_text(p.seconds); }, {"wall time", ">11"}},
          {"", judgement_on, {"", "<"}}};
}

StudyColumns<SubImpact> reference_columns() {
  const auto end = [](const SubImpact& s) {
    return s.end ? fmt::format("{:.5f}", *s.end * us) : "(open)";
  };
  const auto error = [](const SubImpact& s) {
    return s.end_error.value_or(s.start_error.value_or(0.0));
  };
  return {{"index", [](const SubImpact&, std::size_t i) { return i + 1; }, {"no.", ">4"}},
          {"start_s", &SubImpact::start, {"start, us", ">14", ".5f", us}},
          {"", end, {"end, us", ">14"}},
          {"", error, {"+- us", ">11", ".1e", us}},
          {"end_s", &SubImpact::end},
          {"start_error_s", &SubImpact::start_error},
          {"end_error_s", &SubImpact::end_error}};
}

}  // namespace

std::string plan_reference_table(const Plan& plan) {
  return fmt::format("reference: {}, {}\n{}", plan.reference.result.used.mesh,
                     name_of(plan.reference.input.solver.method),
                     printed_table(reference_columns(), plan.reference.sub_impacts));
}

std::string plan_table(const Plan& plan) {
  std::string text = printed_table(columns_of(plan), plan.points);
  if (plan.cheapest) {
    const PlanPoint& best = plan.points[*plan.cheapest];
    text += fmt::format(
        "\ncheapest within {:g} us in all: {}, {}: {}, error {:.1e} us against a "
        "reference known to {:.1e} us; with this case, run\n  {}\n",
        plan.wanted * us, best.mesh, best.setting.method, duration_text(best.seconds),
        best.errors.maximum * us, plan.reference.error * us, settings_text(plan.asked, best));
  } else {
    text += fmt::format("\nno mesh that was tried is within {:g} us together with all finer ones\n",
                        plan.wanted * us);
  }
  return text + fmt::format("judged up to {:.3f} us ({})\n", plan.reference.horizon * us,
                            plan.reference.horizon_reason);
}

void write_plan(const std::filesystem::path& directory, const Plan& plan) {
  write_file(directory / "reference.csv",
             csv_text(columns_in_file(reference_columns()), plan.reference.sub_impacts));
  write_file(directory / "plan.csv", csv_text(columns_in_file(columns_of(plan)), plan.points));
  if (plan.points.empty()) return;
  draw_figure(directory, "plan",
              figure_script("plan", fmt::format("wanted_us = {}\nreference_us = {}\n",
                                                us * plan.wanted, us * plan.reference.error)),
              {960, 560});
}

}  // namespace subimpact
