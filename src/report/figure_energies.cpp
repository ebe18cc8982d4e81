// Energies and relative displacements, with zones and sub-zones marked.

#include <algorithm>

#include "report/figure_script.h"

namespace subimpact {
namespace {

// Runs (from, to, number) of sub-impacts of one zone that share a number.
NumberRows spans(const Result& result, TimeUnit unit, int SubImpact::*number) {
  NumberRows found;
  int last_zone = 0;
  for (const SubImpact& s : result.sub_impacts) {
    const double to = result.end_of(s) * unit.per_second;
    const bool same = !found.empty() && found.back()[2] == s.*number && last_zone == s.zone;
    if (!same) found.push_back({s.start * unit.per_second, to, 1.0 * (s.*number)});
    found.back()[1] = to;
    last_zone = s.zone;
  }
  if (found.empty()) found.push_back({0.0, 0.0, 0.0});
  return found;
}

}  // namespace

FigureScript energies_figure(const Case&, const Result& result) {
  FigureScript figure("energies",
                      "Energies, and the motion of striker (u_mf = w_m − w(0)) and struck point "
                      "(f_c = w_c − w(0)) relative to the beam's end. Above: zones, sub-zones and "
                      "sub-impacts, pale where they are not decided; zones are shaded.",
                      {800, 660});
  const TimeUnit unit = time_unit(result.outcome.time);
  const Unit joule = energy_unit(result.used.initial_energy);
  const Unit metre = length_unit(std::max(largest(result, &HistoryRow::struck_deflection),
                                          largest(result, &HistoryRow::striker_relative)));
  figure.table("zones", "from,to,number", spans(result, unit, &SubImpact::zone));
  figure.table("subzones", "from,to,number", spans(result, unit, &SubImpact::subzone));
  add_sub_impact_bands(figure, "sub_impacts", result, unit);
  const auto line = [&](const char* name, double HistoryRow::*member, double factor) {
    figure.line(name, history_line(result, unit, member, factor), {660, 280});
  };
  line("striker", &HistoryRow::striker_energy, joule.factor);
  line("kinetic", &HistoryRow::beam_kinetic_energy, joule.factor);
  line("elastic", &HistoryRow::bending_elastic, joule.factor);
  line("plastic", &HistoryRow::bending_plastic, joule.factor);
  line("contact", &HistoryRow::contact_plastic, joule.factor);
  line("damping", &HistoryRow::beam_damping, joule.factor);
  line("struck_point", &HistoryRow::struck_deflection, metre.factor);
  line("striker_path", &HistoryRow::striker_relative, metre.factor);
  figure.set("end", result.outcome.time * unit.per_second).set("time_unit", unit.name);
  figure.set("is_damped", result.beam_damping_loss > 0.0 ? 1.0 : 0.0);
  figure.set("energy_unit", joule.name).set("length_unit", metre.name);
  return figure;
}

}  // namespace subimpact
