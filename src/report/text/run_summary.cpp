#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "case/counted.h"
#include "io/printable.h"
#include "numerics/units.h"
#include "report/text/uncertain.h"
#include "subimpact/case/case_keys.h"
#include "subimpact/report/text.h"

namespace subimpact {
namespace {

constexpr std::size_t line_width = 100;
constexpr int label_width = 19;

// A label and what belongs to it, on lines of at most line_width.
std::string labelled(const std::string& label, const std::string& words) {
  std::string text = fmt::format("  {:<{}}", label, label_width);
  std::size_t column = text.size();
  for (std::size_t at = 0; at < words.size();) {
    std::size_t end = std::min(words.find(' ', at), words.size());
    while (words.substr(end, 4) == " +- ") end = std::min(words.find(' ', end + 4), words.size());
    if (column + 1 + end - at > line_width && column > label_width + 2) {
      text += fmt::format("\n{:{}}", "", label_width + 2);
      column = label_width + 2;
    }
    text += ' ' + words.substr(at, end - at);
    column += 1 + end - at;
    at = end + 1;
  }
  return text + '\n';
}

std::string time_or_never(const std::optional<double>& time) {
  return time ? time_text(*time) : "never";
}

// The mesh, the method, their errors by source, what they cost and what they conserve.
std::string details(const Case& input, const Result& result) {
  const Work& work = result.work;
  std::string text = "\n";
  const auto line = [&](const std::string& label, const std::string& words) {
    text += labelled(label, words);
  };
  if (!result.envelope.empty() && result.used.bends()) {
    const auto size = [](const EnvelopeRow& row) {
      return std::max(row.moment.largest.value, -row.moment.smallest.value);
    };
    const EnvelopeRow& most = *std::ranges::max_element(result.envelope, {}, size);
    line("bending",
         fmt::format("moment up to {} at {:.4g} m",
                     total_text(result, RunTotal::max_moment, size(most), {"N m"}), most.position));
  }
  line("first yield", fmt::format("section {}, contact {}; {} of {} sections have yielded",
                                  time_or_never(result.first_section_yield),
                                  time_or_never(result.first_contact_yield),
                                  result.n_yielded_sections, result.used.n_sections));
  line("model", fmt::format("{}; section {}; {}", result.used.mesh,
                            to_text(*find_case_key("model.section")->get(input)),
                            counted(result.used.n_unknowns, "unknown")));
  if (!result.choice.empty()) line("chosen because", printable(result.choice));
  if (result.error_estimate) {
    for (const auto& [name, words] : error_part_words(result)) line(name, words);
  }
  line("method", fmt::format("{}{}", to_string(input.solver.method),
                             result.used.table ? ", table " + *result.used.table : ""));
  line("conservation",
       result.max_momentum_error
           ? fmt::format("energy to {:.1e}, momentum to {:.1e}, relative", result.max_energy_error,
                         *result.max_momentum_error)
           : fmt::format(
                 "energy to {:.1e}, relative; momentum is not conserved: the supports take it up",
                 result.max_energy_error));
  line("work", fmt::format("{}, {} rejected, {}, {}; {}", counted(work.steps, "step"),
                           work.rejected_steps, counted(work.right_hand_sides, "right-hand side"),
                           counted(work.roots, "event"), duration_text(work.wall_seconds)));
  return text;
}

}  // namespace

std::string run_summary(const Case& input, const Result& result, bool verbose) {
  std::string text = (input.title.empty() ? "untitled case" : printable(input.title)) + '\n';
  const auto line = [&](const char* label, const std::string& words) {
    text += labelled(label, words);
  };
  if (const std::string caveat = outcome_caveat(result); !caveat.empty()) line("outcome", caveat);
  if (result.tolerance) line("tolerance", tolerance_words(*result.tolerance, result));
  for (const Answer& answer : answers(input, result)) {
    text += labelled(answer.name, answer.value + (answer.note.empty() ? "" : ": " + answer.note));
  }
  if (result.error_estimate && !error_of_total(result, RunTotal::impulse)) {
    line("errors", "a run beside did not complete, so errors of totals are not known");
  }
  if (result.error_estimate && result.error_estimate->finer_meshes) {
    line("finer meshes", finer_meshes_words(result));
  }
  if (result.predictability) {
    line("predictable", predictability_words(result));
    for (const Answer& answer : scatter_answers(result)) {
      text += labelled(answer.name, answer.value + ": " + answer.note);
    }
  }
  for (const std::string& warning : result.warnings) line("warning", warning);
  return verbose ? text + details(input, result) : text;
}

}  // namespace subimpact
