#include "io/records/run_tables.h"

#include "io/records/run_record.h"
#include "subimpact/io/results.h"

namespace subimpact {
namespace {

std::optional<std::size_t> number_from_1(const std::optional<std::size_t>& index) {
  return index ? std::optional(*index + 1) : std::nullopt;
}

std::optional<double> duration(const SubImpact& s) {
  return s.end ? std::optional(*s.end - s.start) : std::nullopt;
}

// A number of nine digits: fields are looked at and integrated, and their files are large.
Column<ShapeRow> short_column(const char* name, const char* meaning, double ShapeRow::*member) {
  Column<ShapeRow> column(name, meaning, member);
  column.digits = 9;
  return column;
}

// The four columns of a range: its ends, each with the instant at which it was reached.
void add_range(Columns<EnvelopeRow>& columns, const std::string& name, const std::string& unit,
               const std::string& meaning, EnvelopeRow::Range EnvelopeRow::*range) {
  using Range = EnvelopeRow::Range;
  const auto add = [&](const char* prefix, const char* words, EnvelopeRow::Extreme Range::*end) {
    columns.push_back({prefix + name + unit, words + meaning,
                       [=](const EnvelopeRow& row) { return (row.*range.*end).value; }});
    columns.push_back({prefix + name + "_time_s", "instant at which that was reached",
                       [=](const EnvelopeRow& row) { return (row.*range.*end).time; }});
  };
  add("max_", "largest ", &Range::largest);
  add("min_", "smallest ", &Range::smallest);
}

Columns<EnvelopeRow> envelope_columns() {
  Columns<EnvelopeRow> all = {{"position_m", "position along the beam", &EnvelopeRow::position}};
  add_range(all, "displacement", "_m", "displacement", &EnvelopeRow::displacement);
  add_range(all, "moment", "_Nm", "bending moment", &EnvelopeRow::moment);
  add_range(all, "strain", "", "strain of the outer fibre behind, positive in tension",
            &EnvelopeRow::strain);
  add_range(all, "plastic_curvature", "_per_m", "plastic curvature",
            &EnvelopeRow::plastic_curvature);
  all.push_back({"permanent_set_m",
                 "displacement, against the chord of both ends, of the beam at rest after the "
                 "run: the double integral of the plastic curvature",
                 &EnvelopeRow::permanent_set});
  all.push_back({"set_against_supports_m",
                 "the same against the supports: against the clamp of a cantilever, else equal",
                 &EnvelopeRow::set_from_supports});
  return all;
}

void add_gauges(const OutputOptions& output, Columns<HistoryRow>& columns) {
  for (std::size_t i = 0; i < output.gauges.size(); ++i) {
    columns.push_back({fmt::format("gauge_{}_strain", i + 1),
                       "with output.gauges: axial strain at the first of them, positive in "
                       "tension; gauge_2_strain, ...: at the others",
                       [i](const HistoryRow& row) { return row.gauge_strains.at(i); }});
  }
}

}  // namespace

// clang-format off
template <>
const RunTable<SubImpact>& run_table() {
  static const RunTable<SubImpact> table = {
      "events.csv", "one row per sub-impact",
      {{"index", "number of the sub-impact, from 1", [](const SubImpact&, std::size_t index) { return index + 1; }},
       {"zone", "number of its zone, from 1", &SubImpact::zone},
       {"subzone", "number of its sub-zone within the zone, from 1", &SubImpact::subzone},
       {"start_s", "instant at which contact begins", &SubImpact::start},
       {"end_s", "instant at which the contact force returns to zero; empty: after the run's end", &SubImpact::end},
       {"duration_s", "end_s - start_s", duration},
       {"peak_force_N", "largest contact force", &SubImpact::peak_force},
       {"impulse_Ns", "momentum that the striker loses", &SubImpact::impulse},
       {"max_indentation_m", "largest indentation", &SubImpact::max_indentation},
       {"residual_indentation_m", "indentation that remains", &SubImpact::residual_indentation},
       {"striker_velocity_m_per_s", "velocity of the striker at the end", &SubImpact::striker_velocity},
       {"certain", "1: exists, alone, in this place; 0: uncertain; empty: without error bars", &SubImpact::certain},
       {"probability", "of that; 1 where certain", &SubImpact::probability},
       {"start_error_s", "error of start_s; this and what follows: empty without error bars", &SubImpact::start_error},
       {"end_error_s", "error of end_s", &SubImpact::end_error},
       {"start_body_error_s", "error of the body of start_s; this and the next: empty where not known", &SubImpact::start_body_error},
       {"end_body_error_s", "error of the body of end_s", &SubImpact::end_body_error},
       {"peak_force_error_N", "error of peak_force_N; this and the next: empty where not known", &SubImpact::peak_force_error},
       {"impulse_error_Ns", "error of impulse_Ns", &SubImpact::impulse_error},
       {"max_indentation_error_m", "error of max_indentation_m", &SubImpact::max_indentation_error},
       {"residual_indentation_error_m", "error of residual_indentation_m", &SubImpact::residual_indentation_error},
       {"striker_velocity_error_m_per_s", "error of striker_velocity_m_per_s", &SubImpact::striker_velocity_error},
       {"doubt", "why it is not certain", &SubImpact::doubt},
       {"peak_time_s", "instant of the largest force", &SubImpact::peak_time},
       {"opening_m", "largest gap between striker and beam after it, until the next one or the run's end; empty: still in contact then", &SubImpact::opening},
       {"opening_error_m", "error of opening_m; empty where not known", &SubImpact::opening_error}},
      &Result::sub_impacts};
  return table;
}

template <>
const RunTable<Transition>& run_table() {
  static const RunTable<Transition> table = {
      "transitions.csv", "one row per located event",
      {{"time_s", "instant of the event", &Transition::time},
       {"kind", "contact_begins, contact_yields, contact_unloads, contact_ends, support_touches, support_lifts, or section_reverses (not by central-difference)", &Transition::kind},
       {"section", "index of the section, from 0; empty for events of contact and supports", &Transition::section},
       {"value", "indentation (m), or curvature of the section (1/m)", &Transition::value},
       {"spring", "number of the support, as in supports.csv; empty for other events", [](const Transition& event) { return number_from_1(event.spring); }}},
      &Result::transitions};
  return table;
}

template <>
const RunTable<SupportContact>& run_table() {
  static const RunTable<SupportContact> table = {
      "supports.csv", "of a beam that can lift off its supports: one row per contact with one of them, in both halves of a symmetric beam",
      {{"spring", "number of the support in beam.springs, from 1; ends that rest follow after these; a mirror image has the number of the support modelled", [](const SupportContact& contact) { return contact.spring + 1; }},
       {"position_m", "its position along the beam", &SupportContact::position},
       {"start_s", "instant at which the beam touches it; 0: it lay there", &SupportContact::start},
       {"end_s", "instant at which the beam lifts off; empty: after the run's end", &SupportContact::end},
       {"peak_force_N", "largest force; contacts below 1e-9 of the largest of the run are left out", &SupportContact::peak_force},
       {"impulse_Ns", "of the force", &SupportContact::impulse},
       {"start_error_s", "error of start_s; this and the next: empty where not known, or the contact has no counterpart on other meshes", &SupportContact::start_error},
       {"end_error_s", "error of end_s", &SupportContact::end_error}},
      &Result::support_contacts};
  return table;
}

template <>
const RunTable<HistoryRow>& run_table() {
  static const RunTable<HistoryRow> table = {
      "history.csv", "rows at output.interval, and where that is left open at changes of the contact force by 1 % of the largest so far; two rows per event of the contact",
      {{"time_s", "time", &HistoryRow::time},
       {"force_N", "contact force", &HistoryRow::force},
       {"indentation_m", "indentation", &HistoryRow::indentation},
       {"w_c_m", "displacement of the struck point", &HistoryRow::struck_displacement},
       {"w_m_m", "displacement of the striker", &HistoryRow::striker_displacement},
       {"f_c_m", "deflection w_c - w(0) of the struck point", &HistoryRow::struck_deflection},
       {"u_mf_m", "w_m - w(0)", &HistoryRow::striker_relative},
       {"v_c_m_per_s", "velocity of the struck point", &HistoryRow::struck_velocity},
       {"v_m_m_per_s", "velocity of the striker", &HistoryRow::striker_velocity},
       {"stress_back_Pa", "stress of the outer fibre behind the struck point, positive in tension", &HistoryRow::back_stress},
       {"U_m_J", "kinetic energy of the striker", &HistoryRow::striker_energy},
       {"U_k_J", "kinetic energy of the beam", &HistoryRow::beam_kinetic_energy},
       {"U_e_J", "elastic energy of bending, shear, tension, springs, supports and bedding", &HistoryRow::bending_elastic},
       {"U_p_J", "energy dissipated by bending and tension", &HistoryRow::bending_plastic},
       {"U_c_J", "elastic energy of the contact", &HistoryRow::contact_elastic},
       {"D_c_J", "energy dissipated by the contact", &HistoryRow::contact_plastic},
       {"energy_error", "relative error of the sum of these six and D_b_J less W_J", &HistoryRow::energy_error},
       {"momentum_error", "relative error of the momentum; empty where supports take momentum up", &HistoryRow::momentum_error},
       {"D_b_J", "energy dissipated by the damping of the beam and its supports", &HistoryRow::beam_damping},
       {"R_0_N", "force of the support at x = 0 on the beam, positive in the direction of the strike; 0 where the beam has lifted off; empty: free end", &HistoryRow::first_reaction},
       {"R_l_N", "the same at x = length", &HistoryRow::last_reaction},
       {"W_J", "work of gravity and loads on striker and beam since the start", &HistoryRow::work}},
      &Result::history, add_gauges};
  return table;
}

template <>
const RunTable<SectionRow>& run_table() {
  static const RunTable<SectionRow> table = {
      "sections.csv", "one row per section of output.sections and row of history.csv",
      {{"time_s", "time", &SectionRow::time},
       {"position_m", "position of the section along the beam", &SectionRow::position},
       {"curvature_per_m", "curvature", &SectionRow::curvature},
       {"moment_Nm", "bending moment M, E I kappa while elastic", &SectionRow::moment},
       {"plastic_curvature_per_m", "curvature - M/(E I)", &SectionRow::plastic_curvature},
       {"strain", "of the outer fibre on the back, as a strain gauge there reads it, tension positive; on the struck side the negative", &SectionRow::strain}},
      &Result::section_history};
  return table;
}

template <>
const RunTable<PointRow>& run_table() {
  static const RunTable<PointRow> table = {
      "points.csv", "one row per point of output.points and row of history.csv",
      {{"time_s", "time", &PointRow::time},
       {"position_m", "position of the point along the beam", &PointRow::position},
       {"displacement_m", "displacement of the axis there", &PointRow::displacement},
       {"velocity_m_per_s", "velocity", &PointRow::velocity}},
      &Result::point_history};
  return table;
}

template <>
const RunTable<ShapeRow>& run_table() {
  static const RunTable<ShapeRow> table = {
      "shapes.csv", "one row per point of the whole beam, at instants output.shapes apart and at every event of the contact; numbers other than the time have 9 digits",
      {{"time_s", "time", &ShapeRow::time},
       short_column("position_m", "position along the beam, from x = 0 to its length", &ShapeRow::position),
       short_column("displacement_m", "displacement w of the axis, positive in the direction of the strike", &ShapeRow::displacement),
       short_column("velocity_m_per_s", "velocity dw/dt", &ShapeRow::velocity),
       short_column("rotation_rad", "rotation of the section, dw/dx where sections do not shear; at a hinge the mean of both sides", &ShapeRow::rotation),
       short_column("curvature_per_m", "curvature", &ShapeRow::curvature),
       short_column("moment_Nm", "bending moment M, E I kappa while elastic", &ShapeRow::moment),
       short_column("plastic_curvature_per_m", "curvature - M/(E I)", &ShapeRow::plastic_curvature)},
      &Result::shapes};
  return table;
}

template <>
const RunTable<EnvelopeRow>& run_table() {
  static const RunTable<EnvelopeRow> table = {
      "envelope.csv", "one row per point of shapes.csv: extremes over its instants and over rows of history.csv, at least 1/4000 of time.end apart",
      envelope_columns(), &Result::envelope};
  return table;
}
// clang-format on

template <>
const RunTable<StrikeRow>& run_table() {
  static const RunTable<StrikeRow> table = {
      "strikes.csv",
      "one row per strike of a run with repeat.strikes, at its end",
      {{"strike", "its number, from 1", &StrikeRow::strike},
       {"sub_impacts", "their number", &StrikeRow::sub_impacts},
       {"restitution",
        "velocity at which the bodies part over that at which they met; empty until they part",
        &StrikeRow::restitution},
       {"striker_velocity_m_per_s", "velocity of the striker", &StrikeRow::striker_velocity},
       {"peak_force_N", "largest force", &StrikeRow::peak_force},
       {"impulse_Ns", "of all sub-impacts", &StrikeRow::impulse},
       {"dent_m", "residual indentation, of all strikes so far", &StrikeRow::dent},
       {"permanent_set_m", "largest displacement at rest against the supports, so far",
        &StrikeRow::permanent_set},
       {"hinge_rotation_rad", "of the largest plastic hinge, so far", &StrikeRow::hinge_rotation},
       {"striker_J", "energy left in the striker", &StrikeRow::striker_energy},
       {"vibration_J",
        "motion and elastic energy of the beam, with what stays locked in sections that have "
        "yielded",
        &StrikeRow::vibration},
       {"bending_J", "dissipated by bending and by the damping of the beam, in this strike",
        &StrikeRow::bending_dissipated},
       {"contact_J", "dissipated by the contact, in this strike", &StrikeRow::contact_dissipated},
       {"restitution_error", "error of the restitution, from runs beside with as many strikes",
        &StrikeRow::restitution_error},
       {"peak_force_error_N", "error of the force, from these runs", &StrikeRow::peak_force_error},
       {"permanent_set_error_m", "error of the permanent set, from these runs",
        &StrikeRow::permanent_set_error}},
      &Result::strikes};
  return table;
}

std::string column_listing() {
  std::string text;
  OutputOptions with_gauge;
  with_gauge.gauges.emplace_back();
  for_each_run_table([&](const auto& table) {
    text += fmt::format("{}: {}\n", table.file, table.meaning);
    for (const auto& column : table.columns_of(with_gauge)) {
      text += fmt::format("  {:<25} {}\n", column.name, column.meaning);
    }
    text += '\n';
  });
  text += "summary.json: one object; a.b: the member b of the object a, a[].b: of each in a list\n";
  for (const auto& [name, meaning] : listing_of(run_record())) {
    text += fmt::format("  {:<44} {}\n", name, meaning);
  }
  return text;
}

}  // namespace subimpact
