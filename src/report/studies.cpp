#include "subimpact/report/text.h"

#include <fmt/format.h>

#include "case/counted.h"
#include "numerics/units.h"
#include "report/study_columns.h"
#include "subimpact/io/case_file.h"

namespace subimpact {
std::string outcome_table(const OutcomeMap& map) {
  constexpr std::string_view letters = "+wiUFr.";  // in the order of verdicts
  std::string text = fmt::format(
      "reference: {}; {} up to {:.3f} us\n"
      "+ right   w wrong count   i inaccurate   U unstable   F solver failed   r refused   . left "
      "out\n",
      map.reference.description, counted(map.reference.sub_impacts.size(), "sub-impact"),
      map.reference.horizon * us);
  std::optional<bool> fixed_step;
  std::string row;
  for (const OutcomePoint& point : map.points) {
    if (point.setting.fixed_step != fixed_step) {
      if (fixed_step) text += '\n';
      fixed_step = point.setting.fixed_step;
      row.clear();
      text += fmt::format("\n{:<28}", *fixed_step ? "omega_max h" : "rtol");
      for (const OutcomePoint& other : map.points) {
        if (other.setting.fixed_step != fixed_step || other.row != point.row) continue;
        text += fmt::format(" {:>6g}", other.x);
      }
    }
    if (point.row != row) {
      row = point.row;
      text += fmt::format("\n{:<28}", row);
    }
    text += fmt::format(" {:>6}", letters[static_cast<std::size_t>(point.verdict)]);
  }
  return text + '\n';
}

std::string outcomes_csv(const OutcomeMap& map) {
  const auto energy_error = [](const OutcomePoint& p) {
    return p.has_errors() ? std::optional(p.energy_error) : std::nullopt;
  };
  const Columns<OutcomePoint> columns = {
      {"group",
       [](const OutcomePoint& p) {
         return std::string(p.setting.fixed_step ? "fixed step" : "tolerance");
       }},
      {"row", &OutcomePoint::row},
      {"omega_h_or_rtol", &OutcomePoint::x},
      {"verdict", [](const OutcomePoint& p) { return p.verdict; }},
      {"reference_sub_impacts", of_run<&Trial::errors, &EventErrors::n_reference>},
      {"sub_impacts", of_run<&Trial::errors, &EventErrors::n_found>},
      {"corresponding", of_run<&Trial::errors, &EventErrors::n_corresponding>},
      {"median_error_s", known_error<&EventErrors::median>},
      {"max_error_s", known_error<&EventErrors::maximum>},
      {"energy_error", energy_error},
      {"message", &OutcomePoint::message}};
  return csv_text(columns, map.points);
}

namespace {

struct Point : Trial {
  std::string label;  // of the case
  double reference_error = 0.0;
};

std::optional<std::string> correspondence(const Point& row) {
  const EventErrors& errors = row.errors;
  if (!row.has_errors()) return std::nullopt;
  return fmt::format("{:>4}/{:<4}", errors.n_corresponding, errors.n_reference);
}

const StudyColumns<Point>& point_columns() {
  const auto setting = [](const Point& row) { return row.setting.text(); };
  const auto wall_time = [](const Point& row) {
    return row.has_run() ? std::optional(duration_text(row.seconds)) : std::nullopt;
  };
  const auto time = [](const char* heading) { return Print{heading, ">9", ".1e", us}; };
  const auto share = [](const char* heading) { return Print{heading, ">9", ".1e"}; };
  const auto odd = [](double UnmatchedSubImpact::*length) {
    return [length](const Point& row) {
      const auto& unmatched = row.errors.unmatched;
      return unmatched ? std::optional((*unmatched).*length) : std::nullopt;
    };
  };
  static const StudyColumns<Point> columns = {
      {"label", &Point::label},
      {"method", member<&Trial::setting, &Setting::method>, {"method", "<22"}},
      {"kind", [](const Point& row) { return row.setting.fixed_step ? "step" : "rtol"; }},
      {"setting", member<&Trial::setting, &Setting::value>},
      {"", setting, {"setting", "<14"}},
      {"verdict", member<&Trial::verdict>, {"verdict", "<12"}},
      {"reference_sub_impacts", of_run<&Trial::errors, &EventErrors::n_reference>},
      {"sub_impacts", of_run<&Trial::errors, &EventErrors::n_found>},
      {"corresponding", of_run<&Trial::errors, &EventErrors::n_corresponding>},
      {"", correspondence, {"corre-\nspond", ">9"}},
      {"first_odd_s", odd(&UnmatchedSubImpact::start)},
      {"odd_duration_s", odd(&UnmatchedSubImpact::duration)},
      {"median_error_s", known_error<&EventErrors::median>, time("times,\nmedian us")},
      {"max_error_s", known_error<&EventErrors::maximum>, time("times,\nmax us")},
      {"reference_error_s", &Point::reference_error},
      {"observed_order", member<&Trial::order>, {"order", ">6", ".1f"}},
      {"first_error_s", known_error<&EventErrors::first>},
      {"last_error_s", known_error<&EventErrors::last>},
      {"peak_force_error", known_error<&EventErrors::peak_force>, share("peaks,\nmax rel.")},
      {"striker_velocity_error", known_error<&EventErrors::striker_velocity>,
       share("striker,\nrel.")},
      {"beam_velocity_error", known_error<&EventErrors::beam_velocity>},
      {"wall_s", of_run<&Trial::seconds>},
      {"", wall_time, {"wall\ntime", ">10"}},
      {"repeats", of_run<&Trial::repeats>},
      {"setup_s", of_run<&Trial::work, &Work::setup_seconds>},
      {"steps", of_run<&Trial::work, &Work::steps>},
      {"rejected_steps", of_run<&Trial::work, &Work::rejected_steps>},
      {"right_hand_sides",
       of_run<&Trial::work, &Work::right_hand_sides>,
       {"right-hand\nsides", ">10"}},
      {"mass_solves", of_run<&Trial::work, &Work::mass_solves>, {"mass\nsolves", ">10"}},
      {"jacobians", of_run<&Trial::work, &Work::jacobians>},
      {"factorisations", of_run<&Trial::work, &Work::factorisations>, {"factori-\nsations", ">8"}},
      {"message", member<&Trial::message>},
  };
  return columns;
}

std::string setting_text(const Trial& point) {
  return fmt::format("{} at {}: {}, largest error {:.1e} us", point.setting.method,
                     point.setting.text(), duration_text(point.seconds), point.errors.maximum * us);
}

// Why an order is bounded; nothing of OrderBound::none.
std::string bound_text(const MethodOrder& order) {
  if (order.bound == OrderBound::contact) {
    return fmt::format("the force rises as lambda^{:.4g} from each touch", *order.most - 1.0);
  }
  constexpr const char* words[] = {"", "", "events are interpolated within steps",
                                   "events lie on the library's dense output",
                                   "sections begin and cease to flow within steps"};
  return words[static_cast<std::size_t>(order.bound)];
}

std::string order_text(const WorkPrecision& study) {
  if (study.orders.empty()) return {};
  const StudyColumns<MethodOrder> columns = {
      {"", &MethodOrder::method, {"orders at fixed steps", "<22"}},
      {"", &MethodOrder::smooth, {"where forces\nare smooth", ">12"}},
      {"", &MethodOrder::most, {"in the\nlimit", ">8", ".3g"}},
      {"", &MethodOrder::observed, {"observed", ">8", ".2f"}},
      {"", [](const MethodOrder& order) { return " " + bound_text(order); }, {" ", "<"}}};
  return '\n' + printed_table(columns, study.orders);
}

}  // namespace

std::string case_id(const Case& input) {
  Case same = input;
  same.solver.method = {};
  same.solver.table.reset();
  same.solver.rtol = {};
  same.solver.step.reset();
  same.output = {};
  return case_identity(same, {});
}

std::string work_precision_table(const WorkPrecision& study) {
  const Reference& reference = study.reference;
  std::string text =
      fmt::format("reference: {}; {}, times to {:.1e} us\nhorizon: {:.3f} us ({})\n",
                  reference.description, counted(reference.sub_impacts.size(), "sub-impact"),
                  reference.error * us, reference.horizon * us, reference.horizon_reason);
  if (const auto growth = error_growth(study.points)) {
    text += fmt::format("errors grow {:.2g}-fold from the first separation to the last event\n",
                        *growth);
  }
  text += '\n' + printed_heading(point_columns());
  std::string messages;
  const Setting* before = nullptr;
  for (const Trial& point : study.points) {
    const Setting& setting = point.setting;
    const bool goes_on = before == nullptr || (before->method == setting.method &&
                                               before->fixed_step == setting.fixed_step);
    if (!goes_on) text += '\n';
    before = &setting;
    text += printed_row(point_columns(), Point{point, {}});
    if (point.message.empty()) continue;
    messages += fmt::format("{} at {}: {}\n", setting.method, setting.text(), point.message);
  }
  text += order_text(study);
  return messages.empty() ? text : text + '\n' + messages;
}

std::string recommendation_text(const std::vector<Recommendation>& recommendations) {
  std::string text;
  for (const Recommendation& item : recommendations) {
    text += fmt::format(
        "  {:<9} {}\n", fmt::format("{:g} us", item.wanted * us),
        item.point ? setting_text(*item.point) : "not reached by any setting that was run");
    if (!item.steady) continue;
    text += fmt::format("            by chance: finer settings miss it; reliably from {} on\n",
                        setting_text(*item.steady));
  }
  return text;
}

std::string work_precision_csv(const std::vector<WorkPrecision>& studies) {
  std::vector<Point> rows;
  for (const WorkPrecision& study : studies) {
    for (const Trial& point : study.points) {
      rows.push_back({point, study.label, study.reference.error});
    }
  }
  return csv_text(columns_in_file(point_columns()), rows);
}

}  // namespace subimpact
