#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "case/counted.h"
#include "io/printable.h"
#include "report/text/body_words.h"
#include "report/text/strike_words.h"
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
  const auto width_of = [&](std::string Row::*cell) {
    return std::invoke(cell, *std::ranges::max_element(
                                 rows, {}, [&](const Row& row) { return (row.*cell).size(); }))
        .size();
  };
  const std::size_t text = width_of(&Row::text), error = width_of(&Row::error),
                    body = width_of(&Row::body);
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
  line("mesh", fmt::format("{}; section {}; {}", result.used.mesh,
                           to_text(*find_case_key("model.section")->get(input)),
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

}  // namespace

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
