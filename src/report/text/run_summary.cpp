#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "case/counted.h"
#include "case/keys/case_choices.h"
#include "case/problem.h"
#include "io/printable.h"
#include "report/text/uncertain.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/report/text.h"

namespace subimpact {
namespace {

constexpr std::size_t line_width = 100;
constexpr int label_width = 19;

// Words after a beginning, on lines of at most line_width; further lines begin at `indent`.
std::string wrapped(const std::string& words, std::string text = " ", std::size_t indent = 1) {
  std::size_t column = text.size();
  for (std::size_t at = 0; at < words.size();) {
    std::size_t end = std::min(words.find(' ', at), words.size());
    while (words.substr(end, 4) == " +- ") end = std::min(words.find(' ', end + 4), words.size());
    if (column + 1 + end - at > line_width && column > indent) {
      text += fmt::format("\n{:{}}", "", indent);
      column = indent;
    }
    text += ' ' + words.substr(at, end - at);
    column += 1 + end - at;
    at = end + 1;
  }
  return text + '\n';
}

// A label and what belongs to it.
std::string labelled(const std::string& label, const std::string& words) {
  return wrapped(words, fmt::format("  {:<{}}", label, label_width), label_width + 2);
}

std::string time_or_never(const std::optional<double>& time) {
  return time ? time_text(*time) : "never";
}

constexpr double felt = 0.2;           // share of an error of the body
constexpr std::size_t most_zones = 4;  // with a row of their own
constexpr std::size_t most_named = 3;  // answers beside a part

// A row of the table of answers.
struct Row {
  std::string label, text, error, body, part;
};

bool is_shown(const Answer& answer, bool verbose) {
  const bool is_minor = answer.key == AnswerKey::indentation ||
                        answer.key == AnswerKey::contact_pressure || answer.key == AnswerKey::zones;
  return answer.value && (verbose || !is_minor);
}

std::vector<Row> rows_of(const Result& result, bool verbose) {
  std::vector<Row> rows;
  for (const Answer& answer : result.answers) {
    if (is_shown(answer, verbose)) {
      const bool has_part = !answer.parts.empty() && answer.parts.front().change != 0.0;
      rows.push_back({answer.label, answer.text, answer.error_text, answer.body_text,
                      has_part ? answer.parts.front().label : ""});
    }
    if (answer.items.size() < 2) continue;
    for (const Answer::Item& zone : answer.items) {
      if (zone.number > static_cast<int>(most_zones)) break;
      rows.push_back({fmt::format("  zone {}", zone.number),
                      zone.begin_text,
                      zone.error_text,
                      zone.body_text,
                      {}});
    }
  }
  return rows;
}

// One answer a row, with both of its errors.
std::string answer_table(const Result& result, bool verbose) {
  std::vector<Row> rows = rows_of(result, verbose);
  rows.insert(rows.begin(), {"", "", "+- computed", "+- real beam", "mostly of"});
  std::size_t text = 0, error = 0, body = 0;  // widths
  for (const Row& row : rows) {
    text = std::max(text, row.text.size());
    error = std::max(error, row.error.size());
    body = std::max(body, row.body.size());
  }
  std::string table;
  for (const Row& row : rows) {
    const std::string line =
        fmt::format("  {:<{}} {:<{}}  {:>{}}  {:>{}}  {}", row.label, label_width, row.text, text,
                    row.error, error, row.body, body, row.part);
    table += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  return table;
}

// The parts that matter for answers that are shown, with what to do about each and which answers
// gain; then what is in no error.
std::string body_words(const Result& result, bool verbose) {
  struct Felt {
    Answer::Part part;
    std::vector<std::string> answers;
    bool is_known = true;
  };
  std::vector<Felt> felt_parts;
  for (const Answer& answer : result.answers) {
    if (!is_shown(answer, verbose)) continue;
    double sum = 0.0;
    for (const Answer::Part& part : answer.parts) sum += part.change.value_or(0.0);
    for (const Answer::Part& part : answer.parts) {
      if (part.change && !(*part.change > felt * sum)) continue;
      const auto of_kind = [&](const Felt& other) { return other.part.kind == part.kind; };
      auto found = std::ranges::find_if(felt_parts, of_kind);
      if (found == felt_parts.end()) found = felt_parts.insert(found, {part, {}, true});
      found->answers.push_back(answer.label);
      if (!part.change) found->is_known = false;
    }
  }
  std::string text;
  for (auto& [part, answers, is_known] : felt_parts) {
    if (answers.size() > most_named) {
      answers.resize(most_named);
      answers.emplace_back("...");
    }
    text += labelled(part.label, fmt::format("{} ({}{})", part.remedy, fmt::join(answers, ", "),
                                             is_known ? "" : "; not known how much"));
  }
  if (verbose) {
    for (const Answer& answer : result.answers) {
      std::string words;
      for (const Answer::Part& part : answer.parts) {
        words += fmt::format("{}{} {}", words.empty() ? "" : ", ", part.label, part.text);
      }
      if (!words.empty()) text += labelled("", answer.label + ": " + words);
    }
  }
  if (result.body_errors && result.verdict.beam == StrikeVerdict::Beam::bent) {
    text += labelled("in no error", "strain rates; length of the hinge, but for the permanent set");
  }
  return text;
}

// What answers say beside their numbers.
std::string notes(const Result& result) {
  std::string text;
  for (const Answer& answer : result.answers) {
    if (answer.note.empty()) continue;
    text += labelled(answer.label, (answer.value ? "" : "none: ") + answer.note);
    for (const Answer::Item& zone : answer.items) {
      text += labelled(fmt::format("  zone {}", zone.number), zone.text);
    }
  }
  return text;
}

// The mesh, the method, their errors by source, what they cost and what they conserve.
std::string details(const Case& input, const Result& result) {
  const Work& work = result.work;
  std::string text;
  const auto line = [&](const std::string& label, const std::string& words) {
    text += labelled(label, words);
  };
  if (!result.envelope.empty() && result.used.bends()) {
    const auto size = [](const EnvelopeRow& row) { return row.moment.magnitude(); };
    const EnvelopeRow& most = *std::ranges::max_element(result.envelope, {}, size);
    line("bending",
         fmt::format("moment up to {} at {:.4g} m",
                     total_text(result, RunTotal::max_moment, size(most), {"N m"}), most.position));
  }
  line("first yield", fmt::format("section {}, contact {}; {} of {} sections have yielded",
                                  time_or_never(result.first_section_yield),
                                  time_or_never(result.first_contact_yield),
                                  result.n_yielded_sections, result.used.n_sections));
  if (!input.model_choice.empty()) line("theory, contact", input.model_choice);
  line("mesh",
       fmt::format("{}; section {}; {}", result.used.mesh, value_text(input, "model.section"),
                   counted(result.used.n_unknowns, "unknown")));
  if (!result.choice.empty()) line("chosen because", printable(result.choice));
  if (result.error_estimate) line("runs beside", result.error_estimate->refined_run);
  line("method", fmt::format("{}{}", to_string(input.solver.method),
                             result.used.table ? ", table " + *result.used.table : ""));
  line("conservation",
       result.max_momentum_error
           ? fmt::format("energy to {:.1e}, momentum to {:.1e}, relative", result.max_energy_error,
                         *result.max_momentum_error)
           : fmt::format(
                 "energy to {:.1e}, relative; momentum is not conserved: the supports take it up",
                 result.max_energy_error));
  line("work",
       fmt::format("{}, {} rejected, {}, {}; {}", counted(work.steps, "step"), work.rejected_steps,
                   counted(work.right_hand_sides, "right-hand side"), counted(work.roots, "event"),
                   duration_text(work.wall_seconds)) +
           (work.all_seconds > 0.0 ? "; with the runs beside it " + duration_text(work.all_seconds)
                                   : ""));
  return text;
}

std::string mass_text(double mass) {
  if (mass >= 1e4) return fmt::format("{:.4g} t", 1e-3 * mass);
  const ReadUnit unit = unit_for(1e3 * mass, {"g", 3});
  return with_unit(fmt::format("{:.4g}", unit.per_si * 1e3 * mass), unit);
}

std::string end_name(const Beam& beam, std::size_t end) {
  return beam.rests[end] ? "resting" : name_of(beam.ends[end]);
}

std::string striker_words(const Scene& scene, const std::string& contact) {
  const Striker& striker = scene.striker;
  const std::string law = contact.empty() ? "" : " (" + contact + ")";
  if (striker.fixed) return "a stop" + law;
  return fmt::format(
      "{} at {:.4g} m/s{}{}", mass_text(striker.mass), scene.bodies().striker_velocity(),
      striker.drop_height ? fmt::format(" after a fall of {:.4g} m", *striker.drop_height) : "",
      law);
}

constexpr double felt_force = 1e-3;  // over the largest

std::string words_of(const std::vector<SupportContact>& contacts, const Result& result) {
  const auto time = [&](double value, const std::optional<double>& error) {
    const ReadUnit unit = unit_for(result.outcome.time, as_instant);
    return with_unit(error ? number_in(unit, {value, error}, as_time.most_digits)
                           : with_digits(unit.per_si * value, 4),
                     unit);
  };
  if (contacts.empty()) return "the beam never touches it";
  const SupportContact& first = contacts.front();
  std::string words;
  if (first.start > 0.0) words = "touches at " + time(first.start, first.start_error);
  if (!first.end) return words.empty() ? "the beam never lifts off" : words + ", and stays";
  words +=
      fmt::format("{}lifts at {}", words.empty() ? "" : ", ", time(*first.end, first.end_error));
  if (contacts.size() > 1) {
    words += ", back at " + time(contacts[1].start, contacts[1].start_error);
  }
  const auto n = std::ranges::count_if(contacts, [](const auto& c) { return c.end.has_value(); });
  return n > 1 ? fmt::format("{}; {} times", words, n) : words;
}

// What a beam does on supports that it can lift off, one label and its words for each: "support at
// 0", "lifts at 142.1 +- 0.1 us, back at 1310 us; 3 times". Contacts of less than a thousandth of
// the largest force of all supports are left out; empty without such supports.
std::vector<std::pair<std::string, std::string>> support_words(const Case& input,
                                                               const Result& result) {
  std::vector<std::pair<std::string, std::string>> lines;
  const Beam beam = sized_beam(input);
  double largest = 0.0;
  for (const auto& contact : result.support_contacts) {
    largest = std::max(largest, contact.peak_force);
  }
  for (const Spring& spring : beam.springs) {
    if (!spring.one_sided) continue;
    std::vector<SupportContact> contacts;
    const std::size_t index = static_cast<std::size_t>(&spring - beam.springs.data());
    for (const SupportContact& contact : result.support_contacts) {
      const bool is_here = contact.position == spring.position * beam.length;
      const bool is_own = contact.spring == index || result.used.half_model;
      if (is_here && is_own && contact.peak_force >= felt_force * largest) {
        contacts.push_back(contact);
      }
    }
    lines.emplace_back(
        fmt::format("{} at {:.4g} m", spring.one_sided->gap > 0.0 ? "stop" : "support",
                    spring.position * beam.length),
        words_of(contacts, result));
  }
  return lines;
}

// What acts on the bodies besides the strike, and how the beam starts: "gravity 9.81 m/s2, 1
// spring".
std::string others_in_scene(const Scene& scene) {
  const Beam& beam = scene.beam;
  std::vector<std::string> words;
  const auto add = [&](bool is_there, std::string what) {
    if (is_there) words.push_back(std::move(what));
  };
  add(scene.gravity != 0.0, fmt::format("gravity {:.6g} m/s2", scene.gravity));
  add(scene.gravity == 0.0 && scene.striker.drop_height,
      "gravity sets the velocity and does not act in the run");
  add(beam.load != 0.0, fmt::format("load {:.6g} N/m", beam.load));
  add(!beam.forces.empty(), counted(beam.forces.size(), "force"));
  const auto n_one_sided = static_cast<std::size_t>(
      std::ranges::count_if(beam.springs, [](const Spring& s) { return s.one_sided.has_value(); }));
  const std::size_t n_springs = beam.springs.size() - n_one_sided;
  add(n_springs > 0, counted(n_springs, "spring"));
  add(n_one_sided > 0, counted(n_one_sided, "support") + " that it can lift off");
  add(beam.foundation > 0.0, fmt::format("bedding {:.6g} N/m2", beam.foundation));
  add(beam.start == BeamStart::equilibrium || beam.rests[0] || beam.rests[1],
      "beam in equilibrium at the start");
  add(beam.velocity != 0.0, fmt::format("beam moving at {:.6g} m/s", beam.velocity));
  add(beam.angular_velocity != 0.0,
      fmt::format("beam turning at {:.6g} rad/s about {:.6g} of its length", beam.angular_velocity,
                  beam.used_pivot()));
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

std::string strike_words(const Case& input, const Result& result) {
  const Scene& scene = input.scene;
  const double x = scene.striker.position;
  const std::string where = x == 0.5 ? std::string("the middle")
                            : x == 0.0 || x == 1.0
                                ? fmt::format("the {} end", end_name(scene.beam, x == 1.0))
                                : fmt::format("{:.4g} of the length", x);
  const std::string others = others_in_scene(scene);
  const std::size_t n = result.strikes.size();
  return fmt::format(
      "{}{}, {}{}", n > 1 ? fmt::format("the last of {}: ", n) : "",
      striker_words(scene, contact_words(input)),
      scene.beam.fixed ? std::string("on a plane that does not move")
                       : fmt::format("at {} of a {}-{} beam of {}", where, end_name(scene.beam, 0),
                                     end_name(scene.beam, 1), mass_text(scene.beam.mass())),
      others.empty() ? "" : "; " + others);
}

std::string run_summary(const Case& input, const Result& result, bool verbose) {
  std::string text = (input.title.empty() ? "untitled case" : printable(input.title)) + '\n';
  const auto line = [&](const char* label, const std::string& words) {
    text += labelled(label, words);
  };
  text += wrapped(strike_words(input, result));
  if (const std::string caveat = outcome_caveat(result); !caveat.empty()) line("outcome", caveat);
  if (result.tolerance) line("tolerance", tolerance_words(*result.tolerance, result));
  text += wrapped(result.verdict.text) + '\n' + answer_table(result, verbose) + '\n';
  for (const auto& [label, words] : support_words(input, result)) line(label.c_str(), words);
  if (!result.all_certain()) line("not certain", error_words(result));
  text += body_words(result, verbose);
  if (result.error_estimate && !error_of_total(result, RunTotal::impulse)) {
    line("errors", "a run beside did not complete, so errors of totals are not known");
  }
  if (result.error_estimate && result.error_estimate->finer_meshes) {
    line("finer meshes", finer_meshes_words(result));
  }
  for (const std::string& warning : result.warnings) line("warning", warning);
  return verbose ? text + '\n' + notes(result) + details(input, result) : text;
}

}  // namespace subimpact
