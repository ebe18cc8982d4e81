#include <algorithm>
#include <string>

#include "io/csv_text.h"
#include "subimpact/io/results.h"

namespace subimpact {
std::string events_csv(const std::vector<SubImpact>& sub_impacts) {
  const bool with_errors =
      std::any_of(sub_impacts.begin(), sub_impacts.end(),
                  [](const SubImpact& s) { return s.start_error.has_value(); });
  CsvText csv(std::string("index,zone,subzone,start_s,end_s,duration_s,peak_force_N,impulse_Ns,"
                          "max_indentation_m,residual_indentation_m,striker_velocity_m_per_s") +
              (with_errors ? ",start_error_s,end_error_s,error_time_s,error_mesh_s,error_layers_s,"
                             "start_mesh_limit_s,end_mesh_limit_s,mesh_limit_error_s\n"
                           : "\n"));
  std::size_t index = 0;
  for (const SubImpact& s : sub_impacts) {
    const std::optional<double> duration =
        s.end ? std::optional<double>(*s.end - s.start) : std::nullopt;
    csv.whole(++index)
        .whole(static_cast<std::size_t>(s.zone))
        .whole(static_cast<std::size_t>(s.subzone));
    csv.number(s.start).number(s.end).number(duration);
    csv.number(s.peak_force).number(s.impulse).number(s.max_indentation);
    csv.number(s.residual_indentation).number(s.striker_velocity);
    if (with_errors) {
      csv.number(s.start_error).number(s.end_error);
      csv.number(s.error_time).number(s.error_mesh).number(s.error_layers);
      csv.number(s.start_mesh_limit).number(s.end_mesh_limit).number(s.mesh_limit_error);
    }
    csv.end_row();
  }
  return csv.str();
}

std::string transitions_csv(const std::vector<Transition>& transitions) {
  CsvText csv("time_s,kind,section,value\n");
  for (const Transition& event : transitions) {
    csv.number(event.time).word(to_string(event.kind));
    if (event.section) {
      csv.whole(*event.section);
    } else {
      csv.empty();
    }
    csv.number(event.value).end_row();
  }
  return csv.str();
}

std::string history_csv(const std::vector<HistoryRow>& history) {
  CsvText csv(
      "time_s,force_N,indentation_m,w_c_m,w_m_m,f_c_m,u_mf_m,v_c_m_per_s,v_m_m_per_s,"
      "stress_back_Pa,U_m_J,U_k_J,U_e_J,U_p_J,U_c_J,D_c_J,energy_error,momentum_error\n");
  for (const HistoryRow& row : history) {
    csv.number(row.time).number(row.force).number(row.indentation);
    csv.number(row.struck_displacement).number(row.striker_displacement);
    csv.number(row.struck_deflection).number(row.striker_relative);
    csv.number(row.struck_velocity).number(row.striker_velocity).number(row.back_stress);
    csv.number(row.striker_energy).number(row.beam_kinetic_energy);
    csv.number(row.bending_elastic).number(row.bending_plastic);
    csv.number(row.contact_elastic).number(row.contact_plastic);
    csv.number(row.energy_error).number(row.momentum_error).end_row();
  }
  return csv.str();
}

std::string sections_csv(const std::vector<SectionRow>& sections) {
  CsvText csv("time_s,position_m,curvature_per_m,moment_Nm,plastic_curvature_per_m\n");
  for (const SectionRow& row : sections) {
    csv.number(row.time).number(row.position).number(row.curvature);
    csv.number(row.moment).number(row.plastic_curvature).end_row();
  }
  return csv.str();
}

}  // namespace subimpact
