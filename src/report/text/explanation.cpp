#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "case/keys/case_choices.h"
#include "case/problem.h"
#include "io/records/run_record.h"
#include "numerics/units.h"
#include "report/text/uncertain.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/io/results.h"
#include "subimpact/report/text.h"
#include "subimpact/simulate/options.h"
#include "subimpact/study/run_as_asked.h"

namespace subimpact {
namespace {

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

std::string line(const char* label, const std::string& value) {
  return fmt::format("  {:<21} {}\n", label, value);
}

std::string scene_section(const Case& input, const ResolvedSettings& used) {
  const Scene& scene = input.scene;
  std::string text = fmt::format("Scene\n  {}\n", strike_words(input, {}));
  if (!scene.beam.fixed) {
    text += line("theory", value_text(input, "beam.theory"));
    text += line("cross-section", cross_section_text(scene.beam));
  }
  if (scene.bodies().has_approach_to_compute()) {
    text += line("first touch",
                 fmt::format("computed, over a gap of {:.6g} mm", mm * scene.striker.gap));
  } else if (scene.striker.gap > 0.0) {
    text += line("first touch",
                 fmt::format("at {}, after a gap of {:.6g} mm",
                             duration_text(scene.striker.first_touch()), mm * scene.striker.gap));
  }
  if (scene.beam.fixed) return text;
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
  if (const double damping = scene.contact_damping(); damping > 0.0) {
    text += line("damping", fmt::format("{:.6g} s/m", damping));
  }
  if (!input.parts.contact_law) text += line("yield velocity", yield_velocity_text(input));
  return text;
}

// By the record of summary.json.
std::string settings_section(const Case& input, const ResolvedSettings& used) {
  Result result;
  result.given = input;
  result.used = used;
  const auto listing = listing_of(run_record());
  const std::map<std::string, std::string> meanings(listing.begin(), listing.end());
  const Json settings = Json::parse(summary_json(input, result)).at("used");
  std::string text = "Settings, in SI units\n";
  for (const auto& [name, value] : settings.items()) {
    if (value.is_null()) continue;
    const auto meaning = meanings.find("used." + name);
    const std::string shown = value.is_number_float() ? fmt::format("{:.7g}", value.get<double>())
                              : value.is_string()     ? value.get<std::string>()
                                                      : value.dump();
    text += fmt::format("  {:<32} {}{}\n", name, shown,
                        meaning == meanings.end() ? "" : ": " + meaning->second);
  }
  return text + line("files", fmt::format("about {:.2g} MB", MB * expected_bytes(input)));
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
  time += work.most ? fmt::format(" to {} of a processor, the longer the more accuracy takes",
                                  rough(longest_unit * *work.most + seconds_beside[1]))
                    : " of a processor or more: the method chooses its steps";
  const auto n = static_cast<double>(used.n_unknowns);
  // Natural modes may take another matrix, which is not stated.
  const double model = used.memory + (used.decomposition > 0.0 ? sizeof(double) * n * n : 0.0);
  return "Forecast of `subimpact run`\n" +
         line("time", time + (first.strikes > 1
                                  ? "; without strikes after the first, which each take as long"
                                  : "")) +
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
                     contact_section(first, used) + settings_section(first, used);
  if (!first.model_choice.empty()) {
    text += fmt::format("Choice of the model\n  {}\n", first.model_choice);
  }
  if (found.reason.empty()) return text;
  return text + fmt::format("Choice (of the first run; finer ones follow)\n  {}\n", found.reason);
}

std::string key_listing(const std::string& word) {
  std::string text, table, scatter;
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
    constexpr std::string_view of_scatter = "scatter.";
    if (word.empty() && key.name.starts_with(of_scatter)) {  // all alike
      scatter += (scatter.empty() ? "" : ", ") + key.name.substr(of_scatter.size());
      continue;
    }
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
  if (scatter.empty()) return text;
  return text + fmt::format(
                    "\n[scatter]\nrelative standard deviations, each a number, from 0 to "
                    "0.5; default 0, of {}\n",
                    scatter);
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
