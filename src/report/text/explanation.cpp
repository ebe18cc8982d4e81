#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "case/counted.h"
#include "case/keys/case_choices.h"
#include "case/meshes.h"
#include "case/problem.h"
#include "numerics/units.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/results.h"
#include "subimpact/report/text.h"
#include "subimpact/simulate/options.h"
#include "subimpact/study/run_as_asked.h"

namespace subimpact {
namespace {

std::string key_text(const Case& input, const char* name) {
  const CaseKey* key = find_case_key(name);
  const std::optional<KeyValue> value = key->get(input);
  return value ? to_text(*value) : key->default_text;
}

std::string symmetry_text(const Case& input, const ResolvedSettings& used) {
  if (!descriptor_of(input.model.mesh).bends)
    return "not applicable: a rigid body has at most two unknowns";
  if (used.half_model)
    return "used: the strike is at mid-span and both ends are alike, so one half is modelled";
  if (input.model.symmetry == SymmetryUse::off) return "not used (model.symmetry = \"off\")";
  return "not used: the scene is not symmetric about mid-span, so the whole beam is modelled";
}

std::string mesh_text(const Case& input, const ResolvedSettings& used) {
  const auto& refinement = descriptor_of(input.model.mesh).refinement;
  if (input.parts.mesh || !refinement || input.model.strike_refinement != 1.0) return used.mesh;
  const double size = mm * refinement->size(input);
  const bool longer = input.model.spacing == CellSpacing::points;
  return fmt::format(
      "{}; {} of {:.6g} mm{}", used.mesh, refinement->parts, size,
      longer ? fmt::format(", whole ones at both ends: the equations of a beam of {:.7g} mm",
                           size * input.model.segments)
             : "");
}

std::string section_text(const Case& input, const ResolvedSettings& used) {
  if (!descriptor_of(input.model.mesh).bends) return "none: a rigid beam does not bend";
  if (input.model.section == SectionKind::elastic) {
    return used.section + ": sections never yield";
  }
  if (std::isinf(input.scene.beam.yield_stress)) {
    return fmt::format("elastic, although {} was requested: the yield stress is infinite",
                       key_text(input, "model.section"));
  }
  const double share = input.scene.beam.hardening;
  const std::string hardening =
      share > 0.0 ? fmt::format("; hardens with {:.6g} of Young's modulus", share) : "";
  if (input.parts.section) {
    return fmt::format("{}: first yield at a curvature of {:.6g} 1/m{}", used.section,
                       used.yield_curvature * input.parts.section->first_yield(), hardening);
  }
  if (descriptor_of(input.model.section).has_layers) {
    const Fibres fibres = Fibres::layered(input.model.layers, input.scene.beam);
    return fmt::format(
        "{} layers: elastic stiffness {:.6f} of the exact section's, first yield at "
        "{:.6g} 1/m{}",
        input.model.layers, fibres.slope(), used.yield_curvature * fibres.first_yield(), hardening);
  }
  return fmt::format("exact: first yield at a curvature of {:.6g} 1/m{}", used.yield_curvature,
                     hardening);
}

// A nose radius describes the striker whether or not the law uses it; where it does not, the
// explanation states this.
std::string contact_stiffness_text(const Case& input, const ResolvedSettings& used) {
  const Contact& contact = input.scene.contact;
  const std::string unit =
      used.contact_exponent == 1.0 ? "N/m" : fmt::format("N/m^{:.6g}", used.contact_exponent);
  if (input.parts.contact_law || !contact.stiffness)
    return fmt::format("{:.7g} {}", used.contact_stiffness, unit);
  return fmt::format("{:.7g} {}, as given{}", used.contact_stiffness, unit,
                     input.scene.striker.nose_radius ? "; striker.nose_radius has no effect" : "");
}

std::string cross_section_text(const Beam& beam) {
  const CrossSection::Solid outer = beam.outer_solid();
  const CrossSection& given = beam.section;
  const std::string size =
      beam.is_round() ? fmt::format("{:.6g} mm", mm * outer.height)
                      : fmt::format("{:.6g} x {:.6g} mm", mm * outer.height, mm * outer.width);
  const auto thickness = [](const char* of, const std::optional<double>& value) {
    return value ? fmt::format(", {} {:.6g} mm", of, mm * *value) : std::string();
  };
  return fmt::format(
      "{} of {}{}{}{}: area {:.6g} m2, second moment {:.6g} m4, shape factor {:.4g}{}",
      name_of(given.shape), size, thickness("wall", given.wall), thickness("flange", given.flange),
      thickness("web", given.web), beam.area(), beam.second_moment(),
      Fibres::continuous(beam).shape_factor(),
      beam.shears() ? fmt::format(", shear coefficient {:.4g}", beam.used_shear_coefficient())
                    : "");
}

// What a law of two bodies assumes, where it is not the law's only way.
std::string contact_assumptions(const Case& input) {
  const Scene& scene = input.scene;
  const ContactConstants& way = constants_given(input, built_in_contact_law(scene.contact.kind));
  if (input.parts.contact_law || !uses_key(way, "contact.beam_poisson")) return {};
  std::string text;
  if (!scene.contact.striker_modulus)
    text += "; rigid nose, since contact.striker_modulus is not given";
  if (scene.contact.is_from_mid_plane()) text += "; indentation from the mid-plane";
  if (scene.contact.pressure_by_depth) text += "; mean pressure by depth";
  return text;
}

std::string yield_velocity_text(const Case& input) {
  const auto velocity = contact_yield_velocity(input.scene, *contact_law_of(input));
  if (!velocity) return "none: nothing that yields is given";
  const bool leaves_out = input.scene.contact.kind == ContactKind::hertz;
  return fmt::format(
      "{:.4g} m/s: slower strikes leave the contact elastic, on any beam{}", *velocity,
      leaves_out ? "; the law leaves yielding out, contact.law = \"sphere\" has it" : "");
}

std::string method_text(const Case& input, const ResolvedSettings& used) {
  return fmt::format("{}{}{}", to_string(input.solver.method),
                     used.table ? ", table " + *used.table : "",
                     used.max_order ? fmt::format(", order up to {}", *used.max_order) : "");
}

std::string step_text(const Case& input, const ResolvedSettings& used) {
  if (!used.step) {
    return fmt::format("adaptive{}", input.solver.max_step
                                         ? ", at most " + duration_text(*input.solver.max_step)
                                         : "");
  }
  return fmt::format("fixed, {}{} ({:.3g} of the critical step)", duration_text(*used.step),
                     input.solver.step ? "" : " by default", *used.step / used.critical_step);
}

std::string damping_text(const BeamDamping& damping) {
  std::vector<std::string> parts;
  if (damping.ratio > 0.0)
    parts.push_back(fmt::format("{:.6g} of critical in every mode", damping.ratio));
  if (damping.mass > 0.0) parts.push_back(fmt::format("by mass {:.6g} 1/s", damping.mass));
  if (damping.stiffness > 0.0) {
    parts.push_back(fmt::format("by stiffness {:.6g} s", damping.stiffness));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string count_text(double count) {
  return count < 1e4 ? fmt::format("{:.0f}", count) : fmt::format("{:.1e}", count);
}

std::string files_text(const Case& input, const ResolvedSettings& used) {
  const bool has_history = input.output.has_history();
  const bool has_shapes = used.n_shape_points > 0;
  if (!has_history && !has_shapes) return "small: no history rows, no shapes";
  const std::string history =
      has_history ? count_text(input.end_time / input.output.history_interval(input.end_time)) +
                        (input.output.interval ? " history rows" : " history rows and more")
                  : "no history rows";
  const std::string shapes =
      has_shapes ? fmt::format("{} shapes of {} points and one per event",
                               count_text(expected_shapes(input)), used.n_shape_points)
                 : "no shapes";
  return fmt::format("about {:.2g} MB: {}, {}", MB * expected_bytes(input, used.n_shape_points),
                     history, shapes);
}

std::string line(const char* label, const std::string& value) {
  return fmt::format("  {:<21} {}\n", label, value);
}

std::string scene_section(const Case& input, const ResolvedSettings& used) {
  const Scene& scene = input.scene;
  std::string text = "Scene\n";
  if (scene.beam.fixed) {
    text += line("beam", "a plane that does not move");
  } else {
    const char* axial = scene.beam.stretches() ? ", held along the beam: a tension" : "";
    text += line("beam",
                 fmt::format("{:.6g} kg; ends {}{}; theory {}", scene.beam.mass(),
                             key_text(input, "beam.ends"), axial, key_text(input, "beam.theory")));
    text += line("cross-section", cross_section_text(scene.beam));
  }
  text +=
      line("striker", (scene.striker.fixed
                           ? fmt::format("a stop; {:.6g} J in the beam", used.initial_energy)
                           : fmt::format("{:.6g} kg at {:.6g} m/s, {:.6g} J", scene.striker.mass,
                                         scene.bodies().striker_velocity(), used.initial_energy)) +
                          fmt::format("; struck at {:.6g} of the length", scene.striker.position));
  if (const std::string others = others_in_scene(scene); !others.empty())
    text += line("besides", others);
  if (scene.bodies().has_approach_to_compute()) {
    text += line("first touch",
                 fmt::format("computed, over a gap of {:.6g} mm", mm * scene.striker.gap));
  } else if (scene.striker.gap > 0.0) {
    text += line("first touch",
                 fmt::format("at {}, after a gap of {:.6g} mm",
                             duration_text(scene.striker.first_touch()), mm * scene.striker.gap));
  }
  if (scene.beam.fixed) return text;
  text += line("first bending period", duration_text(used.first_period));
  text += line("zones", fmt::format("end after {} of separation, sub-zones after {}",
                                    duration_text(input.output.zone_gap * used.first_period),
                                    duration_text(input.output.subzone_gap * used.first_period)));
  return text;
}

std::string contact_section(const Case& input, const ResolvedSettings& used) {
  const Scene& scene = input.scene;
  std::string text = "Contact\n";
  const std::string words = contact_words(input);
  text += line("law", words.empty() ? used.contact_law : words + contact_assumptions(input));
  text += line("stiffness", contact_stiffness_text(input, used));
  if (const double damping = scene.contact_damping(); damping > 0.0) {
    text += line("damping", fmt::format("{:.6g} s/m", damping));
  }
  text +=
      line("stiffest", fmt::format("{:.4g} N/m, as deep as the strike's energy can press; contacts "
                                   "then last about {} or more",
                                   used.largest_contact_slope, duration_text(used.contact_time)));
  text += line("yield indentation", std::isinf(used.yield_indentation)
                                        ? "infinite: the contact never yields"
                                        : fmt::format("{:.6g} mm", mm * used.yield_indentation));
  if (!input.parts.contact_law) text += line("yield velocity", yield_velocity_text(input));
  return text;
}

std::string model_section(const Case& input, const ResolvedSettings& used) {
  const Scene& scene = input.scene;
  std::string text = "Model\n";
  text += line("mesh", mesh_text(input, used));
  text += line("symmetry", symmetry_text(input, used));
  text += line("unknowns", fmt::format("{} of the beam and 1 of the striker; {}", used.n_unknowns,
                                       counted(used.n_sections, "section")));
  text += line("section law", section_text(input, used));
  if (!scene.beam.damping.is_none()) text += line("damping", damping_text(scene.beam.damping));
  text += line("highest frequency", fmt::format("{:.4g} rad/s", used.highest_frequency));
  text +=
      line("critical step", std::isfinite(used.critical_step)
                                ? duration_text(used.critical_step) +
                                      " (of central differences, with the contact at its stiffest)"
                                : "none: nothing oscillates");
  return text;
}

std::string integration_section(const Case& input, const ResolvedSettings& used) {
  std::string text = "Integration\n";
  text += line("method", method_text(input, used));
  text += line("step", step_text(input, used));
  if (!used.step) {
    text += line("tolerances",
                 fmt::format("{:.3g} m and {:.3g} m/s (rtol {:g} of the scene's scales)",
                             used.position_tolerance, used.velocity_tolerance, input.solver.rtol));
  }
  text += line("events", std::string(to_string(used.events)));
  text += line("section reversals", name_of(used.reversals));
  text += line("accuracy",
               fmt::format("a run completes if its energy stays within {:.1e} of the initial "
                           "energy",
                           used.energy_tolerance));
  text += line("end", duration_text(input.end_time));
  text += line("files", files_text(input, used));
  return text;
}

// Processor time: of an evaluation per unknown, from the cheapest to the dearest scenes of
// validation/cost/run_cost, and of what the program does besides.
constexpr double shortest_unit = 1e-9, longest_unit = 4e-9;
constexpr double seconds_beside[] = {0.01, 0.2};
// Of libraries, files and what earlier runs leave, bytes.
constexpr double memory_beside = 16e6;

std::string cost_section(const Case& first, const ResolvedSettings& used, const WorkRange& work) {
  const auto rough = [](double seconds) {
    return duration_text(std::stod(fmt::format("{:.1g}", seconds)));
  };
  std::string time = rough(shortest_unit * work.least + seconds_beside[0]);
  time += work.most ? " to " + rough(longest_unit * *work.most + seconds_beside[1])
                    : " or more, since the method chooses its steps";
  const auto n = static_cast<double>(used.n_unknowns);
  // Natural modes may take another matrix, which is not stated.
  const double model = used.memory + (used.decomposition > 0.0 ? sizeof(double) * n * n : 0.0);
  std::vector<std::string> without;
  if (first.strikes > 1) without.push_back("strikes after the first, which each take as long");
  if (!first.scatter.empty()) without.emplace_back("the runs that show the scatter");
  return "Forecast of `subimpact run`\n" +
         line("time",
              fmt::format("{} of a processor, the longer the more accuracy takes{}{}", time,
                          without.empty() ? "" : "; without ", fmt::join(without, " and "))) +
         line("memory", fmt::format("about {:.0f} MB on the first mesh, and {:.0f} MB for each run "
                                    "beside it",
                                    MB * (memory_beside + model), MB * model));
}

}  // namespace

std::string explanation(const Case& input, const GivenKeys& given) {
  Case once = input;
  once.strikes = 1;
  ChosenModel found = first_run(once, given);
  found.input.strikes = input.strikes;
  const Case& first = found.input;
  const ResolvedSettings used = resolve(first).settings();
  const WorkRange work = work_expected(first, choices_left(once, given, std::nullopt));
  std::string text = (first.title.empty() ? "untitled case" : first.title) + "\n" +
                     cost_section(first, used, work) + scene_section(first, used) +
                     contact_section(first, used) + model_section(first, used) +
                     integration_section(first, used);
  if (!first.model_choice.empty()) {
    text += fmt::format("Choice of the model\n  {}\n", first.model_choice);
  }
  if (found.reason.empty()) return text;
  return text + fmt::format("Choice (of the first run; finer ones follow)\n  {}\n", found.reason);
}

std::string key_listing(const std::string& word) {
  std::string text;
  std::string table;
  const auto lower = [](unsigned char letter) { return std::tolower(letter); };
  const auto has_word = [&](const std::string& words) {
    return word.empty() || !std::ranges::search(words, word, {}, lower, lower).empty();
  };
  for (const CaseKey& key : case_keys()) {
    const bool is_wanted = has_word(key.name) || has_word(key.meaning) ||
                           std::ranges::any_of(key.choices, [&](const Choice& choice) {
                             return has_word(choice.name) || has_word(choice.note);
                           });
    if (!is_wanted) continue;
    if (key.table() != table) text += fmt::format("\n[{}]\n", table = key.table());
    text += fmt::format("{:<18} {}\n", key.leaf(), key.meaning);
    const std::string allowed =
        key.type == KeyType::choice ? "one of those below" : allowed_values(key);
    text += fmt::format("{:<18} {}; {}\n", "", allowed,
                        key.required ? "required" : "default " + key.default_text);
    for (const Choice& choice : key.choices) {
      text += fmt::format("{:<20} {:<18} {}\n", "", choice.name, choice.note);
    }
  }
  return text;
}

std::string method_listing() {
  std::string text;
  const auto list_choices = [&](const char* title, const char* key) {
    text += fmt::format("{} ({})\n", title, key);
    for (const Choice& choice : find_case_key(key)->choices) {
      text += fmt::format("  {:<20} {}\n", choice.name, choice.note);
    }
  };
  list_choices("Methods", "solver.method");
  text += fmt::format(
      "\nTables (solver.table): order(order of the error estimate), stages or right-hand "
      "sides per step\n");
  for (const MethodTable& table : method_tables()) {
    text += fmt::format("  {:<10} {:<20} {:>6} {:>3}  {}\n", to_string(table.method), table.name,
                        fmt::format("{}({})", table.order, table.embedded_order), table.evaluations,
                        table.note);
  }
  list_choices("\nTreatment of events", "solver.events");
  return text;
}

}  // namespace subimpact
